// All combinations of laws, compiled for each instruction set. A new law needs its header and a line here.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "engine/laws/list.cpp"
#include "engine/vector/targets.hpp"
//
#include "engine/laws/contact_law-inl.hpp"
#include "engine/laws/frictionless-inl.hpp"
#include "engine/laws/hertz-inl.hpp"
#include "engine/laws/incremental_slip-inl.hpp"
#include "engine/laws/kernel-inl.hpp"
#include "engine/laws/linear_spring-inl.hpp"
#include "engine/laws/mindlin-inl.hpp"
#include "engine/laws/rolling_kernel-inl.hpp"
#include "engine/laws/spring_dashpot-inl.hpp"
#include "engine/laws/walton_braun-inl.hpp"
#include "engine/laws/walton_braun_corrected-inl.hpp"
#include "engine/laws/walton_braun_speed-inl.hpp"
#include "engine/laws/walton_braun_table-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace grainreel::HWY_NAMESPACE {

// Linear normal laws go with tangential springs of constant stiffness.
template <class Normal>
const LawKernel* with_linear(TangentialLaw tangential) {
    switch (tangential) {
        case TangentialLaw::incremental_slip:
            return &kernel_of<ContactLaw<Normal, IncrementalSlip>>();
        case TangentialLaw::linear_spring:
            return &kernel_of<ContactLaw<Normal, LinearSpring>>();
        case TangentialLaw::none:
            return &kernel_of<ContactLaw<Normal, Frictionless>>();
        case TangentialLaw::mindlin:
            break;
    }
    return nullptr;
}

const LawKernel* with_hertz(TangentialLaw tangential) {
    if (tangential == TangentialLaw::mindlin) return &kernel_of<ContactLaw<Hertz, Mindlin>>();
    if (tangential == TangentialLaw::none) return &kernel_of<ContactLaw<Hertz, Frictionless>>();
    return nullptr;
}

const LawKernel* find_kernel(const ContactModel& model) {
    switch (model.normal) {
        case NormalForce::walton_braun:
            return with_linear<WaltonBraun>(model.tangential);
        case NormalForce::walton_braun_corrected:
            return with_linear<WaltonBraunCorrected>(model.tangential);
        case NormalForce::walton_braun_speed:
            return with_linear<WaltonBraunSpeed>(model.tangential);
        case NormalForce::walton_braun_table:
            return with_linear<WaltonBraunTable>(model.tangential);
        case NormalForce::spring_dashpot:
            return with_linear<SpringDashpot>(model.tangential);
        case NormalForce::hertz:
            return with_hertz(model.tangential);
    }
    return nullptr;
}

const LawKernel* find_rolling() {
    return &kernel_of_rolling();
}

const char* instructions() {
    return hwy::TargetName(HWY_TARGET);
}

}  // namespace grainreel::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
#include "engine/base/error.hpp"

namespace grainreel {

HWY_EXPORT(find_kernel);
HWY_EXPORT(find_rolling);
HWY_EXPORT(instructions);

const LawKernel& law_kernel(const ContactModel& model) {
    const LawKernel* kernel = HWY_DYNAMIC_DISPATCH(find_kernel)(model);
    GRAINREEL_CHECK(kernel != nullptr);
    return *kernel;
}

const LawKernel& rolling_kernel() {
    return *HWY_DYNAMIC_DISPATCH(find_rolling)();
}

std::string vector_instructions() {
    const std::string name = HWY_DYNAMIC_DISPATCH(instructions)();
    if (name == "AVX3") return "AVX-512";
    return name == "Scalar" || name == "EMU128" ? "none (plain x86-64)" : name;
}

}  // namespace grainreel
#endif
