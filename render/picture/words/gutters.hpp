// The words in the two gutters. The first one, at the left or above the container, says what is seen and how
// large it is (first_gutter.cpp). The second one, at the right or below, has the words that change with time
// (second_gutter.cpp).
#pragma once

#include <string>
#include <vector>

#include "render/picture/words/blocks.hpp"
#include "render/scene/filmed_scene.hpp"

namespace grainreel {

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

// Where time, dial, drive, caption, notes and plots lie in the second gutter; pixels from its corner.
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

// width, height: of the gutter. Plots fill the height that is left; with height 0 all take as little as they
// need. stacked: the gutter lies below the container. Where there is not enough room, first plots are left
// out, then arrows, then the dial.
NumbersPlan plan_numbers(const Writer& measure, const FilmedScene& scene, double width, double height,
                         bool stacked);

}  // namespace grainreel
