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
    for (const char* known : {"AVX2", "SSE4", "NEON"})
        if (name == known) return name;
    return "none (plain code)";
}

}  // namespace grainreel
#endif
