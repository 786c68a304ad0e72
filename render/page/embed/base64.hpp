// Bytes as text that a page can hold.
#pragma once

#include <cstdint>
#include <span>
#include <string>

namespace grainreel {

// Base64 of RFC 4648 with padding, in one line. None of its signs means anything in HTML.
std::string base64(std::span<const std::uint8_t> bytes);

}  // namespace grainreel
