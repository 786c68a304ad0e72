#include "engine/scene/text/data_size.hpp"

#include <fmt/format.h>

#include <array>
#include <charconv>
#include <cmath>
#include <string_view>

namespace grainreel {

std::optional<std::int64_t> parse_data_size(const std::string& text) {
    double number = 0;
    const char* end = text.data() + text.size();
    const auto read = std::from_chars(text.data(), end, number, std::chars_format::fixed);
    if (read.ec != std::errc()) return std::nullopt;
    std::string_view unit(read.ptr, static_cast<std::size_t>(end - read.ptr));
    while (!unit.empty() && unit.front() == ' ') unit.remove_prefix(1);
    constexpr double k = 1000, ki = 1024;
    const std::array<std::pair<std::string_view, double>, 7> units{{{"B", 1},
                                                                    {"kB", k},
                                                                    {"MB", k * k},
                                                                    {"GB", k * k * k},
                                                                    {"KiB", ki},
                                                                    {"MiB", ki * ki},
                                                                    {"GiB", ki * ki * ki}}};
    for (const auto& [name, bytes] : units) {
        const double size = number * bytes;
        if (unit == name && size >= 1 && size < 1e15) return static_cast<std::int64_t>(std::floor(size));
    }
    return std::nullopt;
}

std::string data_size_text(double bytes) {
    constexpr std::array<const char*, 5> units{"B", "kB", "MB", "GB", "TB"};
    std::size_t unit = 0;
    for (; bytes >= 1000 && unit + 1 < units.size(); ++unit) bytes /= 1000;
    return fmt::format("{:.3g} {}", bytes, units[unit]);
}

}  // namespace grainreel
