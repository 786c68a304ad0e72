#include "render/film/sampling/film_frames.hpp"

#include <fmt/format.h>

#include "engine/base/error.hpp"
#include "engine/base/plain_file.hpp"
#include "render/film/sampling/sampler.hpp"

namespace grainreel {

std::vector<FilmPart> film_parts(const Film& film, const std::vector<double>& times, int parts) {
    const auto pictures = static_cast<std::int64_t>(times.size());
    GRAINREEL_CHECK(parts > 0 && pictures / least_pictures_of_part >= parts);
    std::vector<FilmPart> all(static_cast<std::size_t>(parts));
    CaptionHolds holds(film);
    std::int64_t picture = 0, frame = 0;
    for (int k = 0; k < parts; ++k) {
        FilmPart& part = all[static_cast<std::size_t>(k)];
        part.first_picture = picture;
        part.first_frame = frame;
        for (const std::int64_t end = pictures * (k + 1) / parts; picture < end; ++picture)
            frame += 1 + holds.begin_at(times[static_cast<std::size_t>(picture)]);
        part.pictures = picture - part.first_picture;
        part.frames = frame - part.first_frame;
    }
    return all;
}

std::int64_t poster_picture(const Film& film, double duration, const std::vector<double>& times) {
    const double until = poster_time(film, duration);
    std::int64_t picture = 0;
    for (std::size_t i = 1; i < times.size() && times[i] - times.front() <= until; ++i) ++picture;
    return picture;
}

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
