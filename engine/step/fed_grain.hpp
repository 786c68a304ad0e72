// The grains that feeds give: which one comes as a feed's n-th is settled by the scene and its seed, so that
// how many have come tells what has come.
#pragma once

#include <cstddef>
#include <cstdint>

#include "engine/scene/scene.hpp"
#include "engine/state/traffic.hpp"

namespace grainreel {

// All but its place. feed: which of the scene's; number: from 0.
NewGrain fed_grain(const Scene& scene, std::size_t feed, std::int64_t number);

}  // namespace grainreel
