// What pushes the grains of a snapshot that was brought back, so that its forces are known.
#pragma once

#include "engine/inspect/snapshot.hpp"

namespace grainreel {

// Sums over a grain's contacts; `id` need not be there. N, and N m about its centre.
Vec3 contact_force_on(const Snapshot& snapshot, std::int32_t id);
Vec3 contact_torque_on(const Snapshot& snapshot, std::int32_t id);

}  // namespace grainreel
