// Which instruction set the kernels use.
#pragma once

#include <string>

namespace grainreel {

// "AVX-512", "AVX2", "SSE4", "NEON" or "none (plain code)". It is the set for which kernels are chosen, which
// may be less than the processor has.
std::string vector_instructions();

}  // namespace grainreel
