// Writes pictures as PNG files, with texts in them about what they show.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "render/picture/base/picture.hpp"

namespace grainreel {

struct PngText {
    std::string keyword;  // 1 to 79 Latin-1 characters
    std::string text;     // UTF-8
};

// Writes a picture as 8-bit sRGB, with alpha where that is asked for. It is written to `path`.part and
// renamed, so that a file with the final name is always complete. Throws RunError naming the file and the
// reason. dpi: pixels an inch, which the file tells printers (pHYs); 0: it says nothing.
void write_png(const std::filesystem::path& path, const Picture& picture, const std::vector<PngText>& texts,
               bool alpha = false, double dpi = 0);

}  // namespace grainreel
