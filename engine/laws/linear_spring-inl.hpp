// Tangential force: a linear spring with Coulomb's cap, T = k_t s + m_eff c_t v_t, |T| <= mu N (Cundall &
// Strack 1979, Geotechnique 29, 47), as LAMMPS' hooke/history has it. If the normal law has no dashpot, c_t =
// 0.
#if defined(GRAINREEL_LAWS_LINEAR_SPRING_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef GRAINREEL_LAWS_LINEAR_SPRING_INL
#undef GRAINREEL_LAWS_LINEAR_SPRING_INL
#else
#define GRAINREEL_LAWS_LINEAR_SPRING_INL
#endif

#include "engine/laws/friction-inl.hpp"
#include "engine/laws/touch-inl.hpp"
#include "engine/plan/plan.hpp"

HWY_BEFORE_NAMESPACE();
namespace grainreel::HWY_NAMESPACE {

struct LinearSpring {
    // The spring follows any slip exactly, so only the onset of a contact causes an error.
    static constexpr bool rubs = true, gains_by_onset = true;

    template <class R>
    struct Parameters {
        R stiffness;  // N/m, k_t
        R friction;   // mu

        template <class Each>
        HWY_INLINE void each(const Each& visit) {
            visit(stiffness), visit(friction);
        }
    };
    static Parameters<double> from(const PairPlan& plan) {
        return {plan.tangential_stiffness, finite_friction(plan.friction)};
    }

    template <class R>
    struct History {
        Triple<R> spring_force;  // N, on j, the spring's part k_t s of the force

        template <class Each>
        HWY_INLINE void each(const Each& visit) {
            visit.turning(spring_force);
        }
    };

    // Tangential force (N) on j. If the normal force pulls, its magnitude sets the cap, as in LAMMPS.
    template <class R, class Normal>
    static HWY_INLINE Triple<R> force(const Parameters<R>& p, const Normal& normal, History<R>& h,
                                      const Touch<R>& touch, R normal_force) {
        const Triple<R> old = carry_along(h.spring_force, touch.turn, touch.normal);
        h.spring_force = old.plus(touch.slip, p.stiffness);
        const Triple<R> damping = dashpot(normal, touch);
        const Triple<R> whole = h.spring_force + damping;
        const Triple<R> capped = capped_at(whole, p.friction * size_of(normal_force));
        h.spring_force = capped - damping;  // while sliding, spring and dashpot add up to the cap
        return capped;
    }
    // Tangential force (N) on j at the present instant, without a step.
    template <class R, class Normal>
    static HWY_INLINE Triple<R> now(const Parameters<R>& p, const Normal& normal, const History<R>& h,
                                    const Touch<R>& touch, R normal_force) {
        return capped_at(h.spring_force + dashpot(normal, touch), p.friction * size_of(normal_force));
    }

    // Stored energy (J). The cap limits the sum of spring and dashpot, so the spring alone may exceed mu N.
    // The excess does not come back as energy.
    template <class R>
    static HWY_INLINE R stored_energy(const Parameters<R>& p, const History<R>& h, R normal_force) {
        return squared_within(h.spring_force, p.friction * size_of(normal_force)) / (R(2) * p.stiffness);
    }

  private:
    template <class R, class Normal>
    static HWY_INLINE Triple<R> dashpot(const Normal& normal, const Touch<R>& touch) {
        if constexpr (requires { normal.sideways_damping(touch); }) {
            return touch.slip_velocity * normal.sideways_damping(touch);
        } else {
            return {R(0), R(0), R(0)};
        }
    }
};

}  // namespace grainreel::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
