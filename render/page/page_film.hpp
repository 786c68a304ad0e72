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
#include "render/page/page_words.hpp"
#include "render/scene/filmed_scene.hpp"

namespace grainreel {

struct PageFilm {
    std::vector<std::uint8_t> bytes;  // empty where the page has none
    std::string type;                 // "video/mp4"
    std::string file;                 // name in the run's folder: "movie.mp4"; empty without a film
    bool whole_in_folder = false;     // whether the file is the whole film and plays
    PageNote note;                    // for the page, if it shows something other than that file, or no film
};

// The run's own film when browsers play it and it is small enough. Otherwise a copy in H.264 of 720 lines at
// most, which the run has made or which is made here. None when the copy is too large too or cannot be made.
// frames: number of the film's frames, if known, for the progress of a copy. Writes nothing into the run's
// folder.
PageFilm page_film(const FilmedScene& scene, const std::filesystem::path& folder,
                   std::optional<std::int64_t> frames = {}, const PageProgress& progress = kNoPageProgress,
                   std::size_t most_bytes = kMostFilmOnPage);

// poster.png as a JPEG of at most 960 pixels width. Empty when there is none or it cannot be read.
std::vector<std::uint8_t> page_poster(const std::filesystem::path& folder);

struct FilmTimes {
    std::vector<double> times;  // s, one for each frame; empty when they are not known
    PageNote why_not;           // for the page, when they are not known
};

// The times in the run's own table (film_times.csv), if its number of frames is right and its times never go
// back.
std::optional<FilmTimes> kept_film_times(const std::filesystem::path& folder, std::int64_t frames);

// The times without that table, computed from the scene as the run did. They are known if the number of
// frames agrees, or if an incomplete run made fewer and cannot have left out any in between. A run leaves out
// frames of locked segments (one picture a period of the drive) when it finds that the bed repeats itself
// only every few periods. frames: number of the film's frames in run.json. first: time in s at which the run
// began. whole: whether the run was complete.
FilmTimes film_times(const FilmedScene& scene, std::int64_t frames, double first, bool whole);

// A JPEG, at most 960 pixels wide, of a frame from this decoder. Empty when none can be made. Throws RunError
// when the frame cannot be scaled.
std::vector<std::uint8_t> small_jpeg(const AVCodecContext& decoder, AVFrame& frame);

}  // namespace grainreel
