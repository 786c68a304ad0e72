// The film of frames that come without one.
#pragma once

#include "engine/frame.hpp"
#include "render/scene/filmed_scene.hpp"

namespace grainreel {

// A film with all defaults, and the palette's colours for the species; what the scene itself says of its film
// and colours is not looked at. Where the scene has neither a
// container nor listed grains, the frame says what there is: which species, and how much room the grains
// take.
FilmedScene with_plain_film(const Scene& scene, const Frame& frame);

}  // namespace grainreel
