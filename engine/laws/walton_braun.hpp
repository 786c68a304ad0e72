// Normal force: the partially latching spring of Walton & Braun (1986, J. Rheol. 30, 949).
//
//   N = max(0, min(K1 a, K2 (a - a0))),   a0 = a_max (1 - K1/K2),   e = sqrt(K1/K2) at any speed
//
// Loading goes up slope K1, unloading down K2 to the residual overlap a0, reloading up K2 until it meets K1
// again. Between 0 and a0 the force is zero. The residual is forgotten when the spheres part. Some codes
// lower a0 when a contact reloads from inside that gap; the min() rule of the original program does not, nor
// do we.
#pragma once

#include <algorithm>
#include <string_view>

#include "engine/laws/touch.hpp"
#include "engine/scene/plan.hpp"

namespace grainreel {

struct WaltonBraun {
    static constexpr std::string_view name = "walton-braun";
    static constexpr bool uses_velocity = false;

    struct Parameters {
        double loading, unloading;  // N/m: K1, K2
        double residual_share;      // 1 - K1/K2

        explicit Parameters(const PairPlan& plan)
            : loading(plan.loading_stiffness),
              unloading(plan.unloading_stiffness),
              residual_share(1 - plan.loading_stiffness / plan.unloading_stiffness) {}
    };

    struct History {
        double largest_overlap = 0;  // m, a_max since the spheres met
    };

    // N, >= 0.
    static double force(const Parameters& p, History& h, const Touch& touch) {
        h.largest_overlap = std::max(h.largest_overlap, touch.overlap);
        const double residual = h.largest_overlap * p.residual_share;
        return std::max(0.0, std::min(p.loading * touch.overlap, p.unloading * (touch.overlap - residual)));
    }

    // J, what unloading from here gives back: N^2 / (2 K2).
    static double stored_energy(const Parameters& p, const History&, const Touch&, double normal_force) {
        return normal_force * normal_force / (2 * p.unloading);
    }
};

}  // namespace grainreel
