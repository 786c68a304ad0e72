// A file of known, moderate size in memory.
#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

namespace grainreel {

// Throws RunError when it cannot be read, or has more bytes than a page may have.
std::vector<std::uint8_t> read_bytes(const std::filesystem::path& path);

}  // namespace grainreel
