#include "engine/measure/surface/mound.hpp"

#include <cmath>

#include "engine/measure/no_value.hpp"

namespace grainreel {
namespace {

constexpr std::size_t kLeastBins = 6;

// Slope over the bins from `first` to the one before `end`.
double slope_of(const BedOutline& s, std::size_t first, std::size_t end) {
    const auto count = static_cast<double>(end - first);
    double places = 0, heights = 0;
    for (std::size_t i = first; i < end; ++i) {
        places += s.place(i) / count;
        heights += s.height[i] / count;
    }
    double together = 0, squares = 0;
    for (std::size_t i = first; i < end; ++i) {
        together += (s.place(i) - places) * (s.height[i] - heights);
        squares += (s.place(i) - places) * (s.place(i) - places);
    }
    return together / squares;
}

// Mean height between two places; a bin counts by the part of it that lies between them.
double mean_between(const BedOutline& s, double from, double to) {
    double sum = 0, width = 0;
    for (std::size_t i = 0; i < s.height.size(); ++i) {
        const double low = std::max(from, s.place(i) - 0.5 * s.bin),
                     high = std::min(to, s.place(i) + 0.5 * s.bin);
        if (high <= low) continue;
        sum += (high - low) * s.height[i];
        width += high - low;
    }
    return sum / width;
}

}  // namespace

Mound mound_of(const BedOutline& s) {
    const std::size_t count = s.height.size();
    if (count < kLeastBins) return {kNoValue, kNoValue, kNoValue};
    const double sixth = s.width() / 6, right = s.left + s.width();
    const double middle = mean_between(s, s.left + 2 * sixth, right - 2 * sixth);
    const double edges =
        0.5 * (mean_between(s, s.left, s.left + sixth) + mean_between(s, right - sixth, right));
    const std::size_t half = count / 2;  // of an odd number the middle bin belongs to neither half
    return {middle - edges, 0.5 * (slope_of(s, 0, half) - slope_of(s, count - half, count)),
            slope_of(s, 0, count)};
}

}  // namespace grainreel
