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
// the picture each. They lie left and right, or above and below, whichever leaves the container larger. Words
// shrink to four fifths of their size before any of them is left out.
PictureLayout plan_layout(const FilmedScene& scene);

}  // namespace grainreel
