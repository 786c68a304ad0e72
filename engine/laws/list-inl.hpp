// All combinations of laws at one precision, for each instruction set. A new law needs its header and a line
// here.
#if defined(GRAINREEL_LAWS_LIST_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef GRAINREEL_LAWS_LIST_INL
#undef GRAINREEL_LAWS_LIST_INL
#else
#define GRAINREEL_LAWS_LIST_INL
#endif

#include "engine/laws/contact_law-inl.hpp"
#include "engine/laws/friction-inl.hpp"
#include "engine/laws/hertz-inl.hpp"
#include "engine/laws/incremental_slip-inl.hpp"
#include "engine/laws/kernel-inl.hpp"
#include "engine/laws/linear_spring-inl.hpp"
#include "engine/laws/mindlin-inl.hpp"
#include "engine/laws/rolling_kernel-inl.hpp"
#include "engine/laws/softness_lanes-inl.hpp"
#include "engine/laws/spring_dashpot-inl.hpp"
#include "engine/laws/walton_braun-inl.hpp"
#include "engine/laws/walton_braun_corrected-inl.hpp"
#include "engine/laws/walton_braun_speed-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace grainreel::HWY_NAMESPACE {

// Linear normal laws go with tangential springs of constant stiffness.
template <class L, class Normal>
const LawKernel* with_linear(TangentialLaw tangential) {
    switch (tangential) {
        case TangentialLaw::incremental_slip:
            return &kernel_of<LawPair<Normal, IncrementalSlip>, L>();
        case TangentialLaw::linear_spring:
            return &kernel_of<LawPair<Normal, LinearSpring>, L>();
        case TangentialLaw::none:
            return &kernel_of<LawPair<Normal, Frictionless>, L>();
        case TangentialLaw::mindlin:
            break;
    }
    return nullptr;
}

template <class L>
const LawKernel* with_hertz(TangentialLaw tangential) {
    if (tangential == TangentialLaw::mindlin) return &kernel_of<LawPair<Hertz, Mindlin>, L>();
    if (tangential == TangentialLaw::none) return &kernel_of<LawPair<Hertz, Frictionless>, L>();
    return nullptr;
}

// Returns nullptr where laws do not go together.
template <class L>
const LawKernel* kernel_at(const ContactModel& model) {
    switch (model.normal) {
        case NormalForce::walton_braun:
            return with_linear<L, WaltonBraun>(model.tangential);
        case NormalForce::walton_braun_corrected:
            return with_linear<L, WaltonBraunCorrected>(model.tangential);
        case NormalForce::walton_braun_speed:
            return with_linear<L, WaltonBraunSpeed>(model.tangential);
        case NormalForce::walton_braun_table:
            return with_linear<L, WaltonBraunTable>(model.tangential);
        case NormalForce::spring_dashpot:
            return with_linear<L, SpringDashpot>(model.tangential);
        case NormalForce::hertz:
            return with_hertz<L>(model.tangential);
    }
    return nullptr;
}

}  // namespace grainreel::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
