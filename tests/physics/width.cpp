// Runs all tests of this folder with the kernels of one instruction set: GRAINREEL_TEST_WIDTH=AVX2, SSE4 or
// plain.
#include <gtest/gtest.h>
#include <hwy/targets.h>

#include <cstdlib>
#include <string>

#include "engine/vector/instructions.hpp"

namespace grainreel {
namespace {

class Width : public testing::Environment {
  public:
    void SetUp() override {
        const char* wanted = std::getenv("GRAINREEL_TEST_WIDTH");
        if (!wanted || std::string(wanted) == "best") return;
        const std::string width = wanted;
        ASSERT_TRUE(width == "AVX2" || width == "SSE4" || width == "plain") << width;
        std::int64_t target = width == "AVX2" ? HWY_AVX2 : width == "SSE4" ? HWY_SSE4 : kPlain;
        // A processor without this instruction set uses the plain kernels.
        if (!(hwy::SupportedTargets() & target)) target = kPlain;
        hwy::SetSupportedTargetsForTest(target);
        hwy::GetChosenTarget().Update(target);
        used_ = vector_instructions();
        ASSERT_NE(used_.find(target == kPlain ? "plain" : width), std::string::npos) << used_;
    }

    // Checks that nothing has chosen another instruction set: asking what the processor supports would do so.
    void TearDown() override {
        if (!used_.empty()) {
            EXPECT_EQ(vector_instructions(), used_);
        }
    }

  private:
    static constexpr std::int64_t kPlain = HWY_EMU128 | HWY_SCALAR;
    std::string used_;
};

[[maybe_unused]] const auto* const width = testing::AddGlobalTestEnvironment(new Width);

}  // namespace
}  // namespace grainreel
