// What lies on disk and can be asked questions: frames, the scene that they are of, and, where it is a run of
// ours, checkpoints from which its other moments and its forces are brought back.
#pragma once

#include <cstddef>
#include <filesystem>
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

class Record {
  public:
    // With the archive's own scene; where it has none, with one made of its world.
    explicit Record(std::shared_ptr<const FrameArchive> frames);
    // The run's folder.
    explicit Record(std::shared_ptr<const RunArchive> run);
    virtual ~Record() = default;
    Record(const Record&) = delete;
    Record& operator=(const Record&) = delete;

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
class RestoredCheckpoint final : public Record {
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

}  // namespace grainreel
