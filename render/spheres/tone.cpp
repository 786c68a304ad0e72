#include "render/spheres/tone.hpp"

#include <cmath>

#include "render/draw/palette.hpp"

namespace grainreel {

ToneTable::ToneTable() {
    for (int i = 0; i < kSteps; ++i)
        bytes_[static_cast<std::size_t>(i)] =
            static_cast<std::uint8_t>(std::lround(255 * to_srgb(i / (kSteps - 1.0))));
}

const ToneTable& ToneTable::get() {
    static const ToneTable table;
    return table;
}

}  // namespace grainreel
