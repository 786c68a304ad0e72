// Tangential force: Walton's incremental slip (Walton 1993, in Particulate Two-Phase Flow, ch. 25; physics of
// the original program, its section 2.5.2). The stiffness falls from K0 to zero as |T| nears mu N:
//
//   |T| growing:    K_T = K0 [1 - (T - T*) / (mu N - T*)]^gamma
//   |T| shrinking:  K_T = K0 [1 - (T* - T) / (mu N + T*)]^gamma
//
// T is the signed magnitude along the present friction direction, T* its value at the last turning point.
// gamma = 1/3 resembles Mindlin's elastic contact, 1 or 2 contacts with plastic flow.
#pragma once

#include <algorithm>
#include <cmath>
#include <string_view>

#include "engine/base/cube_root.hpp"
#include "engine/laws/carry.hpp"
#include "engine/laws/touch.hpp"
#include "engine/scene/plan.hpp"

namespace grainreel {

struct IncrementalSlip {
    static constexpr std::string_view name = "incremental-slip";
    static constexpr bool rubs = true;

    struct Parameters {
        double stiffness;  // N/m, K0
        double friction;   // mu, may be infinite
        double gamma;

        explicit Parameters(const PairPlan& plan)
            : stiffness(plan.tangential_stiffness), friction(plan.friction), gamma(plan.gamma) {}
    };

    struct History {
        Vec3 force = Vec3::Zero();   // N, on j, perpendicular to `normal`
        Vec3 normal = Vec3::Zero();  // k of the last step; zero for a new contact
        double normal_force = 0;     // N, of the last step
        double turning_force = 0;    // N, T*
        double growing = 1;          // +1 while |T| grows, -1 while it shrinks

        void flip() {  // i and j change places
            force = -force;
            normal = -normal;
        }
    };

    // N, on j. `normal_force` N >= 0.
    template <class NormalParameters>
    static Vec3 force(const Parameters& p, const NormalParameters&, History& h, const Touch& touch,
                      double normal_force) {
        const bool sticks = std::isinf(p.friction);
        const double limit = sticks ? p.friction : p.friction * normal_force;
        const Vec3 old = carry_along(h.force, h.normal, touch.normal, touch.twist);
        h.normal = touch.normal;
        rescale_turning_force(h, limit, normal_force);
        h.normal_force = normal_force;

        const double old_size = std::sqrt(old.squaredNorm());
        Vec3 direction;
        if (old_size > 0) {
            direction = old * (1 / old_size);
        } else {
            const double slip_size = std::sqrt(touch.slip.squaredNorm());
            if (slip_size == 0) return h.force = old;
            direction = touch.slip * (1 / slip_size);
        }
        const double along = direction.dot(touch.slip);

        note_turning(h, along, old_size);
        const double stiffness = sticks ? p.stiffness : p.stiffness * softening(p, h, old_size, limit);
        const double parallel = old_size + stiffness * along;
        Vec3 now = direction * parallel + (touch.slip - direction * along) * p.stiffness;
        if (parallel < 0) {  // through zero: the direction flips, and what shrank now grows
            h.turning_force = -h.turning_force;
            h.growing = 1;
        }
        const double size_squared = now.squaredNorm();
        if (size_squared > limit * limit) now *= limit / std::sqrt(size_squared);
        return h.force = now;
    }

    static double stored_energy(const Parameters& p, const History& h) {
        return h.force.squaredNorm() / (2 * p.stiffness);
    }

  private:
    static void rescale_turning_force(History& h, double limit, double normal_force) {
        if (h.turning_force == 0) return;
        h.turning_force *= h.normal_force > 0 ? normal_force / h.normal_force : 0.0;
        h.turning_force = std::clamp(h.turning_force, -limit, limit);
    }

    static void note_turning(History& h, double along, double old_size) {
        const double growing = along < 0 ? -1.0 : 1.0;
        if (growing != h.growing) h.turning_force = old_size;
        h.growing = growing;
    }

    // [..]^gamma of the law, its base held in [0, 1]; no room left to grow or shrink means no stiffness.
    static double softening(const Parameters& p, const History& h, double old_size, double limit) {
        const double room = limit - h.growing * h.turning_force;
        if (room <= 0) return 0;
        const double used = h.growing * (old_size - h.turning_force) / room;
        const double base = std::clamp(1 - used, 0.0, 1.0);
        if (p.gamma == 1) return base;
        if (p.gamma == 1.0 / 3.0) return cube_root(base);
        return std::pow(base, p.gamma);
    }
};

}  // namespace grainreel
