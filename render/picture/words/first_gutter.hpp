// The words at the left, or above in an upright picture: what is seen, and how large.
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
    double height = 0;                  // that it takes, margins left out
    std::vector<WordBox> boxes;         // around what stands together
    std::vector<std::string> left_out;  // what there was no room for
    bool empty() const { return blocks.empty() && left_out.empty(); }
};
// Title, legend, colour bar, marks, scale bar, axes and arrows in the first gutter, as far as its height
// goes; 0: however much they need. view: null while measuring.
FirstPart first_part(const Writer& writer, const FilmedScene& scene, const View* view,
                     const PictureLayout& layout, double width);

}  // namespace grainreel
