// How a step is put together from kicks (velocities by forces) and drifts (positions by velocities), and when
// its forces are evaluated.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "engine/scene/scene.hpp"
#include "engine/state/drive_motion.hpp"
#include "engine/step/motion/integrate.hpp"

namespace grainreel {

// One force evaluation: a drift before it and a kick after it, in steps.
struct Stage {
    double drift, kick;
};

struct Scheme {
    double opening_kick;  // by the forces at the start of the step
    std::vector<Stage> stages;
    double closing_drift;
    double ahead;           // steps, from the velocity between two forces to the time of the second force
    bool corrects = false;  // Gear: positions and velocities are predicted, then corrected

    // Whether positions still change after the last forces of a step.
    bool moves_after_forces() const { return corrects || closing_drift > 0; }

    // Share of a step for which the forces of a stage act. It counts for the work that walls do.
    double acts(std::size_t stage) const {
        return stages[stage].kick + (stage + 1 == stages.size() ? opening_kick : 0);
    }
};

// velocity_verlet: Swope et al. 1982, J. Chem. Phys. 76, 637; everything at the same time after each step.
// leapfrog: velocities half a step behind the positions, as in the original program (docs/notes/step.md).
// position_verlet: Tuckerman et al. 1992, J. Chem. Phys. 97, 1990; forces at the middle of the step.
// forest_ruth: of fourth order for smooth forces, the optimised form of Omelyan, Mryglod & Folk 2002, Comput.
//   Phys. Commun. 146, 188 (PEFRL, position form); four force evaluations per step, some drifts backwards.
// gear: four-value predictor-corrector (Gear 1971; Allen & Tildesley, Computer Simulation of Liquids, app.
// E).
inline Scheme scheme_of(Integrator integrator) {
    constexpr double xi = 0.1786178958448091, lambda = -0.2123418310626054, chi = -0.06626458266981849;
    switch (integrator) {
        case Integrator::velocity_verlet:
            break;
        case Integrator::leapfrog:
            return {1, {{1, 0}}, 0, 0};
        case Integrator::position_verlet:
            return {0, {{0.5, 1}}, 0.5, 0.5};
        case Integrator::forest_ruth:
            return {0,
                    {{xi, 0.5 * (1 - 2 * lambda)},
                     {chi, lambda},
                     {1 - 2 * (chi + xi), lambda},
                     {chi, 0.5 * (1 - 2 * lambda)}},
                    xi,
                    0};
        case Integrator::gear:
            return {0, {{1, 1}}, 0, 0, true};
    }
    return {0.5, {{1, 0.5}}, 0, 0.5};
}

// When the forces of a step are evaluated, and which kicks and drifts lie between two evaluations.

// The forces of one stage of a step.
struct Evaluation {
    double time;            // steps
    double since;           // s, time since the last forces
    double acts;            // s, time for which these forces will act
    DrivePose before, now;  // poses of the walls, at the last forces and at these
};

// Goes through the evaluations of a run, from one stage of a step to the next.
class Evaluations {
  public:
    // Begins with the first stage of step `from`. `step` is in s. `first_step` is the first step after a
    // restart; nothing moved before it.
    Evaluations(const Scheme& scheme, const DriveMotion& motion, double step, std::int64_t from,
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
    const DriveMotion& motion_;
    double step_;
    std::int64_t step_number_;
    std::int64_t first_step_;
    std::size_t stage_ = 0;
    bool begins_run_ = true;
};

}  // namespace grainreel
