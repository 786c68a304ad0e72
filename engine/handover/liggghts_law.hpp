// The contact laws of a scene as LIGGGHTS wants them: a model, its flags, and matrices by pairs of types.
#pragma once

#include <string>
#include <vector>

#include "engine/handover/carried_scene.hpp"

namespace grainreel {

struct LiggghtsLaw {
    std::string model;                    // "model hooke/stiffness tangential history"
    std::string flags;                    // "absolute_damping off limitForce on tangential_damping off"
    std::vector<std::string> properties;  // lines
};

// All pairs have one law. With the softest number that makes sense where a pair never touches.
LiggghtsLaw liggghts_law(const CarriedScene& carried);

// How many times stiffer than loading the unloading of `luding` can become.
inline constexpr double kLudingRatio = 50;
// The plasticity depth that gives K2 = K1 + S F_max: (r - 1)^2 / (2 r S R_eff).
double luding_depth(const CarriedPair& pair);

}  // namespace grainreel
