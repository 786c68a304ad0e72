// Writes any frames as a trajectory.nc. A run uses TrajectoryWriter itself, which can also continue a file.
#include <optional>

#include "engine/base/error.hpp"
#include "engine/files/frames/frame_writer.hpp"
#include "engine/files/frames/world.hpp"
#include "engine/files/trajectory/trajectory.hpp"

namespace grainreel {

namespace {

class Trajectory final : public FrameWriter {
  public:
    explicit Trajectory(std::filesystem::path path) : path_(std::move(path)) {}

    void begin(const World& world, const FrameSupply& supply) override {
        if (!world.time_known)
            throw RunError(path_.string() +
                           ": a trajectory has times, and those of these frames are not known");
        writer_.emplace(path_, trajectory_info(world, supply));
    }
    void frame(const Frame& frame) override {
        GRAINREEL_CHECK(writer_);
        writer_->write(frame);
    }
    void end() override { writer_.reset(); }

  private:
    std::filesystem::path path_;
    std::optional<TrajectoryWriter> writer_;
};

}  // namespace

FrameFormat trajectory_format() {
    return {"netcdf", "a trajectory.nc, as runs have it; OVITO and any AMBER reader open it", ".nc",
            make_writer<Trajectory>};
}

}  // namespace grainreel
