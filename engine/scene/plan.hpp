// From what the scene says to what the engine does: laws, stiffness, step, and what that will cost.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "engine/base/clock.hpp"
#include "engine/scene/scene.hpp"

namespace grainreel {

// The numbers of one kind of contact, ready for the laws. SI units.
struct PairPlan {
    double effective_mass = 0;       // kg, the lightest pair of these species
    double loading_stiffness = 0;    // N/m: K1 (Walton-Braun) or kn (spring-dashpot)
    double unloading_stiffness = 0;  // N/m: K2 = K1 / e^2; equals K1 for the spring-dashpot
    double hardening = 0;  // 1/m: S of K2 = K1 + S F_max, in place of a constant K2 (which then holds at v*)
    double tangential_stiffness = 0;  // N/m: K0 or kt
    double gamma = 0;
    double restitution = 1;  // at v* where it falls with speed
    double friction = 0;
    double normal_damping = 0;      // 1/s, times the effective mass of the touching pair
    double tangential_damping = 0;  // 1/s, likewise
    double contact_time = 0;        // s, of a free impact
    double allowed_overlap = 0;     // m
    std::string stiffness_reason;   // which condition binds: "impact", "static load", "wave", "the scene"
};

struct Plan {
    NormalLaw normal = NormalLaw::walton_braun;
    TangentialLaw tangential = TangentialLaw::incremental_slip;  // `none` when nothing rubs
    LeverArms arms = LeverArms::contact_plane;
    bool moving_walls = false;

    std::vector<PairPlan> grain;  // species x species, row-major
    std::vector<PairPlan> wall;   // one a species

    Clock clock;
    std::int64_t steps = 0;  // of vibration
    std::int64_t settle_steps_limit = 0;
    std::string step_reason;      // which condition binds the step
    double impact_speed = 0;      // m/s, v* of the stiffness rule
    double expected_overlap = 0;  // largest expected overlap over the smaller diameter

    std::int64_t trajectory_every = 0;  // steps; 0: none
    std::int64_t measures_every = 0;    // steps
    double bed_height = 0;              // m, expected, at a solid fraction of 0.6
    std::vector<std::string> warnings;  // each one line, with place and remedy

    const PairPlan& between(std::size_t a, std::size_t b) const { return grain[a * wall.size() + b]; }
};

// Throws UserError when the scene cannot be run as it stands (does not fit, too many steps, no stiffness).
Plan make_plan(const Scene& scene);

}  // namespace grainreel
