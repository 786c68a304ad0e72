// Helpers to load the places of grains into registers, and the nearest periodic image.
#if defined(GRAINREEL_STEP_PLACES_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef GRAINREEL_STEP_PLACES_INL
#undef GRAINREEL_STEP_PLACES_INL
#else
#define GRAINREEL_STEP_PLACES_INL
#endif

#include "engine/vector/bundles-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace grainreel::HWY_NAMESPACE {

// Views bundles as an array of doubles.
template <class Bundles>
HWY_INLINE const double* numbers(const Bundles& bundles) {
    return reinterpret_cast<const double*>(bundles.data());
}

template <class D>
HWY_INLINE Triple<LanesOf<D>> triple(const Four<D>& f) {
    return {LanesOf<D>(f.a), LanesOf<D>(f.b), LanesOf<D>(f.c)};
}

// The difference x between two grains, taken to the nearest periodic image.
HWY_INLINE Lanes nearest(Lanes x, Lanes period) {
    const Lanes half = period * Lanes(0.5);
    const Lanes low = select(x > half, x - period, x);
    return select(x < -half, x + period, low);
}

}  // namespace grainreel::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
