#include "engine/files/frames/saved_scene.hpp"

#include <fmt/format.h>
#include <cmath>
#include <optional>

#include "engine/base/clock.hpp"
#include "engine/base/error.hpp"
#include "engine/base/plain_file.hpp"
#include "engine/base/system/program.hpp"
#include "engine/base/text.hpp"
#include "engine/measure/columns.hpp"
#include "engine/plan/times.hpp"
#include "engine/state/checkpoint_file.hpp"

namespace grainreel {

namespace fs = std::filesystem;

namespace {

[[noreturn]] void fail_without_folder(const fs::path& path) {
    if (!is_there(path)) throw UserError("{}: no such folder; give the folder of a run", path.string());
    const std::string other = other_than_file(path, true);
    const bool scene = other.empty() && path.extension() == ".toml";
    throw UserError(
        "{}: is {}; give the folder of a run{}", path.string(), other.empty() ? "a file" : other,
        scene ? fmt::format(", or run the scene: {} movie {}", program_call(), shell_word(path.string()))
              : "");
}

}  // namespace

fs::path folder_of_run(const fs::path& folder) {
    if (!is_folder(folder)) fail_without_folder(folder);
    const fs::path normal = folder.lexically_normal();
    if (normal.has_filename() && normal.filename() != "." && normal.filename() != "..") return normal;
    return normal.has_filename() || !normal.has_parent_path() ? fs::canonical(folder) : normal.parent_path();
}

fs::path file_of_run(const fs::path& folder, const char* name, const char* advice) {
    if (const std::string other = other_than_file(folder / name, true); !other.empty())
        throw UserError("{}: is {}, not a file of a run; {}", (folder / name).string(), other, advice);
    if (is_there(folder / name)) return folder / name;
    throw UserError("{}: has no {}; {}", folder.string(), name, advice);
}

Scene plain_scene_of_run(const fs::path& folder) {
    Scene scene = read_scene(file_of_run(folder, "scene.toml", "give the folder of a run of `movie`"), {},
                             measurable_in);
    scene.name = folder.filename().string();
    return scene;
}

CheckpointScene scene_in_checkpoint(const fs::path& checkpoint) {
    const std::optional<CheckpointLabel> label = label_of_checkpoint(checkpoint);
    if (!label)
        throw UserError("{}: is no checkpoint of this version of grainreel, or it is damaged",
                        checkpoint.string());
    const std::string name = checkpoint.string();
    return {{label->scene, checkpoint},
            {{"start.method=file", name},
             {"start.file=" + fs::absolute(checkpoint).string(), name},
             {"start.keep_clock=true", name}}};
}

Scene scene_of_checkpoint(const fs::path& checkpoint) {
    const auto [text, sets] = scene_in_checkpoint(checkpoint);
    Scene scene;
    read_scene_into(scene, text, sets, measurable_in);
    return scene;
}

Clock clock_of_steps(const Scene& scene, double step) {
    Clock clock;
    clock.step = step;
    if (!scene.drive.present || clock.step <= 0) return clock;
    return drive_clock(scene.drive, clock.step, std::llround(1 / (scene.drive.frequency * clock.step)));
}

Clock clock_of(const Scene& scene, const std::vector<State>& moments) {
    double step = 0;
    for (const State& moment : moments)
        if (moment.step != 0) step = moment.time / static_cast<double>(moment.step);
    // The quotient may differ from the scene's own step by rounding. Then the scene's step is used.
    if (scene.run.step && std::abs(step - *scene.run.step) <= 1e-12 * step) step = *scene.run.step;
    return clock_of_steps(scene, step);
}

}  // namespace grainreel
