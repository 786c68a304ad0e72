// Normal force: Hertz' elastic contact with a dashpot (Hertz 1881; Tsuji, Tanaka & Ishida 1992, Powder
// Technol. 71, 239),
//
//   N = k a^(3/2) + d sqrt(m_eff k) a^(1/4) v_n,   k = 4/3 E* sqrt(R_eff).
//
// a is the overlap, v_n the closing speed and d a number without unit. The restitution does not depend on
// speed. `attraction` is as in spring_dashpot-inl.hpp.
#if defined(GRAINREEL_LAWS_HERTZ_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef GRAINREEL_LAWS_HERTZ_INL
#undef GRAINREEL_LAWS_HERTZ_INL
#else
#define GRAINREEL_LAWS_HERTZ_INL
#endif

#include "engine/laws/spring_dashpot-inl.hpp"
#include "engine/laws/touch-inl.hpp"
#include "engine/plan/plan.hpp"

HWY_BEFORE_NAMESPACE();
namespace grainreel::HWY_NAMESPACE {

struct Hertz {
    static constexpr bool has_dashpot = true, uses_velocity = true, uses_mass = true, uses_radius = true;
    static constexpr bool weighs_onset = false;

    template <class R>
    struct Parameters {
        R modulus;         // Pa, 4/3 E*
        R damping;         // d
        R sideways_share;  // ratio of the two dashpots, sideways to normal: the root of the ratio of the
                           // stiffnesses
        R lowest;          // N, lower bound of the force: 0, or so low that no force reaches it

        template <class Each>
        HWY_INLINE void each(const Each& visit) {
            visit(modulus), visit(damping), visit(sideways_share), visit(lowest);
        }
        // Tangent stiffness (N/m), dN/da of the elastic part: 2 E* times the contact's radius.
        HWY_INLINE R tangent_stiffness(const Touch<R>& touch) const {
            return R(1.5) * modulus * contact_radius(touch);
        }
        // Coefficients of the dashpots (kg/s), and the normal one divided by the mass (1/s).
        HWY_INLINE R normal_damping(const Touch<R>& touch) const {
            return damping * root(touch.effective_mass * modulus * contact_radius(touch));
        }
        HWY_INLINE R damping_rate(const Touch<R>& touch) const {
            return normal_damping(touch) * touch.inverse_mass;
        }
        HWY_INLINE R sideways_damping(const Touch<R>& touch) const {
            return sideways_share * normal_damping(touch);
        }
        // Contact radius (m), sqrt(R_eff a).
        static HWY_INLINE R contact_radius(const Touch<R>& touch) {
            return root(touch.effective_radius * touch.overlap);
        }
    };
    static Parameters<double> from(const PairPlan& plan) {
        return {4.0 / 3.0 * plan.modulus, plan.hertz_damping, std::sqrt(plan.tangential_ratio),
                plan.attraction ? -kFarBelow : 0};
    }

    template <class R>
    struct History {
        template <class Each>
        HWY_INLINE void each(const Each&) {}
    };

    // Normal force (N). With attraction it is negative just before the spheres part.
    template <class R>
    static HWY_INLINE R force(const Parameters<R>& p, History<R>& h, const Touch<R>& touch) {
        return now(p, h, touch);
    }
    template <class R>
    static HWY_INLINE R now(const Parameters<R>& p, const History<R>&, const Touch<R>& touch) {
        return larger(p.lowest,
                      multiply_add(p.normal_damping(touch), touch.closing_speed, spring_force(p, touch)));
    }
    template <class R>
    static HWY_INLINE R spring_force(const Parameters<R>& p, const Touch<R>& touch) {
        return p.modulus * p.contact_radius(touch) * touch.overlap;
    }

    // Stored energy (J), 2/5 k a^(5/2).
    template <class R>
    static HWY_INLINE R stored_energy(const Parameters<R>& p, const History<R>&, const Touch<R>& touch, R) {
        return R(0.4) * spring_force(p, touch) * touch.overlap;
    }
};

}  // namespace grainreel::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
