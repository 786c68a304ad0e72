#include "render/run/moments/exposed_moments.hpp"

namespace grainreel {

ExposedMoments::ExposedMoments(const std::vector<Shot>& shots, const std::vector<FilmSegment>& segments,
                               const Clock& clock, const std::vector<int>& multiples, std::int64_t first)
    : segments_(segments), clock_(clock), first_(first) {
    for (const Shot& shot : shots) {
        std::set<std::int64_t> wanted;
        for (const int periods : multiples)
            for (const std::int64_t step : steps_of(shot, periods)) wanted.insert(step);
        if (wanted.empty()) continue;
        segment_[shot.step] = shot.segment;
        moments_.want(shot.step, {wanted.begin(), wanted.end()});
    }
}

std::vector<std::int64_t> ExposedMoments::steps_of(const Shot& shot, int periods) const {
    std::vector<std::int64_t> over =
        exposed_steps(shot, segments_.at(static_cast<std::size_t>(shot.segment)), clock_, periods);
    std::erase_if(over, [&](std::int64_t step) { return step < first_; });
    return over;
}

void ExposedMoments::keep(const Frame& frame) {
    if (moments_.wants(frame.step)) moments_.keep(frame.step, std::make_shared<const Frame>(frame));
}

void ExposedMoments::fill(Frame& frame, int periods) {
    const auto segment = segment_.find(frame.step);
    if (segment == segment_.end()) return;
    for (const std::int64_t step : steps_of({frame.step, segment->second}, periods))
        if (const FramePtr* kept = moments_.at(step)) frame.exposed.push_back(*kept);
    leave_out(frame.step);
}

void ExposedMoments::leave_out(std::int64_t step) {
    segment_.erase(step);
    moments_.done_with(step);
}

}  // namespace grainreel
