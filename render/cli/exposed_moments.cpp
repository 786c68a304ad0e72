#include "render/cli/exposed_moments.hpp"

#include <algorithm>

namespace grainreel {

ExposedMoments::ExposedMoments(const std::vector<Shot>& shots, const std::vector<FilmSegment>& segments,
                               const Clock& clock, std::int64_t first) {
    for (const Shot& shot : shots) {
        std::vector<std::int64_t> over =
            exposed_steps(shot, segments.at(static_cast<std::size_t>(shot.segment)), clock);
        std::erase_if(over, [&](std::int64_t step) { return step < first; });
        if (over.empty()) continue;
        steps_.insert(steps_.end(), over.begin(), over.end());
        wanted_[shot.step] = std::move(over);
    }
    std::sort(steps_.begin(), steps_.end());
    steps_.erase(std::unique(steps_.begin(), steps_.end()), steps_.end());
}

void ExposedMoments::keep(const Frame& frame) {
    if (std::binary_search(steps_.begin(), steps_.end(), frame.step))
        kept_[frame.step] = std::make_shared<const Frame>(frame);
}

void ExposedMoments::fill(Frame& frame) {
    const auto wanted = wanted_.find(frame.step);
    if (wanted != wanted_.end())
        for (const std::int64_t step : wanted->second)
            if (const auto kept = kept_.find(step); kept != kept_.end())
                frame.exposed.push_back(kept->second);
    wanted_.erase(wanted_.begin(), wanted_.upper_bound(frame.step));
    // Later pictures begin later, but where a short exposure is followed by a long one.
    std::int64_t earliest = frame.step;
    for (const auto& [step, over] : wanted_) earliest = std::min(earliest, over.front());
    kept_.erase(kept_.begin(), kept_.lower_bound(earliest));
}

}  // namespace grainreel
