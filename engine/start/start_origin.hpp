// The run that a start file is from: what its checkpoint says of scene, laws and moment.
#pragma once

#include <filesystem>
#include <optional>

#include "engine/plan/plan.hpp"
#include "engine/scene/scene.hpp"
#include "engine/state/grains.hpp"
#include "engine/step/lists/saved_lists.hpp"
#include "engine/step/surroundings.hpp"

namespace grainreel {

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

}  // namespace grainreel
