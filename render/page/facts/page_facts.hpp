// Makes the JSON that the page's scripts read.
#pragma once

#include <string>

#include "engine/measure/measures.hpp"
#include "render/film/sources/shot_source.hpp"
#include "render/page/bed/page_bed.hpp"
#include "render/page/bed/page_meshes.hpp"
#include "render/page/page_film.hpp"
#include "render/page/page_measures.hpp"
#include "render/scene/filmed_scene.hpp"

namespace grainreel {

struct PageFacts {
    std::string name;    // name of the run, when the page has several
    std::string folder;  // name of the run's folder
    const FilmedScene& scene;
    Span span;  // simulated times of the run; the page's time axis
    const PageFilm& film;
    const FilmTimes& film_times;
    const PageBed& bed;
    const PageMeshes& meshes;
    const MeasureTable* table;  // null without measures
    const PageMeasures& measures;
    const PageFields& fields;
};

// The facts for the page's scripts (render/page/html), which find the members by their names. The class that
// takes a part of the facts explains its members, as FieldsPanel in fields.js does. NaN becomes null.
std::string facts_json(const PageFacts& facts);

// The facts for render/page/html/live.js. live_facts_json(): what is known of a run before it has measured
// anything. bed_facts_json(): the newest moments of its bed. all_measures_json(): rows of its measures, with
// all columns.
std::string live_facts_json(const FilmedScene& scene);
std::string bed_facts_json(const FilmedScene& scene, const PageBed& bed, const PageMeshes& meshes);
std::string all_measures_json(const MeasureTable& table, const PageMeasures& measures);

}  // namespace grainreel
