// Splits registers of forces into the forces of single contacts, which are added to the loads of grains one
// after the other.
#if defined(GRAINREEL_STEP_LOADS_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef GRAINREEL_STEP_LOADS_INL
#undef GRAINREEL_STEP_LOADS_INL
#else
#define GRAINREEL_STEP_LOADS_INL
#endif

#include <utility>

#include "engine/laws/row-inl.hpp"
#include "engine/state/grains.hpp"
#include "engine/vector/bundles-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace grainreel::HWY_NAMESPACE {

HWY_INLINE double* numbers(Load& one) {
    return reinterpret_cast<double*>(&one);
}

// Force and torque on one body of each contact, contact by contact. Without friction there is only the force.
// Both stay in registers, because the processor would wait if they were stored in one shape and loaded in
// another.
template <bool rubs>
HWY_INLINE auto by_contact(const Triple<Lanes>& force, const Triple<Lanes>& torque) {
    const auto four = [](const Triple<Lanes>& t) HWY_ATTR {
        return Four<Doubles>{t.x.value, t.y.value, t.z.value, Lanes(0.0).value};
    };
    if constexpr (rubs)
        return rows_of(four(force), four(torque));
    else
        return rows_of(four(force));
}
template <bool rubs>
HWY_INLINE auto by_contact(const Triple<FloatLanes>& force, const Triple<FloatLanes>& torque) {
    const auto four = [](const Triple<FloatLanes>& t) HWY_ATTR {
        return Four<Floats>{t.x.value, t.y.value, t.z.value, FloatLanes(0.0).value};
    };
    if constexpr (rubs)
        return float_rows_of(four(force), four(torque));
    else
        return float_rows_of(four(force));
}

// Calls work<k>() for the first `count` contacts of a register, in their order.
template <class L, class Work>
HWY_INLINE void each_of(int count, const Work& work) {
    const auto in_turn = [&]<int... k>(std::integer_sequence<int, k...>) HWY_ATTR {
        if (count >= L::count)
            (work.template operator()<k>(), ...);
        else
            ((k < count ? work.template operator()<k>() : void()), ...);
    };
    in_turn(std::make_integer_sequence<int, L::count>());
}

template <int size>
HWY_INLINE void add(double* load, const Bundle<size>& more) {
    put(bundle_at<size>(load) + more, load);
}
template <int size>
HWY_INLINE void take_off(double* load, const Bundle<size>& less) {
    put(bundle_at<size>(load) - less, load);
}

}  // namespace grainreel::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
