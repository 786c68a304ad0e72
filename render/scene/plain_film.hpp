// The film of frames that come without one.
#pragma once

#include "render/scene/filmed_scene.hpp"

namespace grainreel {

// A film with all defaults, and the palette's colours for the species.
FilmedScene with_plain_film(const Scene& scene);

}  // namespace grainreel
