// Reduces a column of measures.csv to one number. All are pure functions of times and values.
#pragma once

#include <limits>
#include <vector>

namespace grainreel {

struct Reduction {
    enum class Kind { end, mean, slope, crossing, first_passage, max, min, deviation };
    Kind kind = Kind::end;
    double from = 0,
           to = std::numeric_limits<double>::infinity();  // s; rows within this window count, ends included
    double threshold = 0;                                 // SI
};

// times: s, rising. values: SI units, as many. The result is NaN when there is none: no row lies in the
// window, or the threshold is not reached. Values that are NaN are left out; only for the value at the end
// the last one counts even if it is NaN.
double reduce(const Reduction& how, const std::vector<double>& times, const std::vector<double>& values);

// The mean of rows that are all finite.
double mean_of_values(const std::vector<double>& values);
// The standard deviation of the sample, with n - 1. NaN for fewer than two values.
double deviation_of_values(const std::vector<double>& values);
// The slope of the line of least squares, in 1/s times the value's unit: sum (t - mean t) (v - mean v) / sum
// (t - mean t)^2. NaN for fewer than two different times.
double slope_of(const std::vector<double>& times, const std::vector<double>& values);
// The time in s at which the values, joined by straight lines, first reach the threshold. It is the first
// time when they begin at the threshold.
double first_passage(double threshold, const std::vector<double>& times, const std::vector<double>& values);
// The time in s at which the values cross the threshold for the last time; afterwards they stay on the side
// where they end. A value on the threshold counts as above it.
double last_crossing(double threshold, const std::vector<double>& times, const std::vector<double>& values);

}  // namespace grainreel
