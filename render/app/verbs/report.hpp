// Makes a run's page (report.html), for the verbs that leave one. report.cpp also has the verb `report`,
// which makes pages of finished runs.
#pragma once

#include <filesystem>
#include <optional>
#include <vector>

#include "engine/run/folder/folder_job.hpp"
#include "render/film/sources/film_request.hpp"
#include "render/page/report.hpp"
#include "render/scene/filmed_scene.hpp"

namespace grainreel {

// Whether frames are checked for damage. Those that this program has just written need no check.
enum class Damage { looked_for, none };

// What a page shows that does not lie in the folders of its runs.
struct BesideRuns {
    PageOfAll of_all;
    std::vector<std::filesystem::path> films;  // folder of each run's film; empty: the run's own
    std::vector<std::string> names;            // that the user gave the runs
};

// Makes the page of the runs in these folders, side by side where there are several. out: the page's file;
// empty: report.html in the first run's folder. Returns none when `progress` stopped it. Throws UserError for
// a folder that is no run, and RunError when the page cannot be made.
std::optional<ReportMade> make_page_of(const std::vector<std::filesystem::path>& runs,
                                       const std::filesystem::path& out, Damage damage,
                                       const PageProgress& progress, const BesideRuns& beside = {});

// The plan of a scene; none when this version of the program would not run the scene.
std::optional<PlannedScene> planned_scene(const FilmedScene& scene);

// What a folder of `compare` shows; no runs for other folders.
struct ComparedRuns {
    std::vector<std::filesystem::path> folders;
    std::vector<std::string> captions;  // given by --captions
    std::string title;                  // of its film
};
ComparedRuns runs_of_comparison(const std::filesystem::path& folder);
// Makes report.html in the folder of a comparison.
PageMaker page_of_comparison();

// Makes report.html in the folder of a run that has just ended, however it ended.
PageMaker page_of_ended_run();

}  // namespace grainreel
