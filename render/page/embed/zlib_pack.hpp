// Bytes packed as browsers unpack them.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace grainreel {

// In zlib's format (RFC 1950), which DecompressionStream calls "deflate".
std::vector<std::uint8_t> zlib_packed(std::span<const std::uint8_t> bytes);

}  // namespace grainreel
