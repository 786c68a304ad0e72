// Pixels as a PNG file. Films have a faster way (render/film/codec/png.hpp), which needs more libraries.
#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

namespace grainreel {

// rgba: 4 bytes a pixel, rows from the top. Written to `path`.part and renamed. Throws RunError naming the
// file and the reason.
void write_png_file(const std::filesystem::path& path, int width, int height,
                    const std::vector<std::uint8_t>& rgba);

}  // namespace grainreel
