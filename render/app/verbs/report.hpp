// Makes a run's page (report.html), for the verbs that leave one. report.cpp also has the verb `report`,
// which makes pages of finished runs.
#pragma once

#include <filesystem>
#include <optional>
#include <vector>

#include "engine/run/folder/folder_job.hpp"
#include "render/page/report.hpp"
#include "render/scene/filmed_scene.hpp"

namespace grainreel {

// Whether frames are checked for damage. Those that this program has just written need no check.
enum class Damage { looked_for, none };

// Films of a page that do not lie in the folders of its runs.
struct PageFilms {
    std::filesystem::path of_all;                // folder of a film that shows all runs side by side
    std::vector<std::filesystem::path> of_runs;  // for each run; empty: in its own folder
};

// Makes the page of the runs in these folders, side by side where there are several. out: the page's file;
// empty: report.html in the first run's folder. Returns none when `progress` stopped it. Throws UserError for
// a folder that is no run, and RunError when the page cannot be made.
std::optional<ReportMade> make_page_of(const std::vector<std::filesystem::path>& runs,
                                       const std::filesystem::path& out, Damage damage,
                                       const PageProgress& progress, const PageFilms& films = {});

// The plan of a scene; none when this version of the program would not run the scene.
std::optional<PlannedScene> planned_scene(const FilmedScene& scene);

// The folders of the runs that a folder of `compare` shows; empty for other folders.
std::vector<std::filesystem::path> runs_of_comparison(const std::filesystem::path& folder);
// Makes report.html in the folder of a comparison.
PageMaker page_of_comparison();

// Makes report.html in the folder of a run that has just ended, however it ended.
PageMaker page_of_ended_run();

}  // namespace grainreel
