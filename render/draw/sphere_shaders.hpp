// GLSL of the two sphere passes.
#pragma once

#include <string>

namespace grainreel {

struct ShaderPair {
    std::string vertex, fragment;
};

// First pass: which grain is seen at each pixel's centre, and its depth.
ShaderPair nearest_grain_shaders();
// Second pass: light for every pixel that a grain covers, once; several samples only where grains meet.
ShaderPair grain_light_shaders();

}  // namespace grainreel
