#include "render/picture/grains/grain_colours.hpp"

#include <algorithm>
#include <cmath>

#include "engine/base/error.hpp"
#include "render/picture/base/colour_scale.hpp"
#include "render/picture/base/palette.hpp"
#include "render/scene/filmed_scene.hpp"

namespace grainreel {
namespace {

constexpr Colour pale_grain{0.93, 0.93, 0.93};  // sRGB
constexpr int smooth_steps = 1024;              // of a colour map: finer than 8 bits

}  // namespace

Albedo to_albedo(const Colour& colour) {
    return {static_cast<float>(to_linear(colour.red)), static_cast<float>(to_linear(colour.green)),
            static_cast<float>(to_linear(colour.blue))};
}

GrainColours::GrainColours(const FilmedScene& scene)
    : quantities_(scene, scene.film.shows.colour.by), by_species_(!scene.film.shows.colour.of_grains()) {
    if (by_species_) {
        const bool pale = scene.film.shows.colour.of_field();
        for (const Colour& colour : scene.colours)
            steps_.push_back(to_albedo(pale ? mix(colour, pale_grain, 0.8) : colour));
        return;
    }
    const ColourScale scale(scene.film.shows.colour);
    low_ = scale.low();
    high_ = scale.high();
    banded_ = scale.bands() > 0;
    logarithmic_ = scale.logarithmic();
    const int count = banded_ ? scale.bands() : smooth_steps;
    for (int i = 0; i < count; ++i) steps_.push_back(to_albedo(scale.at_share(i / (count - 1.0))));
}

// Where in the range a value is, as on the colour bar.
double GrainColours::share_of(double value) const {
    if (!logarithmic_) return (value - low_) / (high_ - low_);
    return value <= low_ ? 0 : std::log(value / low_) / std::log(high_ / low_);
}

Albedo GrainColours::of_value(double value) const {
    if (std::isnan(value)) return to_albedo(neutral_grain);
    const auto count = static_cast<double>(steps_.size());
    const double share = share_of(value);
    const double step = banded_ ? std::floor(share * count) : std::round(share * (count - 1));
    return steps_[static_cast<std::size_t>(std::clamp(step, 0.0, count - 1))];
}

const std::vector<Albedo>& GrainColours::of(const Frame& frame) {
    colours_.resize(frame.size());
    if (by_species_) {
        for (std::size_t i = 0; i < frame.size(); ++i) {
            const auto species = static_cast<std::size_t>(frame.species[i]);
            GRAINREEL_CHECK(species < steps_.size());
            colours_[i] = steps_[species];
        }
        return colours_;
    }
    const std::vector<double>& values = quantities_.of(frame);
    for (std::size_t i = 0; i < frame.size(); ++i) {
        colours_[i] = of_value(values[i]);
        clipped_.take(values[i], {low_, high_});
    }
    return colours_;
}

}  // namespace grainreel
