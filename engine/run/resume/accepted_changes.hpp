// Changes to a scene that a run may take up while it goes on (`resume --accept`): those that leave stiffness
// and step as they are.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "engine/plan/plan.hpp"
#include "engine/scene/scene.hpp"
#include "engine/scene/text/assignment.hpp"

namespace grainreel {

struct AcceptedChange {
    std::string key;        // "drive.amplitude"
    std::string then, now;  // as TOML
};

// What differs between the scene that a checkpoint holds and the one that is to go on. accepted: keys that
// the user named, "drive.g_level", or "contact.friction" of all pairs. Throws UserError for a difference that
// was not named, and for a key that cannot change while a run goes on.
std::vector<AcceptedChange> accepted_changes(const std::filesystem::path& checkpoint, const Scene& scene,
                                             const Plan& plan, const std::vector<std::string>& accepted);

// What undoes the changes, for a reader of the scene.
Assignments undone(const std::vector<AcceptedChange>& changes);

// The drive as the run goes on at `time` (s). It changes by a stage, so that place and velocity of the
// container stay continuous. before: with the changes undone; after: with them. Throws UserError when a stage
// of the drive has begun.
Drive drive_changed_at(double time, const Scene& before, const Scene& after,
                       const std::vector<AcceptedChange>& changes);

// "From here on: Γ 4 instead of 3, friction 0.2 instead of 0.5". UTF-8; empty without changes.
std::string words_of_changes(const Scene& before, const Scene& after,
                             const std::vector<AcceptedChange>& changes);

// Throws UserError when the changed scene would need stiffer grains to keep overlaps within the limit.
void check_overlap_stays(const Scene& scene, const Plan& before, const Plan& after);

}  // namespace grainreel
