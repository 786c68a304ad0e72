// The bed that a start file holds: whether it rests, and what its overlaps say of stiffness.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "engine/base/vector.hpp"
#include "engine/plan/plan.hpp"
#include "engine/scene/scene.hpp"
#include "engine/start/start_origin.hpp"
#include "engine/state/grains.hpp"

namespace grainreel {

struct BedInFile {
    bool of_checkpoint = false;  // which has histories of contacts
    Grains grains;               // as the run will take them
    std::optional<StartOrigin> origin;

    // Two bodies that overlap.
    struct Overlap {
        std::size_t first;
        int second;      // index of a grain, or -1 - wall: faces first, then meshes
        bool glued;      // at a grain that is glued to this face
        double depth;    // m
        double radius;   // m, effective
        double carries;  // m: how much of the weights' moment a force of 1 N at this contact carries
    };
    std::vector<Overlap> overlaps;
    double moment_of_weights = 0;  // J

    // What keeps the bed from resting in this scene; empty when it rests. At rest means: a mean kinetic
    // energy a grain of at most 1e-4 m g d, none above 0.05 m g d, at least every other grain touches
    // something, and gravity and what is touched are those of the run that the file is from, as far as it is
    // known.
    std::string moves_because;
    double fastest = 0;  // m/s
    double falls = 0;    // m/s, that a grain may have when it has fallen to the lowest one
};

// Throws UserError where the file cannot be read or has grains that cannot be.
BedInFile bed_in_file(const Scene& scene);

// Sets `linear` and `modulus` of the facts: with this stiffness the bed's overlaps carry its weight. They are
// the same for all contacts of linear laws and of Hertz that have none in the scene (weight_moments.hpp).
void stiffness_of_overlaps(const Scene& scene, const BedInFile& bed, StartFacts& facts);

}  // namespace grainreel
