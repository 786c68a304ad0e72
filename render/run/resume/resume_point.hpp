// Where a run that is taken up again goes on.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>

#include "engine/files/run_json.hpp"
#include "engine/plan/plan.hpp"
#include "engine/run/simulation.hpp"
#include "render/scene/filmed_scene.hpp"

namespace grainreel {

struct ResumePoint {
    Simulation simulation;     // as a checkpoint has it
    std::int64_t first = 0;    // step at which the run began
    std::size_t pictures = 0;  // of the film, that are drawn again from their kept moments
    std::filesystem::path checkpoint{};
    std::string held_back{};              // why it is not the run's last checkpoint; empty: it is
    std::int64_t reached = 0;             // step to which the run has come already
    bool changed = false;                 // its scene is another one from there on
    std::vector<AcceptedKey> accepted{};  // what was changed on the run's way up to there
};

// The last checkpoint from which all files of the run's folder can go on. Its film, where `film` says that it
// has one, is drawn again: from the kept moments of its pictures up to the checkpoint, and from there on as
// the run goes. So a film whose pictures show more than a moment, or one whose moments were not kept, lets
// the run go on from its beginning, without the packing.
//
// scene, plan: how the run is to go on. Throws UserError where there is no such checkpoint, and where the
// scene was changed.
ResumePoint find_resume_point(const FilmedScene& scene, const Plan& plan, const std::filesystem::path& run,
                              bool film, int threads);

// Whether the run's folder has a film, or the beginning of one.
bool has_film(const FilmedScene& scene, const std::filesystem::path& run);

}  // namespace grainreel
