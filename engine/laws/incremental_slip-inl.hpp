// Tangential force: Walton's incremental slip (Walton 1993, in Particulate Two-Phase Flow, ch. 25, as
// the original program has it). The stiffness falls from K0 to zero as |T| nears mu N:
//
//   |T| growing:    K_T = K0 [1 - (T - T*) / (mu N - T*)]^gamma
//   |T| shrinking:  K_T = K0 [1 - (T* - T) / (mu N + T*)]^gamma
//
// T is the signed magnitude along the present friction direction, and T* is its value at the last turning
// point. gamma = 1/3 resembles Mindlin's elastic contact, 1 or 2 contacts with plastic flow.
//
// A step takes the stiffness of its middle, where N and T are means of before and after (the implicit
// midpoint rule, of second order). It is found with the slip of the step, because an estimate of T without it
// may lie beyond the cap, where there is no stiffness. docs/notes/step.md has what other rules would give.
#if defined(GRAINREEL_LAWS_INCREMENTAL_SLIP_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef GRAINREEL_LAWS_INCREMENTAL_SLIP_INL
#undef GRAINREEL_LAWS_INCREMENTAL_SLIP_INL
#else
#define GRAINREEL_LAWS_INCREMENTAL_SLIP_INL
#endif

#include "engine/laws/friction-inl.hpp"
#include "engine/laws/softness-inl.hpp"
#include "engine/laws/touch-inl.hpp"
#include "engine/plan/plan.hpp"

HWY_BEFORE_NAMESPACE();
namespace grainreel::HWY_NAMESPACE {

struct IncrementalSlip {
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
        R pressed;        // N, the normal force that the cap had; negative while |T| shrinks

        template <class Each>
        HWY_INLINE void each(const Each& visit) {
            visit.turning(force), visit(turning_ratio), visit(pressed);
        }
    };

    // Tangential force (N) on j. It is zero where the normal force pulls.
    template <class R, class Normal>
    static HWY_INLINE Triple<R> force(const Parameters<R>& p, const Normal&, History<R>& h,
                                      const Touch<R>& touch, R normal_force) {
        const R pushing = larger(R(0), normal_force), limit = p.friction * pushing;
        const auto shrank = h.pressed < R(0);
        const Triple<R> old = carry_along(h.force, touch.turn, touch.normal);

        // The friction direction is that of the old force, or that of the slip where there is no force yet.
        const R old_squared = old.squared();
        const auto loaded = old_squared > R(0);
        const Triple<R> guide = select(loaded, old, touch.slip);
        const R guide_squared = select(loaded, old_squared, touch.slip.squared());
        const R guide_size = root(guide_squared);
        const R old_size = select(loaded, guide_size, R(0));
        const R inverse_size = select(guide_squared > R(0), R(1) / guide_size, R(0));
        const R along = guide.dot(touch.slip) * inverse_size;

        const auto shrinks = along < R(0);
        const auto turns = differ(shrinks, shrank);
        const R pressed = size_of(h.pressed);
        const R ratio = select(turns, old_size / pressed, h.turning_ratio);
        const R sign = select(shrinks, R(-1), R(1));
        const R share = share_of_stiffness(p, sign * ratio, R(0.5) * (pressed + pushing), sign * old_size,
                                           size_of(along));
        const R gain = p.stiffness * along, parallel = multiply_add(gain, share, old_size);
        const auto through_zero = parallel < R(0);  // the direction flips, and a force that shrank now grows
        h.turning_ratio = select(pushing > R(0), select(through_zero, -ratio, ratio), R(0));
        h.pressed = select(differ(shrinks, through_zero), -pushing, pushing);
        // The slip across the old force meets K0, and so does the slip along it, less what the law leaves
        // out.
        const Triple<R> now = (touch.slip * p.stiffness).plus(guide, (parallel - gain) * inverse_size);
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
    // The factor [..]^gamma of the law in the middle of the step. All forces are counted along the slip:
    // `turning_ratio` is T* / N, `old` is T before the step, `pressed` is N in the middle, and `slip` (m, >=
    // 0) is that of the step. If T has no room left to grow, there is no stiffness. T may lie before its
    // turning point, because T* has grown with N. Then the contact has its full stiffness. Without this rule,
    // a contact that turned at mu N and was then pressed harder would slide for ever. (The bounds keep all
    // numbers finite. Where they act, T comes to the cap in this step.)
    template <class R>
    static HWY_INLINE R share_of_stiffness(const Parameters<R>& p, R turning_ratio, R pressed, R old,
                                           R slip) {
        const R room = (p.friction - turning_ratio) * pressed;   // N, from the turning point to the cap
        const R left = multiply_add(p.friction, pressed, -old);  // N, from T before the step to the cap
        const R half = R(0.5) * p.stiffness * slip;              // N, what T gains by then with all of K0
        const R scale = R(1) / larger(room, multiply_add(R(1e-6), half, R(1e-30)));
        const R b = half * scale, a = larger(R(1e-9), smaller(left * scale, R(1) + b));
        return select(left > R(0), smaller(R(1), softness(a, b, p.gamma)), R(0));
    }
};

}  // namespace grainreel::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
