// The film and the picture that stands for it, as a page can hold them.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "render/film/production/picture_files.hpp"
#include "render/page/page_progress.hpp"
#include "render/scene/filmed_scene.hpp"

namespace grainreel {

struct PageFilm {
    std::vector<std::uint8_t> bytes;  // empty where the page has none
    std::string type;                 // "video/mp4"
    std::string file;                 // in the run's folder: "movie.mp4"; empty without a film
    bool whole_in_folder = false;     // the file is the film, and plays
    std::string note;  // a sentence for the page where it shows something else than that file, or nothing
};

// The run's own film where browsers play it and it is small enough; else a copy in H.264, of 720 lines at
// most, which the run has made or which is made here; none where that is too large too, or cannot be made.
// frames: of the film, where they are known; for the progress of a copy. Writes nothing into the run's
// folder.
PageFilm page_film(const FilmedScene& scene, const std::filesystem::path& folder,
                   std::optional<std::int64_t> frames = {}, const PageProgress& progress = kNoPageProgress,
                   std::size_t most_bytes = kMostFilmOnPage);

// poster.png as a JPEG, 960 pixels wide at most. Empty without one, or where it cannot be read.
std::vector<std::uint8_t> page_poster(const std::filesystem::path& folder);

}  // namespace grainreel
