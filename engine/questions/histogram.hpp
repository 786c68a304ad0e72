// How many grains have which value of a quantity, at one moment or as a mean over several.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "engine/questions/answer.hpp"
#include "engine/questions/snapshot.hpp"

namespace grainreel {

class Histogram {
  public:
    // A column of grain_columns.hpp.
    explicit Histogram(std::string column) : name_(std::move(column)) {}

    // All throw UserError for what cannot be asked.
    void add(const Snapshot& snapshot);
    // In so many equal bins from the smallest value of all moments to the largest. Counts are means over the
    // moments.
    Answer answer(std::size_t bins) const;

    static constexpr std::size_t kMostValues = 50'000'000;  // kept until the bins are known

  private:
    const std::string name_;
    Dimension dimension_ = Dimension::number;
    std::vector<std::string> species_;         // names
    std::vector<std::vector<double>> values_;  // SI, of each species
    std::size_t moments_ = 0, count_ = 0;
};

}  // namespace grainreel
