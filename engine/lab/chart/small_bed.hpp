// A vibrated bed of a thousand grains, small enough to be run many times. It shows how a step, a stiffness or
// a method changes what is measured in a bed.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace grainreel {

// What is changed in the bed, as keys of its scene ("run.steps_per_contact=6").
struct BedSetting {
    std::string name;
    std::vector<std::string> sets;
};

// accuracy.cpp fills it from the columns of bed.csv in this order.
struct BedResult {
    // Height, temperature and contacts are means over the second half of the run.
    double height = 0;       // m, mean height of the grains above the moving floor
    double temperature = 0;  // m2/s2, a third of the mean square of velocities relative to the bed's mean
    double contacts = 0;     // number of contacts of a grain that carry force
    double mixing = 0;       // Lacey's index of the lower half and the upper half, at the end
    double cost = 0;         // ns of one thread for each grain and each simulated microsecond
};

// Runs `duration` seconds of the bed on one thread. Returns nothing when goes_on(), asked every
// eighth of a period, returned false.
std::optional<BedResult> run_bed(const BedSetting& setting, std::uint64_t seed, double duration,
                                 const std::function<bool()>& goes_on);

// How a setting changes the bed: the mean over the seeds minus that of the reference, in per cent of the
// reference. Each `_error` is the standard error of the difference, also in per cent; in the reference's own
// row it is that of its mean.
struct BedDifference {
    std::string setting;
    int seeds = 0;
    double height = 0, height_error = 0, temperature = 0, temperature_error = 0;
    double contacts = 0, contacts_error = 0, mixing = 0, mixing_error = 0;
    double cost = 0;  // divided by the reference's
};
struct BedRow {
    std::string setting;
    BedResult result;
};
// Differences in the order of the rows; the reference is the setting of the first row.
std::vector<BedDifference> bed_differences(const std::vector<BedRow>& rows);

// The step (s) that the plan chooses for this bed.
double default_bed_step();

// The scene of the bed, for readers of the chart.
const char* bed_scene();

}  // namespace grainreel
