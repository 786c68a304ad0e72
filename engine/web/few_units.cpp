// The units of a page's engine. Its scene has plain numbers in SI, so units occur only in messages.
#include <algorithm>
#include <array>
#include <string_view>

#include "engine/scene/text/unit_system.hpp"

namespace grainreel {

namespace {

struct FewUnit {
    std::string_view name, base;
    double size;  // in units of `base`
};

constexpr auto few_units = std::to_array<FewUnit>({
    {"m", "m", 1},
    {"mm", "m", 1e-3},
    {"µm", "m", 1e-6},
    {"s", "s", 1},
    {"Hz", "s-1", 1},
    {"1/s", "s-1", 1},
    {"rad", "rad", 1},
    {"turn", "turn", 1},
    {"degree", "degree", 1},
    {"kg/m3", "m-3.kg", 1},
    {"kg", "kg", 1},
    {"g", "kg", 1e-3},
    {"mg", "kg", 1e-6},
    {"µg", "kg", 1e-9},
    {"N/m", "kg.s-2", 1},
    {"Pa", "m-1.kg.s-2", 1},
    {"kPa", "m-1.kg.s-2", 1e3},
    {"MPa", "m-1.kg.s-2", 1e6},
    {"m/s", "m.s-1", 1},
    {"mm/s", "m.s-1", 1e-3},
    {"µm/s", "m.s-1", 1e-6},
    {"rad/s", "rad.s-1", 1},
    {"m/s2", "m.s-2", 1},
    {"J", "m2.kg.s-2", 1},
    {"mJ", "m2.kg.s-2", 1e-3},
    {"µJ", "m2.kg.s-2", 1e-6},
    {"nJ", "m2.kg.s-2", 1e-9},
    {"N", "m.kg.s-2", 1},
    {"kN", "m.kg.s-2", 1e3},
    {"mN", "m.kg.s-2", 1e-3},
    {"µN", "m.kg.s-2", 1e-6},
    {"N.m", "m2.kg.s-2", 1},
    {"1", "", 1},
    {"kg/s", "kg.s-1", 1},
    {"W", "m2.kg.s-3", 1},
});

const FewUnit* few_unit(std::string_view name) {
    const auto found = std::find_if(few_units.begin(), few_units.end(),
                                    [&](const FewUnit& unit) { return unit.name == name; });
    return found == few_units.end() ? nullptr : &*found;
}

}  // namespace

bool unit_system::knows(const std::string& unit) {
    return few_unit(unit) != nullptr;
}

std::optional<double> unit_system::factor(const std::string& from, const std::string& to) {
    const FewUnit *const one = few_unit(from), *const other = few_unit(to);
    if (one == nullptr || other == nullptr || one->base != other->base) return std::nullopt;
    return one->size / other->size;
}

std::optional<std::string> unit_system::base_units(const std::string& unit) {
    const FewUnit* const known = few_unit(unit);
    return known == nullptr ? std::nullopt : std::optional(std::string(known->base));
}

}  // namespace grainreel
