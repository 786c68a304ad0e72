// Plans the gutters for words from the room that the words of the scene need. Many files include this header,
// so it includes nothing of Cairo.
#pragma once

#include "engine/state/state.hpp"
#include "render/picture/base/picture.hpp"
#include "render/scene/filmed_scene.hpp"

namespace grainreel {

// A frame whose words are as long as words get.
State widest_frame();

// The layout that film.words asks for. Gutters are as wide as their words need, and at most about a third of
// the picture each. They lie beside the container, above it or below it, or one at a side and the other above
// or below. It is the layout with the largest container among those that leave out the fewest words. Words
// shrink to 0.7 of their size before any of them is left out, and where the container gains by it.
PictureLayout plan_layout(const FilmedScene& scene);

}  // namespace grainreel
