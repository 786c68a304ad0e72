#include "render/film/moments/known_reach.hpp"

#include <algorithm>
#include <vector>

namespace grainreel {

namespace {

constexpr double most_grains = 2e7;  // that are read, over all frames
constexpr double strays = 0.01;      // of the grains, that may be higher

}  // namespace

std::optional<double> reach_of(const Frame& frame) {
    std::vector<double> tops;
    tops.reserve(frame.size());
    for (std::size_t i = 0; i < frame.size(); ++i) tops.push_back(frame.position[i].z() + frame.radius[i]);
    if (tops.empty()) return {};
    const auto higher = static_cast<std::ptrdiff_t>(strays * static_cast<double>(tops.size()));
    const auto at = tops.end() - 1 - higher;
    std::nth_element(tops.begin(), at, tops.end());
    return *at;
}

std::optional<double> known_reach(const FrameArchive& archive) {
    const std::size_t frames = archive.moments().size();
    const double grains = static_cast<double>(frames) *
                          static_cast<double>(std::max<std::size_t>(1, archive.world().most_grains));
    const auto stride = static_cast<std::size_t>(std::max(1.0, grains / most_grains));
    std::optional<double> reach;
    for (std::size_t i = 0; i < frames; i += stride) {
        try {
            const std::optional<double> here = reach_of(archive.grains(i));
            if (here && (!reach || *here > *reach)) reach = here;
        } catch (const DamagedFrame&) {
            continue;  // whoever draws it says so
        }
    }
    return reach;
}

}  // namespace grainreel
