// The legend's small spheres, lit as the grains are.
#pragma once

#include <cairo.h>

#include "render/scene/filmed_scene.hpp"

namespace grainreel {

// (x, y): centre; pixels.
void draw_lit_ball(cairo_t* on, double x, double y, double radius, const Colour& colour);

}  // namespace grainreel
