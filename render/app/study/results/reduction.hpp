// From a column of measures.csv to one number. Pure functions of times and values.
#pragma once

#include <limits>
#include <vector>

namespace grainreel {

struct Reduction {
    enum class Kind { end, mean, slope, crossing, first_passage, max, min, deviation };
    Kind kind = Kind::end;
    double from = 0, to = std::numeric_limits<double>::infinity();  // s: rows within, ends included
    double threshold = 0;                                           // SI
};

// times: s, rising; values: SI, as many. NaN where there is nothing to tell: no row in the window, a
// threshold that is not reached. Values that are NaN are left out, but the last one is the value at the end,
// NaN or not.
double reduce(const Reduction& how, const std::vector<double>& times, const std::vector<double>& values);

// The mean of rows that are all finite.
double mean_of_values(const std::vector<double>& values);
// The standard deviation of the sample, with n - 1. NaN for fewer than two values.
double deviation_of_values(const std::vector<double>& values);
// 1/s times the value's unit: sum (t - mean t) (v - mean v) / sum (t - mean t)^2, the line of least squares.
// NaN for fewer than two different times.
double slope_of(const std::vector<double>& times, const std::vector<double>& values);
// s: when the values, joined by straight lines, first come to the threshold from where they begin; the first
// time when they begin there.
double first_passage(double threshold, const std::vector<double>& times, const std::vector<double>& values);
// s: when they pass the threshold for the last time, after which they stay on the side where they end. A
// value on the threshold counts as above.
double last_crossing(double threshold, const std::vector<double>& times, const std::vector<double>& values);

}  // namespace grainreel
