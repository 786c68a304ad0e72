// report.html: a finished run, or several, as one page that a browser opens without a network.
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "engine/plan/plan.hpp"
#include "render/film/sources/recorded_run.hpp"
#include "render/page/embed.hpp"
#include "render/scene/filmed_scene.hpp"

namespace grainreel {

// The plan of the run's scene, and the same in words, as `grainreel check` has them.
struct PlannedScene {
    Plan plan;
    std::vector<std::pair<std::string, std::string>> lines;  // of a name and a text
    std::string contacts;                                    // a table in columns
};

struct ReportMade {
    std::filesystem::path file;
    std::size_t bytes = 0;
    std::vector<std::string> news;  // what the user is to know, a line each
};

constexpr std::size_t kMostPageBytes = 20'000'000;

// A run for a page.
struct PageRun {
    std::filesystem::path folder;
    FilmedScene scene;                 // named after the folder
    std::shared_ptr<RecordedRun> run;  // null of a run that kept no moment of its grains
    bool contacts = false;             // its frames come with touches (RecordedRun of a film that shows them)
    std::optional<PlannedScene> planned;  // empty where the scene cannot be planned any more
};

// One run, or several side by side on one time axis. The page is written whole or not at all; nothing comes
// back when `progress` stopped it. Throws RunError.
std::optional<ReportMade> write_report(const std::vector<PageRun>& runs, const std::filesystem::path& out,
                                       const PageProgress& progress);

}  // namespace grainreel
