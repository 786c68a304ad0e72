// The first gutter, at the left or above the container. Its words say what is seen and how large it is.
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
    std::vector<WordBox> boxes;         // around what stands together
    std::vector<std::string> left_out;  // what there was no room for
    bool empty() const { return blocks.empty() && left_out.empty(); }
};
// Puts title, legend, colour bar, marks, scale bar, axes and arrows into the first gutter, as many as its
// height has room for. A gutter of height 0 takes whatever they need. view: null while measuring.
FirstPart first_part(const Writer& writer, const FilmedScene& scene, const View* view,
                     const PictureLayout& layout, double width);

}  // namespace grainreel
