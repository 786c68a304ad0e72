// From the pictures of a film to its frames: frames that are held so that a caption can be read, which frames
// a part of the film has, and film_times.csv, which says what moment each frame shows.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <vector>

#include "engine/frame.hpp"
#include "render/scene/filmed_scene.hpp"

namespace grainreel {

// Frames that one caption's hold adds to the film.
inline std::int64_t held_frames(const FilmCaption& caption, double rate) {
    return std::llround(caption.hold * rate);
}
inline std::int64_t held_frames(const Film& film) {
    std::int64_t frames = 0;
    for (const FilmCaption& caption : film.captions) frames += held_frames(caption, film.rate);
    return frames;
}

// Counts what is added picture by picture.
class CaptionHolds {
  public:
    explicit CaptionHolds(const Film& film) : captions_(film.captions), rate_(film.rate) {}

    // How often the picture at this simulated time (s; they come by rising time) is shown again: it is the
    // first with its caption, or it is not.
    std::int64_t begin_at(double time) {
        for (; next_ < captions_.size() && time >= captions_[next_].from - rounding; ++next_)
            if (shows_caption(captions_[next_], time)) return held_frames(captions_[next_++], rate_);
        return 0;
    }

  private:
    static constexpr double rounding = 1e-9;  // s
    std::vector<FilmCaption> captions_;
    double rate_;
    std::size_t next_ = 0;
};

// Frames that these pictures are, with those that are held. times: s, simulated, from the film's first
// picture on.
inline std::int64_t frames_of(const Film& film, const std::vector<double>& times) {
    CaptionHolds holds(film);
    auto frames = static_cast<std::int64_t>(times.size());
    for (const double time : times) frames += holds.begin_at(time);
    return frames;
}

// What one part of a film has that is drawn in parts.
struct FilmPart {
    std::int64_t first_picture = 0, pictures = 0;  // of the film's
    std::int64_t first_frame = 0, frames = 0;      // of the film's, with those that are held for captions
};

// Fewer pictures than these are no group of an encoder that codes them out of order.
constexpr std::int64_t least_pictures_of_part = 4;

// As even as they can be, and none of them empty. times: s, simulated, of the film's pictures; rising, and at
// least least_pictures_of_part times as many as parts.
std::vector<FilmPart> film_parts(const Film& film, const std::vector<double>& times, int parts);

// The picture that stands for the whole film, of those at these times. duration: s, of the run.
std::int64_t poster_picture(const Film& film, double duration, const std::vector<double>& times);

// The file that says which moment of the run each frame of its film shows.
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
