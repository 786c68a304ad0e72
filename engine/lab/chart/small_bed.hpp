// A vibrated bed of a thousand grains, small enough to be run again and again: what a step, a stiffness or a
// method changes of what one measures in it.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace grainreel {

// What of the bed is changed, as keys of its scene ("run.steps_per_contact=6").
struct BedSetting {
    std::string name;
    std::vector<std::string> sets;
};

struct BedResult {
    double height = 0;       // m, mean height over the moving floor, averaged over the second half
    double temperature = 0;  // m2/s2, mean square of the velocities about the bed's, as above
    double contacts = 0;     // force-carrying contacts a grain, as above
    double mixing = 0;       // Lacey's index of the lower half against the upper, at the end
    double cost = 0;         // ns of one thread a grain and simulated microsecond
};

// Runs `duration` seconds of the bed on one thread. Nothing when goes_on(), asked a few times a second, says
// no.
std::optional<BedResult> run_bed(const BedSetting& setting, std::uint64_t seed, double duration,
                                 const std::function<bool()>& goes_on);

// What a setting changes of the bed: the mean over its seeds, and how far that is from the reference's, in
// per cent of it; `error` is the standard error of the difference, as above.
struct BedDifference {
    std::string setting;
    int seeds = 0;
    double height = 0, height_error = 0, temperature = 0, temperature_error = 0;
    double contacts = 0, contacts_error = 0, mixing = 0, mixing_error = 0;
    double cost = 0;  // over the reference's
};
struct BedRow {
    std::string setting;
    BedResult result;
};
// In the order of the rows; `reference` is the first row's setting.
std::vector<BedDifference> bed_differences(const std::vector<BedRow>& rows);

// s, that the plan chooses for it.
double default_bed_step();

// The scene it is, for the reader of the chart.
const char* bed_scene();

}  // namespace grainreel
