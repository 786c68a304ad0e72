// GLSL that lights the grains.
#pragma once

#include <string>

namespace grainreel {

struct ShaderPair {
    std::string vertex, fragment;
};

// Light for every pixel that a grain covers, once; several samples only where grains meet.
ShaderPair grain_light_shaders();

}  // namespace grainreel
