// Measured values in memory: a row of measures.csv (Measures), all its rows (MeasureTable), and fields on
// grids. Code that reads, writes or draws values includes this header without the observers.
#pragma once

#include <cstddef>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "engine/base/error.hpp"
#include "engine/base/numbers.hpp"

namespace grainreel {

// The numbers of one moment, by the names of their columns: a row of measures.csv, or a part of one.
class Measures {
  public:
    using Names = std::shared_ptr<const std::vector<std::string>>;

    // `values` has one value for each name.
    Measures(Names names, std::vector<double> values) : names_(std::move(names)), values_(std::move(values)) {
        GRAINREEL_CHECK(names_->size() == values_.size());
    }

    // The column must exist.
    double at(std::string_view column) const { return values_[index_of(column)]; }
    void set(std::string_view column, double value) { values_[index_of(column)] = value; }

    const std::vector<std::string>& names() const { return *names_; }
    const std::vector<double>& values() const { return values_; }

  private:
    std::size_t index_of(std::string_view column) const {
        std::size_t index = 0;
        while (index < names_->size() && (*names_)[index] != column) ++index;
        GRAINREEL_CHECK(index < names_->size());
        return index;
    }

    Names names_;
    std::vector<double> values_;
};

// The rows of measures.csv in memory. The engine's thread adds rows while the drawing thread reads complete
// ones.
class MeasureTable {
  public:
    explicit MeasureTable(std::vector<std::string> columns) : columns_(std::move(columns)) {}

    const std::vector<std::string>& columns() const { return columns_; }
    // The number of a column; none where the table does not have it.
    std::optional<std::size_t> find(std::string_view name) const {
        for (std::size_t column = 0; column < columns_.size(); ++column)
            if (columns_[column] == name) return column;
        return std::nullopt;
    }

    void add(const std::vector<double>& row) {
        GRAINREEL_CHECK(row.size() == columns_.size());
        const std::scoped_lock lock(mutex_);
        values_.insert(values_.end(), row.begin(), row.end());
    }
    std::size_t rows() const {
        const std::scoped_lock lock(mutex_);
        return values_.size() / columns_.size();
    }
    // Values of one column in the rows from `from` to the one before `to`.
    std::vector<double> values(std::size_t column, std::size_t from, std::size_t to) const {
        GRAINREEL_CHECK(column < columns_.size());
        std::vector<double> part;
        const std::scoped_lock lock(mutex_);
        for (std::size_t row = from; row < to; ++row)
            part.push_back(values_.at(row * columns_.size() + column));
        return part;
    }
    // All values of a column; empty where the table does not have it.
    std::vector<double> all(std::string_view name) const {
        const std::optional<std::size_t> column = find(name);
        return column ? values(*column, 0, rows()) : std::vector<double>();
    }

  private:
    const std::vector<std::string> columns_;
    mutable std::mutex mutex_;
    std::vector<double> values_;  // row after row
};

// For columns at a moment when there is nothing to measure.
inline void add_no_values(std::vector<double>& row, std::size_t columns) {
    row.insert(row.end(), columns, kUnknown);
}

// Fields are values of an observer place by place, on grids that stay the same for the whole run.

// One axis of a grid. Its coordinate may be a place, a phase of the drive or a species.
struct MeasuredAxis {
    std::string name;        // "z", unique within an observer
    std::string unit;        // "m", "turns", "1"
    std::string about;       // in words: "height above the floor"
    std::vector<double> at;  // the middles of the cells, rising
};

struct FieldInfo {
    std::string name;               // name in files: "solid_fraction"
    std::string label;              // name for readers: "solid fraction"
    std::string unit;               // "1", "m/s"
    std::string about;              // in words, with the source of its formula
    std::vector<std::string> axes;  // names of its axes; the last axis runs fastest
};

// Everything that one observer gives.
struct FieldSet {
    std::vector<MeasuredAxis> axes;
    std::vector<FieldInfo> fields;
};

// The values of all fields of a set: for each field one value per cell, in the order of the field's axes; NaN
// in a cell without a value.
using FieldValues = std::vector<std::vector<double>>;

}  // namespace grainreel
