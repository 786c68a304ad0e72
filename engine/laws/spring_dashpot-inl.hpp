// Normal force: linear spring and dashpot, N = k a + m_eff c v_n, where a is the overlap and v_n the closing
// speed. c is a constant of the contact's kind, as in LAMMPS' hooke/history, or c_1 / sqrt(m_eff), which
// gives grains of all sizes the same restitution. At the end of contact the dashpot would pull. With
// attraction it may pull, as in LAMMPS' hooke/history, and a free impact has e = exp(-pi b / sqrt(1 - b^2)),
// b = c / (2 sqrt(k / m_eff)). Without attraction, N is at least 0 and e is a little larger (Schwager &
// Poeschel 2007, Granul. Matter 9, 465).
#if defined(GRAINREEL_LAWS_SPRING_DASHPOT_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef GRAINREEL_LAWS_SPRING_DASHPOT_INL
#undef GRAINREEL_LAWS_SPRING_DASHPOT_INL
#else
#define GRAINREEL_LAWS_SPRING_DASHPOT_INL
#endif

#include "engine/laws/touch-inl.hpp"
#include "engine/plan/plan.hpp"

HWY_BEFORE_NAMESPACE();
namespace grainreel::HWY_NAMESPACE {

constexpr double kFarBelow = 1e30;  // N

struct SpringDashpot {
    static constexpr bool has_dashpot = true, uses_velocity = true, uses_mass = true, uses_radius = false;
    static constexpr bool weighs_onset = false;

    template <class R>
    struct Parameters {
        R stiffness;           // N/m
        R damping;             // 1/s, to be multiplied by the effective mass
        R tangential_damping;  // 1/s, for the tangential law
        R by_root,
            tangential_by_root;  // kg^(1/2)/s; divided by the root of the effective mass, they are added to
                                 // the two dampings
        R lowest;                // N, lower bound of the force: 0, or so low that no force reaches it

        template <class Each>
        HWY_INLINE void each(const Each& visit) {
            visit(stiffness), visit(damping), visit(tangential_damping);
            visit(by_root), visit(tangential_by_root), visit(lowest);
        }
        // Coefficients of the dashpots (kg/s), and the normal one divided by the mass (1/s).
        HWY_INLINE R normal_damping(const Touch<R>& touch) const {
            return damping_rate(touch) * touch.effective_mass;
        }
        HWY_INLINE R damping_rate(const Touch<R>& touch) const { return rate(damping, by_root, touch); }
        HWY_INLINE R sideways_damping(const Touch<R>& touch) const {
            return rate(tangential_damping, tangential_by_root, touch) * touch.effective_mass;
        }

      private:
        // In most beds the grains of a kind have one size, and no root is needed.
        static HWY_INLINE R rate(R fixed, R over_root, const Touch<R>& touch) {
            if (none(over_root > R(0))) return fixed;
            return fixed + over_root * root(touch.inverse_mass);
        }
    };
    static Parameters<double> from(const PairPlan& plan) {
        return {plan.loading_stiffness,          plan.normal_damping,
                plan.tangential_damping,         plan.damping_by_root,
                plan.tangential_damping_by_root, plan.attraction ? -kFarBelow : 0};
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
        return p.stiffness * touch.overlap;
    }

    // Stored energy (J), k a^2 / 2.
    template <class R>
    static HWY_INLINE R stored_energy(const Parameters<R>& p, const History<R>&, const Touch<R>& touch, R) {
        return R(0.5) * p.stiffness * touch.overlap * touch.overlap;
    }
};

}  // namespace grainreel::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
