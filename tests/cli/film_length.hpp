// Counts the pictures that a player gets out of a film file.
#pragma once

#include <filesystem>

namespace grainreel::test {

// Decodes the whole first video stream; -1 when the file cannot be opened.
int decoded_pictures(const std::filesystem::path& film);

}  // namespace grainreel::test
