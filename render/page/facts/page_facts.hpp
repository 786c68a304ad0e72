// What the page's scripts read: JSON.
#pragma once

#include <optional>
#include <string>

#include "engine/measure/measures.hpp"
#include "render/film/sources/frame_source.hpp"
#include "render/page/bed/bed_frames.hpp"
#include "render/page/bed/page_meshes.hpp"
#include "render/page/page_film.hpp"
#include "render/page/page_measures.hpp"
#include "render/scene/filmed_scene.hpp"

namespace grainreel {

struct PageFacts {
    std::string name;    // of the run, where the page has several
    std::string folder;  // its name
    const FilmedScene& scene;
    Span span;
    const PageFilm& film;
    const FilmTimes& film_times;
    const BedFrames& bed;
    const PageMeshes& meshes;
    const MeasureTable* table;  // null without measures
    const PageMeasures& measures;
    const PageFields& fields;
};

// For main.js, which names the members. Numbers that are none become null.
std::string facts_json(const PageFacts& facts);

// For live.js: what is known of a run before it has measured anything; its newest moments of the bed; the
// rows of its measures, of all columns.
std::string live_facts_json(const FilmedScene& scene);
std::string bed_facts_json(const FilmedScene& scene, const BedFrames& bed, const PageMeshes& meshes);
std::string all_measures_json(const MeasureTable& table, const PageMeasures& measures);

}  // namespace grainreel
