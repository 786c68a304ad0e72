// When the forces of a step are evaluated, and which kicks and drifts lie between two evaluations.
#pragma once

#include <cstddef>
#include <cstdint>

#include "engine/state/wall_motion.hpp"
#include "engine/step/motion/integrate.hpp"
#include "engine/step/motion/scheme.hpp"

namespace grainreel {

// The forces of one stage of a step.
struct Evaluation {
    double time;       // steps
    double since;      // s, since the last forces
    double acts;       // s, that these will act
    Pose before, now;  // of the walls, at the last forces and at these
};

// Goes through the evaluations of a run, from one stage of a step to the next.
class Evaluations {
  public:
    // Begins with the first stage of step `from`. step: s. `first_step` is the first step after a restart:
    // nothing moved before it.
    Evaluations(const Scheme& scheme, const WallMotion& motion, double step, std::int64_t from,
                std::int64_t first_step)
        : scheme_(scheme), motion_(motion), step_(step), step_number_(from), first_step_(first_step) {}

    // The step of the present stage, and whether this stage is its last one.
    std::int64_t step_number() const { return step_number_; }
    bool ends_step() const { return stage_ + 1 == scheme_.stages.size(); }
    void go_on() {
        if (ends_step())
            stage_ = 0, ++step_number_;
        else
            ++stage_;
        begins_run_ = false;
    }

    Evaluation now() const;
    // Sets the lengths of the kicks and of the drift from the last forces to those of the present stage. In
    // the first step of a run the closing drift of the last step is left out, because the last run has made
    // it already.
    void set_kicks(KickInput& kicks) const;

  private:
    const Scheme& scheme_;
    const WallMotion& motion_;
    double step_;
    std::int64_t step_number_;
    std::int64_t first_step_;
    std::size_t stage_ = 0;
    bool begins_run_ = true;
};

}  // namespace grainreel
