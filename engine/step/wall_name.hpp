// What a wall is called in messages.
#pragma once

#include <string>

#include "engine/step/surroundings.hpp"

namespace grainreel {

// wall: as ContactView counts them, faces first and meshes behind them (wall = -1 - second).
inline std::string wall_name(const Surroundings& around, std::int32_t wall) {
    const auto number = static_cast<std::size_t>(wall);
    const std::size_t faces = around.faces.size();
    return number < faces ? "the " + around.faces[number].name
                          : "\"" + around.meshes[number - faces].name + "\"";
}

}  // namespace grainreel
