// Whether a measured column is steady: where its transient ends, and whether it drifts after that.
//
// There are two questions with one test each, and before them a third: do the rows tell enough? All see means
// of batches, and a batch is m rows in succession. MSER-m (marginal standard error rule) finds where the
// transient ends. It drops batches at the front. Their number is the one for which the mean of the rest has
// the least standard error (White, Simulation 69, 1997; White, Cobb and Spratt, Proc. Winter Simulation
// Conf., 2000). It needs no parameter and is hard to mislead. The Mann-Kendall test decides whether the rest
// drifts (Mann, Econometrica 13, 1945; Kendall, Rank Correlation Methods, 1975). It looks for a trend of any
// shape and assumes no distribution. The size of the drift is the slope of Sen (J. Am. Stat. Assoc. 63,
// 1968). The test and the interval of the mean assume independent values, so they get means of long batches.
// In a run of few correlation times these means hang together too, and then the interval is too narrow and
// the test sees drifts everywhere. So the answer is "too short" where the rows are worth less than
// kLeastIndependent independent values, or where the lag-1 correlation of the long batches is not small (Law
// and Carson, Oper. Res. 27, 1979). Geweke's test (1992) would answer both questions with one number, but it
// needs spectral estimates that short series do not give.
#pragma once

#include <cstddef>
#include <memory>
#include <string>
#include <vector>

#include "engine/base/numbers.hpp"
#include "engine/measure/measures.hpp"
#include "engine/questions/answer.hpp"
#include "engine/scene/scene.hpp"

namespace grainreel {

class StoredRun;  // engine/run/stored/stored_run.hpp

constexpr std::size_t kRowsWithoutDrive = 5;                  // rows in a batch of MSER, without a drive
constexpr std::size_t kLeastBatches = 10, kMostBatches = 20;  // batches in the test of drift
constexpr double kSignificance = 0.05;                        // level of the test of drift, two-sided
// Least number of independent values that the rows behind the transient must be worth. A series of first
// order and T correlation times is worth T / 2; from about 70 on, 95 % intervals hold the mean in 92 % to 95
// %.
constexpr double kLeastIndependent = 36;

struct Steadiness {
    enum class Verdict { steady, drifts, too_short };
    Verdict verdict = Verdict::too_short;
    double from = kUnknown;   // s, where the transient ends
    std::size_t batches = 0;  // number of all batches; each has the rows of a period, or kRowsWithoutDrive
    std::size_t dropped = 0;  // batches dropped at the front
    std::size_t tested = 0;   // number of means in the test of drift
    double independent = 0;   // how many independent values the rows behind the transient are worth
    double correlation = 0;   // lag-1 correlation of the means in the test of drift
    // Mean after the transient, and half the width of its 95 % interval (Student's t of the tested means,
    // wider by what is left of their correlation).
    double mean = kUnknown, half_width = mean;
    double slope = mean;  // Sen's slope, the value's unit per s
    // Kendall's tau, and the probability of this |tau| or a larger one if there is no trend.
    double tau = mean, p = mean;
};

// `times` (s) rise, and there are as many `values`; rows whose value is not finite are left out. `period`
// (s) is the drive's; the rows of one period make a batch. It is 0 without a drive.
Steadiness steadiness_of(const std::vector<double>& times, const std::vector<double>& values, double period);

// The number of batches that MSER drops. If the least error lies in the second half, the transient is not
// over, and the number is that of all batches. Otherwise it is at most half of them.
std::size_t mser_truncation(const std::vector<double>& batch_means);

// The number of independent values that would give a mean of the same error: n (1 - r) / (1 + r) for n values
// with the lag-1 correlation r of an autoregressive process of first order. A straight line is taken from the
// values first. Its slope and their mean make r too small, by (2 + 4 r) / n (Kendall, Biometrika 41, 1954);
// this is added again.
double independent_values(const std::vector<double>& values);

// The mean of all rows, or the slope of the line of least squares (per s), with half the width of its 95 %
// interval. The half is NaN where the rows tell too little for one; then `why` says what is lacking.
struct Estimate {
    double value = kUnknown, half_width = value;
    std::size_t rows = 0, batches = 0;
    double independent = 0;  // how many independent values the rows are worth; a slope has none
    std::string why;
};

// The mean, whose interval comes from means of long batches by the rules of steadiness_of(). Nothing is left
// out as a transient.
Estimate mean_estimate(const std::vector<double>& times, const std::vector<double>& values, double period);

// The slope. Its interval comes from the slopes between the ends of batches: of what is summed up, as mass
// that flows out, these are nearly independent. They are wider by what is left of their correlation, and by
// the factor sqrt(6/5) by which a line of least squares through a random walk errs more than the line through
// its ends.
Estimate slope_estimate(const std::vector<double>& times, const std::vector<double>& values);

struct MannKendall {
    double s = 0, tau = 0, z = 0, p = 1;
};
// The Mann-Kendall test, corrected for ties and for continuity.
MannKendall mann_kendall(const std::vector<double>& values);

// The run's measures.csv, which has the columns time_s and that one. Throws UserError where it has not.
std::shared_ptr<const MeasureTable> table_with(const StoredRun& run, const std::string& column);
// The period of a drive that never changes, in s; 0 for another or none.
double steady_period(const Scene& scene);
Dimension dimension_of_column(const Scene& scene, const std::string& column);

// Tests a column of a run's measures.csv. Throws UserError where there is no such file or column.
Answer steady_answer(const StoredRun& run, const std::string& column);

}  // namespace grainreel
