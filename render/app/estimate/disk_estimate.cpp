#include "render/app/estimate/disk_estimate.hpp"

#include <algorithm>

#include "engine/run/driver/run_files.hpp"
#include "engine/run/replay/checkpoint_ring.hpp"
#include "render/film/sampling/film_limits.hpp"
#include "render/scene/filmed_scene.hpp"

namespace grainreel {
namespace {

// A grain and frame: id, type, radius, x in double, v, spin, contact number.
constexpr double trajectory_bytes = 68;
constexpr double orientation_bytes = 16;
constexpr double measures_bytes = 400;     // a row
constexpr double checkpoint_bytes = 1300;  // a grain: lists and histories
constexpr double end_state_bytes =
    1500;  // a grain: its row of final.csv, and lists and histories of the checkpoint

// every: steps from one to the next, not always a whole number.
std::int64_t moments(std::int64_t steps, double every) {
    return static_cast<std::int64_t>(static_cast<double>(steps) / every) + 1;
}

}  // namespace

DiskEstimate estimate_disk(const FilmedScene& scene, const Plan& plan, std::int64_t pictures) {
    const auto grains = static_cast<double>(scene.grains());
    DiskEstimate disk;
    if (plan.trajectory_every > 0) {
        disk.trajectory_frames = moments(plan.steps, plan.trajectory_every);
        disk.trajectory = static_cast<double>(disk.trajectory_frames) * grains *
                          (trajectory_bytes + (scene.keeps_orientations() ? orientation_bytes : 0));
    }
    disk.measures_rows = moments(plan.steps, plan.measures_every);
    disk.measures = static_cast<double>(disk.measures_rows) * measures_bytes;
    if (pictures > 0) disk.film = estimated_film_size(scene.film, pictures);
    disk.film_moments = film_moments_bytes(scene, plan, pictures);
    if (scene.output.checkpoints)
        disk.checkpoints = std::min(static_cast<double>(*scene.output.checkpoints),
                                    static_cast<double>(CheckpointRing::kMost) * grains * checkpoint_bytes);
    disk.end_state = grains * end_state_bytes;
    return disk;
}

}  // namespace grainreel
