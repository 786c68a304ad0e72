// The text of a scene file, or of a pipe that brings one.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>

namespace grainreel {

// Bytes: a hundred thousand grains listed one by one, and far more than any scene written by hand.
constexpr std::size_t largest_scene_file = 16u << 20;

// Throws UserError when there is no such file, when it is neither an ordinary file nor a pipe (a folder, a
// device that has no end), when it is larger than that, or when it cannot be read.
std::string load_scene_file(const std::filesystem::path& file);

}  // namespace grainreel
