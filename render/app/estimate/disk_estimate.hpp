// What a run will leave on disk.
#pragma once

#include <cstdint>

#include "engine/plan/plan.hpp"
#include "render/scene/filmed_scene.hpp"

namespace grainreel {

struct DiskEstimate {
    std::int64_t trajectory_frames = 0, measures_rows = 0;
    double trajectory = 0, measures = 0, film = 0;  // bytes
    double film_moments = 0, checkpoints = 0;       // as above
    double end_state = 0;                           // of checkpoint and final.csv

    double all() const { return trajectory + measures + film + film_moments + checkpoints + end_state; }
};

// pictures: of the film; 0 without one.
DiskEstimate estimate_disk(const FilmedScene& scene, const Plan& plan, std::int64_t pictures);

}  // namespace grainreel
