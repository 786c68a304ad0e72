// Draws texts on Cairo surfaces. Pango measures and sets them; halos and plates keep them legible over a
// picture. Hinting is off, so that letters neither jump nor depend on the screen. Only files of
// render/picture may include this header, since no other folder knows Cairo's headers.
#pragma once

#include <cairo.h>
#include <memory>
#include <string>
#include <vector>

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
    bool centred = false;  // lines stand in the middle of the wrap width
};

// wrap: the width in pixels at which lines break between words; with 0 there is one line. There are at most
// `lines` lines, and an ellipsis ends the last one if there is more text. A word that is a little too long
// for its line makes the letters smaller; one that is much too long breaks.
TextSize measure_text(const std::string& text, const TextStyle& style, double wrap = 0, int lines = 1);

// Whether the fonts on this machine have all letters of the text. Letters that they lack are drawn as boxes.
bool has_fonts_for(const std::string& text);

// Pixels: the width of the longest word. Words end at spaces.
double longest_word(const std::string& text, const TextStyle& style);

// Draws a text with its top left corner at (x, y). Returns its size.
TextSize draw_text(cairo_t* on, double x, double y, const std::string& text, const TextStyle& style,
                   const Colour& colour, double wrap = 0, int lines = 1);

// Draws on a part of a page: its corner becomes the origin, and nothing is drawn beyond it.
template <class Draw>
void draw_part(cairo_t* on, const Rectangle& part, const Draw& draw) {
    cairo_save(on);
    cairo_rectangle(on, part.x, part.y, part.width, part.height);
    cairo_clip(on);
    cairo_translate(on, part.x, part.y);
    draw();
    cairo_restore(on);
}

// Whether texts stay text on this context, as on a page of PDF. On others letters become pixels.
bool keeps_text(cairo_t* on);

// Surfaces and contexts of Cairo that delete themselves.
struct CairoDestroy {
    void operator()(cairo_surface_t* surface) const { cairo_surface_destroy(surface); }
    void operator()(cairo_t* context) const { cairo_destroy(context); }
};
using CairoSurface = std::unique_ptr<cairo_surface_t, CairoDestroy>;
using CairoContext = std::unique_ptr<cairo_t, CairoDestroy>;

void set_colour(cairo_t* on, const Colour& colour, double alpha = 1);
// A line from (x0, y0) to (x1, y1), as wide as the context's lines are.
void draw_line(cairo_t* on, double x0, double y0, double x1, double y1);

// A surface as large as the part, all of one colour. With alpha 0 it is clear.
CairoSurface blank_surface(const Rectangle& part, const Colour& colour, double alpha = 1);
void fill_surface(cairo_t* on, const Colour& colour, double alpha = 1);

// Copies a surface to the place `to` in the picture, which has the size of the surface.
void copy_surface(cairo_surface_t* from, const Rectangle& to, Picture& picture);
// Copies a part of a surface whose corner lies at (x, y) in the picture.
void copy_part(cairo_surface_t* from, const Rectangle& part, int x, int y, Picture& picture);

// A soft seam around the letters of words that have no background, so that they are legible on whatever lies
// under them.
struct WordHalo {
    Colour colour;
    double reach = 0;  // pixels beyond the words
};
// The halo's colour is the background that the words are made for.
WordHalo halo_of(const TypeScale& type, const Palette& palette);

// Does what copy_part() does, with a halo under the words. Around each pixel the halo is as strong as the
// pixel, and it ends at its reach. The halo of words beside the part reaches into the part too.
void copy_part_on_halo(cairo_surface_t* from, const Rectangle& part, int x, int y, const WordHalo& halo,
                       Picture& picture);

// A box around words, in pixels from the corner of the gutter, the strip of the picture kept for words.
struct WordBox {
    double x, y, width, height;
};

// The plates behind words that lie over the picture: rectangles of whole pixels around each box, inside the
// gutter.
std::vector<Rectangle> plates_around(const std::vector<WordBox>& boxes, const TypeScale& type,
                                     const Rectangle& gutter);

// Paints plates with rounded corners, opaque enough for the words on them to be read.
void paint_plates(cairo_t* on, const std::vector<Rectangle>& plates, const TypeScale& type,
                  const Palette& palette);

// Lays parts of a gutter's surface over the picture.
void lay_plates(cairo_surface_t* from, const std::vector<Rectangle>& plates, const Rectangle& gutter,
                Picture& picture);

}  // namespace grainreel
