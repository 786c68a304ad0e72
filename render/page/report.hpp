// Writes report.html: one page about a finished run, or several, that a browser opens without a network.
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "engine/plan/plan.hpp"
#include "engine/run/stored/stored_run.hpp"
#include "render/page/embed.hpp"
#include "render/scene/filmed_scene.hpp"

namespace grainreel {

// The plan of a run's scene, also in words as `grainreel check` prints it.
struct PlannedScene {
    Plan plan;
    std::vector<std::pair<std::string, std::string>> lines;  // lines with a name and a text
    std::string contacts;                                    // the table of contacts
};

struct ReportMade {
    std::filesystem::path file;
    std::size_t bytes = 0;
    std::vector<std::string> news;  // lines that the user should see
};

constexpr std::size_t kMostPageBytes = 20'000'000;

// A run that a page shows.
struct PageRun {
    std::filesystem::path folder;
    FilmedScene scene;                       // named after the folder
    std::shared_ptr<StoredRun> run;          // null for a run that kept no moment of its grains
    std::optional<PlannedScene> planned;     // empty when the scene cannot be planned any more
    std::filesystem::path film_folder = {};  // where film and poster lie; empty: in the run's folder
    std::string name = {};                   // that the user gave it
};

// What shows all runs of a page together.
struct PageOfAll {
    std::filesystem::path film;  // folder of the film that shows them side by side; empty: there is none
    std::string title;           // of that film; empty: the title that the runs share
};

// Writes the page of one run, or of several side by side on one time axis. It is written completely or not at
// all. Returns none when `progress` stopped it. Throws RunError when it cannot be written.
std::optional<ReportMade> write_report(const std::vector<PageRun>& runs, const std::filesystem::path& out,
                                       const PageProgress& progress, const PageOfAll& of_all = {});

}  // namespace grainreel
