// A normal and a tangential law as one: the contact force between two grains, or a grain and a wall.
// How to add a law: docs/architecture.md, "Adding a contact law".
#pragma once

#include "engine/base/vector.hpp"
#include "engine/laws/touch.hpp"
#include "engine/scene/plan.hpp"

namespace grainreel {

template <class NormalLawType, class TangentialLawType>
struct ContactLaw {
    using Normal = NormalLawType;
    using Tangential = TangentialLawType;
    static constexpr bool rubs = Tangential::rubs;  // needs slip, twist and spin
    static constexpr bool uses_velocity = Normal::uses_velocity;

    struct Parameters {
        typename Normal::Parameters normal;
        typename Tangential::Parameters tangential;

        explicit Parameters(const PairPlan& plan) : normal(plan), tangential(plan) {}
    };

    struct History {
        [[no_unique_address]] typename Normal::History normal;
        [[no_unique_address]] typename Tangential::History tangential;

        void flip() {
            if constexpr (rubs) tangential.flip();
        }
    };

    // On body j (the wall): normal force along k, tangential force across it. N.
    struct Force {
        double normal;
        Vec3 tangential;
    };

    static Force force(const Parameters& p, History& h, const Touch& touch) {
        Force f{Normal::force(p.normal, h.normal, touch), Vec3::Zero()};
        if constexpr (rubs) {
            f.tangential = Tangential::force(p.tangential, p.normal, h.tangential, touch, f.normal);
        }
        return f;
    }

    // J, what the contact would give back if it were unloaded now.
    static double stored_energy(const Parameters& p, const History& h, const Touch& touch,
                                double normal_force) {
        double energy = Normal::stored_energy(p.normal, h.normal, touch, normal_force);
        if constexpr (rubs) energy += Tangential::stored_energy(p.tangential, h.tangential);
        return energy;
    }
};

}  // namespace grainreel
