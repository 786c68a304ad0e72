// Normal force: the partially latching spring of Walton & Braun (1986, J. Rheol. 30, 949).
//
//   N = max(0, min(K1 a, K2 (a - a0))),   a0 = a_max (1 - K1/K2),   e = sqrt(K1/K2) at any speed
//
// a is the overlap and a_max the largest one since the spheres met. Loading follows slope K1. Unloading
// follows K2 down to the residual overlap a0, and reloading follows K2 up until it meets K1 again. Between 0
// and a0 the force is zero. The residual is forgotten when the spheres part. Some codes lower a0 when a
// contact reloads from inside that gap; the min() rule of the original program does not, and this code does
// not either.
#if defined(GRAINREEL_LAWS_WALTON_BRAUN_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef GRAINREEL_LAWS_WALTON_BRAUN_INL
#undef GRAINREEL_LAWS_WALTON_BRAUN_INL
#else
#define GRAINREEL_LAWS_WALTON_BRAUN_INL
#endif

#include "engine/laws/touch-inl.hpp"
#include "engine/plan/plan.hpp"

HWY_BEFORE_NAMESPACE();
namespace grainreel::HWY_NAMESPACE {

struct WaltonBraun {
    static constexpr bool has_dashpot = false, uses_velocity = false, uses_mass = false, uses_radius = false;
    static constexpr bool weighs_onset = false;

    template <class R>
    struct Parameters {
        R loading, unloading;  // N/m: K1, K2
        R residual_share;      // 1 - K1/K2

        template <class Each>
        HWY_INLINE void each(const Each& visit) {
            visit(loading), visit(unloading), visit(residual_share);
        }
    };
    static Parameters<double> from(const PairPlan& plan) {
        return {plan.loading_stiffness, plan.unloading_stiffness,
                1 - plan.loading_stiffness / plan.unloading_stiffness};
    }

    template <class R>
    struct History {
        R largest_overlap;  // m, a_max since the spheres met

        template <class Each>
        HWY_INLINE void each(const Each& visit) {
            visit(largest_overlap);
        }
    };

    // Normal force (N), >= 0.
    template <class R>
    static HWY_INLINE R force(const Parameters<R>& p, History<R>& h, const Touch<R>& touch) {
        h.largest_overlap = larger(h.largest_overlap, touch.overlap);
        return now(p, h, touch);
    }
    template <class R>
    static HWY_INLINE R now(const Parameters<R>& p, const History<R>& h, const Touch<R>& touch) {
        const R residual = h.largest_overlap * p.residual_share;
        return larger(R(0), smaller(p.loading * touch.overlap, p.unloading * (touch.overlap - residual)));
    }

    // Energy (J) that unloading from here gives back: N^2 / (2 K2).
    template <class R>
    static HWY_INLINE R stored_energy(const Parameters<R>& p, const History<R>&, const Touch<R>&,
                                      R normal_force) {
        return normal_force * normal_force / (R(2) * p.unloading);
    }
    // Latched energy (J), the area between the slopes up to a_max and back: K1 (1 - K1/K2) a_max^2 / 2.
    template <class R>
    static HWY_INLINE R latched_energy(const Parameters<R>& p, const History<R>& h, const Touch<R>&) {
        return R(0.5) * p.loading * p.residual_share * h.largest_overlap * h.largest_overlap;
    }
};

// Shared part of the laws whose unloading slope depends on the largest overlap. Law::unloading() gives the
// slope.
template <class Law>
struct HardeningSpring {
    // Normal force (N), >= 0.
    template <class P, class H, class R>
    static HWY_INLINE R force(const P& p, H& h, const Touch<R>& touch) {
        h.largest_overlap = larger(h.largest_overlap, touch.overlap);
        return now(p, h, touch);
    }
    template <class P, class H, class R>
    static HWY_INLINE R now(const P& p, const H& h, const Touch<R>& touch) {
        // K2 (a - a0) with a0 = a_max (1 - K1/K2), without a division.
        const R down =
            Law::unloading(p, h, touch) * (touch.overlap - h.largest_overlap) + p.loading * h.largest_overlap;
        return larger(R(0), smaller(p.loading * touch.overlap, down));
    }
    // Energy (J) that unloading from here gives back: N^2 / (2 K2).
    template <class P, class H, class R>
    static HWY_INLINE R stored_energy(const P& p, const H& h, const Touch<R>& touch, R normal_force) {
        return normal_force * normal_force / (R(2) * Law::unloading(p, h, touch));
    }
    // Latched energy (J), the area between the slopes up to a_max and back: K1 (1 - K1/K2) a_max^2 / 2.
    template <class P, class H, class R>
    static HWY_INLINE R latched_energy(const P& p, const H& h, const Touch<R>& touch) {
        const R share = R(1) - p.loading / Law::unloading(p, h, touch);
        return R(0.5) * p.loading * share * h.largest_overlap * h.largest_overlap;
    }
};

}  // namespace grainreel::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
