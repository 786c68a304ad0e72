// Gutters for words, planned from what the scene's words need.
#pragma once

#include "engine/frame.hpp"
#include "render/picture/base/picture.hpp"
#include "render/scene/filmed_scene.hpp"

namespace grainreel {

// A frame whose words are as long as they get.
Frame widest_frame();
// As film.words has it. Gutters are as wide as their words need, and at most about a third of the picture
// each: left and right, or above and below, whichever leaves the container larger. Words shrink to their
// least size, four fifths, before any is left out.
PictureLayout plan_layout(const FilmedScene& scene);

}  // namespace grainreel
