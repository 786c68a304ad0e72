// The colour maps as tables of colours, and the scales of grains and walls with their words.
#include "render/picture/base/colour_scale.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <array>
#include <cmath>
#include <span>

#include "engine/scene/text/units.hpp"
#include "render/picture/base/picture.hpp"
#include "render/scene/axis_titles.hpp"
#include "render/scene/shown_values.hpp"

namespace grainreel {

namespace {

std::string quantity_words(const GrainColouring& colouring, const Wording& wording) {
    switch (colouring.by) {
        case GrainValue::speed:
            return wording(Word::speed);
        case GrainValue::vertical_velocity:
            return wording(Word::upward_velocity);
        case GrainValue::start_height:
            return wording(Word::start_height);
        case GrainValue::displacement:
            return wording(Word::displacement);
        case GrainValue::rise:
            return wording(Word::rise);
        case GrainValue::spin:
            return wording(Word::spin);
        case GrainValue::kinetic_energy:
            return wording(Word::kinetic_energy);
        case GrainValue::coordination:
            return wording(Word::contacts);
        case GrainValue::contact_force:
            return wording(Word::normal_forces);
        case GrainValue::own:
            return colouring.title;
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

// "0.4 % of the grains lie above 0.75 m/s, ..."; empty where no value lies beyond an end.
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

}  // namespace

std::string clipped_words(const GrainColouring& colouring, const ClippedCount& count, const char* of) {
    const bool banded = bands_of(colouring) > 0;  // the highest band has no upper end
    const double size = unit_size(colouring.unit, dimension_of(colouring.by));
    const std::string parts = parts_beyond(count, of,
                                           {in_unit(colouring.range[0], size, colouring.unit),
                                            banded ? "" : in_unit(colouring.range[1], size, colouring.unit)});
    if (parts.empty()) return "";
    return fmt::format("colours by {}: {}, where the bar ends (film.colour.range)",
                       quantity_words(colouring, {}), parts);
}

// The words leave out triangles below the range: hardly anything touches those.
std::string clipped_words(const FilmWalls& walls, const ClippedCount& count) {
    const WallUnit unit = unit_of(walls);
    const std::string parts =
        parts_beyond(count, "triangles", {"", in_unit(walls.range[1], unit.size, unit.name)});
    if (parts.empty()) return "";
    return fmt::format("walls by {}: {}, where the bar ends (film.walls.range)",
                       word_of(walls.colour, wall_colour_words), parts);
}

ColourScale::ColourScale(const GrainColouring& colouring, const Wording& wording)
    : map_(colouring.map),
      range_(colouring.range),
      bands_(bands_of(colouring)),
      signed_(is_signed(colouring.by) || colouring.by == GrainValue::own),
      logarithmic_(colouring.logarithmic),
      unit_size_(grainreel::unit_size(colouring.unit, dimension_of(colouring.by))),
      title_(with_unit(quantity_words(colouring, wording), colouring.unit, dimension_of(colouring.by))) {}

ColourScale::ColourScale(const FilmWalls& walls, const Wording& wording)
    : map_(ColourMap::bilbao), range_(walls.range), logarithmic_(walls.logarithmic()) {
    const WallUnit unit = unit_of(walls);
    unit_size_ = unit.size;
    const bool wear = walls.colour == FilmWalls::Colour::wear;
    title_ = with_unit(wording(wear ? Word::wear : Word::pressure), unit.name, dimension_of(walls.colour));
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

namespace {

// The maps are sRGB colours at even steps from the low end to the high one, interpolated linearly. viridis
// and cividis keep every 15th of the 256 published colours; the interpolation misses the others by at most
// 0.02 in viridis and 0.04 in cividis.

// S. van der Walt and N. Smith (2015), bids.github.io/colormap.
constexpr std::array<Colour, 18> viridis{{
    {0.267004, 0.004874, 0.329415},
    {0.281924, 0.089666, 0.412415},
    {0.280255, 0.165693, 0.476498},
    {0.263663, 0.237631, 0.518762},
    {0.237441, 0.305202, 0.541921},
    {0.208623, 0.367752, 0.552675},
    {0.182256, 0.426184, 0.557120},
    {0.159194, 0.482237, 0.558073},
    {0.137770, 0.537492, 0.554906},
    {0.121148, 0.592739, 0.544641},
    {0.128087, 0.647749, 0.523491},
    {0.180653, 0.701402, 0.488189},
    {0.274149, 0.751988, 0.436601},
    {0.395174, 0.797475, 0.367757},
    {0.535621, 0.835785, 0.281908},
    {0.688944, 0.865448, 0.182725},
    {0.845561, 0.887322, 0.099702},
    {0.993248, 0.906157, 0.143936},
}};

// J. R. Nuñez, C. R. Anderton and R. S. Renslow, PLOS ONE 13 (2018) e0199239.
constexpr std::array<Colour, 18> cividis{{
    {0.000000, 0.135112, 0.304751},
    {0.000000, 0.176082, 0.407577},
    {0.087465, 0.214879, 0.437342},
    {0.180503, 0.256180, 0.427299},
    {0.247605, 0.296986, 0.422917},
    {0.305886, 0.337681, 0.424512},
    {0.359916, 0.378641, 0.431501},
    {0.411607, 0.420145, 0.443577},
    {0.461616, 0.462405, 0.461969},
    {0.514226, 0.505546, 0.472640},
    {0.570607, 0.549695, 0.469593},
    {0.628576, 0.595104, 0.459641},
    {0.687957, 0.641966, 0.442886},
    {0.748772, 0.690470, 0.418448},
    {0.811054, 0.740801, 0.385198},
    {0.875057, 0.793125, 0.339685},
    {0.941147, 0.847530, 0.275815},
    {0.995737, 0.909344, 0.217772},
}};

constexpr Colour rgb(unsigned value) {
    return {(value >> 16) / 255.0, ((value >> 8) & 255) / 255.0, (value & 255) / 255.0};
}

// F. Crameri (2018), Scientific colour maps, doi:10.5281/zenodo.1243862: 11 steps of version 8.
constexpr std::array<Colour, 11> vik{rgb(0x001261), rgb(0x023a7b), rgb(0x116496), rgb(0x5496b7),
                                     rgb(0xa7c9da), rgb(0xece5e0), rgb(0xe1b8a0), rgb(0xcd8961),
                                     rgb(0xb75a26), rgb(0x852206), rgb(0x590008)};

// bilbao, from the same maps: every 15th colour from a light grey (the 241st of 256) to dark red (the first).
constexpr std::array<Colour, 17> bilbao{{
    {0.896900, 0.896462, 0.894410},
    {0.817076, 0.813079, 0.794420},
    {0.778869, 0.766425, 0.707465},
    {0.755564, 0.731793, 0.618437},
    {0.729308, 0.690226, 0.515344},
    {0.700009, 0.632449, 0.421261},
    {0.680660, 0.576514, 0.385570},
    {0.667900, 0.530350, 0.374203},
    {0.656223, 0.487239, 0.364841},
    {0.644613, 0.444345, 0.355565},
    {0.632457, 0.399424, 0.345790},
    {0.617797, 0.349190, 0.333637},
    {0.588592, 0.287186, 0.305597},
    {0.531968, 0.218597, 0.246306},
    {0.462612, 0.152543, 0.172633},
    {0.386025, 0.082853, 0.097458},
    {0.299144, 0.000324, 0.003027},
}};

std::span<const Colour> steps_of(ColourMap map) {
    switch (map) {
        case ColourMap::viridis:
            return viridis;
        case ColourMap::cividis:
            return cividis;
        case ColourMap::bilbao:
            return bilbao;
        case ColourMap::vik:
            break;
    }
    return vik;
}

}  // namespace

Colour colour_of(ColourMap map, double share) {
    const std::span<const Colour> steps = steps_of(map);
    const double at = std::clamp(share, 0.0, 1.0) * static_cast<double>(steps.size() - 1);
    const std::size_t step = std::min(static_cast<std::size_t>(at), steps.size() - 2);
    return mix(steps[step], steps[step + 1], at - static_cast<double>(step));
}

}  // namespace grainreel
