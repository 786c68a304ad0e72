// A part of a picture on which Cairo writes.
#pragma once

#include <cairo.h>

#include <memory>

#include "render/picture/base/picture.hpp"
#include "render/picture/base/view.hpp"

namespace grainreel {

struct CairoDestroy {
    void operator()(cairo_surface_t* surface) const { cairo_surface_destroy(surface); }
    void operator()(cairo_t* context) const { cairo_destroy(context); }
};
using CairoSurface = std::unique_ptr<cairo_surface_t, CairoDestroy>;
using CairoContext = std::unique_ptr<cairo_t, CairoDestroy>;

// As large as the part, all of one colour, or of none with alpha 0.
CairoSurface blank_surface(const Rectangle& part, const Colour& colour, double alpha = 1);
void fill_surface(cairo_t* on, const Colour& colour, double alpha = 1);

// Puts a surface where `to` lies in the picture; they have the same size.
void copy_surface(cairo_surface_t* from, const Rectangle& to, Picture& picture);
// A part of a surface whose corner lies at (x, y) in the picture.
void copy_part(cairo_surface_t* from, const Rectangle& part, int x, int y, Picture& picture);

}  // namespace grainreel
