#include "render/picture/spheres/light/lamp.hpp"

#include <algorithm>
#include <cmath>

#include "render/picture/base/picture.hpp"

namespace grainreel {

ToneTable::ToneTable() {
    for (int i = 0; i < kSteps; ++i)
        bytes_[i] = static_cast<std::uint8_t>(std::lround(255 * to_srgb(i / (kSteps - 1.0))));
}

const ToneTable& ToneTable::get() {
    static const ToneTable table;
    return table;
}

// The places in the table are found first, because registers find several of them at a time.
void ToneTable::pixels(const float* red, const float* green, const float* blue, int count,
                       std::uint32_t* out) const {
    constexpr int kSome = 64;
    std::array<int, kSome> steps[3];
    const float* const colours[3] = {red, green, blue};
    for (int first = 0; first < count; first += kSome) {
        const int some = std::min(kSome, count - first);
        for (int c = 0; c < 3; ++c)
            for (int i = 0; i < some; ++i) steps[c][i] = step(colours[c][first + i]);
        for (int i = 0; i < some; ++i) {
            const auto byte = [&](int c) -> std::uint32_t { return bytes_[steps[c][i]]; };
            out[first + i] = byte(0) | byte(1) << 8 | byte(2) << 16 | 0xff000000u;
        }
    }
}

}  // namespace grainreel
