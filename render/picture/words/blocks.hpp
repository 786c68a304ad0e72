// Places the overlay's blocks. Without a surface it only measures, so that layout and drawing share one code.
#pragma once

#include <cairo.h>
#include <algorithm>
#include <string>
#include <vector>

#include "engine/frame.hpp"
#include "render/picture/base/cairo_text.hpp"
#include "render/picture/base/colour_scale.hpp"
#include "render/picture/base/palette.hpp"
#include "render/picture/base/picture.hpp"
#include "render/picture/base/view.hpp"
#include "render/scene/filmed_scene.hpp"

namespace grainreel {

struct Writer {
    cairo_t* on = nullptr;  // null: measure
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
    // Writes a line below those that `size` has already, which begin at (x, y), and adds it to the size.
    void write_below(TextSize& size, double x, double y, const std::string& line, const TextStyle& style,
                     const Colour& colour, double wrap = 0, int lines = 1) const {
        const TextSize part = write(x, y + size.height, line, style, colour, wrap, lines);
        size = {std::max(size.width, part.width), size.height + part.height};
    }
};

// The lines of a text, which "\n" separates.
std::vector<std::string> lines_of(const std::string& text);

// Each draws itself with its top left corner at (x, y), pixels, and returns its size.
TextSize title_block(const Writer& writer, const FilmedScene& scene, double x, double y, double wrap);
// In as many columns as `wrap` has room for; in one with wrap 0, which sets no limit. Of species that there
// is no `room` (pixels of height; 0: without end) for it says how many there are; nothing where not one fits.
TextSize legend_block(const Writer& writer, const FilmedScene& scene, double x, double y, double wrap,
                      double room = 0);
std::size_t species_in_legend(const Writer& writer, const FilmedScene& scene, double wrap, double room);
// Where the colours are inside the colour bar's block, whose words end at y; whole pixels. Beside them lie
// the tips of arrows, where an end stands for all values beyond it, too.
struct ColourBarPlace {
    int x = 0, y = 0, width = 0, height = 0;
    int tip_below = 0, tip_above = 0;  // how long; 0: none
};
ColourBarPlace colour_bar_place(const ColourScale& scale, const TypeScale& type, double x, double y,
                                double width);
// What the film has colour bars for: the grains, unless they are coloured by species, and the walls.
std::vector<ColourScale> colour_scales(const Film& film);
inline bool has_colour_bar(const Film& film) {
    return film.word_kinds.legend &&
           (film.shows.colour.by != GrainValue::species || film.look.walls.coloured());
}
// Below each other.
TextSize colour_bar_block(const Writer& writer, const FilmedScene& scene, double x, double y, double width);
// What the marks over the grains mean, with a sample of each; nothing without marks. scale: pixels a metre.
TextSize marks_block(const Writer& writer, const FilmedScene& scene, double scale, double x, double y,
                     double wrap);
TextSize scale_block(const Writer& writer, double scale, double x, double y, double longest);
// Directions of gravity and of the drive as the camera sees them. view: null while measuring.
TextSize arrows_block(const Writer& writer, const FilmedScene& scene, const View* view, double x, double y);
// x, y and z as the camera sees them, where the film wants them; as above.
TextSize axes_block(const Writer& writer, const FilmedScene& scene, const View* view, double x, double y);
// f, Gamma and amplitude, and by how much the motion is exaggerated. frame: null to measure the longest.
TextSize drive_block(const Writer& writer, const FilmedScene& scene, const Frame* frame, double x, double y);
// The last of these alone; nothing while motion is drawn as it is.
TextSize exaggeration_block(const Writer& writer, const Film& film, double x, double y);
// A hand that turns once a period, and beside it where in its stroke the floor is; without `frame` only the
// still part. view: tells right from left for a drive that goes sideways; null: seen along -x.
TextSize dial_block(const Writer& writer, const Drive& drive, const Frame* frame, double radius, double x,
                    double y, const View* view = nullptr);
// Lines of the scene's own words, each in up to `most` lines of the gutter.
TextSize note_block(const Writer& writer, const std::string& text, double x, double y, double wrap, int most);
// All that clock_block would write.
std::string clock_words(const FilmedScene& scene, const Frame& frame);
// Time and, with a drive, the cycle.
TextSize clock_block(const Writer& writer, const FilmedScene& scene, const Frame& frame, double x, double y);

}  // namespace grainreel
