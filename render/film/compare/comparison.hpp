// What `compare` is to show, read and checked: the panels, and the moments that all of them show.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "render/film/compare/member.hpp"
#include "render/film/sampling/timeline.hpp"
#include "render/film/sources/film_request.hpp"
#include "render/picture/panels/panels.hpp"
#include "render/scene/filmed_scene.hpp"

namespace grainreel {

struct Comparison {
    std::vector<std::unique_ptr<ComparedMember>> members;
    std::vector<Panel> panels;        // as drawn, in the same order
    FilmedScene film;                 // stands for the whole: name, title, size, rate, segments, duration
    Pictures pictures;                // of every member
    std::size_t reference = 0;        // the panel by whose drive the film goes
    bool by_schedule = true;          // the film's segments chose the moments; else a finished run did
    std::vector<std::string> labels;  // one a panel, of what is varied; none where nothing is
    // A picture of one moment in place of a film: where the film has it, s of film.
    std::optional<double> still;
    double dots_an_inch = 0;         // of that picture, for print; 0: of no size on paper
    std::int64_t film_pictures = 0;  // that the film has, or would have
    ThreadPlan threads;
    std::vector<std::string> warnings;

    bool all_recorded() const;  // nothing is run
    double film_end = 0;        // s, of the last moment that the film has, or would have
};

// Members, threads, labels and warnings of a comparison. Throws UserError for whatever scene, run or option
// is wrong.
void read_members(const CompareRequest& what, Comparison& all);

// The moments that all of its members show, and by which rules. Throws UserError when they share none.
void choose_moments(const CompareRequest& what, Comparison& all);

// Throws UserError for whatever scene, run or option is wrong.
Comparison read_comparison(const CompareRequest& what, const FilmRequest& film);

}  // namespace grainreel
