// The numbers of one moment, by the names of their columns: a row of measures.csv, or a part of one.
#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "engine/base/error.hpp"

namespace grainreel {

class Measures {
  public:
    using Names = std::shared_ptr<const std::vector<std::string>>;

    // A value for each name.
    Measures(Names names, std::vector<double> values) : names_(std::move(names)), values_(std::move(values)) {
        GRAINREEL_CHECK(names_->size() == values_.size());
    }

    // The column must be there.
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

}  // namespace grainreel
