// Tangential force: a linear spring with Coulomb's cap, T = k_t s + m_eff c_t v_t, |T| <= mu N (Cundall &
// Strack 1979, Geotechnique 29, 47), as LAMMPS' hooke/history has it. With a normal law that has no dashpot
// c_t = 0.
#pragma once

#include <algorithm>
#include <cmath>
#include <string_view>

#include "engine/laws/carry.hpp"
#include "engine/laws/touch.hpp"
#include "engine/scene/plan.hpp"

namespace grainreel {

struct LinearSpring {
    static constexpr std::string_view name = "linear-spring";
    static constexpr bool rubs = true;

    struct Parameters {
        double stiffness;  // N/m, k_t
        double friction;   // mu, may be infinite

        explicit Parameters(const PairPlan& plan)
            : stiffness(plan.tangential_stiffness), friction(plan.friction) {}
    };

    struct History {
        Vec3 force = Vec3::Zero();         // N, the force on j
        Vec3 spring_force = Vec3::Zero();  // N, the spring's part of it, k_t s
        Vec3 normal = Vec3::Zero();        // k of the last step; zero for a new contact

        void flip() {  // i and j change places
            force = -force;
            spring_force = -spring_force;
            normal = -normal;
        }
    };

    // N, on j. A normal force that pulls caps by its size, as in LAMMPS.
    template <class NormalParameters>
    static Vec3 force(const Parameters& p, const NormalParameters& normal, History& h, const Touch& touch,
                      double normal_force) {
        h.spring_force = carry_along(h.spring_force, h.normal, touch.normal, touch.twist);
        h.normal = touch.normal;
        h.spring_force += touch.slip * p.stiffness;
        Vec3 damping = Vec3::Zero();
        if constexpr (requires { normal.tangential_damping; }) {
            damping = touch.slip_velocity * (normal.tangential_damping * touch.effective_mass);
        }
        h.force = h.spring_force + damping;
        const double limit = p.friction * std::abs(normal_force);
        const double size = h.force.norm();
        if (size > limit) {  // slides: the spring keeps what the cap leaves it
            h.force *= limit / size;
            h.spring_force = h.force - damping;
        }
        return h.force;
    }

    static double stored_energy(const Parameters& p, const History& h) {
        return h.spring_force.squaredNorm() / (2 * p.stiffness);
    }
};

}  // namespace grainreel
