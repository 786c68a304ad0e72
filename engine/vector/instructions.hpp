// The instruction set of the kernels that calls go to now.
#pragma once

#include <string>

namespace grainreel {

// "AVX-512", "AVX2", "SSE4" or "none (plain x86-64)"; as the kernels themselves are chosen, not as the
// processor would have it.
std::string vector_instructions();

}  // namespace grainreel
