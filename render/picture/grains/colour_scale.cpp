#include "render/picture/grains/colour_scale.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "engine/scene/text/fitting_unit.hpp"
#include "render/picture/grains/colour_map.hpp"
#include "render/scene/grain_values.hpp"

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

}  // namespace

std::string clipped_words(const GrainColouring& colouring, const ClippedCount& count, const char* of) {
    const bool banded = bands_of(colouring) > 0;  // the highest band has no upper end
    std::string parts;
    const auto part = [&](std::int64_t beyond, const char* side, double end) {
        if (beyond == 0) return;
        const std::string unit = colouring.unit.empty() ? "" : " " + colouring.unit;
        const double percent = 100 * static_cast<double>(beyond) / static_cast<double>(count.all);
        parts += fmt::format("{}{} % of the {} lie {} {:.3g}{}", parts.empty() ? "" : ", ",
                             percent < 10 ? fmt::format("{:.2g}", percent) : fmt::format("{:.0f}", percent),
                             of, side, end / unit_size(colouring.unit, dimension_of(colouring.by)), unit);
    };
    part(count.below, "below", colouring.range[0]);
    if (!banded) part(count.above, "above", colouring.range[1]);
    if (parts.empty()) return "";
    return fmt::format("colours by {}: {}, where the bar ends (film.colour.range)",
                       quantity_words(colouring.by), parts);
}

ColourScale::ColourScale(const GrainColouring& colouring)
    : colouring_(colouring),
      bands_(bands_of(colouring)),
      unit_size_(grainreel::unit_size(colouring.unit, dimension_of(colouring.by))) {}

Colour ColourScale::at(double value) const {
    return at_share((value - low()) / (high() - low()));
}

Colour ColourScale::at_share(double share) const {
    if (bands_ == 0) return colour_of(colouring_.map, share);
    const double band = std::clamp(std::floor(share * bands_), 0.0, bands_ - 1.0);
    return colour_of(colouring_.map, band / (bands_ - 1));
}

std::string ColourScale::title() const {
    const std::string words = quantity_words(colouring_.by);
    return colouring_.unit.empty() ? words : fmt::format("{} ({})", words, colouring_.unit);
}

}  // namespace grainreel
