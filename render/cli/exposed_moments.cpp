#include "render/cli/exposed_moments.hpp"

namespace grainreel {

ExposedMoments::ExposedMoments(const std::vector<Shot>& shots, const std::vector<FilmSegment>& segments,
                               const Clock& clock, std::int64_t first) {
    for (const Shot& shot : shots) {
        std::vector<std::int64_t> over =
            exposed_steps(shot, segments.at(static_cast<std::size_t>(shot.segment)), clock);
        std::erase_if(over, [&](std::int64_t step) { return step < first; });
        moments_.want(shot.step, over);
    }
}

void ExposedMoments::keep(const Frame& frame) {
    if (moments_.wants(frame.step)) moments_.keep(frame.step, std::make_shared<const Frame>(frame));
}

void ExposedMoments::fill(Frame& frame) {
    for (const std::int64_t step : moments_.of(frame.step))
        if (const FramePtr* kept = moments_.at(step)) frame.exposed.push_back(*kept);
    moments_.done_with(frame.step);
}

}  // namespace grainreel
