#include "render/picture/base/colour_map.hpp"

#include <algorithm>
#include <array>
#include <span>

#include "render/picture/base/palette.hpp"

namespace grainreel {
namespace {

// Colours in sRGB at even steps from the low end to the high one, straight lines between them. The first two
// are every 15th of the 256 published, and nowhere farther than 0.02 and 0.04 from the others.

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

// Likewise: bilbao, from a light grey (its 241st of 256 colours) to dark red (its first), every 15th.
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
