#include "engine/run/driver/kept_moments.hpp"

#include <memory>

#include "engine/files/frames/frame_archive.hpp"

namespace grainreel {

Frame places_of(const Frame& frame) {
    Frame places = moment_of(frame);
    places.id = frame.id;
    places.position = frame.position;
    return places;
}

void KeptMoments::want(std::int64_t frame, const std::vector<WantedMoment>& moments) {
    for (const WantedMoment& moment : moments) {
        Wanted& wanted = wanted_[moment.step];
        wanted.whole = wanted.whole || moment.whole;
        wanted.last = frame;
        of_frame_[frame].insert(moment.step);
    }
}

std::set<std::int64_t> KeptMoments::steps() const {
    std::set<std::int64_t> steps;
    for (const auto& [step, wanted] : wanted_) steps.insert(steps.end(), step);
    return steps;
}

void KeptMoments::keep(const Frame& frame) {
    const auto wanted = wanted_.find(frame.step);
    if (wanted == wanted_.end()) return;
    kept_[frame.step] = std::make_shared<const Frame>(wanted->second.whole ? frame : places_of(frame));
}

FramePtr KeptMoments::at(std::int64_t step) const {
    const auto found = kept_.find(step);
    return found == kept_.end() ? nullptr : found->second;
}

void KeptMoments::done_with(std::int64_t frame) {
    const auto done = of_frame_.find(frame);
    if (done == of_frame_.end()) return;
    for (const std::int64_t step : done->second)
        if (wanted_.at(step).last == frame) kept_.erase(step);
    of_frame_.erase(done);
}

}  // namespace grainreel
