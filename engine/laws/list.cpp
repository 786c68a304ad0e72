// All combinations of laws, compiled for each instruction set. A new law needs its header and a line here.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "engine/laws/list.cpp"
#include "engine/vector/targets.hpp"
//
#include "engine/laws/contact_law-inl.hpp"
#include "engine/laws/frictionless-inl.hpp"
#include "engine/laws/incremental_slip-inl.hpp"
#include "engine/laws/kernel-inl.hpp"
#include "engine/laws/linear_spring-inl.hpp"
#include "engine/laws/spring_dashpot-inl.hpp"
#include "engine/laws/walton_braun-inl.hpp"
#include "engine/laws/walton_braun_speed-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace grainreel::HWY_NAMESPACE {

template <class Normal>
const LawKernel* with_normal(TangentialLaw tangential) {
    switch (tangential) {
        case TangentialLaw::incremental_slip:
            return &kernel_of<ContactLaw<Normal, IncrementalSlip>>();
        case TangentialLaw::linear_spring:
            return &kernel_of<ContactLaw<Normal, LinearSpring>>();
        case TangentialLaw::none:
            return &kernel_of<ContactLaw<Normal, Frictionless>>();
    }
    return nullptr;
}

const LawKernel* find_kernel(NormalLaw normal, TangentialLaw tangential) {
    switch (normal) {
        case NormalLaw::walton_braun:
            return with_normal<WaltonBraun>(tangential);
        case NormalLaw::walton_braun_speed:
            return with_normal<WaltonBraunSpeed>(tangential);
        case NormalLaw::spring_dashpot:
            return with_normal<SpringDashpot>(tangential);
    }
    return nullptr;
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
HWY_EXPORT(instructions);

const LawKernel& law_kernel(NormalLaw normal, TangentialLaw tangential) {
    const LawKernel* kernel = HWY_DYNAMIC_DISPATCH(find_kernel)(normal, tangential);
    GRAINREEL_CHECK(kernel != nullptr);
    return *kernel;
}

std::string vector_instructions() {
    const std::string name = HWY_DYNAMIC_DISPATCH(instructions)();
    if (name == "AVX3") return "AVX-512";
    return name == "Scalar" || name == "EMU128" ? "none (plain x86-64)" : name;
}

}  // namespace grainreel
#endif
