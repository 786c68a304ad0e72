#include "render/picture/base/colour_scale.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "engine/scene/text/units.hpp"
#include "render/picture/base/colour_map.hpp"
#include "render/scene/grain_values.hpp"
#include "render/scene/wall_values.hpp"

namespace grainreel {
namespace {

const char* quantity_words(GrainValue value) {
    switch (value) {
        case GrainValue::speed:
            return "speed";
        case GrainValue::vertical_velocity:
            return "upward velocity";
        case GrainValue::start_height:
            return "height at the start";
        case GrainValue::displacement:
            return "displacement in a period";
        case GrainValue::rise:
            return "rise in a period";
        case GrainValue::spin:
            return "spin";
        case GrainValue::kinetic_energy:
            return "kinetic energy";
        case GrainValue::coordination:
            return "contacts of a grain";
        case GrainValue::contact_force:
            return "normal forces on a grain";
        case GrainValue::species:
            break;
    }
    return "";
}

int bands_of(const GrainColouring& colouring) {
    switch (colouring.by) {
        case GrainValue::start_height:
            return colouring.layers;
        default:
            return 0;
    }
}

// "0.4 % of the grains lie above 0.75 m/s, ..."; empty where none lies beyond an end.
std::string parts_beyond(const ClippedCount& count, const char* of, const std::array<std::string, 2>& ends) {
    std::string parts;
    const auto part = [&](std::int64_t beyond, const char* side, const std::string& end) {
        if (beyond == 0 || end.empty()) return;
        const double percent = 100 * static_cast<double>(beyond) / static_cast<double>(count.all);
        parts += fmt::format("{}{} % of the {} lie {} {}", parts.empty() ? "" : ", ",
                             percent < 10 ? fmt::format("{:.2g}", percent) : fmt::format("{:.0f}", percent),
                             of, side, end);
    };
    part(count.below, "below", ends[0]);
    part(count.above, "above", ends[1]);
    return parts;
}

std::string in_unit(double value, double size, const std::string& unit) {
    return fmt::format("{:.3g}{}{}", value / size, unit.empty() ? "" : " ", unit);
}

std::string with_unit(const std::string& words, const std::string& unit) {
    return unit.empty() ? words : fmt::format("{} ({})", words, unit);
}

}  // namespace

std::string clipped_words(const GrainColouring& colouring, const ClippedCount& count, const char* of) {
    const bool banded = bands_of(colouring) > 0;  // the highest band has no upper end
    const double size = unit_size(colouring.unit, dimension_of(colouring.by));
    const std::string parts = parts_beyond(count, of,
                                           {in_unit(colouring.range[0], size, colouring.unit),
                                            banded ? "" : in_unit(colouring.range[1], size, colouring.unit)});
    if (parts.empty()) return "";
    return fmt::format("colours by {}: {}, where the bar ends (film.colour.range)",
                       quantity_words(colouring.by), parts);
}

// What lies below is what hardly anything touches.
std::string clipped_words(const FilmWalls& walls, const ClippedCount& count) {
    const WallUnit unit = unit_of(walls);
    const std::string parts =
        parts_beyond(count, "triangles", {"", in_unit(walls.range[1], unit.size, unit.name)});
    if (parts.empty()) return "";
    return fmt::format("walls by {}: {}, where the bar ends (film.walls.range)",
                       word_of(walls.colour, wall_colour_words), parts);
}

ColourScale::ColourScale(const GrainColouring& colouring)
    : map_(colouring.map),
      range_(colouring.range),
      bands_(bands_of(colouring)),
      signed_(is_signed(colouring.by)),
      logarithmic_(colouring.logarithmic),
      unit_size_(grainreel::unit_size(colouring.unit, dimension_of(colouring.by))),
      title_(with_unit(quantity_words(colouring.by), colouring.unit)) {}

ColourScale::ColourScale(const FilmWalls& walls)
    : map_(ColourMap::bilbao), range_(walls.range), logarithmic_(walls.logarithmic()) {
    const WallUnit unit = unit_of(walls);
    unit_size_ = unit.size;
    const bool wear = walls.colour == FilmWalls::Colour::wear;
    title_ = with_unit(wear ? "wear of walls" : "pressure on walls", unit.name);
}

double ColourScale::share_of(double value) const {
    if (!logarithmic_) return (value - low()) / (high() - low());
    return value > 0 ? std::log(value / low()) / std::log(high() / low()) : 0;
}

Colour ColourScale::at_share(double share) const {
    if (bands_ == 0) return colour_of(map_, share);
    const double band = std::clamp(std::floor(share * bands_), 0.0, bands_ - 1.0);
    return colour_of(map_, band / (bands_ - 1));
}

}  // namespace grainreel
