// What the page's scripts read: JSON.
#pragma once

#include <optional>
#include <string>

#include "engine/measure/measure_table.hpp"
#include "render/report/bed_frames.hpp"
#include "render/report/film_times.hpp"
#include "render/report/page_film.hpp"
#include "render/report/page_measures.hpp"

namespace grainreel {

struct PageFacts {
    const Scene& scene;
    Span span;
    const PageFilm& film;
    const FilmTimes& film_times;
    const BedFrames& bed;
    const MeasureTable* table;  // null without measures
    const PageMeasures& measures;
};

// For main.js, which names the members. Numbers that are none become null.
std::string facts_json(const PageFacts& facts);

}  // namespace grainreel
