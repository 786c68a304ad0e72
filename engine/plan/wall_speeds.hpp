// Walls with a motion of their own: how fast they are.
#pragma once

#include "engine/scene/scene.hpp"

namespace grainreel {

// m/s: of the fastest point of a mesh, by its turn, its velocity or its path; 0 where it only follows the
// drive. A path may move and turn it at the same time.
double own_speed(const SceneMesh& mesh);

// m/s: of the fastest point of the container, where it turns. An open one counts up to its rim.
double own_speed(const Container& container);

// m/s: the largest of all these. Planes are not counted: their velocities are in the scene as they are.
double fastest_own_speed(const Scene& scene);

// Throws UserError where a wall moves by itself further within `step` (s) than a tenth of the smallest
// grain's diameter.
void check_rims(const Scene& scene, double step);

}  // namespace grainreel
