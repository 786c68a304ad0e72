// The bed that a start file holds: whether it rests, and what its overlaps say of stiffness.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "engine/base/vector.hpp"
#include "engine/plan/plan.hpp"
#include "engine/scene/scene.hpp"
#include "engine/state/grains.hpp"
#include "engine/step/lists/saved_lists.hpp"
#include "engine/step/surroundings.hpp"

namespace grainreel {

// The run that a start file is from: what its checkpoint says of scene, laws and moment.

struct StartOrigin {
    Scene scene;  // as it was used
    Plan plan;    // its laws, and the speed of its impacts
    Surroundings around;
    std::int64_t step = 0;
    // Whether its container, or a part of it, had moved from its rest position or was moving.
    bool walls_moved() const;
    WallParts parts() const { return parts_of(around); }
};

// The origin that a checkpoint tells. None where it tells none, or one that this program does not understand.
std::optional<StartOrigin> origin_of(const std::filesystem::path& checkpoint);

// The origin of a final.csv is that of the checkpoint beside it, if that has the same grains at the same
// places (those of `grains`, numbered without gaps).
std::optional<StartOrigin> origin_beside(const Scene& scene, const Grains& grains);

// Whether contacts of both kinds have the same forces for the same history, as far as a bed at rest feels it:
// law and stiffness. (How much is lost in an impact may differ, and so may friction.)
bool act_alike(const PairPlan& one, const PairPlan& other);

bool same_glued_grains(const GluedGrains& one, const GluedGrains& other);

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
