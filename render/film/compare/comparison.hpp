// Reads and checks what `compare` will show: the panels, and the moments that all of them show.
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
    std::vector<Panel> panels;  // the members as they are drawn, in the same order
    FilmedScene film;           // stands for the whole: name, title, size, rate, segments, duration
    Pictures pictures;          // the moments that every member shows
    std::size_t reference = 0;  // the panel whose drive the film's segments follow
    bool by_schedule = true;    // the film's segments chose the moments; else a finished run did
    // One for each panel, with the value that is varied; empty where nothing is varied.
    std::vector<std::string> labels;
    std::vector<std::string> captions;  // one for each panel, where the user gave them
    // If one picture is drawn instead of a film: its time in s of film.
    std::optional<double> still;
    bool pdf = false;                // that picture is a PDF
    double dots_an_inch = 0;         // resolution of that picture for print; 0: it has no size on paper
    std::int64_t film_pictures = 0;  // number of pictures of the film, also if only one is drawn
    ThreadPlan threads;
    std::vector<std::string> warnings;

    bool all_recorded() const;  // whether nothing has to be run
    double film_end = 0;        // s, time of the last moment of the film, also if one picture is drawn
};

// Reads members, threads, labels and warnings of a comparison. Throws UserError for any scene, run or option
// that is wrong.
void read_members(const CompareRequest& what, Comparison& all);

// Chooses the moments that all members show and the rules by which they show them. Throws UserError when the
// members share no moment.
void choose_moments(const CompareRequest& what, Comparison& all);

// Reads the members, chooses the moments and makes the panels. Throws UserError if a scene, a run or an
// option is wrong.
Comparison read_comparison(const CompareRequest& what, const FilmRequest& film);

}  // namespace grainreel
