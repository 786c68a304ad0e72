#include "engine/handover/back/bring_back.hpp"

#include <fmt/format.h>

#include "engine/base/error.hpp"
#include "engine/files/run_json.hpp"
#include "engine/handover/back/returned_run.hpp"
#include "engine/handover/handover_folder.hpp"
#include "engine/measure/columns.hpp"
#include "engine/plan/plan.hpp"
#include "engine/scene/scene_file.hpp"

namespace grainreel {

namespace fs = std::filesystem;

namespace {

constexpr const char* made_names[] = {"measures.csv", "outflow.csv", "final.csv", "trajectory.nc"};

// A folder that is gone afterwards.
struct PassingFolder {
    explicit PassingFolder(const fs::path& folder) : path(folder / ".returning") {
        std::error_code failed;
        fs::remove_all(path, failed);
        if (!fs::create_directory(path, failed))
            throw RunError(fmt::format("{}: cannot be made: {}", path.string(), failed.message()));
    }
    ~PassingFolder() {
        std::error_code ignored;
        fs::remove_all(path, ignored);
    }
    const fs::path path;
};

bool is_newer(const fs::path& made, const fs::path& dump) {
    std::error_code missing;
    const auto when = fs::last_write_time(made, missing);
    return !missing && when >= fs::last_write_time(dump, missing) && !missing;
}

}  // namespace

BroughtBack bring_back(const fs::path& folder, const std::string& version,
                       const std::function<bool(double)>& watcher) {
    const HandoverFacts facts = read_handover(folder);
    std::error_code missing;
    if (!fs::is_regular_file(facts.dump, missing))
        throw UserError(fmt::format("{}: is not there, so {} has not run yet; run it: sh {}/run.sh",
                                    facts.dump.string(), name_of(facts.engine), folder.string()));
    BroughtBack back;
    if (is_newer(folder / "trajectory.nc", facts.dump)) return back;
    const Scene scene = read_scene(folder / "scene.toml", {}, measurable_in);
    const Plan plan = make_plan(scene);
    const PassingFolder made(folder);
    {
        ReturnedRun run(made.path, scene, plan, facts, version);
        while (run.take_next())
            if (!watcher(static_cast<double>(run.frames()) /
                         static_cast<double>(std::max<std::int64_t>(run.frames(), facts.dumps))))
                return back;
        if (run.last() == nullptr)
            throw UserError(fmt::format("{}: has no whole frame so far", facts.dump.string()));
        back.frames = run.frames();
        back.until = run.last()->time;
        back.whole = run.last()->step >= facts.last;
        RunRecord record;
        run.close(record);
    }
    for (const char* name : made_names)
        if (fs::exists(made.path / name, missing)) fs::rename(made.path / name, folder / name);
    if (!back.whole)
        back.news.push_back(fmt::format("{} has come to {:.4g} s of {:.4g} s; what there is is drawn",
                                        name_of(facts.engine), back.until, plan.clock.time(facts.last)));
    return back;
}

}  // namespace grainreel
