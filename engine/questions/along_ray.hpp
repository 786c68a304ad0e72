// What lies along a ray through a moment: which grains, and which wall behind them.
#pragma once

#include <cstdint>
#include <vector>

#include "engine/questions/answer.hpp"
#include "engine/questions/ray.hpp"
#include "engine/questions/snapshot.hpp"

namespace grainreel {

// How the moment is looked at.
struct AlongRay {
    std::vector<KeptHalf> kept;              // of a cut
    std::vector<std::int32_t> seen_through;  // species that hide nothing
};

// shown: the grains of the snapshot where they are seen. The nearest first; through: what lies behind, too.
Answer along_ray_answer(const Snapshot& snapshot, const Frame& shown, const Ray& ray, const AlongRay& along,
                        bool through);

}  // namespace grainreel
