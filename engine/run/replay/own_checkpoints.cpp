#include "engine/run/replay/own_checkpoints.hpp"

#include <optional>
#include <system_error>

#include <fmt/format.h>

#include "engine/base/error.hpp"
#include "engine/base/text.hpp"
#include "engine/files/frames/saved_scene.hpp"
#include "engine/files/run_json.hpp"
#include "engine/run/replay/replay.hpp"
#include "engine/start/continuation.hpp"
#include "engine/start/restart.hpp"

namespace grainreel {

namespace fs = std::filesystem;

namespace {

constexpr const char* kDamaged = "is damaged, or of another version of grainreel";

// What a scene that an earlier version kept means today: keys that it did not know have their defaults.
std::string meant_today(const fs::path& checkpoint, const std::string& kept) {
    try {
        const Scene scene = scene_of_checkpoint(checkpoint);
        return scene_to_keep(scene, make_plan(scene));
    } catch (const UserError&) {
        return kept;
    }
}

std::string value_text(const std::string& value) {
    return value.empty() ? "not there" : excerpt(value);
}

// Why a checkpoint is not of the run with this scene; empty: it is.
std::string why_not(const KeptCheckpoint& one, const std::string& today,
                    const std::vector<AcceptedKey>& accepted) {
    const std::optional<CheckpointLabel> label = label_of_checkpoint(one.file);
    if (!label) return kDamaged;
    if (label->step != one.step)
        return fmt::format("is of another moment, step {}, than its name says", label->step);
    std::vector<KeyDifference> different = differences_of_future(label->scene, today, one.step, accepted);
    if (!different.empty())
        different = differences_of_future(meant_today(one.file, label->scene), today, one.step, accepted);
    if (different.empty()) return "";
    const KeyDifference& first = different.front();
    return fmt::format("is of another run: '{}' is {} there, but {} in scene.toml", excerpt(first.key),
                       value_text(first.then), value_text(first.now));
}

}  // namespace

OwnCheckpoints own_checkpoints(const fs::path& run, const Scene& scene) {
    OwnCheckpoints own;
    const auto pass_over = [&](const fs::path& file, const std::string& why) {
        own.news.push_back(fmt::format("{}: {}; it is passed over", file.string(), why));
    };
    std::vector<KeptCheckpoint> all = kept_checkpoints(run);
    std::error_code ignored;
    if (const fs::path last = run / "checkpoint.grs"; fs::exists(last, ignored) && !label_of_checkpoint(last))
        pass_over(last, kDamaged);
    if (all.empty()) return own;
    const std::string today = scene_to_keep(scene, plan_of_run(scene, run));
    const std::vector<AcceptedKey> accepted = accepted_in_run_json(run / "run.json");
    for (KeptCheckpoint& one : all) {
        const std::string why = why_not(one, today, accepted);
        why.empty() ? own.kept.push_back(std::move(one)) : pass_over(one.file, why);
    }
    // It says how far the run has come.
    while (!own.kept.empty() && !is_whole_checkpoint(own.kept.back().file)) {
        pass_over(own.kept.back().file, kDamaged);
        own.kept.pop_back();
    }
    return own;
}

}  // namespace grainreel
