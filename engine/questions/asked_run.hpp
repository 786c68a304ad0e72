// What lies on disk and can be asked questions: frames, their scene and, for a run of ours, checkpoints. A
// checkpoint brings back moments that were not kept, and forces. Nothing here changes a file.
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

class AskedRun {
  public:
    // With the archive's own scene; where it has none, with one made of its world.
    explicit AskedRun(std::shared_ptr<const FrameArchive> frames);
    // The run's folder.
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

    // By rising step.
    std::vector<KeptCheckpoint> checkpoints() const { return own().kept; }
    // Names the checkpoints that are passed over, and why: they are of another run, or damaged.
    std::vector<std::string> checkpoint_news() const { return own().news; }
    // Damage of the files beside the checkpoints, which makes answers poorer than the run was.
    std::vector<std::string> faults() const;
    std::vector<std::string> news() const { return frames_->news(); }

    // A moment with all that is known of it.
    virtual Frame frame(std::size_t index) const;
    virtual std::optional<MeasuredRow> measured_near(std::size_t index) const {
        return frames_->measured_near(index);
    }

  private:
    const OwnCheckpoints& own() const;

    std::shared_ptr<const FrameArchive> frames_;
    const RunArchive* run_ = nullptr;
    Scene scene_;
    Clock clock_;
    mutable std::optional<OwnCheckpoints> own_;  // once they were asked for
};

// A checkpoint that was restored, so that all that it measured is known. Throws UserError where it cannot be
// used.
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

// The grains of any moment of a run that lies on disk: from trajectory.nc or film_moments.nc where the moment
// was kept, else brought back from a checkpoint.

class ReachableMoments {
  public:
    // threads: of the engine; 0: nothing is brought back. Throws UserError when film_moments.nc is of another
    // run. The run outlives it.
    ReachableMoments(const AskedRun& run, int threads);

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

    const AskedRun& run_;
    std::unique_ptr<FrameArchive> film_moments_;
    std::map<std::int64_t, std::size_t> filmed_;  // places of its moments, by step
    std::optional<Replayer> replayer_;
    bool proven_ = false;  // that the replay goes the run's way
    std::vector<std::string> news_;
};

}  // namespace grainreel
