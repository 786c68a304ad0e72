// The grains of any moment of a run that lies on disk: from trajectory.nc or film_moments.nc where the moment
// was kept, else brought back from a checkpoint.
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "engine/files/frames/frame_archive.hpp"
#include "engine/questions/record.hpp"
#include "engine/run/replay/replay.hpp"

namespace grainreel {

class ReachableMoments {
  public:
    // threads: of the engine; 0: nothing is brought back. Throws UserError when film_moments.nc is of another
    // run. The record outlives it.
    ReachableMoments(const Record& run, int threads);

    enum class Place { trajectory, film_moments, checkpoints, nowhere };
    // touches: with the contacts of the moment.
    Place place_of(std::int64_t step, bool touches) const;

    struct Found {
        Frame frame;
        bool brought_back = false;  // then with its contacts
    };
    // From the first of these places where it is whole. Throws UserError where there is none, RunError when a
    // replay fails or the watcher stops it.
    Found at(std::int64_t step, bool touches, const ReplayWatcher& watcher);

    // Goes to a kept moment on the way to this step, if there is one, and compares the grains. Throws
    // UserError when they are others: the checkpoints are of another run. Once is enough.
    void prove(std::int64_t step, const ReplayWatcher& watcher);
    // Whether a checkpoint leads to the run's first moment, and so to all of them.
    bool brings_all_back() const;
    // The kept moment that is nearest.
    std::int64_t nearest_kept(std::int64_t step, bool touches) const;
    // Which was found not to be as it should be.
    const std::vector<std::string>& news() const { return news_; }

  private:
    void read_film_moments();
    void check_film_moments() const;
    std::optional<std::size_t> in_trajectory(std::int64_t step) const;
    Frame film_moment(std::size_t index) const;

    const Record& run_;
    std::unique_ptr<FrameArchive> film_moments_;
    std::map<std::int64_t, std::size_t> filmed_;  // places of its moments, by step
    std::optional<Replayer> replayer_;
    bool proven_ = false;  // that the replay goes the run's way
    std::vector<std::string> news_;
};

}  // namespace grainreel
