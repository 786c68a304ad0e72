// report.html: a finished run as one page that a browser opens without a network.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "engine/plan/plan.hpp"
#include "render/run/frames/recorded_run.hpp"

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

// contacts: whether the run's frames come with touches (RecordedRun of a film that shows them). planned:
// empty where the scene cannot be planned any more. The page is written whole or not at all. Throws RunError.
ReportMade write_report(RecordedRun& run, bool contacts, const std::optional<PlannedScene>& planned,
                        const std::filesystem::path& out);

}  // namespace grainreel
