// Combines a normal and a tangential law into one law for the contact force between two grains, or a grain
// and a wall. kernel-inl.hpp evaluates it for a chunk of contacts. CONTRIBUTING.md, "A contact law", says how
// to add a law.
#if defined(GRAINREEL_LAWS_CONTACT_LAW_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef GRAINREEL_LAWS_CONTACT_LAW_INL
#undef GRAINREEL_LAWS_CONTACT_LAW_INL
#else
#define GRAINREEL_LAWS_CONTACT_LAW_INL
#endif

#include "engine/laws/touch-inl.hpp"
#include "engine/plan/plan.hpp"

HWY_BEFORE_NAMESPACE();
namespace grainreel::HWY_NAMESPACE {

// Values of the last step that laws with a dashpot need; all zero for a new contact.
template <class R, bool kept>
struct StepBefore {
    template <class Each>
    HWY_INLINE void each(const Each&) {}
};
template <class R>
struct StepBefore<R, true> {
    Triple<R> velocity;  // m/s, at the middle of that step
    R force;             // N, normal force at the end of that step

    template <class Each>
    HWY_INLINE void each(const Each& visit) {
        visit.turning(velocity), visit(force);
    }
};

template <class NormalLawType, class TangentialLawType>
struct LawPair {
    using Normal = NormalLawType;
    using Tangential = TangentialLawType;
    static constexpr bool rubs = Tangential::rubs;  // needs slip, twist and spin
    static constexpr bool uses_velocity = Normal::uses_velocity, has_dashpot = Normal::has_dashpot;
    static constexpr bool uses_mass = Normal::uses_mass, uses_radius = Normal::uses_radius;

    // True if the normal law takes into account at which instant of the step the contact began, and the
    // tangential law gains accuracy by it. The tangential force then acts for as long as the normal force.
    static constexpr bool weighs_onset = Normal::weighs_onset && Tangential::gains_by_onset;

    template <class R>
    struct Parameters {
        typename Normal::template Parameters<R> normal;
        typename Tangential::template Parameters<R> tangential;

        template <class Each>
        HWY_INLINE void each(const Each& visit) {
            normal.each(visit), tangential.each(visit);
        }
    };
    static Parameters<double> from(const PairPlan& plan) {
        return {Normal::from(plan), Tangential::from(plan)};
    }

    template <class R>
    struct History {
        typename Normal::template History<R> normal;
        typename Tangential::template History<R> tangential;
        StepBefore<R, has_dashpot> before;

        template <class Each>
        HWY_INLINE void each(const Each& visit) {
            normal.each(visit), tangential.each(visit), before.each(visit);
        }
    };

    // The force (N) on body j, which may be a wall: the normal force along k (touch.normal,
    // from i to j), and the tangential force perpendicular to k.
    template <class R>
    struct Force {
        R normal;
        Triple<R> tangential;
    };

    // `velocity` (m/s) is the velocity of i's surface relative to j's between the last force and this one,
    // and `step` (s) is the time between them. Dashpots need the velocity at the time of this force. That is
    // `ahead` steps after the time of `velocity`; `ahead` is 0.5 for Verlet.
    template <class R>
    static HWY_INLINE Force<R> force(const Parameters<R>& p, History<R>& h, Touch<R> touch,
                                     const Triple<R>& velocity, R step, R ahead) {
        if constexpr (uses_velocity) touch.step = step;
        if constexpr (has_dashpot) {
            set_velocity(touch, later(velocity, h.before.velocity, ahead));
            slow_down(touch, p.normal, h.before.force, ahead * step);
            h.before.velocity = velocity;
        } else if constexpr (uses_velocity) {
            set_velocity(touch, velocity);
        }
        if constexpr (rubs) touch.slip = velocity.across(touch.normal) * touched(h.normal, touch, step);
        if constexpr (weighs_onset) {
            const R over_the_step = Normal::force(p.normal, h.normal, touch);
            const R spring = Normal::now(p.normal, h.normal, touch);
            const R acts = select(spring > R(0), over_the_step / spring, R(0));
            return {over_the_step,
                    Tangential::force(p.tangential, p.normal, h.tangential, touch, spring) * acts};
        }
        Force<R> f{Normal::force(p.normal, h.normal, touch), {R(0), R(0), R(0)}};
        if constexpr (has_dashpot) h.before.force = f.normal;
        if constexpr (rubs) {
            f.tangential = Tangential::force(p.tangential, p.normal, h.tangential, touch, f.normal);
        }
        return f;
    }

    // The force at the present instant, without a step, and the energies. `velocity` is the present velocity.
    template <class R>
    static HWY_INLINE Force<R> now(const Parameters<R>& p, const History<R>& h, Touch<R> touch,
                                   const Triple<R>& velocity, ContactEnergies<R>& e) {
        set_velocity(touch, velocity);
        Force<R> f{Normal::now(p.normal, h.normal, touch), {R(0), R(0), R(0)}};
        e = {Normal::stored_energy(p.normal, h.normal, touch, f.normal), R(0), R(0), R(0), R(0)};
        if constexpr (has_dashpot) {
            e.damping = (f.normal - Normal::spring_force(p.normal, touch)) * touch.closing_speed;
        } else {
            e.latched = Normal::latched_energy(p.normal, h.normal, touch);
        }
        if constexpr (rubs) {
            f.tangential = Tangential::now(p.tangential, p.normal, h.tangential, touch, f.normal);
            e.sideways = Tangential::stored_energy(p.tangential, h.tangential, f.normal);
            e.stored += e.sideways;
            e.rubbing = f.tangential.dot(touch.slip_velocity);
        }
        return f;
    }

  private:
    // Time (s) of the step for which the bodies have touched, as far as the normal law knows it.
    template <class R>
    static HWY_INLINE R touched(const typename Normal::template History<R>& h, const Touch<R>& touch,
                                R step) {
        if constexpr (Normal::weighs_onset)
            return Normal::touched(h, touch);
        else
            return step;
    }

    // Dashpots need the velocity at the time of the force. With Verlet this is half a step after the time of
    // the known velocity. The velocity is assumed to go on changing as it did over the last step. For two
    // grains that only forces move, this adds exactly what the old force does in half a step (the half kick
    // of Verlet). A new contact has no earlier velocity, and the known one is taken as it is.
    template <class R>
    static HWY_INLINE Triple<R> later(const Triple<R>& velocity, const Triple<R>& before, R ahead) {
        const auto known = before.squared() > R(0);
        return velocity.plus(select(known, velocity - before, Triple<R>{R(0), R(0), R(0)}), ahead);
    }

    // The contact's own force has changed since the last step, and this change alters the closing speed
    // during `time` (s). The new velocity and the new force depend on each other. The dashpot is linear, so
    // the velocity can be solved for.
    template <class R, class P>
    static HWY_INLINE void slow_down(Touch<R>& touch, const P& p, R force_before, R time) {
        const R elastic = Normal::spring_force(p, touch) - force_before;
        touch.closing_speed = less_product(touch.closing_speed, time * elastic, touch.inverse_mass) *
                              (R(1) / (R(1) + time * p.damping_rate(touch)));
    }

    template <class R>
    static HWY_INLINE void set_velocity(Touch<R>& touch, const Triple<R>& velocity) {
        touch.closing_speed = touch.normal.dot(velocity);
        touch.slip_velocity = velocity.less(touch.normal, touch.closing_speed);
    }
};

}  // namespace grainreel::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
