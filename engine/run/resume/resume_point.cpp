#include "engine/run/resume/resume_point.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <vector>

#include "engine/base/error.hpp"
#include "engine/base/lists.hpp"
#include "engine/files/run_names.hpp"
#include "engine/run/replay/checkpoint_ring.hpp"
#include "engine/run/resume/kept_files.hpp"
#include "engine/scene/scene.hpp"
#include "engine/start/restart.hpp"

namespace grainreel {

namespace fs = std::filesystem;

namespace {

// Whether a key of [output] may change. Only the ring of checkpoints and film_moments.nc depend on these two,
// and they need not go on as they began.
bool may_change(const std::string& key) {
    return key == "output.checkpoints" || key == "output.film_moments";
}

// Checks that the settings of measures and files are the former ones, because the files go on.
void check_same_files(const std::string& then, const Scene& scene, const Plan& plan) {
    for (const KeyDifference& difference : differences_of_table(then, scene_to_keep(scene, plan), "output")) {
        if (may_change(difference.key)) continue;
        throw UserError(
            "{}: '{}' is {}, but it was {} in this run, whose files would not go together; put "
            "back what it was",
            scene.where(difference.key), difference.key,
            difference.now.empty() ? "not there" : difference.now,
            difference.then.empty() ? "not there" : difference.then);
    }
}

struct Limits {
    std::int64_t first = 0,
                 film = 0;  // steps: where the run began, and the last one from which its film can go on
};

// Whether the run had ended at this checkpoint and is longer now. Its last record of fields may then have
// been cut short, and the data gathered for it are lost.
bool is_former_end(const KeptCheckpoint& one, const CheckpointLabel& label, const Scene& scene,
                   const Plan& plan) {
    for (const KeyDifference& difference :
         differences_of_table(label.scene, scene_to_keep(scene, plan), "run"))
        if (difference.key == "run.duration")
            return one.step >= std::llround(std::strtod(difference.then.c_str(), nullptr) / plan.clock.step);
    return false;
}

std::optional<SimulatedBed> usable(const KeptCheckpoint& one, const Scene& scene, const Plan& plan,
                                   int threads, std::optional<UserError>& mistake) {
    try {
        if (const auto label = label_of_checkpoint(one.file)) {
            check_same_files(label->scene, scene, plan);
            if (keeps_fields(scene) && is_former_end(one, *label, scene, plan)) return std::nullopt;
        }
        return SimulatedBed::at_checkpoint(scene, plan, one.file, threads);
    } catch (const UserError& error) {
        if (!mistake) mistake = error;
    }
    return std::nullopt;
}

// The reason why the run goes on from this checkpoint and not from the last one; empty for the last one.
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
            "{}: the moments that its film needs are not there, and neither is a checkpoint from "
            "before them; "
            "--no-film goes on without the film, and `render` draws one of the trajectory",
            run.string());
    throw UserError("{}: has no checkpoint that its other files reach; run the scene again", run.string());
}

}  // namespace

ResumePoint find_resume_point(const Scene& scene, const Plan& plan, const fs::path& run, int threads,
                              const FramesReach& reach) {
    const std::vector<KeptCheckpoint> kept = kept_checkpoints(run);
    if (kept.empty())
        throw UserError(
            "{}: has no checkpoint; the run was stopped while its grains were packed, so "
            "run its scene.toml again",
            run.string());
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
        if (std::optional<SimulatedBed> simulation = usable(*one, scene, plan, threads, mistake)) {
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

namespace {

bool ends_in(const std::string& key, const std::string& name) {
    return key.size() > name.size() && key.ends_with("." + name);
}

bool is_of_drive(const std::string& key) {
    return key == "drive.amplitude";
}

bool is_friction(const std::string& key) {
    return key.starts_with("contact.pair[") && (ends_in(key, "friction") || ends_in(key, "rolling_friction"));
}

// Whether the user named this key of the resolved scene.
bool is_named(const std::string& key, const std::vector<std::string>& accepted) {
    return std::any_of(accepted.begin(), accepted.end(), [&](const std::string& name) {
        if (name == key) return true;
        if (name == "drive.g_level") return key == "drive.amplitude";
        if (name == "contact.friction") return is_friction(key) && ends_in(key, "friction");
        if (name == "contact.rolling_friction") return is_friction(key) && ends_in(key, "rolling_friction");
        return false;
    });
}

// Whether a name stands for keys that can change. The run's scene has friction by pairs.
bool can_be_named(const std::string& name) {
    return name == "drive.g_level" || is_of_drive(name) ||
           (name.starts_with("contact.") && (ends_in(name, "friction") || ends_in(name, "rolling_friction")));
}

void check_can_change(const std::string& key) {
    if (can_be_named(key)) return;
    throw UserError(
        "--accept: '{}' cannot change while a run goes on; these can: drive.g_level, "
        "drive.amplitude, contact.friction, contact.rolling_friction",
        key);
}

}  // namespace

std::vector<AcceptedChange> accepted_changes(const std::filesystem::path& checkpoint, const Scene& scene,
                                             const Plan& plan, const std::vector<std::string>& accepted) {
    std::vector<AcceptedChange> changes;
    const std::optional<CheckpointLabel> label = label_of_checkpoint(checkpoint);
    if (!label) return changes;
    for (const std::string& name : accepted) check_can_change(name);
    for (const KeyDifference& difference : deciding_differences(label->scene, scene_to_keep(scene, plan))) {
        check_can_change(difference.key);
        if (!is_named(difference.key, accepted))
            throw UserError(
                "{}: '{}' is {}, but it was {} in this run; put back what it was, or give --accept {}",
                scene.where(difference.key), difference.key,
                difference.now.empty() ? "not there" : difference.now,
                difference.then.empty() ? "not there" : difference.then, difference.key);
        changes.push_back({difference.key, difference.then, difference.now});
    }
    for (const std::string& name : accepted)
        if (std::none_of(changes.begin(), changes.end(),
                         [&](const AcceptedChange& change) { return is_named(change.key, {name}); }))
            throw UserError(
                "--accept: '{}' is what it was in this run; give it another value, as in "
                "drive.g_level=3",
                name);
    return changes;
}

Assignments undone(const std::vector<AcceptedChange>& changes) {
    Assignments sets;
    for (const AcceptedChange& change : changes)
        sets.push_back({fmt::format("{}={}", change.key, change.then), "--accept"});
    return sets;
}

Drive drive_changed_at(double time, const Scene& before, const Scene& after,
                       const std::vector<AcceptedChange>& changes) {
    const bool changes_drive = std::any_of(
        changes.begin(), changes.end(), [](const AcceptedChange& change) { return is_of_drive(change.key); });
    if (!changes_drive) return after.drive;
    Drive drive = before.drive;
    if (!drive.stages.empty() && drive.stages.front().from <= time)
        throw UserError(
            "--accept: a stage of the drive began at {:.6g} s; change the stages in scene.toml that come "
            "after {:.6g} s",
            drive.stages.front().from, time);
    DriveStage stage;
    stage.from = time;
    stage.frequency = after.drive.frequency;
    stage.amplitude = after.drive.amplitude;
    drive.stages.insert(drive.stages.begin(), stage);
    return drive;
}

// The text names "Γ" and friction, which users know. Pairs that change alike are named once.
std::string words_of_changes(const Scene& before, const Scene& after,
                             const std::vector<AcceptedChange>& changes) {
    if (changes.empty()) return "";
    std::vector<std::string> parts;
    const auto add = [&](const std::string& part) {
        if (!contains(parts, part)) parts.push_back(part);
    };
    for (const AcceptedChange& change : changes) {
        if (change.key == "drive.amplitude") {
            const double gravity = before.gravity.norm();
            const double then = before.drive.g_level(gravity), now = after.drive.g_level(gravity);
            if (gravity > 0 && std::abs(now - then) > 1e-6 * then)
                add(fmt::format("Γ {:.3g} instead of {:.3g}", now, then));
            else
                add(fmt::format("amplitude {:.3g} mm instead of {:.3g} mm", 1e3 * after.drive.amplitude,
                                1e3 * before.drive.amplitude));
        } else {
            add(fmt::format("{} {} instead of {}",
                            ends_in(change.key, "rolling_friction") ? "rolling friction" : "friction",
                            change.now, change.then));
        }
    }
    return fmt::format("From here on: {}", fmt::join(parts, ", "));
}

void check_overlap_stays(const Scene& scene, const Plan& before, const Plan& after) {
    const double limit = std::max(scene.run.overlap, before.expected_overlap);
    if (after.expected_overlap <= limit * (1 + 1e-9)) return;
    throw UserError(
        "--accept: grains would overlap by {:.3g} % of their diameter, and this run is made for "
        "{:.3g} %; shake less, or start anew from its final.csv",
        100 * after.expected_overlap, 100 * limit);
}

}  // namespace grainreel
