// The point from which a resumed run goes on, and the changes to its scene that are allowed there (`resume
// --accept`).
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "engine/files/run_json.hpp"
#include "engine/plan/plan.hpp"
#include "engine/run/simulation/simulated_bed.hpp"
#include "engine/scene/keys/keys.hpp"
#include "engine/scene/scene.hpp"

namespace grainreel {

struct ResumePoint {
    SimulatedBed simulation;  // in the state of the checkpoint
    std::int64_t first = 0;   // step at which the run began
    std::size_t frames = 0;   // frames in film_moments.nc that were handed out before
    std::filesystem::path checkpoint{};
    std::string held_back{};                  // why this is not the run's last checkpoint; empty if it is
    std::int64_t reached = 0;                 // step that the run has already reached
    bool changed = false;                     // whether the scene changes from there on
    std::vector<AcceptedKey> accepted{};      // keys that were changed on the run's way up to there
    std::optional<DeepestContact> deepest{};  // of the run so far, as its run.json has it
    std::optional<double> settled{};          // s, of its packing, likewise
};

// For a caller that needs all frames of the run again, such as a film: returns the last step from which the
// run may go on. Earlier frames are read from film_moments.nc, which has frames at the steps `kept`; later
// frames come as the run goes on. `first` is the step at which the run began, and `last` the step of its last
// checkpoint. If `first` is returned, the run goes on from its beginning, without packing again.
using FramesReach =
    std::function<std::int64_t(const std::vector<std::int64_t>& kept, std::int64_t first, std::int64_t last)>;

// Finds the last checkpoint from which all files of the run's folder can go on, and the frames too if they
// are needed. `reach` is null if they are not.
//
// `scene` and `plan` are those with which the run is to go on. Throws UserError if there is no such
// checkpoint, or if the scene was changed.
ResumePoint find_resume_point(const Scene& scene, const Plan& plan, const std::filesystem::path& run,
                              int threads, const FramesReach& reach = {});

// A change to a scene that a run may take up while it goes on: stiffness and step stay as they are.
struct AcceptedChange {
    std::string key;        // "drive.amplitude"
    std::string then, now;  // as TOML
};

// The differences between the scene of a checkpoint and the scene that is to go on. `accepted` holds keys
// that the user named, for example "drive.g_level", or "contact.friction" for all pairs. Throws UserError for
// a difference that was not named, and for a key that cannot change while a run goes on.
std::vector<AcceptedChange> accepted_changes(const std::filesystem::path& checkpoint, const Scene& scene,
                                             const Plan& plan, const std::vector<std::string>& accepted);

// Assignments that undo the changes, for the reader of the scene.
Assignments undone(const std::vector<AcceptedChange>& changes);

// The drive of a run that goes on at `time` (s). A new stage makes the change, so that place and velocity of
// the container stay continuous. `before` is the scene without the changes, and `after` the scene with them.
// Throws UserError if a stage of the drive has begun.
Drive drive_changed_at(double time, const Scene& before, const Scene& after,
                       const std::vector<AcceptedChange>& changes);

// "From here on: Γ 4 instead of 3, friction 0.2 instead of 0.5". UTF-8; empty without changes.
std::string words_of_changes(const Scene& before, const Scene& after,
                             const std::vector<AcceptedChange>& changes);

// Throws UserError if the changed scene would need stiffer grains to keep overlaps within the limit.
void check_overlap_stays(const Scene& scene, const Plan& before, const Plan& after);

}  // namespace grainreel
