#include "engine/questions/dimensions.hpp"

#include <array>
#include <cmath>

#include <fmt/format.h>

namespace grainreel {
namespace {

constexpr std::array named = {
    Dimension::length, Dimension::time,     Dimension::frequency, Dimension::speed,   Dimension::acceleration,
    Dimension::spin,   Dimension::angle,    Dimension::mass,      Dimension::density, Dimension::force,
    Dimension::energy, Dimension::pressure, Dimension::stiffness};

}  // namespace

Powers powers_of(Dimension dimension) {
    if (dimension == Dimension::number) return {};
    return parse_unit(text_of(dimension).unit).value().powers;
}

bool same_powers(const Powers& a, const Powers& b) {
    for (std::size_t k = 0; k < a.size(); ++k)
        if (std::abs(a[k] - b[k]) > 1e-9) return false;
    return true;
}

bool is_plain(const Powers& powers) {
    return same_powers(powers, Powers{});
}

std::string noun_of_powers(const Powers& powers) {
    if (is_plain(powers)) return "a plain number";
    for (const Dimension dimension : named)
        if (same_powers(powers, powers_of(dimension))) return text_of(dimension).noun;
    constexpr std::array base = {"m", "kg", "s", "rad"};
    std::string unit;
    for (std::size_t k = 0; k < powers.size(); ++k)
        if (powers[k] != 0)
            unit += fmt::format("{}{}{}", unit.empty() ? "" : ".", base[k],
                                powers[k] == 1 ? "" : fmt::format("{:g}", powers[k]));
    return "a number in " + unit;
}

}  // namespace grainreel
