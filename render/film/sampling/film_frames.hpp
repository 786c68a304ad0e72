// How the pictures of a film become its frames. A picture with a caption is held for several frames, so that
// the caption can be read. A film can be drawn in parts, and film_times.csv says which moment each frame
// shows. The size, limits and warnings of a film are also here; they are known before the film is made.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "engine/state/state.hpp"
#include "render/film/sampling/sampler.hpp"
#include "render/scene/filmed_scene.hpp"

namespace grainreel {

// Number of frames that one caption's hold adds to the film.
inline std::int64_t held_frames(const FilmCaption& caption, double rate) {
    return std::llround(caption.hold * rate);
}
inline std::int64_t held_frames(const Film& film) {
    std::int64_t frames = 0;
    for (const FilmCaption& caption : film.captions) frames += held_frames(caption, film.rate);
    return frames;
}

// Counts the added frames picture by picture.
class CaptionHolds {
  public:
    explicit CaptionHolds(const Film& film) : captions_(film.captions), rate_(film.rate) {}

    // How many more times the picture at this simulated time (s) is shown: the first picture with a caption
    // is held, and no other. To be called by rising time.
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

// Number of frames that these pictures become, with the held ones. times: simulated times (s) from the film's
// first picture on.
inline std::int64_t frames_of(const Film& film, const std::vector<double>& times) {
    CaptionHolds holds(film);
    auto frames = static_cast<std::int64_t>(times.size());
    for (const double time : times) frames += holds.begin_at(time);
    return frames;
}

// The pictures and frames of one part, when a film is drawn in parts.
struct FilmPart {
    std::int64_t first_picture = 0, pictures = 0;  // the film's pictures: the first one and their number
    std::int64_t first_frame = 0, frames = 0;      // in the film, with those that are held for captions
};

// An encoder that codes pictures out of order needs at least this many for a group.
constexpr std::int64_t least_pictures_of_part = 4;

// Divides a film into parts that are as even as they can be; none is empty. times: simulated times (s,
// rising) of the film's pictures; there must be at least least_pictures_of_part for each part.
std::vector<FilmPart> film_parts(const Film& film, const std::vector<double>& times, int parts);

// Number of the picture that stands for the whole film. times: of all pictures, s. duration: of the run, s.
std::int64_t poster_picture(const Film& film, double duration, const std::vector<double>& times);

// The file that says which moment of the run each frame of its film shows.
inline constexpr const char* kFilmTimes = "film_times.csv";

class FilmTimesTable {
  public:
    // Adds the next picture, which the film shows in so many frames.
    void add(const State& picture, std::int64_t frames);
    // Writes the rows of the film's first `frames` frames. Throws RunError.
    void write(const std::filesystem::path& path, std::int64_t frames) const;

  private:
    struct Row {
        std::int64_t step = 0;
        double time = 0;  // s
    };
    std::vector<Row> rows_;  // one row for each frame of the film
};

// Bytes of a film of so many frames, estimated from pixels, format and quality, and no more than its cap. It
// is good to a factor of two or three.
double estimated_film_size(const Film& film, std::int64_t frames);

// Limit for the frames of a film. At 30 frames a second such a film plays for four days; its schedule takes
// 160 MB.
constexpr std::int64_t most_frames = 10'000'000;
// Limit for the earlier moments over which pictures are exposed or averaged; their lists take 2 GB at worst.
constexpr std::int64_t most_moments = 20'000'000;

// Throws UserError when the film would have more than most_frames frames or most_moments earlier moments. The
// error names the segment that makes most of them.
void check_schedule(const FilmedScene& scene, const std::vector<SegmentCount>& counts);

// Throws UserError when film.max_size leaves so few bits for a pixel that nothing could be made out.
void check_max_size(const FilmedScene& scene, std::int64_t frames);

// Throws UserError when a limit of the process (`ulimit -v`) leaves too few addresses for a film's pictures.
void check_addresses(const Film& film);

// Warnings: words that the picture has no room for, letters that no font has, and films for a journal that
// journals do not take.
std::vector<std::string> film_warnings(const FilmedScene& scene, std::int64_t frames);

}  // namespace grainreel
