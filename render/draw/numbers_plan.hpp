// Where the blocks of the second gutter lie: time, dial, drive, caption, plots. Pixels from its corner.
#pragma once

#include <vector>

#include "engine/scene/scene.hpp"
#include "render/draw/writer.hpp"

namespace grainreel {

struct NumbersPlan {
    double x = 0, inner = 0;                  // left margin; width between the margins
    double radius = 0;                        // of the dial
    double clock = 0, caption = 0, dial = 0;  // upper ends
    double caption_x = 0, caption_wrap = 1;
    int caption_lines = 1;
    bool caption_beside = false;  // the clock, not below it
    double drive_x = 0, drive = 0;
    double note = 0, note_end = 0;  // the scene's own words, under the caption
    double arrows_x = 0;            // portrait only: gravity and drive, beside the drive's numbers
    // Where what changes is cut off from what follows below.
    double clock_end = 0, caption_end = 0, dial_end = 0;
    std::vector<Rectangle> plots;             // as many as there is room for
    bool has_dial = true, has_arrows = true;  // else there is no room for them
    double width = 0, height = 0;             // needed, without the outer margin
    bool fits = true;                         // clock, drive and words have the room that they need
};

// width: of the gutter. height: of the gutter, where plots fill what is left; 0: as much as they need. What
// there is no room for is left out: plots, then arrows, then the dial.
NumbersPlan plan_numbers(const Writer& measure, const Scene& scene, double width, double height,
                         bool portrait);

}  // namespace grainreel
