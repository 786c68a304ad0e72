#include "render/run/frames/kept_moments.hpp"

#include <memory>

namespace grainreel {

void KeptMoments::want(std::int64_t shot, const std::vector<PictureParts::Moment>& moments) {
    for (const PictureParts::Moment& moment : moments) {
        Wanted& wanted = wanted_[moment.step];
        wanted.whole = wanted.whole || moment.whole;
        wanted.last_shot = shot;
        of_shot_[shot].insert(moment.step);
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

void KeptMoments::done_with(std::int64_t shot) {
    const auto done = of_shot_.find(shot);
    if (done == of_shot_.end()) return;
    for (const std::int64_t step : done->second)
        if (wanted_.at(step).last_shot == shot) kept_.erase(step);
    of_shot_.erase(done);
}

}  // namespace grainreel
