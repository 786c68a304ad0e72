// Writes the parts of the page that are words, as HTML.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "engine/files/run_json.hpp"
#include "render/page/bed/page_bed.hpp"
#include "render/page/bed/page_meshes.hpp"
#include "render/page/page_film.hpp"
#include "render/page/page_words.hpp"
#include "render/page/report.hpp"
#include "render/scene/filmed_scene.hpp"

namespace grainreel {

// Whose run it is. Files of other programs do not tell how it was computed or how it ended.
enum class RunOf { us, others };

// A sentence that says what the run is; lead_text() has no full stop and no HTML.
std::string lead_text(const FilmedScene& scene, const PageWords& say, RunOf of = RunOf::us);
std::string lead_html(const FilmedScene& scene, const PageWords& say, RunOf of = RunOf::us);

// For a run that was not completed: how it ended. until: the time in s that it reached. Empty for a complete
// run.
std::string end_html(const FilmedScene& scene, const ReadRunJson& run, double until, const PageWords& say);

// The film's element and the words about it. poster: a JPEG, or empty. why_not_tied: why the film does not
// move together with charts and bed; empty when it does. about: what is seen, for readers who cannot see it.
// n: ending of the ids of elements, since a page may show several runs. beside: whether the page lies beside
// the film's file.
std::string film_html(const PageFilm& film, const std::vector<std::uint8_t>& poster,
                      const PageNote& why_not_tied, const std::string& about, const PageWords& say,
                      const std::string& n = "", bool beside = true);

// Says which of the bed's moments the page has, and how exact they are.
std::string bed_about(const PageBed& bed, const PageMeshes& meshes, const FilmedScene& scene,
                      const PageWords& say);

// The scene's captions as buttons that go to their moments, with the values of measures.csv in the run's
// folder; empty without captions.
std::string story_html(const FilmedScene& scene, const std::filesystem::path& folder, const PageWords& say);

// The chapters: the plan in words, contacts, methods and sources, provenance, scene and files. page_name:
// name of the page in the run's folder; without it there are no links to the folder's files. n: ending of the
// ids of elements.
std::string chapters_html(const FilmedScene& scene, const ReadRunJson& run,
                          const std::optional<PlannedScene>& planned, const std::filesystem::path& folder,
                          const std::string& page_name, const PageWords& say, const std::string& n = "",
                          RunOf of = RunOf::us);

}  // namespace grainreel
