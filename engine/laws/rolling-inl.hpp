// Resistance to rolling: an elastic-plastic rolling spring (Iwashita & Oda 1998, J. Eng. Mech. 124, 285; Ai
// et al. 2011, Powder Technol. 206, 269, model C without dashpot). The torque grows with the rolled angle
// theta,
//
//   M = k_r theta,   k_r = K0 R_eff^2,   |M| <= mu_r R_eff N.
//
// K0 is the tangential stiffness of the pair (PairPlan), R_eff the effective radius, mu_r the coefficient of
// rolling friction and N the normal force. A spring can hold a grain at rest on a slope; a torque of constant
// size cannot. The resistance is added to any contact law with friction.
#if defined(GRAINREEL_LAWS_ROLLING_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef GRAINREEL_LAWS_ROLLING_INL
#undef GRAINREEL_LAWS_ROLLING_INL
#else
#define GRAINREEL_LAWS_ROLLING_INL
#endif

#include "engine/laws/friction-inl.hpp"
#include "engine/plan/plan.hpp"

HWY_BEFORE_NAMESPACE();
namespace grainreel::HWY_NAMESPACE {

struct RollingSpring {
    template <class R>
    struct Parameters {
        R stiffness;  // N/m, K0
        R friction;   // mu_r

        template <class Each>
        HWY_INLINE void each(const Each& visit) {
            visit(stiffness), visit(friction);
        }
    };
    static Parameters<double> from(const PairPlan& plan) {
        return {plan.tangential_stiffness, plan.rolling_friction};
    }

    template <class R>
    struct History {
        Triple<R> torque;  // N m, on j

        template <class Each>
        HWY_INLINE void each(const Each& visit) {
            visit.turning(torque);
        }
    };

    // Torque (N m) on j. `angle` (rad) is the rotation of i relative to j in this step, without its part
    // about the normal; `normal` and `turn` are as in Touch.
    template <class R>
    static HWY_INLINE Triple<R> torque(const Parameters<R>& p, History<R>& h, const Triple<R>& normal,
                                       const Triple<R>& turn, const Triple<R>& angle, R effective_radius,
                                       R normal_force) {
        const Triple<R> old = carry_along(h.torque, turn, normal);
        h.torque = capped_at(old + angle * (p.stiffness * effective_radius * effective_radius),
                             p.friction * effective_radius * larger(R(0), normal_force));
        return h.torque;
    }

    // Stored energy (J), M^2 / (2 k_r).
    template <class R>
    static HWY_INLINE R stored_energy(const Parameters<R>& p, const History<R>& h, R effective_radius) {
        const R stiffness = p.stiffness * effective_radius * effective_radius;
        return select(stiffness > R(0), h.torque.squared() / (R(2) * stiffness), R(0));
    }
};

}  // namespace grainreel::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
