// Tangential force that goes with Hertz' normal force: Mindlin's no-slip stiffness K_t = 8 G* sqrt(R_eff a)
// with Coulomb's cap and a dashpot (Mindlin 1949, J. Appl. Mech. 16, 259; Di Renzo & Di Maio 2005, Chem. Eng.
// Sci. 60, 1303). K_t is 2(1 - nu)/(2 - nu) times Hertz' tangent stiffness for equal materials. Where the
// contact shrinks, its force shrinks with the contact's radius, because otherwise energy would be created
// (Thornton, Cummins & Cleary 2013, Powder Technol. 233, 30).
#if defined(GRAINREEL_LAWS_MINDLIN_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef GRAINREEL_LAWS_MINDLIN_INL
#undef GRAINREEL_LAWS_MINDLIN_INL
#else
#define GRAINREEL_LAWS_MINDLIN_INL
#endif

#include "engine/laws/friction-inl.hpp"
#include "engine/laws/touch-inl.hpp"
#include "engine/plan/plan.hpp"

HWY_BEFORE_NAMESPACE();
namespace grainreel::HWY_NAMESPACE {

struct Mindlin {
    static constexpr bool rubs = true, gains_by_onset = false;

    template <class R>
    struct Parameters {
        R ratio;     // tangential stiffness divided by normal tangent stiffness
        R friction;  // mu

        template <class Each>
        HWY_INLINE void each(const Each& visit) {
            visit(ratio), visit(friction);
        }
    };
    static Parameters<double> from(const PairPlan& plan) {
        return {plan.tangential_ratio, finite_friction(plan.friction)};
    }

    template <class R>
    struct History {
        Triple<R> spring_force;  // N, on j
        R stiffness;             // N/m, K_t of the last step

        template <class Each>
        HWY_INLINE void each(const Each& visit) {
            visit.turning(spring_force), visit(stiffness);
        }
    };

    // Tangential force (N) on j. If the normal force pulls, its magnitude sets the cap.
    template <class R, class Normal>
    static HWY_INLINE Triple<R> force(const Parameters<R>& p, const Normal& normal, History<R>& h,
                                      const Touch<R>& touch, R normal_force) {
        const R stiffness = p.ratio * normal.tangent_stiffness(touch);
        const R shrunk = select(stiffness < h.stiffness, stiffness / h.stiffness, R(1));
        h.spring_force = carry_along(h.spring_force, touch.turn, touch.normal) * shrunk;
        h.stiffness = stiffness;
        h.spring_force += touch.slip * stiffness;
        const Triple<R> damping = touch.slip_velocity * normal.sideways_damping(touch);
        const Triple<R> capped = capped_at(h.spring_force + damping, p.friction * size_of(normal_force));
        h.spring_force = capped - damping;  // while sliding, spring and dashpot add up to the cap
        return capped;
    }
    // Tangential force (N) on j at the present instant, without a step.
    template <class R, class Normal>
    static HWY_INLINE Triple<R> now(const Parameters<R>& p, const Normal& normal, const History<R>& h,
                                    const Touch<R>& touch, R normal_force) {
        return capped_at(h.spring_force + touch.slip_velocity * normal.sideways_damping(touch),
                         p.friction * size_of(normal_force));
    }

    // Stored energy (J), as in linear_spring-inl.hpp.
    template <class R>
    static HWY_INLINE R stored_energy(const Parameters<R>& p, const History<R>& h, R normal_force) {
        const R squared = squared_within(h.spring_force, p.friction * size_of(normal_force));
        return select(h.stiffness > R(0), squared / (R(2) * h.stiffness), R(0));
    }
};

}  // namespace grainreel::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
