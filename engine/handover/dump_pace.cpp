#include "engine/handover/dump_pace.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

namespace grainreel {

namespace {

// How many of its dumps the pace gives as the engine will compute it, from the first one on.
std::int64_t right_ones(const DumpPace& pace, const std::int64_t* steps) {
    for (std::int64_t k = 0; k < pace.count; ++k)
        if (pace.at(k) != steps[k] || pace.next(steps[k]) != steps[k + 1]) return k;
    return pace.count;
}

// The longest pace from the first of `count` steps: all that leave some distance possible,
// (d_k - 1/2) / k <= every < (d_k + 1/2) / k for d_k steps from the first to the k-th.
DumpPace longest(const std::int64_t* steps, std::int64_t count) {
    DumpPace pace{*steps, static_cast<double>(steps[1] - steps[0]), 1};
    double low = 0, high = INFINITY;
    for (std::int64_t k = 1; k < count; ++k) {
        const auto d = static_cast<double>(steps[k] - steps[0]), n = static_cast<double>(k);
        low = std::max(low, (d - 0.5) / n);
        high = std::min(high, (d + 0.5) / n);
        if (!(low < high)) break;
        const double whole = std::round((low + high) / 2);
        const DumpPace more{*steps, whole >= low && whole < high ? whole : (low + high) / 2, k};
        if (more.every < 1) break;
        pace = more;
    }
    pace.count = right_ones(pace, steps);
    if (pace.count == 0) pace = {*steps, static_cast<double>(steps[1] - steps[0]), 1};
    return pace;
}

}  // namespace

std::int64_t DumpPace::at(std::int64_t k) const {
    return from + static_cast<std::int64_t>(std::floor(static_cast<double>(k) * every + 0.5));
}

std::int64_t DumpPace::next(std::int64_t step) const {
    const double k = std::ceil((static_cast<double>(step - from) + 0.5) / every);
    return from + static_cast<std::int64_t>(std::floor(k * every + 0.5));
}

std::string DumpPace::next_text(std::int64_t shift) const {
    return fmt::format("{}+floor(ceil((step-{}+0.5)/{})*{}+0.5)", from + shift, from + shift, every, every);
}

std::vector<DumpPace> dump_paces(const std::vector<std::int64_t>& steps) {
    std::vector<DumpPace> paces;
    const auto count = static_cast<std::int64_t>(steps.size());
    for (std::int64_t at = 0; at + 1 < count;) {
        paces.push_back(longest(steps.data() + at, count - at));
        at += paces.back().count;
    }
    return paces;
}

}  // namespace grainreel
