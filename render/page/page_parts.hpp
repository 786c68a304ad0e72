// The parts of the page that are words: HTML, made of facts.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "render/page/bed/bed_frames.hpp"
#include "render/page/bed/page_meshes.hpp"
#include "render/page/facts/run_facts.hpp"
#include "render/page/page_film.hpp"
#include "render/page/report.hpp"
#include "render/scene/filmed_scene.hpp"

namespace grainreel {

// What the run is, in a sentence.
std::string lead_html(const FilmedScene& scene);

// How a run ended that did not come to its end, and where (s); empty for one that did.
std::string end_html(const FilmedScene& scene, const RunFacts& facts, double until);

// The film's element and what is to be said of it. poster: a JPEG, or nothing. why_not_tied: empty where the
// film goes with charts and bed. n: what the ids of elements end in. beside: the page lies beside the film's
// file.
std::string film_html(const PageFilm& film, const std::vector<std::uint8_t>& poster,
                      const std::string& why_not_tied, const std::string& n = "", bool beside = true);

// What the page has of the bed's moments, and how exactly.
std::string bed_about(const BedFrames& bed, const PageMeshes& meshes, const FilmedScene& scene);

// The scene's captions, each a button that goes there; empty without any.
std::string story_html(const FilmedScene& scene);

// The plan in words, contacts, methods and sources, provenance, scene and files. page_name: of the page,
// which lies in the run's folder; without one there are no links to its files. n: what the ids of elements
// end in.
std::string chapters_html(const FilmedScene& scene, const RunFacts& facts,
                          const std::optional<PlannedScene>& planned, const std::filesystem::path& folder,
                          const std::string& page_name, const std::string& n = "");

}  // namespace grainreel
