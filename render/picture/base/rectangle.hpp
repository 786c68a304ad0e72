#pragma once

namespace grainreel {

// Pixels, from the top left corner of the whole picture.
struct Rectangle {
    int x = 0, y = 0, width = 0, height = 0;
};

}  // namespace grainreel
