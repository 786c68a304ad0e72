#include "engine/questions/record.hpp"

#include <utility>

#include "engine/files/frames/open_frames.hpp"
#include "engine/files/frames/saved_scene.hpp"
#include "engine/run/replay/replay.hpp"
#include "engine/state/checkpoint_file.hpp"

namespace grainreel {

namespace {

namespace fs = std::filesystem;

// A single moment tells the step only roughly; the scene's is exact.
Clock clock_of_frames(const Scene& scene, const FrameArchive& frames) {
    Clock clock = clock_of(scene, frames.moments());
    if (scene.run.step) clock.step = *scene.run.step;
    return clock;
}

}  // namespace

Record::Record(std::shared_ptr<const FrameArchive> frames)
    : frames_(std::move(frames)),
      scene_(frames_->scene() ? *frames_->scene() : scene_of(frames_->world())),
      clock_(clock_of_frames(scene_, *frames_)) {}

Record::Record(std::shared_ptr<const RunArchive> run)
    : frames_(run), run_(run.get()), scene_(*run->scene()), clock_(run->clock()) {}

std::vector<std::string> Record::faults() const {
    return run_ ? run_->faults() : std::vector<std::string>();
}

const OwnCheckpoints& Record::own() const {
    if (own_) return *own_;
    own_.emplace();
    std::error_code error;
    const fs::path& path = frames_->path();
    if (run_)
        own_ = own_checkpoints(path, scene_);
    else if (is_checkpoint(path))
        own_->kept = {{moments().front().step, path, fs::file_size(path, error)}};
    return *own_;
}

Frame Record::frame(std::size_t index) const {
    Frame frame = frames_->grains(index);
    if (std::optional<std::vector<Touch>> touches = frames_->touches(index))
        frame.touches = std::move(*touches);
    return frame;
}

RestoredCheckpoint::RestoredCheckpoint(const fs::path& file) : RestoredCheckpoint(file, restore(file)) {}

RestoredCheckpoint::RestoredCheckpoint(const fs::path& file, Restored restored)
    : Record(std::shared_ptr<const FrameArchive>(open_frames(file, {.format = "checkpoint"}))),
      restored_(std::move(restored)) {}

RestoredCheckpoint::Restored RestoredCheckpoint::restore(const fs::path& file) {
    const Simulation run = run_of_checkpoint(file, 1);
    Frame frame = run.frame();
    MeasuredRow measured{frame.time, run.measured(), run.measures().values()};
    return {std::move(frame), std::move(measured)};
}

}  // namespace grainreel
