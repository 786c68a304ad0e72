// A film that a page shows beside those of its runs: that of a comparison, which has its own folder.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "render/page/page_film.hpp"
#include "render/page/page_words.hpp"
#include "render/scene/filmed_scene.hpp"

namespace grainreel {

class ShownFilm {
  public:
    // scene: one of the scenes that are shown; it gives settings for a smaller copy. folder: has movie.*,
    // poster.png, film_times.csv and run.json. Throws PageStopped.
    ShownFilm(const FilmedScene& scene, const std::filesystem::path& folder, std::size_t most_bytes,
              const PageProgress& progress);

    // about: what is seen. n: ending of the ids of its elements.
    std::string html(const std::string& about, const PageWords& say, const std::string& n, bool beside) const;
    std::string facts() const;  // JSON; "null" without a film
    const std::vector<std::uint8_t>& bytes() const { return film_.bytes; }
    std::size_t taken() const { return (film_.bytes.size() + poster_.size()) / 3 * 4; }

  private:
    PageFilm film_;
    std::vector<std::uint8_t> poster_;
    FilmTimes times_;
    double rate_;
};

}  // namespace grainreel
