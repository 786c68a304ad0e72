#include "engine/step/motion/scheme.hpp"

namespace grainreel {

Evaluation Evaluations::now() const {
    // Sums of this step's drifts, as shares of a step: up to the forces of this stage, up to the step's last
    // forces, and up to the forces before those of this stage.
    double share = 0, all = 0, before = 0;
    for (std::size_t s = 0; s < scheme_.stages.size(); ++s) {
        if (s < stage_) before += scheme_.stages[s].drift;
        if (s <= stage_) share += scheme_.stages[s].drift;
        all += scheme_.stages[s].drift;
    }
    Evaluation at;
    at.time = static_cast<double>(step_number_) + share;
    at.acts = step_ * scheme_.acts(stage_);
    at.now = motion_.at(step_number_, share);
    // Whether the forces before those of this stage belong to the previous step.
    const bool goes_on = stage_ == 0 && step_number_ != first_step_;
    at.before = goes_on ? motion_.at(step_number_ - 1, all) : motion_.at(step_number_, before);
    at.since = step_ * (scheme_.stages[stage_].drift + (goes_on ? scheme_.closing_drift : 0));
    return at;
}

void Evaluations::set_kicks(KickInput& kicks) const {
    const std::size_t stage_before = stage_ == 0 ? scheme_.stages.size() - 1 : stage_ - 1;
    kicks.end_kick = step_ * scheme_.stages[stage_before].kick;
    kicks.begin_kick = stage_ == 0 ? step_ * scheme_.opening_kick : 0;
    kicks.drift = step_ * scheme_.stages[stage_].drift;
    const bool goes_on = stage_ == 0 && !begins_run_ && !scheme_.corrects;
    kicks.closing_drift = goes_on ? step_ * scheme_.closing_drift : 0;
}

}  // namespace grainreel
