#include "engine/run/resume/resume_point.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <system_error>
#include <vector>

#include <fmt/format.h>

#include "engine/base/error.hpp"
#include "engine/files/run_names.hpp"
#include "engine/run/replay/checkpoint_ring.hpp"
#include "engine/run/resume/kept_files.hpp"
#include "engine/scene/scene.hpp"
#include "engine/start/continuation.hpp"
#include "engine/start/restart.hpp"

namespace grainreel {

namespace fs = std::filesystem;

namespace {

// How much is kept of checkpoints and of the film's moments may change.
bool may_change(const std::string& key) {
    return key == "output.checkpoints" || key == "output.film_moments";
}

// What is measured and kept must be what it was, for the files go on.
void check_same_files(const std::string& then, const Scene& scene, const Plan& plan) {
    for (const KeyDifference& difference : differences_of_table(then, scene_to_keep(scene, plan), "output")) {
        if (may_change(difference.key)) continue;
        throw UserError(
            fmt::format("{}: '{}' is {}, but it was {} in this run, whose files would not go together; put "
                        "back what it was",
                        scene.where(difference.key), difference.key,
                        difference.now.empty() ? "not there" : difference.now,
                        difference.then.empty() ? "not there" : difference.then));
    }
}

struct Limits {
    std::int64_t first = 0,
                 film = 0;  // steps: where the run began; checkpoints up to there will do for its film
};

// Whether the run had come to its end there, and is longer now. Its last record of fields may have been cut
// short then, and what was gathered of it is gone.
bool is_former_end(const KeptCheckpoint& one, const CheckpointLabel& label, const Scene& scene,
                   const Plan& plan) {
    for (const KeyDifference& difference :
         differences_of_table(label.scene, scene_to_keep(scene, plan), "run"))
        if (difference.key == "run.duration")
            return one.step >= std::llround(std::strtod(difference.then.c_str(), nullptr) / plan.clock.step);
    return false;
}

std::optional<Simulation> usable(const KeptCheckpoint& one, const Scene& scene, const Plan& plan, int threads,
                                 std::optional<UserError>& mistake) {
    try {
        if (const auto label = label_of_checkpoint(one.file)) {
            check_same_files(label->scene, scene, plan);
            if (keeps_fields(scene) && is_former_end(one, *label, scene, plan)) return std::nullopt;
        }
        return Simulation::at_checkpoint(scene, plan, one.file, threads);
    } catch (const UserError& error) {
        if (!mistake) mistake = error;
    }
    return std::nullopt;
}

// Why the run goes on from this checkpoint and not from the last one; empty for the last one.
std::string why_held_back(const KeptCheckpoint& one, const KeptCheckpoint& last, const Limits& limits,
                          const Plan& plan) {
    if (one.step == last.step) return "";
    const char* why = last.step > limits.film
                          ? "the film has to be drawn anew from there"
                          : "what lies in its files, or in its checkpoints, is whole up to there";
    return fmt::format("the run had come to {:.6g} s; {}", plan.clock.time(last.step), why);
}

[[noreturn]] void refuse(const fs::path& run, const Limits& limits, std::int64_t earliest) {
    if (limits.film < earliest)
        throw UserError(
            fmt::format("{}: the moments that its film needs are not there, and neither is a checkpoint from "
                        "before them; "
                        "--no-film goes on without the film, and `render` draws one of the trajectory",
                        run.string()));
    throw UserError(
        fmt::format("{}: has no checkpoint that its other files reach; run the scene again", run.string()));
}

}  // namespace

ResumePoint find_resume_point(const Scene& scene, const Plan& plan, const fs::path& run, int threads,
                              const FramesReach& reach) {
    const std::vector<KeptCheckpoint> kept = kept_checkpoints(run);
    if (kept.empty())
        throw UserError(
            fmt::format("{}: has no checkpoint; the run was stopped while its grains were packed, so "
                        "run its scene.toml again",
                        run.string()));
    check_files_of_run(run, scene, plan);
    const std::vector<std::int64_t> rows = steps_in_measures(run / "measures.csv"),
                                    frames = steps_in_trajectory(run / kFilmMoments);
    Limits limits;
    limits.first = rows.empty() ? kept.front().step : rows.front();
    const std::int64_t last = kept.back().step;
    limits.film = reach ? reach(frames, limits.first, last) : last;
    std::optional<UserError> mistake;
    for (auto one = kept.rbegin(); one != kept.rend(); ++one) {
        if (one->step > limits.film || !files_reach(run, scene, plan, limits.first, one->step)) continue;
        if (std::optional<Simulation> simulation = usable(*one, scene, plan, threads, mistake)) {
            const auto end = std::lower_bound(frames.begin(), frames.end(), one->step);
            return {std::move(*simulation),
                    limits.first,
                    static_cast<std::size_t>(end - frames.begin()),
                    one->file,
                    why_held_back(*one, kept.back(), limits, plan),
                    reached_step(run, last)};
        }
    }
    if (mistake) throw *mistake;
    refuse(run, limits, kept.front().step);
}

}  // namespace grainreel
