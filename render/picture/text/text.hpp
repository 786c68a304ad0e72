// Words and their sizes, through Pango: no hinting, so that letters neither jump nor depend on the screen.
#pragma once

#include <cairo.h>

#include <memory>
#include <string>

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

}  // namespace grainreel
