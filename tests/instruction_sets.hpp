// The instruction sets of this processor, and the same test with the kernels of each.
#pragma once

#include <gtest/gtest.h>
#include <hwy/targets.h>

#include <cstdint>

#include "engine/vector/targets.hpp"

namespace grainreel::test {

// Sets that round a product and a sum once, and those that cannot; the fast ones first. Kernels of the same
// kind give the same bits.
#if HWY_ARCH_ARM
inline constexpr std::int64_t fused_sets[] = {HWY_STATIC_TARGET};
#else
inline constexpr std::int64_t fused_sets[] = {HWY_AVX2, HWY_AVX3};
#endif
inline constexpr std::int64_t plain_sets[] = {HWY_SSE4, HWY_EMU128, HWY_SCALAR};

// Whether this processor has the set and kernels are compiled for it. It has the set of the other code
// anyway.
inline bool has_instruction_set(std::int64_t target) {
    return ((hwy::SupportedTargets() | HWY_STATIC_TARGET) & HWY_TARGETS & target) != 0;
}

// Calls work() with the kernels of one set, if it is there.
template <class Work>
void with_instruction_set(std::int64_t target, const Work& work) {
    if (!has_instruction_set(target)) return;
    hwy::GetChosenTarget().Update(target);
    SCOPED_TRACE(hwy::TargetName(target));
    work();
    hwy::GetChosenTarget().Update(hwy::SupportedTargets());
}

// Calls work(target) for each set.
template <class Work>
void for_each_instruction_set(const Work& work) {
    for (const std::int64_t target : plain_sets) with_instruction_set(target, [&] { work(target); });
    for (const std::int64_t target : fused_sets) with_instruction_set(target, [&] { work(target); });
}

}  // namespace grainreel::test
