// The rows of measures.csv in memory, growing while others read: the engine's thread adds, the drawing one
// reads rows that are complete.
#pragma once

#include <cstddef>
#include <mutex>
#include <string>
#include <utility>
#include <vector>

#include "engine/base/error.hpp"

namespace grainreel {

class MeasureTable {
  public:
    explicit MeasureTable(std::vector<std::string> columns) : columns_(std::move(columns)) {}

    const std::vector<std::string>& columns() const { return columns_; }

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

  private:
    const std::vector<std::string> columns_;
    mutable std::mutex mutex_;
    std::vector<double> values_;  // row after row
};

}  // namespace grainreel
