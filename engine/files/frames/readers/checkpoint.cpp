// Reads a checkpoint as one frame: its grains and its scene. The state of the step loop is not read, so no
// laws are needed. Forces and measures of that moment can be had only by restoring the run.

#include "engine/base/error.hpp"
#include "engine/base/numbers.hpp"
#include "engine/files/damage.hpp"
#include "engine/files/frames/saved_scene.hpp"
#include "engine/files/frames/state_archive.hpp"
#include "engine/state/body.hpp"
#include "engine/state/checkpoint_file.hpp"
#include "engine/state/container_faces.hpp"
#include "engine/state/drive_motion.hpp"

namespace grainreel {

namespace {

namespace fs = std::filesystem;

[[noreturn]] void damaged(const fs::path& file) {
    throw UserError("{}: is damaged; take another checkpoint", file.string());
}

CheckpointFile whole_file(const fs::path& path) {
    CheckpointFile file(path);
    switch (file.fault()) {
        case CheckpointFile::Fault::unreadable:
            throw UserError("{}: cannot be read; give the checkpoint.grs of a run", path.string());
        case CheckpointFile::Fault::other_version:
            throw UserError(
                "{}: is a checkpoint of another version of grainreel; give the final.csv beside it",
                path.string());
        case CheckpointFile::Fault::damaged:
            damaged(path);
        case CheckpointFile::Fault::none:
            break;
    }
    return file;
}

// The grains by rising id, as in all frames, with x within the period along the depth (0: not periodic).
State frame_of(const Grains& grains, double period) {
    State frame;
    frame.id = grains.id;
    frame.species = grains.species;
    frame.orientation = grains.orientation;
    for (std::size_t i = 0; i < grains.size(); ++i) {
        frame.radius.push_back(grains.place[i].radius);
        Vec3 position = grains.place[i].position;
        position.x() = wrapped(position.x(), period);
        frame.position.push_back(position);
        frame.velocity.push_back(grains.motion[i].velocity);
        frame.spin.push_back(grains.motion[i].spin);
    }
    return sorted_by_id(frame);
}

class Checkpoint final : public StateArchive {
  public:
    explicit Checkpoint(const fs::path& path)
        : path_(path), scene_(scene_of_checkpoint(path)), world_(world_of(scene_)) {
        scene_.name = path.stem().string();
        const CheckpointFile file = whole_file(path);
        frame_ = frame_of(file.grains, period_of_depth(scene_.container));
        const Clock clock = clock_of_steps(scene_, scene_.run.step.value_or(0));
        frame_.step = file.header.step;
        frame_.time = clock.time(frame_.step);
        frame_.cycles = clock.cycles(frame_.step);
        frame_.phase = clock.phase(frame_.step);
        frame_.bodies = poses_of(bodies_of(scene_), DriveMotion(scene_.drive, clock).at(frame_.step));
        if (moment_fault(frame_) || grains_fault(frame_, scene_.species.size())) damaged(path);
        moments_ = {moment_of(frame_)};
        world_.most_grains = frame_.size();
    }

    const fs::path& path() const override { return path_; }
    const StoredWorld& world() const override { return world_; }
    StateSupply supply() const override {
        StateSupply supply;
        supply.orientations = !frame_.orientation.empty();
        return supply;
    }
    const std::vector<State>& moments() const override { return moments_; }
    State grains(std::size_t) const override { return frame_; }
    const Scene* scene() const override { return &scene_; }

  private:
    fs::path path_;
    Scene scene_;
    StoredWorld world_;
    State frame_;
    std::vector<State> moments_;
};

bool takes(const FileStart& head) {
    return !head.folder && begins_checkpoint(head.bytes);
}

std::unique_ptr<StateArchive> open(const fs::path& path, const OpenRequest&) {
    return std::make_unique<Checkpoint>(path);
}

}  // namespace

ReadFormat checkpoint_reader() {
    return {"checkpoint", "a checkpoint (checkpoint.grs)", takes, open};
}

}  // namespace grainreel
