// Whether a measured column is steady: where its transient ends, and whether it drifts behind that.
//
// Two questions, one test each. Where the transient ends: MSER-m, which drops so many batches at the front
// that the squared standard error of the mean of the rest is least (White, Simulation 69, 1997; White, Cobb
// and Spratt, Proc. Winter Simulation Conf., 2000). It needs no parameter and is hard to mislead. Whether the
// rest drifts: the Mann-Kendall test (Mann, Econometrica 13, 1945; Kendall, Rank Correlation Methods, 1975),
// which asks for a trend of any shape and assumes no distribution, with the slope of Sen (J. Am. Stat. Assoc.
// 63, 1968). It assumes independent values, so it sees means of long batches. Geweke's test (1992) would
// answer both with one number, but it needs spectral estimates that short series do not give.
#pragma once

#include <cstddef>
#include <filesystem>
#include <limits>
#include <string>
#include <vector>

#include "engine/questions/answer.hpp"
#include "engine/scene/scene.hpp"

namespace grainreel {

constexpr std::size_t kRowsWithoutDrive = 5;                  // of a batch of MSER
constexpr std::size_t kLeastBatches = 10, kMostBatches = 20;  // of the test of drift
constexpr double kSignificance = 0.05;                        // of the test of drift, on both sides

struct Steadiness {
    enum class Verdict { steady, drifts, too_short };
    Verdict verdict = Verdict::too_short;
    double from = std::numeric_limits<double>::quiet_NaN();  // s: where the rest begins
    std::size_t batches = 0;  // in all, of the rows of a period, or of kRowsWithoutDrive
    std::size_t dropped = 0;  // of these, at the front
    std::size_t tested = 0;   // means that the test of drift saw
    // Mean of the rest, and half the width of its 95 % interval (Student's t over the means tested).
    double mean = std::numeric_limits<double>::quiet_NaN(), half_width = mean;
    double slope = mean;          // Sen's, 1/s times the value's unit
    double tau = mean, p = mean;  // Kendall's tau, and the probability of one as large without a trend
};

// times: s, rising; values: as many; those that are not finite are left out with their rows. period: s, of
// the drive, whose rows make a batch; 0 without a drive.
Steadiness steadiness_of(const std::vector<double>& times, const std::vector<double>& values, double period);

// Batches that MSER drops: at most half of them, or all, where the least error lies in the second half and
// so the transient is not over.
std::size_t mser_truncation(const std::vector<double>& batch_means);

struct MannKendall {
    double s = 0, tau = 0, z = 0, p = 1;
};
// With the correction for ties, and for continuity.
MannKendall mann_kendall(const std::vector<double>& values);

// Tests a column of a run's measures.csv. Throws UserError where there is no such file or column.
Answer steady_answer(const std::filesystem::path& run, const Scene& scene, const std::string& column);

}  // namespace grainreel
