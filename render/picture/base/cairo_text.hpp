// Words and their sizes, through Pango: no hinting, so that letters neither jump nor depend on the screen.
#pragma once

#include <cairo.h>
#include <memory>
#include <string>

#include "render/picture/base/palette.hpp"
#include "render/picture/base/picture.hpp"
#include "render/picture/base/view.hpp"
#include "render/scene/filmed_scene.hpp"

namespace grainreel {

struct TextSize {
    double width = 0, height = 0;  // pixels
};

struct TextStyle {
    double size = 12;  // pixels, of the letters' body
    bool bold = false;
    bool centred = false;  // lines in the middle of the wrap
};

// wrap: pixels, where lines break between words (0: nowhere); at most `lines` lines, the last cut short by an
// ellipsis. A word that is a little too long for its line makes the letters smaller; one that is much too
// long breaks.
TextSize measure_text(const std::string& text, const TextStyle& style, double wrap = 0, int lines = 1);

// Whether some font here has what it takes to draw the text; else it has boxes in it.
bool has_fonts_for(const std::string& text);

// Pixels, of one line; words end at spaces.
double longest_word(const std::string& text, const TextStyle& style);

// (x, y): top left corner of the text. Returns its size.
TextSize draw_text(cairo_t* on, double x, double y, const std::string& text, const TextStyle& style,
                   const Colour& colour, double wrap = 0, int lines = 1);

// A part of a picture on which Cairo writes.

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

// Words without a background, which have to be read on whatever they are laid over: each stands on a halo.

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
