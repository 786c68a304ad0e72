// Normal force: linear spring and dashpot, N = k a + m_eff c v_n, with v_n the closing speed. Not clipped at
// the end of contact, where it may pull (as in LAMMPS' hooke/history), so that a free impact has e = exp(-pi
// b / sqrt(1 - b^2)), b = c / (2 sqrt(k / m_eff)) (Schwager & Poeschel 2007, Granul. Matter 9, 465).
#pragma once

#include <string_view>

#include "engine/laws/touch.hpp"
#include "engine/scene/plan.hpp"

namespace grainreel {

struct SpringDashpot {
    static constexpr std::string_view name = "spring-dashpot";
    static constexpr bool uses_velocity = true;

    struct Parameters {
        double stiffness;           // N/m
        double damping;             // 1/s, times the effective mass
        double tangential_damping;  // 1/s, likewise

        explicit Parameters(const PairPlan& plan)
            : stiffness(plan.loading_stiffness),
              damping(plan.normal_damping),
              tangential_damping(plan.tangential_damping) {}
    };

    struct History {};

    // N, may be negative just before the spheres part.
    static double force(const Parameters& p, History&, const Touch& touch) {
        return p.stiffness * touch.overlap + p.damping * touch.effective_mass * touch.closing_speed;
    }

    // J, k a^2 / 2.
    static double stored_energy(const Parameters& p, const History&, const Touch& touch, double) {
        return 0.5 * p.stiffness * touch.overlap * touch.overlap;
    }
};

}  // namespace grainreel
