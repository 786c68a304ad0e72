// The formulas of kicks and drifts, for one number, or for a bundle of a grain's numbers.
#if defined(GRAINREEL_STEP_KICKS_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef GRAINREEL_STEP_KICKS_INL
#undef GRAINREEL_STEP_KICKS_INL
#else
#define GRAINREEL_STEP_KICKS_INL
#endif

#include "engine/vector/number-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace grainreel::HWY_NAMESPACE {

HWY_INLINE double without_tiny(double a, double least) {
    return size_of(a) < least ? 0 : a;
}

// The lengths (s) of the kick that ends a step and of that which begins the next one, and the share that drag
// leaves after the first.
template <class B>
struct Kicks {
    B last, next, keep;
};

// A velocity or a spin after the kicks. `gains` are m/s2 or rad/s2.
template <bool ends, bool begins, bool drags, class B>
HWY_INLINE B kicked(B now, const B& gains, const Kicks<B>& kicks, double least) {
    if constexpr (ends) now = multiply_add(kicks.last, gains, now);
    if constexpr (ends && drags) now = without_tiny(now * kicks.keep, least);
    if constexpr (begins) now = multiply_add(kicks.next, gains, now);
    if constexpr (begins && drags) now = without_tiny(now, least);
    return now;
}

// A place after the drifts, of which the first (s) is there where a step is closed by one.
template <bool closes, class B>
HWY_INLINE B drifted(B place, const B& velocity, const B& closing, const B& whole) {
    if constexpr (closes) place = multiply_add(closing, velocity, place);
    return multiply_add(whole, velocity, place);
}

}  // namespace grainreel::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
