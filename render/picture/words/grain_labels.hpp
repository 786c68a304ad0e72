// Words beside single grains, [[film.label]]. Each label stands on a plate to the right of its grain, with a
// line to it.
#pragma once

#include <string>
#include <vector>

#include "engine/frame.hpp"
#include "render/picture/base/palette.hpp"
#include "render/picture/base/picture.hpp"
#include "render/picture/base/view.hpp"
#include "render/scene/filmed_scene.hpp"

namespace grainreel {

// Draws the labels of a frame. A label whose grain is not there or lies outside the view is left out. A label
// that would lie over another moves down below it. found: for each label, 1 if its grain has been in a frame;
// this frame is counted.
void draw_grain_labels(const FilmedScene& scene, const Frame& frame, const View& view,
                       const PictureLayout& layout, const Palette& palette, Picture& picture,
                       std::vector<char>& found);

// "label \"big\": no grain has the id 900 ..."; empty where all labels have had their grain.
std::string missing_labels(const FilmedScene& scene, const std::vector<char>& found);

}  // namespace grainreel
