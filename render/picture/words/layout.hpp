// Plans the gutters for words from the room that the words of the scene need. Many files include this header,
// so it includes nothing of Cairo.
#pragma once

#include <vector>

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
// With film.gutters it has the place, the letters and the least sizes given there, if the words fit there.
PictureLayout plan_layout(const FilmedScene& scene);

// The gutters of that layout as film.gutters would give them.
FilmGutters gutters_of(const FilmedScene& scene);
// The gutters with which the words of all these scenes fit and their containers are largest: with them all
// pictures have one layout. Not `wanted` where there are none.
FilmGutters gutters_for_all(std::vector<FilmedScene> scenes);

}  // namespace grainreel
