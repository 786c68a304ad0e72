// Gutters for words, planned from what the scene's words need.
#pragma once

#include <cairo.h>
#include <vector>

#include "engine/frame.hpp"
#include "render/picture/base/palette.hpp"
#include "render/picture/base/picture.hpp"
#include "render/scene/filmed_scene.hpp"

namespace grainreel {

// A frame whose words are as long as they get.
Frame widest_frame();
// As film.words has it. Gutters are as wide as their words need, and at most about a third of the picture
// each: left and right, or above and below, whichever leaves the container larger. Words shrink to their
// least size, four fifths, before any is left out.
PictureLayout plan_layout(const FilmedScene& scene);

// Backing plates: what words stand on when they lie over the picture.

// Pixels, from the gutter's corner.
struct WordBox {
    double x, y, width, height;
};

// Whole pixels around each box, inside the gutter.
std::vector<Rectangle> plates_around(const std::vector<WordBox>& boxes, const TypeScale& type,
                                     const Rectangle& gutter);

// As strong as words on them need, with rounded corners.
void paint_plates(cairo_t* on, const std::vector<Rectangle>& plates, const TypeScale& type,
                  const Palette& palette);

// Lays parts of a gutter's surface over the picture.
void lay_plates(cairo_surface_t* from, const std::vector<Rectangle>& plates, const Rectangle& gutter,
                Picture& picture);

}  // namespace grainreel
