// Writes any frames as a trajectory.nc. A run uses TrajectoryWriter itself, which can also continue a file.
//
// The header says how many places for grains there are. If the world does not know how many are needed, the
// first frame tells it. A frame that needs more makes the file anew.
#include <algorithm>
#include <iterator>
#include <optional>
#include <system_error>
#include <vector>

#include "engine/base/error.hpp"
#include "engine/files/frames/state_writer.hpp"
#include "engine/files/frames/stored_world.hpp"
#include "engine/files/trajectory/trajectory.hpp"

namespace grainreel {

namespace {

class Trajectory final : public StateWriter {
  public:
    explicit Trajectory(std::filesystem::path path) : path_(std::move(path)) {}

    void begin(const StoredWorld& world, const StateSupply& supply) override {
        if (!world.time_known)
            throw RunError(path_.string() +
                           ": a trajectory has times, and those of these frames are not known");
        info_ = trajectory_info(world, supply);
        if (info_.capacity > 0) writer_.emplace(path_, info_);
    }
    void cell(const std::optional<WorldCell>& now) override {
        if (!now) return;
        info_.cell = trajectory_cell(*now);
        if (writer_) writer_->set_cell(info_.cell);
    }
    void frame(const State& frame, const std::vector<Link>&) override {
        count(frame);
        if (!writer_) {
            info_.capacity = std::max<std::size_t>(1, most_);
            writer_.emplace(path_, info_);
        }
        if (most_ > info_.capacity) {
            make_again(std::max(most_, info_.capacity + info_.capacity / 4));
            grown_ = true;
        }
        writer_->write(frame);
    }
    void end() override {
        if (grown_ && most_ < info_.capacity) make_again(most_);
        writer_.reset();
    }

  private:
    // In a file with traffic each grain that ever was there keeps its place.
    void count(const State& frame) {
        most_ = std::max(most_, frame.size());
        if (!info_.traffic || std::includes(seen_.begin(), seen_.end(), frame.id.begin(), frame.id.end()))
            return;
        std::vector<std::int32_t> all;
        std::set_union(seen_.begin(), seen_.end(), frame.id.begin(), frame.id.end(), std::back_inserter(all));
        seen_ = std::move(all);
        most_ = seen_.size();
    }
    // Makes the file anew with that many places. If this fails, the file and its frames stay as they were.
    void make_again(std::size_t capacity) {
        const auto frames = static_cast<std::size_t>(writer_->frames());
        writer_.reset();
        std::filesystem::path other = path_;
        other += ".again";
        TrajectoryInfo info = info_;
        info.capacity = capacity;
        try {
            TrajectoryWriter::write_again(path_, frames, other, info);
            std::error_code error;
            std::filesystem::rename(other, path_, error);
            if (error)
                throw RunError("{}: cannot be made anew with more places for grains: {}", path_.string(),
                               error.message());
            info_ = info;
        } catch (...) {
            std::error_code ignored;
            std::filesystem::remove(other, ignored);
            writer_.emplace(path_, info_, frames);
            throw;
        }
        writer_.emplace(path_, info_, frames);
    }

    std::filesystem::path path_;
    TrajectoryInfo info_;
    std::optional<TrajectoryWriter> writer_;
    std::size_t most_ = 0;            // places that the frames so far need
    std::vector<std::int32_t> seen_;  // with traffic: the ids of all grains so far
    bool grown_ = false;
};

}  // namespace

WriteFormat trajectory_format() {
    return {"netcdf", "a trajectory.nc, as runs have it: AMBER NetCDF in SI units; OVITO and ASE open it",
            ".nc", make_writer<Trajectory>};
}

}  // namespace grainreel
