// Normal force: Walton and Braun's latching spring, with corrections for the errors that a finite step makes
// at its kinks. The four corrections help only together. Each alone can make the error larger, because the
// errors partly cancel:
//
//   onset   the first force acts for the time s = a / v the grains have touched, not for half a step
//   peak    the largest overlap is that of the harmonic motion, sqrt(a^2 + m v^2 / K1), not of a sample
//   exit    the last force leaves the speed of the harmonic exit, sqrt(v^2 + K2 (a - a0)^2 / m)
//   K2      1/K2' = e^2/K1 + (1 - e^2) dt^2 / (4 m), which takes back what the step does to the loop's area
//
// The corrections assume that the grains have no other contact, and are right to second order where they have
// others. They are for velocity Verlet, whose v belongs to the middle of the step.
#if defined(GRAINREEL_LAWS_WALTON_BRAUN_CORRECTED_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef GRAINREEL_LAWS_WALTON_BRAUN_CORRECTED_INL
#undef GRAINREEL_LAWS_WALTON_BRAUN_CORRECTED_INL
#else
#define GRAINREEL_LAWS_WALTON_BRAUN_CORRECTED_INL
#endif

#include "engine/laws/touch-inl.hpp"
#include "engine/plan/plan.hpp"

HWY_BEFORE_NAMESPACE();
namespace grainreel::HWY_NAMESPACE {

struct WaltonBraunCorrected {
    static constexpr bool has_dashpot = false, uses_velocity = true, uses_mass = true, uses_radius = false;
    static constexpr bool weighs_onset = true;

    template <class R>
    struct Parameters {
        R loading;     // N/m, K1
        R compliance;  // m/N, 1 / K1
        R give_back;   // m/N, e^2 / K1
        R loss_share;  // (1 - e^2) / 4

        template <class Each>
        HWY_INLINE void each(const Each& visit) {
            visit(loading), visit(compliance), visit(give_back), visit(loss_share);
        }
    };
    static Parameters<double> from(const PairPlan& plan) {
        const double lost = 1 - plan.loading_stiffness / plan.unloading_stiffness;
        return {plan.loading_stiffness, 1 / plan.loading_stiffness, 1 / plan.unloading_stiffness,
                0.25 * lost};
    }

    template <class R>
    struct History {
        R largest_overlap;  // m, a_max since the spheres met
        R peak;             // m, overlap that the harmonic motion will reach
        R softness;         // m/N, 1/K2'

        template <class Each>
        HWY_INLINE void each(const Each& visit) {
            visit(largest_overlap), visit(peak), visit(softness);
        }
    };

    // Time (s) of the step for which the grains have touched. It is the whole step except in the first step
    // of a contact.
    template <class R>
    static HWY_INLINE R touched(const History<R>& h, const Touch<R>& touch) {
        const R v = touch.closing_speed, dt = touch.step;
        const auto begins = h.largest_overlap == R(0);
        if (none(begins)) return dt;
        const R since = select(v > R(0), smaller(dt, touch.overlap / v), dt);
        return select(begins, since, dt);
    }
    // Normal force (N), >= 0: the mean over the step that has this overlap in its middle. (Divisions and
    // roots took most of the time. So the inverses of masses and stiffnesses are stored, and terms that only
    // some contacts need are computed only if one of the contacts needs them.)
    template <class R>
    static HWY_INLINE R force(const Parameters<R>& p, History<R>& h, const Touch<R>& touch) {
        const R by_mass = touch.inverse_mass, dt = touch.step, by_step = R(1) / dt;
        const R v = touch.closing_speed, a = touch.overlap;
        const R met = touched(h, touch);
        const auto loads = a > h.largest_overlap;
        h.softness = p.give_back + p.loss_share * dt * dt * by_mass;
        h.largest_overlap = select(loads, a, larger(h.largest_overlap, h.peak));

        const R spring = now(p, h, touch);
        const R before = R(0.5) * spring * met;  // N s, impulse up to now
        const R speed = v - before * by_mass;    // m/s, now
        if (!none(loads)) {
            const R peak = root(a * a + speed * speed * (p.compliance / by_mass));
            h.peak = select(loads, peak, h.peak);
        }
        const R whole = before + R(0.5) * spring * dt;  // N s, impulse of the step
        const R rest = a - residual(p, h);              // m, overlap left until the force ends
        const auto steps = dt > R(0);
        const decltype(steps) leaves = (rest + dt * (v - whole * by_mass) < R(0)) & (spring > R(0));
        const R over_the_step = select(steps, whole * by_step, spring);
        if (none(leaves)) return over_the_step;
        const R exit = root(speed * speed + spring * spring * h.softness * by_mass);
        const R impulse = (v + exit) / by_mass;
        return select(leaves & steps, larger(R(0), impulse) * by_step, over_the_step);
    }
    template <class R>
    static HWY_INLINE R now(const Parameters<R>& p, const History<R>& h, const Touch<R>& touch) {
        const R down = (touch.overlap - residual(p, h)) / larger(h.softness, p.give_back);
        return larger(R(0), smaller(p.loading * touch.overlap, down));
    }

    // Energy (J) that unloading from here gives back: N^2 / (2 K2).
    template <class R>
    static HWY_INLINE R stored_energy(const Parameters<R>& p, const History<R>& h, const Touch<R>&,
                                      R normal_force) {
        return R(0.5) * normal_force * normal_force * larger(h.softness, p.give_back);
    }
    // Latched energy (J), the area between the slopes up to a_max and back: K1 a0 a_max / 2.
    template <class R>
    static HWY_INLINE R latched_energy(const Parameters<R>& p, const History<R>& h, const Touch<R>&) {
        return R(0.5) * p.loading * residual(p, h) * h.largest_overlap;
    }

  private:
    // Residual overlap (m), a0 = a_max (1 - K1 / K2').
    template <class R>
    static HWY_INLINE R residual(const Parameters<R>& p, const History<R>& h) {
        return h.largest_overlap * (R(1) - p.loading * larger(h.softness, p.give_back));
    }
};

}  // namespace grainreel::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
