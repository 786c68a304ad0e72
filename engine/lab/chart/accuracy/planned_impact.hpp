// Two grains, or a grain and a plane, with the stiffness and the step that the plan chooses for them.
#pragma once

#include <string>

#include "engine/lab/chart/small_world.hpp"
#include "engine/laws/law_kernel.hpp"
#include "engine/step/lists/histories.hpp"

namespace grainreel {

struct ImpactScene {
    double restitution = 0.9, friction = 0;
    double speed = 0.3;                        // m/s
    double size_ratio = 1, density_ratio = 1;  // of the second grain over the first, of bench_radius
    bool wall = false;                         // a plane in place of the second grain
};

// Species 0 is the first grain, 1 the second.
Plan plan_of(const ImpactScene& impact);

// s: the step that the plan chooses for two grains of default restitution and friction whose stiffness is
// bench_stiffness.
double usual_step();

struct Impact {
    Vec3 velocity[2], spin[2];             // m/s, rad/s, afterwards; the plane's is zero
    double energy = 0, energy_before = 0;  // J
    double momentum_change = 0;            // of all, over the first's
    double angular_change = 0;             // of all about the origin, over momentum x radius of the first
};
// The first grain flies at the second, or down on the plane, at `angle` (rad) from the normal. `phase`: of a
// step, 0 to 1, that is left to the first touch. `step`: s.
Impact make_impact(const ImpactScene& impact, const Plan& plan, double step, double angle, double phase);

// One contact led along a path by hand, through the same law that the step loop uses.

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
