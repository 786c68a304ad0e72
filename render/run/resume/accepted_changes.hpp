// Changes to a scene that a run may take up while it goes on (`resume --accept`): those that leave stiffness
// and step as they are.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "engine/plan/plan.hpp"
#include "engine/scene/text/assignment.hpp"
#include "render/scene/filmed_scene.hpp"

namespace grainreel {

struct AcceptedChange {
    std::string key;        // "drive.amplitude"
    std::string then, now;  // as TOML
};

// What differs between the scene that a checkpoint holds and the one that is to go on. accepted: keys that
// the user named, "drive.g_level", or "contact.friction" of all pairs. Throws UserError for a difference that
// was not named, and for a key that cannot change while a run goes on.
std::vector<AcceptedChange> accepted_changes(const std::filesystem::path& checkpoint,
                                             const FilmedScene& scene, const Plan& plan,
                                             const std::vector<std::string>& accepted);

// What undoes the changes, for a reader of the scene.
Assignments undone(const std::vector<AcceptedChange>& changes);

// The scene as it goes on at `time` (s). A drive changes by a stage, so that place and velocity of the
// container stay continuous; a caption says what changed. before: with the changes undone; after: with them.
// Throws UserError when a stage of the drive has begun.
FilmedScene changed_at(double time, const FilmedScene& before, const FilmedScene& after,
                       const std::vector<AcceptedChange>& changes);

// Throws UserError when the changed scene would need stiffer grains to keep overlaps within the limit.
void check_overlap_stays(const FilmedScene& scene, const Plan& before, const Plan& after);

}  // namespace grainreel
