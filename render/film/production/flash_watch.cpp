#include "render/film/production/flash_watch.hpp"

#include <algorithm>
#include <cstddef>

#include "render/picture/base/picture.hpp"

namespace grainreel {

namespace {

constexpr double kChange = 0.1, kBright = 0.8;  // relative luminance
constexpr std::size_t kMostTurns = 7;  // in a second: three flashes of two changes each, and one more change
constexpr int kEvery = 4;              // every fourth pixel is enough for a mean

// For red, green and blue: the part of the relative luminance that each value of a byte gives.
using Parts = std::array<std::array<float, 256>, 3>;
const Parts& parts_of_luminance() {
    static const Parts parts = [] {
        Parts table{};
        for (std::size_t i = 0; i < 256; ++i) {
            const double linear = to_linear(static_cast<double>(i) / 255);
            table[0][i] = static_cast<float>(0.2126 * linear);
            table[1][i] = static_cast<float>(0.7152 * linear);
            table[2][i] = static_cast<float>(0.0722 * linear);
        }
        return table;
    }();
    return parts;
}

}  // namespace

void FlashWatch::add(const Picture& picture) {
    const double now = static_cast<double>(frames_++) / rate_;
    const Parts& parts = parts_of_luminance();
    std::array<double, kAcross * kDown> sum{}, count{};
    // The first pixel to the right of `place` that is looked at, or the row's end.
    const auto end_of = [&](int place) {
        const int first = ((place + 1) * picture.width + kAcross - 1) / kAcross;
        return std::min((first + kEvery - 1) / kEvery * kEvery, picture.width);
    };
    for (int y = 0; y < picture.height; y += kEvery)
        for (int place = 0, x = 0; place < kAcross; ++place) {
            const int begin = x, end = end_of(place);
            float row = 0;
            for (; x < end; x += kEvery) {
                const std::uint8_t* pixel = picture.pixel(x, y);
                row += parts[0][pixel[0]] + parts[1][pixel[1]] + parts[2][pixel[2]];
            }
            const auto at = static_cast<std::size_t>(y * kDown / picture.height * kAcross + place);
            sum[at] += row;
            count[at] += (x - begin + kEvery - 1) / kEvery;
        }
    for (std::size_t i = 0; i < places_.size(); ++i)
        if (count[i] > 0) take(places_[i], sum[i] / count[i], now);
    for (int row = 0; row < kRows && !at_; ++row)
        for (int column = 0; column < kColumns && !at_; ++column)
            if (4 * flashing_in(column, row) >= kWide * kHigh) at_ = now;
}

// The number of places in a window that flashed more than three times in the last second.
int FlashWatch::flashing_in(int column, int row) const {
    int flashing = 0;
    for (int y = row; y < row + kHigh; ++y)
        for (int x = column; x < column + kWide; ++x)
            flashing += places_[y * kAcross + x].turns.size() > kMostTurns;
    return flashing;
}

// Takes the luminance of a place. A change is noted once it is large enough, and grows as long as it goes on
// in its direction.
void FlashWatch::take(Place& place, double luminance, double now) const {
    if (frames_ == 1) place.low = place.high = luminance;
    const auto turned = [&](int direction) {
        place.direction = direction;
        place.turns.push_back(now);
        place.low = place.high = luminance;
    };
    if (place.direction <= 0 && luminance - place.low >= kChange && place.low < kBright)
        turned(1);
    else if (place.direction >= 0 && place.high - luminance >= kChange && luminance < kBright)
        turned(-1);
    place.low = std::min(place.low, luminance);
    place.high = std::max(place.high, luminance);
    while (!place.turns.empty() && place.turns.front() <= now - 1 + 1e-9) place.turns.pop_front();
}

}  // namespace grainreel
