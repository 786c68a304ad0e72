#include "render/app/verbs/page_of_run.hpp"

#include "engine/base/error.hpp"
#include "engine/files/frames/open_frames.hpp"
#include "engine/files/frames/saved_scene.hpp"
#include "engine/run/resume/kept_files.hpp"
#include "render/app/check/print_plan.hpp"
#include "render/film/sources/recorded_scene.hpp"
#include "render/scene/filmed_scene.hpp"

namespace grainreel {
namespace {

namespace fs = std::filesystem;

// Settings with which frames come with the contacts that the run kept.
Assignments with_contacts() {
    return {{"film.force_chains=true", "report"}};
}

// Whether the run kept moments. A damaged file counts as kept: reading it tells what is wrong.
bool kept_moments(const fs::path& folder) {
    if (!is_there(folder / "trajectory.nc")) return false;
    try {
        const auto frames = open_frames(folder / "trajectory.nc", {.format = "trajectory"});
        return !frames->moments().empty() || !frames->damage().empty();
    } catch (const UserError&) {
        return true;
    }
}

}  // namespace

std::optional<PlannedScene> planned_scene(const FilmedScene& scene) {
    try {
        Plan plan = plan_with_film(scene);
        PlanWords words = plan_words(scene, plan);
        return PlannedScene{std::move(plan), std::move(words.lines), std::move(words.contacts)};
    } catch (const UserError&) {
        return std::nullopt;  // the scene is of an earlier version, and this version would not run it
    }
}

std::optional<ReportMade> make_page_of(const std::vector<fs::path>& runs, const fs::path& out, bool checked,
                                       const PageProgress& progress) {
    std::vector<PageRun> all;
    for (const fs::path& run : runs) {
        PageRun& one = all.emplace_back();
        one.folder = folder_of_run(run);
        if (kept_moments(one.folder)) {
            one.contacts = is_there(one.folder / "contacts.nc");
            one.run =
                std::make_shared<RecordedRun>(one.folder, one.contacts ? with_contacts() : Assignments());
            if (!checked) one.run->leave_out_damaged();
        }
        one.scene = one.run ? one.run->scene() : scene_of_run(one.folder, {});
        one.planned = planned_scene(one.scene);
    }
    return write_report(all, out.empty() ? all.front().folder / kPageName : out, progress);
}

PageMaker page_of_ended_run() {
    return
        [](const fs::path& folder, const std::function<bool(double)>& go_on) -> std::optional<std::string> {
            const bool checked = true;
            if (!make_page_of({folder}, folder / kPageName, checked, go_on)) return std::nullopt;
            return kPageName;
        };
}

}  // namespace grainreel
