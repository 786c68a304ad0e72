// What `compare` is to show, read and checked: the panels, and the moments that all of them show.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "render/cli/estimate/thread_plan.hpp"
#include "render/draw/panels/panels.hpp"
#include "render/film/sampling/timeline.hpp"
#include "render/run/compare/compare_panel.hpp"
#include "render/run/film_request.hpp"

namespace grainreel {

struct Comparison {
    std::vector<std::unique_ptr<ComparePanel>> sources;
    std::vector<Panel> panels;  // as drawn, in the same order
    Scene film;                 // stands for the whole: name, title, size, rate, segments, duration
    std::vector<Instant> instants;
    std::size_t reference = 0;  // the panel by whose drive the film goes
    ThreadPlan threads;
    std::vector<std::string> warnings;
};

// Throws UserError for whatever scene, run or option is wrong.
Comparison read_comparison(const CompareRequest& request, const FilmRequest& film);

}  // namespace grainreel
