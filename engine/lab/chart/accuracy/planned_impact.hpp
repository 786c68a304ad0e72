// Computes the impact of two grains, or of a grain and a plane, with the stiffness that the plan chooses for
// them. Also moves one contact along a given path.
#pragma once

#include "engine/lab/chart/small_world.hpp"
#include "engine/laws/law_kernel.hpp"
#include "engine/step/lists/histories.hpp"

namespace grainreel {

struct ImpactScene {
    double restitution = 0.9, friction = 0;
    double speed = 0.3;                        // m/s
    double size_ratio = 1, density_ratio = 1;  // of the second grain to the first, which has bench_radius
    bool wall = false;                         // a plane in place of the second grain
    std::string law;                           // more lines of [contact], such as its laws
};

// The plan of the impact. Species 0 is the first grain, species 1 the second.
Plan plan_of(const ImpactScene& impact);

// The step (s) that the plan chooses for two grains with restitution 0.9 and friction 0.5, converted to the
// stiffness bench_stiffness.
double usual_step();

struct Impact {
    Vec3 velocity[2], spin[2];             // m/s, rad/s, after the impact; zero for the plane
    double energy = 0, energy_before = 0;  // J
    double momentum_change = 0;            // change of the total momentum, divided by that of the first grain
    double angular_change = 0;  // change of the total angular momentum about the origin, divided by momentum
                                // times radius of the first grain
};
// Makes the impact: the first grain flies at the second, or down on the plane, at `angle` (rad) from the
// normal. `phase` is the share of a step, 0 to 1, that is left before the first touch. `step` is in s.
Impact make_impact(const ImpactScene& impact, const Plan& plan, double step, double angle, double phase);

// One contact that is moved along a path by hand, through the same law as in the step loop.
class DrivenContact {
  public:
    explicit DrivenContact(const PairPlan& pair);

    // How the contact moves in one step.
    struct Move {
        Vec3 normal{0, 0, 1};  // unit, from i to j, at the end of the step
        double overlap = 0;    // m, at the end of the step
        Vec3 slip{0, 0, 0};    // m, of i relative to j during the step
        double twist = 0;      // rad, about the normal, during the step
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
    Vec3 normal_{0, 0, 0};  // normal of the last move
};

}  // namespace grainreel
