// The film of a page, the picture that stands for it, and which moment of the run each of its frames shows.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "render/film/codec/ffmpeg.hpp"
#include "render/film/production/picture_files.hpp"
#include "render/page/embed.hpp"
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

struct FilmTimes {
    std::vector<double> times;  // s, one a frame; empty where they are not known
    std::string why_not;        // then: a sentence for the page
};

// As the run's own table has them (film_times.csv), where it agrees with the number of frames and its times
// rise.
std::optional<FilmTimes> kept_film_times(const std::filesystem::path& folder, std::int64_t frames);

// Without it: made from the scene as the run made it. frames: of the film, as run.json has them. first: s,
// where the run began. Known only where the number of frames agrees: a film may leave out locked frames of a
// bed that repeats itself every other period, as the run finds out. whole: the run was complete.
FilmTimes film_times(const FilmedScene& scene, std::int64_t frames, double first, bool whole);

// A JPEG, 960 pixels wide at most, of a frame that this decoder gave. Empty where none can be made. Throws
// RunError.
std::vector<std::uint8_t> small_jpeg(const AVCodecContext& decoder, AVFrame& frame);

}  // namespace grainreel
