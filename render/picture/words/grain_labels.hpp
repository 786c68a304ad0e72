// Words beside single grains, [[film.label]]: each on a plate to the right of its grain, with a line to it.
#pragma once

#include "engine/frame.hpp"
#include "render/picture/base/palette.hpp"
#include "render/picture/base/picture.hpp"
#include "render/picture/base/picture_layout.hpp"
#include "render/picture/base/view.hpp"
#include "render/scene/filmed_scene.hpp"

namespace grainreel {

// Of a frame as it is drawn. A label whose grain is not there, or lies outside the view, is left out; one that would
// lie over another moves down below it.
void draw_grain_labels(const FilmedScene& scene, const Frame& frame, const View& view, const PictureLayout& layout,
                       const Palette& palette, Picture& picture);

}  // namespace grainreel
