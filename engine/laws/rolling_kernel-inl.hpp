// The resistance to rolling (rolling-inl.hpp) as a LawKernel: its functions over a chunk of contacts.
#if defined(GRAINREEL_LAWS_ROLLING_KERNEL_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef GRAINREEL_LAWS_ROLLING_KERNEL_INL
#undef GRAINREEL_LAWS_ROLLING_KERNEL_INL
#else
#define GRAINREEL_LAWS_ROLLING_KERNEL_INL
#endif

#include "engine/laws/kernel-inl.hpp"
#include "engine/laws/rolling-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace grainreel::HWY_NAMESPACE {

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
