// Resistance to rolling: an elastic-plastic rolling spring (Iwashita & Oda 1998, J. Eng. Mech. 124, 285; Ai
// et al. 2011, Powder Technol. 206, 269, model C without dashpot). The torque grows with the rolled angle
// theta,
//
//   M = k_r theta,   k_r = K0 R_eff^2,   |M| <= mu_r R_eff N.
//
// K0 is the tangential stiffness of the pair (PairPlan), R_eff the effective radius, mu_r the coefficient of
// rolling friction and N the normal force. A spring can hold a grain at rest on a slope; a torque of constant
// size cannot. The resistance is added to any contact law with friction.
#if defined(GRAINREEL_LAWS_ROLLING_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef GRAINREEL_LAWS_ROLLING_INL
#undef GRAINREEL_LAWS_ROLLING_INL
#else
#define GRAINREEL_LAWS_ROLLING_INL
#endif

#include "engine/laws/friction-inl.hpp"
#include "engine/laws/kernel-inl.hpp"
#include "engine/plan/plan.hpp"

HWY_BEFORE_NAMESPACE();
namespace grainreel::HWY_NAMESPACE {

struct RollingSpring {
    template <class R>
    struct Parameters {
        R stiffness;  // N/m, K0
        R friction;   // mu_r

        template <class Each>
        HWY_INLINE void each(const Each& visit) {
            visit(stiffness), visit(friction);
        }
    };
    static Parameters<double> from(const PairPlan& plan) {
        return {plan.tangential_stiffness, plan.rolling_friction};
    }

    template <class R>
    struct History {
        Triple<R> torque;  // N m, on j

        template <class Each>
        HWY_INLINE void each(const Each& visit) {
            visit.turning(torque);
        }
    };

    // Torque (N m) on j. `angle` (rad) is the rotation of i relative to j in this step, without its part
    // about the normal; `normal` and `turn` are as in Touch.
    template <class R>
    static HWY_INLINE Triple<R> torque(const Parameters<R>& p, History<R>& h, const Triple<R>& normal,
                                       const Triple<R>& turn, const Triple<R>& angle, R effective_radius,
                                       R normal_force) {
        const Triple<R> old = carry_along(h.torque, turn, normal);
        h.torque = capped_at(old + angle * (p.stiffness * effective_radius * effective_radius),
                             p.friction * effective_radius * larger(R(0), normal_force));
        return h.torque;
    }

    // Stored energy (J), M^2 / (2 k_r).
    template <class R>
    static HWY_INLINE R stored_energy(const Parameters<R>& p, const History<R>& h, R effective_radius) {
        const R stiffness = p.stiffness * effective_radius * effective_radius;
        return select(stiffness > R(0), h.torque.squared() / (R(2) * stiffness), R(0));
    }
};

// Runs the resistance to rolling over a chunk of contacts, after their law. The functions are those of
// LawKernel, as in kernel-inl.hpp.

template <class L>
void step_rolling(const LawInput& in, void* history, ForceChunk& out) {
    using Number = NumberOf<L>;
    for (int c = 0; c < in.count; c += L::count) {
        Number* kept = static_cast<Number*>(history) + place_in_history(c, in.history_stride);
        const auto touching = touching_at<L, Number>(in, c);
        RollingSpring::History<L> h;
        h.each(LoadHistory<L>(kept));
        const Triple<L> angle = triple_at<L, Number>(in.rolling->rate, c) * L(in.step);
        const Triple<L> torque = RollingSpring::torque(
            parameters_at<RollingSpring, L>(in, c), h, triple_at<L, Number>(in.touch->normal, c),
            triple_at<L, Number>(in.touch->turn, c), angle, row_at<L, Number>(in.touch->effective_radius, c),
            row_at<L, Number>(out.normal, c));
        h.each(StoreHistory<L>(touching, kept));
        put_where<Number>(touching, torque, in.rolling->torque, c);
    }
}

template <class L>
HWY_INLINE void add_where(typename L::Mask which, L more, double* to) {
    store_as(load_as<L>(to) + select(which, more, L(0.0)), to);
}

template <class L>
void observe_rolling(const LawInput& in, const void* history, ForceChunk&, EnergyChunk& energy) {
    const auto* numbers = static_cast<const NumberOf<L>*>(history);
    for (int c = 0; c < in.count; c += L::count) {
        const auto touching = touching_at<L, double>(in, c);
        RollingSpring::History<L> h;
        h.each(LoadHistory<L>(numbers + place_in_history(c, in.history_stride)));
        const L stored = RollingSpring::stored_energy(parameters_at<RollingSpring, L>(in, c), h,
                                                      row_at<L, double>(in.touch->effective_radius, c));
        const L power = h.torque.dot(triple_at<L, double>(in.rolling->rate, c));
        put_where<double>(touching, h.torque, in.rolling->torque, c);
        add_where(touching, stored, energy.stored + c);
        add_where(touching, stored, energy.sideways + c);
        add_where(touching, power, energy.rubbing + c);
    }
}

template <class L>
const LawKernel& kernel_of_rolling() {
    static const LawKernel kernel = [] {
        LawKernel k{};
        RollingSpring::History<double> history{};
        history.each(CountNumbers{k.turns});
        k.history_size = static_cast<int>(k.turns.size());
        k.number_size = sizeof(NumberOf<L>);
        k.rubs = k.rolls = k.uses_radius = true;
        k.parameters = parameters_of<RollingSpring>;
        k.step = k.step_one_kind = step_rolling<L>;
        k.observe = observe_rolling<L>;
        return k;
    }();
    return kernel;
}

}  // namespace grainreel::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
