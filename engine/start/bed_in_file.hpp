// Examines the bed of grains in a start file: whether it rests, and what its overlaps say about stiffness.
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

// The run that a start file comes from: what its checkpoint tells of scene, laws and moment.

struct StartOrigin {
    Scene scene;  // as that run used it
    Plan plan;    // the laws of that run, and the speed of its impacts
    Surroundings around;
    std::int64_t step = 0;
    // Whether that run's container, or a part of it, was moving or away from its rest position.
    bool walls_moved() const;
    WallParts parts() const { return parts_of(around); }
};

// Reads the origin from a checkpoint. None where the checkpoint has none, or one that this program does not
// understand.
std::optional<StartOrigin> origin_of(const std::filesystem::path& checkpoint);

// The origin of a final.csv: that of the checkpoint beside it, if this has the same grains at the same
// places. `grains` are those of the table, numbered without gaps.
std::optional<StartOrigin> origin_beside(const Scene& scene, const Grains& grains);

// Whether contacts of both kinds have the same forces for the same history, as far as a bed at rest feels
// it: the same law and stiffness. Restitution and friction may differ.
bool act_alike(const PairPlan& one, const PairPlan& other);

bool same_glued_grains(const GluedGrains& one, const GluedGrains& other);

struct BedInFile {
    bool of_checkpoint = false;  // a checkpoint, which has histories of contacts
    Grains grains;               // as the run will take them
    std::optional<StartOrigin> origin;

    // Two bodies that overlap.
    struct Overlap {
        std::size_t first;
        int second;      // index of a grain, or -1 - wall: faces first, then meshes
        bool glued;      // whether the overlap is with a grain that is glued to the face `second`
        double depth;    // m
        double radius;   // m, effective
        double carries;  // m: the part of moment_of_weights that a force of 1 N at this contact carries
    };
    std::vector<Overlap> overlaps;
    double moment_of_weights = 0;  // J, the sum of weight times height (WeightSums)

    // Says what keeps the bed from resting in this scene; empty when it rests. A bed rests when the mean
    // kinetic energy of a grain is at most 1e-4 m g d, no grain has more than 0.05 m g d, at least half of
    // the grains touch something, and gravity and all that is touched are as in the file's run, as far as
    // that is known.
    std::string moves_because;
    double fastest = 0;  // m/s, speed of the fastest grain
    double falls = 0;    // m/s, largest speed of a grain after it has fallen to the height of the lowest one
};

// Throws UserError where the file cannot be read, or where its grains are impossible.
BedInFile bed_in_file(const Scene& scene);

// Sets `linear` and `modulus` of the facts: the stiffness with which the bed's overlaps carry its weight.
// There is one value for all linear contacts, and one for all Hertz contacts, that have no stiffness in the
// scene (WeightSums in held_histories.hpp).
void stiffness_of_overlaps(const Scene& scene, const BedInFile& bed, StartFacts& facts);

}  // namespace grainreel
