// How far the container has come, for what goes with its shaking and not with its turning.
#pragma once

#include "engine/frame.hpp"
#include "render/scene/filmed_scene.hpp"

namespace grainreel {

// m, from its place at rest; of one that turns, of a point on its axis.
inline Vec3 way_of_container(const FilmedScene& scene, const Frame& frame) {
    const std::optional<BodyTurn>& turn = scene.container.turn;
    return turn ? Vec3(frame.container().moved(turn->through) - turn->through) : frame.container().place;
}

}  // namespace grainreel
