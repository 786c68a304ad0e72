// One contact led along a path by hand, through the same law that the step loop uses.
#pragma once

#include "engine/laws/law_kernel.hpp"
#include "engine/step/lists/histories.hpp"

namespace grainreel {

class DrivenContact {
  public:
    explicit DrivenContact(const PairPlan& pair);

    // Where the contact is led in one step.
    struct Move {
        Vec3 normal{0, 0, 1};  // unit, from i to j, at the end of the step
        double overlap = 0;    // m, as above
        Vec3 slip{0, 0, 0};    // m, of i over j during the step
        double twist = 0;      // rad, about the normal, as above
    };
    void move(const Move& move);

    double normal_force() const;  // N
    Vec3 tangential() const;      // N, on j

  private:
    Vec3 turn_of(const Move& move) const;

    const LawKernel& law_;
    LawParameters parameters_;
    Histories history_;
    TouchChunk touch_;
    ForceChunk force_;
    Vec3 normal_{0, 0, 0};  // of the last move
};

}  // namespace grainreel
