// Words without a background, which have to be read on whatever they are laid over: each stands on a halo.
#pragma once

#include <cairo.h>

#include "render/picture/base/palette.hpp"
#include "render/picture/base/picture.hpp"

namespace grainreel {

struct Halo {
    Colour colour;
    double reach = 0;  // pixels beyond the words
};
// The halo, in the colour that the words are made for.
Halo halo_of(const TypeScale& type, const Palette& palette);

// As copy_part(), with a halo under it: around each pixel as strong as that is, and gone beyond its reach.
// Words beside the part reach into it too.
void copy_part_on_halo(cairo_surface_t* from, const Rectangle& part, int x, int y, const Halo& halo,
                       Picture& picture);

}  // namespace grainreel
