// The moment that a question about a run means, and its snapshot: of a moment that the run kept in a file, or
// of one that is brought back, that is, computed again from the last checkpoint before it.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>

#include "engine/questions/snapshot.hpp"
#include "engine/run/stored/stored_run.hpp"

namespace grainreel {

// Which moment is meant. If none of the three values is given, it is the last moment that is kept or has a
// checkpoint.
struct MomentRequest {
    std::optional<double> at{};           // s
    std::optional<double> cycle{};        // periods of the drive
    std::optional<std::int64_t> frame{};  // number of the film's frame, from 0
    bool frame_of_file = false;           // `frame` counts the moments of an imported file, not of the film
    const char* at_option = "--at";       // option that gave `at`, for messages
    // For how many additional frames the film holds the picture of a moment (time in s). It is called with
    // rising times. Empty: each picture is one frame.
    std::function<std::int64_t(double time)> held{};
};

struct AskedMoment {
    std::int64_t step = 0;
    double time = 0;                  // s
    std::optional<std::size_t> kept;  // index in the run's kept moments; empty if it was not kept
    std::size_t nearest = 0;          // index of the nearest kept moment
    bool last = false;                // whether it is the run's last moment
};

// Finds the moment. Throws UserError, with the option's name, for a moment that the run does not have.
AskedMoment find_moment(const StoredRun& run, const MomentRequest& request);
// Whether the moment has a checkpoint of its own, so that no steps need to be computed.
bool has_checkpoint(const StoredRun& run, const AskedMoment& moment);

// The snapshot of a kept moment. with_ways: with the displacements over the last period of the drive, if the
// run kept the moment a period earlier too.
Snapshot kept_snapshot(const StoredRun& run, std::size_t index, bool with_ways = false);
// Brings a moment back from the checkpoints, with its forces. Throws UserError where no checkpoint leads
// there.
Snapshot brought_back_snapshot(StoredRun& run, const AskedMoment& moment, const ReplayWatcher& watcher);
// Does the same and adds how far grains moved in the last period of the drive (Snapshot::displacement), as
// the film counts it. Throws UserError also where the run has no drive, or does not reach back so far.
Snapshot brought_back_with_ways(StoredRun& run, const AskedMoment& moment, const ReplayWatcher& watcher);

// How far beyond the ends of a run a multiple of an interval (s) may lie, as a share of the interval.
double room_in(const StoredRun& run, double interval);

// Calls `see` with moments of the last `periods` periods of the drive before `moment`, and with `moment`
// itself. With `replay` these are kMomentsAPeriod moments for each period, brought back; without it, the
// moments that the run kept in this time. Throws UserError without a drive, and where the run does not reach
// back so far.
void see_periods(StoredRun& run, const AskedMoment& moment, double periods, bool replay,
                 const ReplayWatcher& watcher, const std::function<void(Snapshot)>& see);
constexpr int kMomentsAPeriod = 20;
// Brings back the moments at the multiples of a time (s), from the run's first moment to its last, and calls
// `see` with each. The run is computed once more from its first checkpoint. Throws UserError where no
// checkpoint leads there, where the time is shorter than a step, and where there are more than a million
// moments.
void see_every(StoredRun& run, double interval, const ReplayWatcher& watcher,
               const std::function<void(const Snapshot&)>& see);

}  // namespace grainreel
