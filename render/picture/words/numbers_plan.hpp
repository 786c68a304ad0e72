// Where the blocks of the second gutter lie: time, dial, drive, caption, plots. Pixels from its corner.
#pragma once

#include <vector>

#include "render/picture/words/blocks.hpp"
#include "render/scene/filmed_scene.hpp"

namespace grainreel {

// An upper left corner.
struct WordPoint {
    double x = 0, y = 0;
};

struct NumbersPlan {
    double radius = 0;  // of the dial
    WordPoint clock, caption, note, dial, drive, arrows;
    double caption_wrap = 1, note_wrap = 1;
    int caption_lines = 0;
    // What changes is drawn anew within these; none lies over another.
    Rectangle clock_part, caption_part, note_part, dial_part;
    Rectangle drive_part;                     // of a drive that changes; else empty
    std::vector<Rectangle> plots;             // as many as there is room for
    std::vector<WordBox> boxes;               // around what stands together
    bool has_dial = true, has_arrows = true;  // else there is no room for them
    double width = 0, height = 0;             // needed, without the outer margin
    bool fits = true;                         // clock, drive and words have the room that they need
    bool wraps = true;                        // has words that break into as many lines as they need
    bool empty = false;                       // there is nothing to write or draw
};

// width: of the gutter. height: of the gutter, where plots fill what is left; 0: as little as they need.
// stacked: the gutter lies above or below the container. What there is no room for is left out: plots, then
// arrows, then the dial.
NumbersPlan plan_numbers(const Writer& measure, const FilmedScene& scene, double width, double height,
                         bool stacked);

}  // namespace grainreel
