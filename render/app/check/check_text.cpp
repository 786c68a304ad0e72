#include <fmt/format.h>

#include <cmath>

#include "render/app/check/check_parts.hpp"

namespace grainreel {

std::string metres_text(double metres) {
    const double size = std::abs(metres);
    if (size >= 1) return fmt::format("{:.4g} m", metres);
    if (size >= 1e-3 || size == 0) return fmt::format("{:.4g} mm", metres * 1e3);
    return fmt::format("{:.3g} um", metres * 1e6);
}

std::string span_text(double seconds) {
    if (seconds >= 5400) return fmt::format("{:.1f} h", seconds / 3600);
    if (seconds >= 90) return fmt::format("{:.1f} min", seconds / 60);
    if (seconds >= 0.1) return fmt::format("{:.3g} s", seconds);
    return seconds >= 1e-3 ? fmt::format("{:.3g} ms", seconds * 1e3)
                           : fmt::format("{:.3g} us", seconds * 1e6);
}

std::string grouped(std::int64_t count) {
    std::string digits = fmt::format("{}", count);
    for (std::size_t at = digits.size(); at > 3;) digits.insert(at -= 3, ",");
    return digits;
}

}  // namespace grainreel
