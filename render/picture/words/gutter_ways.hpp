// The ways to place the two gutters of words (GutterPlace), and the layout of each. layout.hpp chooses one.
#pragma once

#include <vector>

#include "render/picture/base/picture.hpp"
#include "render/picture/words/blocks.hpp"
#include "render/scene/filmed_scene.hpp"

namespace grainreel {

// The layouts with the gutters at this place, with letters of the size of `layout`: several where a column
// may have more than one width, none where the words would be squeezed. layout: has the band of captions.
// Gutters have at least the size that film.gutters asks for.
std::vector<PictureLayout> laid_out(const FilmedScene& scene, const PictureLayout& layout,
                                    const Writer& measure, GutterPlace place);

}  // namespace grainreel
