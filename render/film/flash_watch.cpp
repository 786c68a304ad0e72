#include "render/film/flash_watch.hpp"

#include <algorithm>
#include <cstddef>

#include "render/draw/palette.hpp"

namespace grainreel {
namespace {

constexpr double kChange = 0.1, kBright = 0.8;  // of relative luminance
constexpr std::size_t kMostTurns = 7;           // three pairs, and half of one
constexpr int kEvery = 4;                       // pixels: a mean wants no more

double luminance(const std::uint8_t* pixel) {
    static const std::array<double, 256> linear = [] {
        std::array<double, 256> table{};
        for (std::size_t i = 0; i < table.size(); ++i) table[i] = to_linear(static_cast<double>(i) / 255);
        return table;
    }();
    return 0.2126 * linear[pixel[0]] + 0.7152 * linear[pixel[1]] + 0.0722 * linear[pixel[2]];
}

}  // namespace

void FlashWatch::add(const Picture& picture) {
    const double now = static_cast<double>(frames_++) / rate_;
    std::array<double, kAcross * kDown> sum{}, count{};
    for (int y = 0; y < picture.height; y += kEvery)
        for (int x = 0; x < picture.width; x += kEvery) {
            const auto place = static_cast<std::size_t>(y * kDown / picture.height * kAcross + x * kAcross / picture.width);
            sum[place] += luminance(picture.pixel(x, y));
            count[place] += 1;
        }
    for (std::size_t i = 0; i < places_.size(); ++i)
        if (count[i] > 0) take(places_[i], sum[i] / count[i], now);
    if (!at_ && too_much()) at_ = now;
}

// A change is noted once it is large enough, and extends as long as it goes on in its direction.
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

bool FlashWatch::too_much() const {
    constexpr int kWide = kAcross / 3, kHigh = kDown / 3;
    for (int top = 0; top + kHigh <= kDown; ++top)
        for (int left = 0; left + kWide <= kAcross; ++left) {
            int flashing = 0;
            for (int y = top; y < top + kHigh; ++y)
                for (int x = left; x < left + kWide; ++x)
                    flashing += places_[static_cast<std::size_t>(y * kAcross + x)].turns.size() > kMostTurns;
            if (4 * flashing >= kWide * kHigh) return true;
        }
    return false;
}

}  // namespace grainreel
