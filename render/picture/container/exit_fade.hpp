// Grains that leave the run below an outlet are gone from one frame to the next. So that they do not vanish
// in mid-air, they fade while they fall the last part of the way.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "render/picture/base/view.hpp"
#include "render/scene/filmed_scene.hpp"

namespace grainreel {

// m: the height at which a grain that falls below all else leaves, into a box or out of one. Empty without
// boxes.
std::optional<double> exit_level(const FilmedScene& scene);

// How strong grains are in each row of a port so high, counted from the top, 0 to 255. Empty where all
// are as they are: without an outlet or a box that they leave into or out of below a vessel, with a tray, and
// where the eye looks down so steeply that rows with grains of the bed would fade too. meshes: m, their
// outermost points.
std::vector<std::uint32_t> exit_fade(const FilmedScene& scene, const View& view, int height,
                                     const std::vector<Vec3>& meshes = {});

}  // namespace grainreel
