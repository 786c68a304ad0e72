// All tests of this folder with the kernels of one instruction set: GRAINREEL_TEST_WIDTH=AVX2, SSE4 or plain.
#include <gtest/gtest.h>
#include <hwy/targets.h>

#include <cstdlib>
#include <string>

#include "engine/laws/law_kernel.hpp"

namespace grainreel {
namespace {

class Width : public testing::Environment {
  public:
    void SetUp() override {
        const char* wanted = std::getenv("GRAINREEL_TEST_WIDTH");
        if (!wanted) return;
        const std::string width = wanted;
        constexpr std::int64_t avx512 = HWY_AVX3 | HWY_AVX3_DL, vectors = HWY_AVX2 | HWY_SSE4 | HWY_SSSE3;
        ASSERT_TRUE(width == "AVX2" || width == "SSE4" || width == "plain") << width;
        const std::int64_t wanted_target = width == "AVX2" ? HWY_AVX2 : width == "SSE4" ? HWY_SSE4 : 0;
        const bool here = wanted_target == 0 || (hwy::SupportedTargets() & wanted_target);
        hwy::DisableTargets(width == "AVX2"   ? avx512
                            : width == "SSE4" ? avx512 | HWY_AVX2
                                              : avx512 | vectors);
        hwy::GetChosenTarget().Update(hwy::SupportedTargets());
        // A processor without it goes on with the best it has below.
        if (here) {
            ASSERT_NE(vector_instructions().find(width), std::string::npos) << vector_instructions();
        }
    }
};

[[maybe_unused]] const auto* const width = testing::AddGlobalTestEnvironment(new Width);

}  // namespace
}  // namespace grainreel
