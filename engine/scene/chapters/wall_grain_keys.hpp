// The keys of container.wall_grains. Internal to [container].
#pragma once

#include "engine/scene/keys/bound_key.hpp"

namespace grainreel {

// Called after all that says the container's size.
keys::BoundKey<Container> wall_grains_key();

// Throws UserError where glued grains do not suit their container.
void check_wall_grains(const Scene& scene);

// Whether a species of this number and name is that of the glued grains, before the container is read.
bool is_glued(Document& document, std::size_t number, const std::string& name);

}  // namespace grainreel
