// Tangential force: Walton's incremental slip (Walton 1993, in Particulate Two-Phase Flow, ch. 25, as
// the original program has it). The stiffness falls from K0 to zero as |T| nears mu N:
//
//   |T| growing:    K_T = K0 [1 - (T - T*) / (mu N - T*)]^gamma
//   |T| shrinking:  K_T = K0 [1 - (T* - T) / (mu N + T*)]^gamma
//
// T is the signed magnitude along the present friction direction, and T* is its value at the last turning
// point. gamma = 1/3 resembles Mindlin's elastic contact, 1 or 2 contacts with plastic flow.
#if defined(GRAINREEL_LAWS_INCREMENTAL_SLIP_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef GRAINREEL_LAWS_INCREMENTAL_SLIP_INL
#undef GRAINREEL_LAWS_INCREMENTAL_SLIP_INL
#else
#define GRAINREEL_LAWS_INCREMENTAL_SLIP_INL
#endif

#include "engine/laws/friction-inl.hpp"
#include "engine/laws/power-inl.hpp"
#include "engine/laws/touch-inl.hpp"
#include "engine/plan/plan.hpp"

HWY_BEFORE_NAMESPACE();
namespace grainreel::HWY_NAMESPACE {

struct IncrementalSlip {
    // The stiffness is taken at the step's beginning, which leaves an error of first order. So it would not
    // help to know exactly when the contact began.
    static constexpr bool rubs = true, gains_by_onset = false;

    template <class R>
    struct Parameters {
        R stiffness;  // N/m, K0
        R friction;   // mu
        R gamma;

        template <class Each>
        HWY_INLINE void each(const Each& visit) {
            visit(stiffness), visit(friction), visit(gamma);
        }
    };
    static Parameters<double> from(const PairPlan& plan) {
        return {plan.tangential_stiffness, finite_friction(plan.friction), plan.gamma};
    }

    template <class R>
    struct History {
        Triple<R> force;  // N, on j, perpendicular to k
        R turning_ratio;  // T* / N: T* grows and falls with N
        R shrinks;        // 1 while |T| shrinks, else 0

        template <class Each>
        HWY_INLINE void each(const Each& visit) {
            visit.turning(force), visit(turning_ratio), visit(shrinks);
        }
    };

    // Tangential force (N) on j. It is zero where the normal force pulls.
    template <class R, class Normal>
    static HWY_INLINE Triple<R> force(const Parameters<R>& p, const Normal&, History<R>& h,
                                      const Touch<R>& touch, R normal_force) {
        const R pushing = larger(R(0), normal_force), limit = p.friction * pushing;
        const auto shrank = h.shrinks > R(0);
        const Triple<R> old = carry_along(h.force, touch.turn, touch.normal);

        // The friction direction is that of the old force, or that of the slip where there is no force yet.
        const R old_squared = old.squared();
        const auto loaded = old_squared > R(0);
        const Triple<R> guide = select(loaded, old, touch.slip);
        const R guide_squared = select(loaded, old_squared, touch.slip.squared());
        const R guide_size = root(guide_squared);
        const R old_size = select(loaded, guide_size, R(0));
        const R inverse_size = select(guide_squared > R(0), R(1) / guide_size, R(0));
        const Triple<R> direction = guide * inverse_size;
        const R along = direction.dot(touch.slip);

        const auto shrinks = along < R(0);
        const auto turns = differ(shrinks, shrank);
        const R ratio_before = larger(-p.friction, smaller(p.friction, h.turning_ratio));
        const R turning_force = select(turns, old_size, ratio_before * pushing);
        const R sign = select(shrinks, R(-1), R(1));
        const R parallel =
            old_size + p.stiffness * softening(p, sign, turning_force, old_size, limit) * along;
        const Triple<R> now = (direction * parallel).plus(touch.slip.less(direction, along), p.stiffness);
        const auto through_zero = parallel < R(0);  // the direction flips, and a force that shrank now grows
        const R ratio = select(pushing > R(0), select(turns, old_size / pushing, ratio_before), R(0));
        h.turning_ratio = select(through_zero, -ratio, ratio);
        h.shrinks = select(shrinks, select(through_zero, R(0), R(1)), R(0));
        h.force = capped_at(now, limit);
        return h.force;
    }
    // Tangential force (N) on j at the present instant, without a step.
    template <class R, class Normal>
    static HWY_INLINE Triple<R> now(const Parameters<R>&, const Normal&, const History<R>& h, const Touch<R>&,
                                    R) {
        return h.force;
    }

    // Stored energy (J). The force itself is capped, so the energy needs no cap.
    template <class R>
    static HWY_INLINE R stored_energy(const Parameters<R>& p, const History<R>& h, R) {
        return h.force.squared() / (R(2) * p.stiffness);
    }

  private:
    // The factor [..]^gamma of the law, with its base held in [0, 1]. If T has no room left to grow or
    // shrink, there is no stiffness. T may lie before its turning point, because T* has grown with N. Then
    // the contact has its full stiffness. Without this rule, a contact that turned at mu N and was then
    // pressed harder would slide for ever. `sign` is -1 while |T| shrinks, else 1.
    template <class R>
    static HWY_INLINE R softening(const Parameters<R>& p, R sign, R turning_force, R old_size, R limit) {
        const R room = limit - sign * turning_force;
        const R gone = sign * (old_size - turning_force);  // N, change since the turning point
        const R base = larger(R(0), smaller(R(1), R(1) - gone / room));
        return select(gone < R(0), R(1), select(room > R(0), power(base, p.gamma), R(0)));
    }
};

}  // namespace grainreel::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
