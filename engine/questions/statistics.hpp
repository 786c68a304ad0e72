// Plain statistics of numbers: their mean and spread, the confidence interval of a mean, and histograms.
// Values that are not finite are left out.
#pragma once

#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

#include "engine/base/numbers.hpp"
#include "engine/questions/answer.hpp"
#include "engine/questions/snapshot.hpp"

namespace grainreel {

struct Statistics {
    std::size_t count = 0;
    double least = kUnknown, most = least, mean = least, deviation = least;
    std::size_t where_least = 0, where_most = 0;  // places in the list
};

// deviation is the standard deviation of the sample, with count - 1; NaN for fewer than two values.
inline Statistics statistics_of(const std::vector<double>& values) {
    Statistics all;
    double sum = 0;
    for (std::size_t i = 0; i < values.size(); ++i) {
        const double value = values[i];
        if (!std::isfinite(value)) continue;
        if (all.count == 0 || value < all.least) all.least = value, all.where_least = i;
        if (all.count == 0 || value > all.most) all.most = value, all.where_most = i;
        sum += value;
        ++all.count;
    }
    if (all.count == 0) return all;
    all.mean = sum / static_cast<double>(all.count);
    double squares = 0;
    for (const double value : values)
        if (std::isfinite(value)) squares += (value - all.mean) * (value - all.mean);
    if (all.count > 1) all.deviation = std::sqrt(squares / static_cast<double>(all.count - 1));
    return all;
}

// The t with P(|T| <= t) = probability for `freedom` degrees of freedom, to a relative 1e-12. 0 < probability
// < 1, freedom >= 1.
double student_t(double probability, int freedom);

// P(|T| <= t) for t >= 0, by the finite sums of Abramowitz and Stegun (1964), 26.7.3 and 26.7.4.
double student_probability(double t, int freedom);

// The mean of a sample and its confidence interval after Student (1908, Biometrika 6, 1).
struct MeanInterval {
    std::size_t count = 0;  // number of finite values
    double mean = 0;        // NaN without any
    double half = 0;        // half the width of the interval, t s / sqrt(n); NaN for fewer than two values
};

// Gives the mean and the interval of the values that are finite.
MeanInterval mean_interval(const std::vector<double>& values, double probability = 0.95);

// A histogram counts how many grains have which value of a quantity, at one moment or as a mean over several.
class Histogram {
  public:
    // column is the name of a column of grain_columns.hpp.
    explicit Histogram(std::string column) : name_(std::move(column)) {}

    // All functions throw UserError for what cannot be asked.
    void add(const Snapshot& snapshot);
    // Counts the values in `bins` equal bins, from the smallest value of all moments to the largest. Counts
    // are means over the moments.
    Answer answer(std::size_t bins) const;

    static constexpr std::size_t kMostValues = 50'000'000;  // values are kept until the bins are known

  private:
    const std::string name_;
    Dimension dimension_ = Dimension::number;
    std::vector<std::string> species_;         // names
    std::vector<std::vector<double>> values_;  // SI, one list for each species
    std::size_t moments_ = 0, count_ = 0;
};

}  // namespace grainreel
