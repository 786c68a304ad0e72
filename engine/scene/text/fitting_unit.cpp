#include "engine/scene/text/fitting_unit.hpp"

#include <cmath>
#include <vector>

namespace grainreel {

namespace {

std::vector<std::string> usual_units(Dimension dimension) {
    switch (dimension) {
        case Dimension::length:
            return {"m", "mm", "µm"};
        case Dimension::speed:
            return {"m/s", "mm/s", "µm/s"};
        case Dimension::energy:
            return {"J", "mJ", "µJ", "nJ"};
        case Dimension::force:
            return {"kN", "N", "mN", "µN"};
        case Dimension::mass:
            return {"kg", "g", "mg", "µg"};
        case Dimension::moment:
            return {"N.m", "mN.m", "µN.m", "nN.m"};
        case Dimension::pressure:
            return {"MPa", "kPa", "Pa"};
        case Dimension::number:
            return {""};
        default:
            return {text_of(dimension).unit};
    }
}

}  // namespace

double unit_size(const std::string& unit, Dimension dimension) {
    return unit.empty() ? 1.0 : parse_quantity("1 " + unit, dimension);
}

std::string fitting_unit(double value, Dimension dimension) {
    const std::vector<std::string> units = usual_units(dimension);
    for (const std::string& unit : units)
        if (std::abs(value) >= 0.5 * unit_size(unit, dimension)) return unit;
    return units.back();
}

}  // namespace grainreel
