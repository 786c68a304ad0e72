// A run on disk about which questions are asked: its frames, their scene and, for a run of grainreel, its
// checkpoints. From a checkpoint the engine can compute moments that were not kept, and forces. Nothing here
// changes a file.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "engine/base/clock.hpp"
#include "engine/files/frames/frame_archive.hpp"
#include "engine/files/frames/run_archive.hpp"
#include "engine/run/replay/replay.hpp"
#include "engine/scene/scene.hpp"

namespace grainreel {

struct Snapshot;  // engine/questions/snapshot.hpp

class AskedRun {
  public:
    // Takes the archive's own scene; where it has none, makes one from the world that the frames describe.
    explicit AskedRun(std::shared_ptr<const FrameArchive> frames);
    // Opens the run's folder.
    explicit AskedRun(std::shared_ptr<const RunArchive> run);
    virtual ~AskedRun() = default;
    AskedRun(const AskedRun&) = delete;
    AskedRun& operator=(const AskedRun&) = delete;

    const FrameArchive& frames() const { return *frames_; }
    const Scene& scene() const { return scene_; }
    const Clock& clock() const { return clock_; }
    const std::vector<Frame>& moments() const { return frames_->moments(); }
    double from() const { return moments().front().time; }  // s
    double to() const { return moments().back().time; }

    // Checkpoints by rising step.
    std::vector<KeptCheckpoint> checkpoints() const { return own().kept; }
    // Names the checkpoints that are not used, and says why: they belong to another run, or are damaged.
    std::vector<std::string> checkpoint_news() const { return own().news; }
    // Damage of the files beside the checkpoints, because of which less can be answered.
    std::vector<std::string> faults() const;
    std::vector<std::string> news() const { return frames_->news(); }

    virtual Frame frame(std::size_t index) const;  // a kept moment
    // Adds what was kept beside the grains of that moment.
    virtual void add_kept(std::size_t index, Snapshot& snapshot) const;
    virtual std::optional<MeasuredRow> measured_near(std::size_t index) const {
        return frames_->measured_near(index);
    }

  private:
    const OwnCheckpoints& own() const;

    std::shared_ptr<const FrameArchive> frames_;
    const RunArchive* run_ = nullptr;
    Scene scene_;
    Clock clock_;
    mutable std::optional<OwnCheckpoints> own_;  // set when they are first asked for
};

// A checkpoint alone, asked as a run of one moment. The engine restores its state, so all that the run
// measured is known. Throws UserError where the file cannot be used.
class RestoredCheckpoint final : public AskedRun {
  public:
    explicit RestoredCheckpoint(const std::filesystem::path& file);

    Frame frame(std::size_t) const override { return restored_.frame; }
    std::optional<MeasuredRow> measured_near(std::size_t) const override { return restored_.measured; }

  private:
    struct Restored {
        Frame frame;
        MeasuredRow measured;
    };
    static Restored restore(const std::filesystem::path& file);
    RestoredCheckpoint(const std::filesystem::path& file, Restored restored);

    Restored restored_;
};

// The grains of any moment of a run on disk: from trajectory.nc or film_moments.nc where the moment was
// kept, else brought back from a checkpoint.

class ReachableMoments {
  public:
    // `threads` is the number of the engine's threads; with 0 nothing is brought back. Throws UserError
    // when film_moments.nc belongs to another run. The run must outlive this object.
    ReachableMoments(const AskedRun& run, int threads);

    enum class Place { trajectory, film_moments, checkpoints, nowhere };
    // Where a moment can be found. touches: the contacts of the moment are wanted too.
    Place place_of(std::int64_t step, bool touches) const;

    struct Found {
        Frame frame;
        bool brought_back = false;
        std::vector<Touch> touches{};  // if they are wanted, and the moment was brought back
    };
    // Takes the moment from the first of these places that is undamaged. Throws UserError where there is
    // none, and RunError when a replay fails or the watcher stops it.
    Found at(std::int64_t step, bool touches, const ReplayWatcher& watcher);

    // Replays to a kept moment on the way to this step, if there is one, and compares the grains. Throws
    // UserError when they differ: then the checkpoints belong to another run. Only the first call compares.
    void prove(std::int64_t step, const ReplayWatcher& watcher);
    // Whether a checkpoint leads to the run's first moment, and so to all of them.
    bool brings_all_back() const;
    // The step of the nearest kept moment.
    std::int64_t nearest_kept(std::int64_t step, bool touches) const;
    // What was found damaged or wrong so far.
    const std::vector<std::string>& news() const { return news_; }

  private:
    void read_film_moments();
    void check_film_moments() const;
    std::optional<std::size_t> in_trajectory(std::int64_t step) const;
    Frame film_moment(std::size_t index) const;

    const AskedRun& run_;
    std::unique_ptr<FrameArchive> film_moments_;
    std::map<std::int64_t, std::size_t> filmed_;  // place in film_moments.nc, by step
    std::optional<Replayer> replayer_;
    bool proven_ = false;  // whether prove() has compared a replay with a kept moment
    std::vector<std::string> news_;
};

}  // namespace grainreel
