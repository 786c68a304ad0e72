/// @file
/// A contact at one moment.
#pragma once

#include <cstdint>

#include "grainreel/vector.hpp"

namespace grainreel::v1 {

/// Two bodies that touch, and what they do to each other.
struct Contact {
    std::int32_t first = 0;      ///< Id of a grain.
    std::int32_t second = 0;     ///< Id of a grain, or -1 - w for wall w of Scene::walls().
    Vector normal{};             ///< Unit, from first to second.
    Vector point{};              ///< m, where they touch.
    double overlap = 0;          ///< m.
    double normal_force = 0;     ///< N, on second along the normal, on first against it; < 0: they attract.
    Vector tangential_force{};   ///< N, on second; the opposite acts on first.
    double stored_energy = 0;    ///< J, the energy that unloading would give back.
    std::int32_t triangle = -1;  ///< The touched triangle of the mesh `second`; -1 if that is no mesh.
};

}  // namespace grainreel::v1
