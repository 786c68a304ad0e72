// film_times.csv: which moment of the run each frame of its film shows.
#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

#include "engine/frame.hpp"

namespace grainreel {

inline constexpr const char* kFilmTimes = "film_times.csv";

class FilmTimesTable {
  public:
    // The next picture, which the film shows in so many frames.
    void add(const Frame& picture, std::int64_t frames);
    // Writes the times of the film's first `frames`. Throws RunError.
    void write(const std::filesystem::path& path, std::int64_t frames) const;

  private:
    struct Row {
        std::int64_t step = 0;
        double time = 0;  // s
    };
    std::vector<Row> rows_;  // one a frame of the film
};

}  // namespace grainreel
