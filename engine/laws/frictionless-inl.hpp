// No tangential force: no history, no torque, no spin.
#if defined(GRAINREEL_LAWS_FRICTIONLESS_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef GRAINREEL_LAWS_FRICTIONLESS_INL
#undef GRAINREEL_LAWS_FRICTIONLESS_INL
#else
#define GRAINREEL_LAWS_FRICTIONLESS_INL
#endif

#include "engine/laws/touch-inl.hpp"
#include "engine/plan/plan.hpp"

HWY_BEFORE_NAMESPACE();
namespace grainreel::HWY_NAMESPACE {

struct Frictionless {
    static constexpr bool rubs = false, gains_by_onset = false;

    template <class R>
    struct Parameters {
        template <class Each>
        HWY_INLINE void each(const Each&) {}
    };
    static Parameters<double> from(const PairPlan&) { return {}; }

    template <class R>
    struct History {
        template <class Each>
        HWY_INLINE void each(const Each&) {}
    };
};

}  // namespace grainreel::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
