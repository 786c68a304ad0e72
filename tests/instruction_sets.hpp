// The same test with the kernels of each instruction set.
#pragma once

#include <gtest/gtest.h>
#include <hwy/targets.h>

#include <cstdint>

#include "engine/vector/targets.hpp"

namespace grainreel::test {

// Calls work(target) for each that this processor has and the kernels are compiled for.
template <class Work>
void for_each_instruction_set(const Work& work) {
    const std::int64_t supported = hwy::SupportedTargets();
    for (const std::int64_t target :
         {std::int64_t{HWY_SCALAR}, std::int64_t{HWY_EMU128}, std::int64_t{HWY_SSE4}, std::int64_t{HWY_AVX2},
          std::int64_t{HWY_AVX3}}) {
        const bool plain = target == HWY_SCALAR || target == HWY_EMU128;
        if (!plain && !(supported & HWY_TARGETS & target)) continue;
        hwy::GetChosenTarget().Update(target);
        SCOPED_TRACE(hwy::TargetName(target));
        work(target);
    }
    hwy::GetChosenTarget().Update(supported);
}

}  // namespace grainreel::test
