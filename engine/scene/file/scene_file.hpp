// The text of a scene file. A scene that the user names may come through a pipe.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>

namespace grainreel {

// Bytes: a hundred thousand grains listed one by one, and far more than any scene written by hand.
constexpr std::size_t largest_scene_file = 16u << 20;

// What may stand for a file. A pipe can be read once, and is waited for until something comes through it.
enum class Pipes { refused, taken };

// Throws UserError when there is no such file, when it is something else (a folder, a device that has no end,
// a pipe unless it is taken), when it is larger than that, or when it cannot be read; and when a signal comes
// while a pipe is waited for.
std::string load_scene_file(const std::filesystem::path& file, Pipes pipes = Pipes::refused);

}  // namespace grainreel
