// Pixels as a PNG file. Films have a faster way (render/film/codec/png.hpp), which needs more libraries.
#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

#include "engine/frame.hpp"
#include "render/scene/filmed_scene.hpp"

namespace grainreel {

// rgba: 4 bytes a pixel, rows from the top. Written to `path`.part and renamed. Throws RunError naming the
// file and the reason.
void write_png_file(const std::filesystem::path& path, int width, int height,
                    const std::vector<std::uint8_t>& rgba);

// The film of frames that come without one.

// A film with all defaults, and the palette's colours for the species; what the scene itself says of its film
// and colours is not looked at. Where the scene has neither a
// container nor listed grains, the frame says what there is: which species, and how much room the grains
// take.
FilmedScene with_plain_film(const Scene& scene, const Frame& frame);

}  // namespace grainreel
