// Which instruction set the kernels use.
#pragma once

#include <string>

namespace grainreel {

// "AVX-512", "AVX2", "SSE4", "NEON" or "none (plain code)". It is the set for which kernels are chosen, which
// may be less than the processor has.
std::string vector_instructions();

// Takes the kernels of another instruction set from now on: "plain", "SSE4", "AVX2" or "AVX-512". The
// environment's GRAINREEL_INSTRUCTIONS names it, to get the bits of another machine or of a page. Throws
// UserError for another name, and where the processor lacks it.
void use_instructions(const std::string& name);

}  // namespace grainreel
