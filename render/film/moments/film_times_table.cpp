#include "render/film/moments/film_times_table.hpp"

#include <string>

#include <fmt/format.h>

#include "engine/base/plain_file.hpp"

namespace grainreel {

void FilmTimesTable::add(const Frame& picture, std::int64_t frames) {
    rows_.insert(rows_.end(), static_cast<std::size_t>(frames), {picture.step, picture.time});
}

void FilmTimesTable::write(const std::filesystem::path& path, std::int64_t frames) const {
    std::string text = "frame,step,time_s\n";
    for (std::size_t k = 0; k < rows_.size() && static_cast<std::int64_t>(k) < frames; ++k)
        text += fmt::format("{},{},{}\n", k, rows_[k].step, rows_[k].time);
    replace_file(path, text);
}

}  // namespace grainreel
