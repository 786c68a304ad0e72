// A plain step that follows the documentation. It looks at every pair and every wall in every step, computes
// one number at a time, and sums forces as they come. It shares no code with engine/step and engine/laws.
// Formulas: docs/reference/theory.md, with the sources there. It has only velocity Verlet and no periodic
// depth.
#pragma once

#include <cstdint>
#include <map>
#include <utility>
#include <vector>

#include "engine/plan/plan.hpp"
#include "engine/state/container_faces.hpp"

namespace grainreel {

struct ReferenceGrain {
    int species = 0;
    double radius = 0, mass = 0;                               // m, kg
    Vec3 position{0, 0, 0}, velocity{0, 0, 0}, spin{0, 0, 0};  // m, m/s, rad/s
    Vec3 force{0, 0, 0}, torque{0, 0, 0};                      // N, N m
};

// Walls are at rest, or shaken by amplitude x sin(2 pi frequency t) along `direction`, where t counts from
// step 0.
struct ReferenceShaking {
    double amplitude = 0, frequency = 0;  // m, Hz
    Vec3 direction{0, 0, 1};
};

class ReferenceStep {
  public:
    // The grains touch nothing at first. plan: gives pairs and walls by species, and clock.step.
    ReferenceStep(const Plan& plan, std::vector<Face> faces, const Vec3& gravity, ReferenceShaking shaking,
                  std::vector<ReferenceGrain> grains);

    void run(std::int64_t steps);
    const std::vector<ReferenceGrain>& grains() const { return grains_; }
    std::int64_t contacts_met() const { return met_; }  // since the start

  private:
    // What a contact remembers; all zero when the bodies meet.
    struct Memory {
        double largest_overlap = 0, peak = 0, softness = 0;  // m, m, m/N: Walton-Braun
        Vec3 tangential{0, 0, 0}, rolling{0, 0, 0};          // N, N m, on the second body
        double turning_ratio = 0, stiffness = 0;             // incremental slip; Mindlin, N/m
        double pressed = 0;                                  // N, last normal force: incremental slip
        bool shrinks = false;                                // incremental slip
        Vec3 velocity_before{0, 0, 0};                       // m/s: dashpots
        double force_before = 0;                             // N: dashpots
    };
    // Two bodies that touch, and their motion between the last forces and these.
    struct Meeting {
        Vec3 k;                        // unit, from the first to the second
        double overlap, mass, radius;  // m; effective mass and radius: kg, m
        Vec3 velocity;                 // m/s, of the first surface relative to the second
        Vec3 turn;                     // Cayley's vector of the contact's turn
        Vec3 rolled;                   // rad, of the first relative to the second, across k
    };
    struct Push {
        double normal;             // N, repulsive
        Vec3 tangential, rolling;  // N, N m, on the second body
    };

    void meet_grain(std::size_t i, std::size_t j);
    void meet_wall(std::size_t i, std::size_t f);
    Push push(const PairPlan& p, Memory& m, Meeting c) const;
    double normal_force(const PairPlan& p, Memory& m, const Meeting& c, double speed, double& acts,
                        double& touched) const;
    double corrected_force(const PairPlan& p, Memory& m, const Meeting& c, double speed, double& acts,
                           double& touched) const;
    Vec3 slip_force(const PairPlan& p, Memory& m, const Vec3& slip, double normal) const;
    Vec3 displacement(const Face& face, std::int64_t step) const;

    const Plan& plan_;
    const std::vector<Face> faces_;
    const Vec3 gravity_;
    const ReferenceShaking shaking_;
    const double dt_;
    std::vector<ReferenceGrain> grains_;
    std::map<std::pair<std::size_t, std::int64_t>, Memory>
        memory_;  // by (grain, grain) and (grain, -1 - face)
    std::int64_t step_ = 0, met_ = 0;
};

}  // namespace grainreel
