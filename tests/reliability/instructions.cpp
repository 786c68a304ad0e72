// Loaded before a program that uses Highway (LD_PRELOAD), it answers for Highway which instructions the
// processor has: those that GRAINREEL_TEST_TARGETS names, if the processor has them indeed.
#include <hwy/targets.h>

#include <cstdint>
#include <cstdlib>
#include <cstring>

namespace hwy {

std::int64_t SupportedTargets() {
    const char* const name = std::getenv("GRAINREEL_TEST_TARGETS");
    const std::int64_t plain = HWY_SCALAR | HWY_EMU128;
    if (name == nullptr || std::strcmp(name, "plain") == 0) return plain;
    if (std::strcmp(name, "SSE4") == 0) return plain | HWY_SSE4;
    return plain | HWY_SSE4 | HWY_AVX2;
}

}  // namespace hwy
