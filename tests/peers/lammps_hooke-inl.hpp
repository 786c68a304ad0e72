// LAMMPS' gran/hooke/history as this engine would compute it, its conventions kept: velocities of the half
// step in dashpots and slip, taken across the normal of its end, the slip turned by projection alone, no slip
// in the forces before the first step. For the comparison with it only (same_state.cpp); with arms of the
// full radii.
#if defined(GRAINREEL_TESTS_LAMMPS_HOOKE_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef GRAINREEL_TESTS_LAMMPS_HOOKE_INL
#undef GRAINREEL_TESTS_LAMMPS_HOOKE_INL
#else
#define GRAINREEL_TESTS_LAMMPS_HOOKE_INL
#endif

#include "engine/laws/kernel-inl.hpp"
#include "engine/laws/touch-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace grainreel::HWY_NAMESPACE {

struct LammpsHooke {
    static constexpr bool rubs = true, uses_velocity = true, uses_mass = true, uses_radius = false;

    template <class R>
    struct Parameters {
        R normal_stiffness, tangential_stiffness;  // N/m
        R normal_damping, tangential_damping;      // 1/s, times the effective mass
        R friction;

        template <class Each>
        HWY_INLINE void each(const Each& visit) {
            visit(normal_stiffness), visit(tangential_stiffness);
            visit(normal_damping), visit(tangential_damping), visit(friction);
        }
    };
    static Parameters<double> from(const PairPlan& plan) {
        return {plan.loading_stiffness, plan.tangential_stiffness, plan.normal_damping,
                plan.tangential_damping, plan.friction};
    }

    template <class R>
    struct History {
        Triple<R> slip;  // m, of i on j

        template <class Each>
        HWY_INLINE void each(const Each& visit) {
            visit.turning(slip);
        }
    };

    template <class R>
    struct Force {
        R normal;
        Triple<R> tangential;
    };

    template <class R>
    static HWY_INLINE Force<R> force(const Parameters<R>& p, History<R>& h, const Touch<R>& touch,
                                     const Triple<R>& velocity, R step, R) {
        const Triple<R>& k = touch.normal;
        const R closing = k.dot(velocity), m = touch.effective_mass;
        const Triple<R> across = velocity - k * closing;
        const R normal = p.normal_stiffness * touch.overlap + m * p.normal_damping * closing;

        h.slip += across * step;
        const auto slipped = h.slip.squared() > R(0);
        h.slip = h.slip - k * k.dot(h.slip);
        const Triple<R> damping = across * (m * p.tangential_damping);
        const Triple<R> whole = h.slip * p.tangential_stiffness + damping;
        const R size = root(whole.squared()), limit = p.friction * size_of(normal);
        const auto slides = size > limit;
        const Triple<R> none{R(0), R(0), R(0)};
        const Triple<R> capped = select(slipped, whole * (limit / size), none);
        const Triple<R> left = (capped - damping) * (R(1) / p.tangential_stiffness);
        h.slip = select(slides & slipped, left, h.slip);
        return {normal, select(slides, capped, whole)};
    }
    template <class R>
    static HWY_INLINE Force<R> now(const Parameters<R>& p, const History<R>& h, const Touch<R>& touch,
                                   const Triple<R>& velocity, ContactEnergies<R>& energies) {
        energies = {R(0), R(0), R(0), R(0), R(0)};  // LAMMPS is asked for none
        History<R> copy = h;
        return force(p, copy, touch, velocity, R(0), R(0));
    }
};

}  // namespace grainreel::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
