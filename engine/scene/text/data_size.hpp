// Sizes of files: "10 MB".
#pragma once

#include <cstdint>
#include <optional>
#include <string>

namespace grainreel {

// Bytes of "10 MB", "1.5GB" or "9 MiB": B, kB, MB, GB by thousands, KiB, MiB, GiB by 1024, rounded down. None
// for what is no positive size.
std::optional<std::int64_t> parse_data_size(const std::string& text);

// "9.31 MB", by thousands.
std::string data_size_text(double bytes);

}  // namespace grainreel
