#include "engine/files/foreign/meaning/units.hpp"

#include <array>
#include <utility>

namespace grainreel {

namespace {

constexpr double dalton = 1.66053906660e-27;  // kg (CODATA 2018)

const std::vector<UnitSystem>& systems() {
    static const std::vector<UnitSystem> all{
        {"si", 1, 1, 1, true},
        {"lj", 1, 1, 1, false},
        {"cgs", 1e-2, 1, 1e-3, true},
        {"micro", 1e-6, 1e-6, 1e-15, true},
        {"nano", 1e-9, 1e-9, 1e-21, true},
        {"real", 1e-10, 1e-15, dalton, true},
        {"metal", 1e-10, 1e-12, dalton, true},
    };
    return all;
}

constexpr std::array<std::pair<const char*, double>, 16> in_names{{{"m", 1},
                                                                   {"cm", 1e-2},
                                                                   {"mm", 1e-3},
                                                                   {"um", 1e-6},
                                                                   {"µm", 1e-6},
                                                                   {"micron", 1e-6},
                                                                   {"nm", 1e-9},
                                                                   {"s", 1},
                                                                   {"ms", 1e-3},
                                                                   {"us", 1e-6},
                                                                   {"m/s", 1},
                                                                   {"cm/s", 1e-2},
                                                                   {"mm/s", 1e-3},
                                                                   {"kg", 1},
                                                                   {"g", 1e-3},
                                                                   {"kg/m3", 1}}};

}  // namespace

std::optional<UnitSystem> unit_system(const std::string& name) {
    for (const UnitSystem& one : systems())
        if (one.name == name) return one;
    return std::nullopt;
}

std::vector<std::string> unit_names() {
    std::vector<std::string> names;
    for (const UnitSystem& one : systems()) names.push_back(one.name);
    return names;
}

std::optional<double> unit_in_name(const std::string& column) {
    const std::size_t from = column.find_first_of("[(");
    const std::size_t to = column.find_first_of("])", from == std::string::npos ? 0 : from);
    if (from == std::string::npos || to == std::string::npos) return std::nullopt;
    const std::string unit = column.substr(from + 1, to - from - 1);
    for (const auto& [name, value] : in_names)
        if (unit == name) return value;
    return std::nullopt;
}

}  // namespace grainreel
