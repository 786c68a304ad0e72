// The keys of container.tray. Internal to [container].
#pragma once

#include "engine/scene/keys/bound_key.hpp"

namespace grainreel {

// Called after the outlet.
keys::BoundKey<Container> tray_key();

// Throws UserError where a tray does not suit its container.
void check_tray(const Scene& scene);

}  // namespace grainreel
