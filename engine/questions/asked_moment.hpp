// The moment that a question to a run is put to: one that the run kept, or one that is brought back.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>

#include "engine/questions/asked_run.hpp"
#include "engine/questions/snapshot.hpp"
#include "engine/run/replay/replay.hpp"

namespace grainreel {

// Which one is meant; none of the three: the last that there is, kept or in a checkpoint.
struct MomentRequest {
    std::optional<double> at{};           // s
    std::optional<double> cycle{};        // periods of the drive
    std::optional<std::int64_t> frame{};  // of the film, from 0
    bool frame_of_file = false;      // frame counts the moments of an imported file in place of the film's
    const char* at_option = "--at";  // where `at` comes from, for messages
    // How many frames more the film shows the picture of a moment (s; they come by rising time); none: each
    // picture is one frame.
    std::function<std::int64_t(double time)> held{};
};

struct AskedMoment {
    std::int64_t step = 0;
    double time = 0;                  // s
    std::optional<std::size_t> kept;  // its place in the run's moments, where it was kept
    std::size_t nearest = 0;          // the kept moment that is nearest
    bool last = false;                // the run has none after it
};

class MomentFinder {
  public:
    explicit MomentFinder(const AskedRun& run) : run_(run) {}

    // Throws UserError for a moment that the run does not have, with the option's name.
    AskedMoment find(const MomentRequest& request) const;
    // As it was kept.
    Snapshot kept(std::size_t index) const;
    // From the checkpoints, with its forces. Throws UserError where none of them leads there.
    Snapshot brought_back(const AskedMoment& moment, const ReplayWatcher& watcher);
    // The same with ways over the last period of the drive (Frame::displacement): per period, as the film
    // counts them. Throws UserError too where the run has no drive, or does not reach back so far.
    Snapshot brought_back_with_ways(const AskedMoment& moment, const ReplayWatcher& watcher);
    // kMomentsAPeriod moments for each of so many periods of the drive, the last of them at the moment;
    // brought back, or, where `replay` says not to, all that were kept meanwhile. Throws UserError without a
    // drive, and where the run does not reach back so far.
    void over_periods(const AskedMoment& moment, double periods, bool replay, const ReplayWatcher& watcher,
                      const std::function<void(Snapshot)>& see);
    static constexpr int kMomentsAPeriod = 20;
    // The moments at the multiples of a time (s) from the run's first moment to its last, brought back. The
    // run is computed once more, from its first checkpoint. Throws UserError where it has none from there,
    // where the time is shorter than a step, and where there are more than a million.
    void at_every(double interval, const ReplayWatcher& watcher,
                  const std::function<void(const Snapshot&)>& see);
    // Whether there is a checkpoint of the moment, or before it.
    bool can_bring_back(const AskedMoment& moment) const;
    // Whether the moment is that of a checkpoint, so that it comes back at once.
    bool is_checkpoint(const AskedMoment& moment) const;

  private:
    AskedMoment kept_frame(std::int64_t frame, const std::string& name) const;
    void check_can_bring_back(const AskedMoment& moment) const;
    std::int64_t step_of_frame(const MomentRequest& request) const;
    double last_time() const;
    AskedMoment last() const;

    const AskedRun& run_;
};

}  // namespace grainreel
