// Where a run that is taken up again goes on.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "engine/files/run_json.hpp"
#include "engine/plan/plan.hpp"
#include "engine/run/simulation/simulation.hpp"
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

// Up to which step a checkpoint will do for whoever wants all frames of the run once more, as its film does:
// those before come from film_moments.nc, which has them at the steps `kept`, and the later ones as the run
// goes. first: the step at which the run began; last: that of its last checkpoint. With `first` the run goes
// on from its beginning, without the packing.
using FramesReach =
    std::function<std::int64_t(const std::vector<std::int64_t>& kept, std::int64_t first, std::int64_t last)>;

// The last checkpoint from which all files of the run's folder can go on, and whoever wants its frames.
// reach: null where nobody does.
//
// scene, plan: how the run is to go on. Throws UserError where there is no such checkpoint, and where the
// scene was changed.
ResumePoint find_resume_point(const Scene& scene, const Plan& plan, const std::filesystem::path& run,
                              int threads, const FramesReach& reach = {});

}  // namespace grainreel
