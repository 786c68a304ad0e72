// The band below the picture for the captions of the film (film.caption). All captions of a film have letters
// of one size and the band has the height of the longest, so that nothing moves when captions change.
#pragma once

#include <string>

#include "render/picture/words/blocks.hpp"
#include "render/scene/filmed_scene.hpp"

namespace grainreel {

struct CaptionPlan {
    double letters = 0;  // pixels: 1/25 of the picture's height, less where captions are very long
    int lines = 0;       // of the longest caption
    double height = 0;   // pixels, of the longest caption; 0 without captions
    double margin = 0;   // pixels above and below it
    bool cut = false;    // a caption is too long and ends with an ellipsis
    int band() const;    // pixels: height of the band
};

// width: pixels that the band is wide.
CaptionPlan plan_captions(const Film& film, double width);

// Draws a caption in the middle of the band, whose upper left corner is (0, 0). Its lines are about equally
// long.
void draw_caption(const Writer& writer, const CaptionPlan& plan, const std::string& caption, double width);

}  // namespace grainreel
