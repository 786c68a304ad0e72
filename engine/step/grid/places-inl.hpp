// Helpers to load the places of grains into registers.
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

}  // namespace grainreel::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
