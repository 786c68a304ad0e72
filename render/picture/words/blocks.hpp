// The blocks of words around a picture, the Writer that they write with, and the two gutters that they stand
// in. A writer without a surface only measures, so that layout and drawing share their code. legend_block.cpp
// has legend and colour bars, dial_block.cpp the dial, marks.cpp the legend of the marks, and blocks.cpp has
// all other blocks. first_gutter.cpp and second_gutter.cpp place the blocks in the gutters.
#pragma once

#include <cairo.h>
#include <algorithm>
#include <string>
#include <vector>

#include "engine/state/state.hpp"
#include "render/picture/base/cairo_text.hpp"
#include "render/picture/base/colour_scale.hpp"
#include "render/picture/base/picture.hpp"
#include "render/picture/base/view.hpp"
#include "render/scene/filmed_scene.hpp"

namespace grainreel {

struct Writer {
    cairo_t* on = nullptr;  // null: the writer only measures
    const TypeScale& type;
    const Palette& palette;

    TextStyle main() const { return {type.main, false}; }
    TextStyle minor() const { return {type.minor, false}; }
    TextStyle strong() const { return {1.2 * type.main, true}; }
    TextStyle title() const { return {type.title, true}; }

    TextSize write(double x, double y, const std::string& text, const TextStyle& style, const Colour& colour,
                   double wrap = 0, int lines = 1) const {
        return on ? draw_text(on, x, y, text, style, colour, wrap, lines)
                  : measure_text(text, style, wrap, lines);
    }
    // Writes a line below the lines that begin at (x, y) and take `size`, and adds the line to the size.
    void write_below(TextSize& size, double x, double y, const std::string& line, const TextStyle& style,
                     const Colour& colour, double wrap = 0, int lines = 1) const {
        const TextSize part = write(x, y + size.height, line, style, colour, wrap, lines);
        size = {std::max(size.width, part.width), size.height + part.height};
    }
};

// The lines of a text, which "\n" separates.
std::vector<std::string> lines_of(const std::string& text);

// Each of these draws a block with its top left corner at (x, y), pixels, and returns its size. A block with
// nothing to say has the size 0. wrap: pixels, the width at which lines break.
TextSize title_block(const Writer& writer, const FilmedScene& scene, double x, double y, double wrap);
// The legend has as many columns as `wrap` has room for; with wrap 0 it has one column of any width. room:
// pixels of height; 0: no limit. Where there is no room for all species, the legend says how many more there
// are; where there is no room for one, the legend is left out.
TextSize legend_block(const Writer& writer, const FilmedScene& scene, double x, double y, double wrap,
                      double room = 0);
std::size_t species_in_legend(const Writer& writer, const FilmedScene& scene, double wrap, double room);
// Where the colours lie in a colour bar's block, in whole pixels. An end of the bar that also stands for all
// values beyond it has the tip of an arrow.
struct ColourBarPlace {
    int x = 0, y = 0, width = 0, height = 0;
    int tip_below = 0, tip_above = 0;  // lengths of the tips; 0: no tip
};
// y: where the words above the bar end.
ColourBarPlace colour_bar_place(const ColourScale& scale, const TypeScale& type, double x, double y,
                                double width);
// The scales that the film has colour bars for: one of grains, unless they are coloured by species, and one
// of walls.
std::vector<ColourScale> colour_scales(const Film& film);
inline bool has_colour_bar(const Film& film) {
    return film.word_kinds.legend &&
           (film.shows.colour.by != GrainValue::species || film.look.walls.coloured());
}
// All colour bars, below each other.
TextSize colour_bar_block(const Writer& writer, const FilmedScene& scene, double x, double y, double width);
// What the marks over the grains mean, with a sample of each. scale: pixels a metre.
TextSize marks_block(const Writer& writer, const FilmedScene& scene, double scale, double x, double y,
                     double wrap);
TextSize scale_block(const Writer& writer, double scale, double x, double y, double longest);
// The directions of gravity and of the drive as the camera sees them. view: null while measuring.
TextSize arrows_block(const Writer& writer, const FilmedScene& scene, const View* view, double x, double y);
// The directions x, y and z as the camera sees them, where the film wants them. view: null while measuring.
TextSize axes_block(const Writer& writer, const FilmedScene& scene, const View* view, double x, double y);
// What shakes: an arrow along the drive's direction, and words beside it. numbers: "15 Hz, Γ = 4"; may be
// empty. view: null: seen along -x.
TextSize shaking_block(const Writer& writer, const FilmedScene& scene, const std::string& numbers,
                       const View* view, double x, double y);
// What shakes; f, Gamma and amplitude of the drive; and by how much its motion is exaggerated. frame: null to
// measure the longest lines.
TextSize drive_block(const Writer& writer, const FilmedScene& scene, const State* frame, const View* view,
                     double x, double y);
// Says only by how much the motion is exaggerated.
TextSize exaggeration_block(const Writer& writer, const Film& film, double x, double y);
// A dial whose hand turns once a period, and beside it the place of the floor in its stroke. Without a frame
// only what stands still is drawn. view: tells right from left for a drive that goes sideways; null: seen
// along -x.
TextSize dial_block(const Writer& writer, const Drive& drive, const State* frame, double radius, double x,
                    double y, const View* view = nullptr);
// The scene's own words. Each of their lines may take up to `most` lines of the gutter.
TextSize note_block(const Writer& writer, const std::string& text, double x, double y, double wrap, int most);
// All words that clock_block() would write.
std::string clock_words(const FilmedScene& scene, const State& frame);
// The time and, with a drive, the cycle; with a tray also how many grains lie in it.
TextSize clock_block(const Writer& writer, const FilmedScene& scene, const State& frame, double x, double y);
// The size of the clock with the longest words that it gets.
TextSize widest_clock(const Writer& measure, const FilmedScene& scene);

// The words in the first gutter. They say what is seen and how large it is.
struct FirstPart {
    struct Block {
        std::string name;
        WordBox box;
    };
    std::vector<Block> blocks;
    double height = 0;                  // pixels that it takes, without margins
    std::vector<WordBox> boxes;         // boxes around groups of words
    std::vector<std::string> left_out;  // names of blocks that there was no room for
    bool empty() const { return blocks.empty() && left_out.empty(); }
};
// Puts title, legend, colour bar, marks, scale bar, axes and arrows into the first gutter, as many of them as
// its height has room for. A gutter of height 0 takes whatever they need. view: null while measuring.
FirstPart first_part(const Writer& writer, const FilmedScene& scene, const View* view,
                     const PictureLayout& layout, double width);

// The upper left corner of a block in the second gutter; pixels from the gutter's corner.
struct WordPoint {
    double x = 0, y = 0;
};

// Where time, dial, drive, caption, notes and plots lie in the second gutter, which has the words that change
// with time. Pixels from its corner.
struct NumbersPlan {
    double radius = 0;  // radius of the dial
    WordPoint clock, caption, note, dial, drive, arrows;
    double caption_wrap = 1, note_wrap = 1;
    int caption_lines = 0;
    // Words that change are drawn anew within these parts. None of the parts lies over another.
    Rectangle clock_part, caption_part, note_part, dial_part;
    Rectangle drive_part;                     // empty unless the drive changes
    std::vector<Rectangle> plots;             // as many as there is room for
    std::vector<WordBox> boxes;               // boxes around groups of words
    bool has_dial = true, has_arrows = true;  // whether there is room for them
    double width = 0, height = 0;             // needed, without the outer margin
    bool fits = true;                         // whether clock, drive and words have the room that they need
    bool wraps = true;                        // whether some words may break into lines
    bool empty = false;                       // whether there is nothing to write or draw
};

// Where there is not enough room, first plots are left out, then arrows, then the dial.
NumbersPlan plan_numbers(const Writer& measure, const FilmedScene& scene, const PictureLayout& layout);
// The plan for a gutter of another size. Plots fill the height that is left; with height 0 all take as little
// as they need. stacked: the gutter lies below the container.
NumbersPlan plan_numbers(const Writer& measure, const FilmedScene& scene, double width, double height,
                         bool stacked, bool at_left = false);

}  // namespace grainreel
