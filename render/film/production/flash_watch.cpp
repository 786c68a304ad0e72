#include "render/film/production/flash_watch.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdlib>

#include "render/picture/base/picture.hpp"

namespace grainreel {

namespace {

constexpr double kChange = 0.1, kBright = 0.8;  // relative luminance
constexpr std::size_t kMostTurns = 7;           // three pairs of changes, and half of one
constexpr int kEvery = 4;                       // every fourth pixel is enough for a mean
constexpr double kTogether = 0.05;              // s, within which changes count as one

// For each colour: its part of the relative luminance, by the byte's value.
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
    // The first pixel of the place to the right of `place` that is looked at, or the row's end.
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
    for (int row = 0; row < kRows; ++row)
        for (int column = 0; column < kColumns; ++column) {
            Window& window = windows_[static_cast<std::size_t>(row * kColumns + column)];
            const int direction = turning(column, row, now);
            if (direction != 0 && direction != window.direction) {
                window.direction = direction;
                window.turns.push_back(now);
            }
            while (!window.turns.empty() && window.turns.front() <= now - 1 + 1e-9) window.turns.pop_front();
            if (!at_ && window.turns.size() > kMostTurns) at_ = now;
        }
}

// Returns 1 or -1 when a quarter of the window has just become brighter or darker, else 0. Places that became
// brighter and places that became darker at the same time cancel.
int FlashWatch::turning(int column, int row, double now) const {
    int more = 0;  // places that became brighter, less those that became darker
    for (int y = row; y < row + kHigh; ++y)
        for (int x = column; x < column + kWide; ++x) {
            const Place& place = places_[static_cast<std::size_t>(y * kAcross + x)];
            if (place.direction != 0 && place.turned >= now - kTogether) more += place.direction;
        }
    if (4 * std::abs(more) < kWide * kHigh) return 0;
    return more > 0 ? 1 : -1;
}

// Takes the luminance of a place. A change is noted once it is large enough, and grows as long as it goes on
// in its direction.
void FlashWatch::take(Place& place, double luminance, double now) const {
    if (frames_ == 1) place.low = place.high = luminance;
    const auto turned = [&](int direction) {
        place.direction = direction;
        place.turned = now;
        place.low = place.high = luminance;
    };
    if (place.direction <= 0 && luminance - place.low >= kChange && place.low < kBright)
        turned(1);
    else if (place.direction >= 0 && place.high - luminance >= kChange && luminance < kBright)
        turned(-1);
    place.low = std::min(place.low, luminance);
    place.high = std::max(place.high, luminance);
}

}  // namespace grainreel
