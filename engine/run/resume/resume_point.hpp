// Where a run that is taken up again goes on, and changes to its scene that it may take up there (`resume
// --accept`).
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "engine/files/run_json.hpp"
#include "engine/plan/plan.hpp"
#include "engine/run/simulation/simulation.hpp"
#include "engine/scene/keys/keys.hpp"
#include "engine/scene/scene.hpp"

namespace grainreel {

struct ResumePoint {
    Simulation simulation;   // as a checkpoint has it
    std::int64_t first = 0;  // step at which the run began
    std::size_t frames = 0;  // of film_moments.nc, that were handed out before
    std::filesystem::path checkpoint{};
    std::string held_back{};              // why it is not the run's last checkpoint; empty: it is
    std::int64_t reached = 0;             // step to which the run has come already
    bool changed = false;                 // its scene is another one from there on
    std::vector<AcceptedKey> accepted{};  // what was changed on the run's way up to there
};

// The last step whose checkpoint will do for a caller that wants all frames of the run once more, as a film
// does. Earlier frames come from film_moments.nc, which has them at the steps `kept`; later ones come as the
// run goes. first: the step at which the run began; last: that of its last checkpoint. With `first` the run
// goes on from its beginning, without the packing.
using FramesReach =
    std::function<std::int64_t(const std::vector<std::int64_t>& kept, std::int64_t first, std::int64_t last)>;

// The last checkpoint from which all files of the run's folder can go on, and the frames as well where they
// are wanted. reach: null where they are not.
//
// scene, plan: how the run is to go on. Throws UserError where there is no such checkpoint, and where the
// scene was changed.
ResumePoint find_resume_point(const Scene& scene, const Plan& plan, const std::filesystem::path& run,
                              int threads, const FramesReach& reach = {});

// A change to a scene that a run may take up while it goes on: stiffness and step stay as they are.
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
