#include "render/page/shown_film.hpp"

#include <nlohmann/json.hpp>

#include "engine/base/plain_file.hpp"
#include "engine/files/run_json.hpp"
#include "render/film/codec/codec.hpp"
#include "render/film/codec/film_file.hpp"
#include "render/page/page_parts.hpp"
#include "render/scene/shown_values.hpp"

namespace grainreel {

namespace {

namespace fs = std::filesystem;

// The scene with the format of the film that lies in the folder.
FilmedScene in_format_of(FilmedScene scene, const fs::path& folder) {
    for (const auto& [word, format] : film_format_words) {
        if (format == FilmFormat::png || format == FilmFormat::y4m) continue;
        if (!is_there(folder / (std::string("movie.") + codec_of(format).extension))) continue;
        scene.film.format = format;
        break;
    }
    return scene;
}

}  // namespace

ShownFilm::ShownFilm(const FilmedScene& of, const fs::path& folder, std::size_t most_bytes,
                     const PageProgress& progress)
    : poster_(page_poster(folder)), rate_(of.film.rate) {
    const FilmedScene scene = in_format_of(of, folder);
    const std::optional<std::int64_t> frames = read_run_json(folder / "run.json").record.film_frames;
    film_ = page_film(scene, folder, frames, progress, most_bytes);
    if (film_.bytes.empty()) return;
    if (const double rate = frame_rate_of(folder / film_.file); rate > 0) rate_ = rate;
    if (auto kept = kept_film_times(folder, frames.value_or(0)))
        times_ = *kept;
    else
        times_.why_not = PageNote("Which moments the film shows is not known, so it goes by itself.");
}

std::string ShownFilm::html(const std::string& about, const PageWords& say, const std::string& n,
                            bool beside) const {
    return film_html(film_, poster_, times_.why_not, about, say, n, beside);
}

std::string ShownFilm::facts() const {
    if (film_.bytes.empty()) return "null";
    const nlohmann::json film = {{"type", film_.type}, {"rate", rate_}, {"times", times_.times}};
    return film.dump();
}

}  // namespace grainreel
