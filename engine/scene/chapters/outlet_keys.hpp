// The keys of container.outlet. Internal to [container].
#pragma once

#include "engine/scene/keys/bound_key.hpp"

namespace grainreel {

// Called after all that says the container's size.
keys::BoundKey<Container> outlet_key();

// Throws UserError where an outlet does not suit its container or the grains.
void check_outlet(const Scene& scene);

}  // namespace grainreel
