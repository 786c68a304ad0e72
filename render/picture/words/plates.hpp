// Backing plates: what words stand on when they lie over the picture.
#pragma once

#include <cairo.h>

#include <vector>

#include "render/picture/base/palette.hpp"
#include "render/picture/base/picture.hpp"

namespace grainreel {

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
