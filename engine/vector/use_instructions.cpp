// Chooses the instruction set by its name, for the bits of another machine.
#include <fmt/format.h>
#include <hwy/targets.h>
#include <cstdint>

#include "engine/base/error.hpp"
#include "engine/base/text.hpp"
#include "engine/vector/instructions.hpp"

namespace grainreel {

void use_instructions(const std::string& name) {
    std::int64_t target = 0;
    if (name == "plain") target = HWY_EMU128 | HWY_SCALAR;
    if (name == "SSE4") target = HWY_SSE4;
    if (name == "AVX2") target = HWY_AVX2;
    if (name == "AVX-512") target = HWY_AVX3;
    if (target == 0 || (hwy::SupportedTargets() & target) == 0)
        throw UserError(
            fmt::format("GRAINREEL_INSTRUCTIONS: is \"{}\"; give plain, SSE4, AVX2 or AVX-512, as far as the "
                        "processor has it",
                        excerpt(name)));
    hwy::SetSupportedTargetsForTest(target);
    hwy::GetChosenTarget().Update(target);
}

}  // namespace grainreel
