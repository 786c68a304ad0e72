// The newest picture of a film that still grows.
#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

namespace grainreel {

// As a JPEG, 960 pixels wide at most. Empty where there is none yet, or the file is damaged.
std::vector<std::uint8_t> last_picture(const std::filesystem::path& film);

}  // namespace grainreel
