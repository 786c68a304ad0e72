// What `compare` is to show, read and checked: the panels, and the moments that all of them show.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "render/draw/panels/panels.hpp"
#include "render/film/sampling/timeline.hpp"
#include "render/run/compare/member.hpp"
#include "render/run/film_request.hpp"
#include "render/run/thread_plan.hpp"

namespace grainreel {

struct Comparison {
    std::vector<std::unique_ptr<Member>> members;
    std::vector<Panel> panels;  // as drawn, in the same order
    Scene film;                 // stands for the whole: name, title, size, rate, segments, duration
    Pictures pictures;          // of every member
    std::size_t reference = 0;  // the panel by whose drive the film goes
    ThreadPlan threads;
    std::vector<std::string> warnings;

    bool all_recorded() const;  // nothing is run
};

// Throws UserError for whatever scene, run or option is wrong.
Comparison read_comparison(const CompareRequest& what, const FilmRequest& film);

}  // namespace grainreel
