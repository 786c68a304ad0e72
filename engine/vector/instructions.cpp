#include "engine/vector/instructions.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "engine/vector/instructions.cpp"
#include "engine/vector/targets.hpp"
//
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace grainreel::HWY_NAMESPACE {

std::int64_t own_target() {
    return HWY_TARGET;
}

}  // namespace grainreel::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace grainreel {

HWY_EXPORT(own_target);

std::string vector_instructions() {
    const std::string name = hwy::TargetName(HWY_DYNAMIC_DISPATCH(own_target)());
    if (name == "AVX3") return "AVX-512";
    if (name.rfind("NEON", 0) == 0) return "NEON";  // later Highways tell several sets of NEON apart
    if (name == "AVX2" || name == "SSE4") return name;
    return "none (plain code)";
}

}  // namespace grainreel
#endif
