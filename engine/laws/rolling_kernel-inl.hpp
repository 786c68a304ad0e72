// Runs the resistance to rolling over a chunk of contacts, after their law: LawKernel as kernel-inl.hpp has
// it.
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

HWY_INLINE Triple<Lanes> triple_at(const double (*from)[kChunk], int c) {
    return {load(from[0] + c), load(from[1] + c), load(from[2] + c)};
}

HWY_INLINE void put_rolling(LanesMask touching, const Triple<Lanes>& torque, int c, RollingChunk& out) {
    store(select(touching, torque.x, Lanes(0.0)), out.torque[0] + c);
    store(select(touching, torque.y, Lanes(0.0)), out.torque[1] + c);
    store(select(touching, torque.z, Lanes(0.0)), out.torque[2] + c);
}

inline void step_rolling(const LawInput& in, double* history, ForceChunk& out) {
    for (int c = 0; c < in.count; c += kLanes) {
        double* kept = history + (c / kBlock) * (in.history_stride * kBlock) + c % kBlock;
        const LanesMask touching = load(in.touch->overlap + c) > Lanes(0.0);
        RollingSpring::History<Lanes> h;
        h.each(LoadHistory(kept));
        const Triple<Lanes> angle = triple_at(in.rolling->rate, c) * Lanes(in.step);
        const Triple<Lanes> torque = RollingSpring::torque(
            parameters_at<RollingSpring>(in, c), h, triple_at(in.touch->normal, c), load(in.touch->twist + c),
            angle, load(in.effective_radius + c), load(out.normal + c));
        h.each(StoreHistory(touching, kept));
        put_rolling(touching, torque, c, *in.rolling);
    }
}

HWY_INLINE void add(LanesMask touching, Lanes more, double* to) {
    store(load(to) + select(touching, more, Lanes(0.0)), to);
}

inline void observe_rolling(const LawInput& in, const double* history, ForceChunk&, EnergyChunk& energy) {
    for (int c = 0; c < in.count; c += kLanes) {
        const LanesMask touching = load(in.touch->overlap + c) > Lanes(0.0);
        RollingSpring::History<Lanes> h;
        h.each(LoadHistory(history + (c / kBlock) * (in.history_stride * kBlock) + c % kBlock));
        const Lanes stored = RollingSpring::stored_energy(parameters_at<RollingSpring>(in, c), h,
                                                          load(in.effective_radius + c));
        const Lanes power = h.torque.dot(triple_at(in.rolling->rate, c));
        put_rolling(touching, h.torque, c, *in.rolling);
        add(touching, stored, energy.stored + c);
        add(touching, stored, energy.sideways + c);
        add(touching, power, energy.rubbing + c);
    }
}

inline const LawKernel& kernel_of_rolling() {
    static const LawKernel kernel = [] {
        LawKernel k{};
        RollingSpring::History<double> history{};
        history.each(CountNumbers{k.turns});
        k.history_size = static_cast<int>(k.turns.size());
        k.rubs = k.rolls = k.uses_radius = true;
        k.parameters = parameters_of<RollingSpring>;
        k.step = step_rolling;
        k.observe = observe_rolling;
        return k;
    }();
    return kernel;
}

}  // namespace grainreel::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
