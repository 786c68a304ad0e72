// The faces of the tray that catches what flows out of an outlet.
#pragma once

#include <vector>

#include "engine/state/container_faces.hpp"

namespace grainreel {

// None without a tray. Its floor is an endless plane. Its walls are thin plates that end above, at their rim,
// so that they touch nothing in the container. They stand still and are there before the outlet opens.
std::vector<Face> tray_faces(const Scene& scene);

}  // namespace grainreel
