#include "render/film/run/film_in_parts.hpp"

#include <xxhash.h>

#include <utility>

#include <fmt/format.h>

#include "engine/base/error.hpp"
#include "engine/scene/scene_file.hpp"
#include "render/film/codec/film_writer.hpp"
#include "render/scene/keys/words.hpp"

namespace grainreel {

namespace {

std::string option_of(const PartsWanted& wanted) {
    return wanted.number > 0 ? fmt::format("--part {}/{}", wanted.number, wanted.of)
                             : fmt::format("--parts {}", wanted.of);
}

void check(const PartsWanted& wanted, const FilmRequest& request, const FilmedScene& scene,
           std::size_t pictures) {
    const std::string option = option_of(wanted);
    const std::size_t most = pictures / least_pictures_of_part;
    if (most < static_cast<std::size_t>(wanted.of))
        throw UserError(fmt::format("{}: the film has {} picture{}, and a part needs {}; {}", option,
                                    pictures, pictures == 1 ? "" : "s", least_pictures_of_part,
                                    most > 1 ? fmt::format("{} parts at most", most) : "draw it in one go"));
    if (wanted.number > 0 && request.to_stdout)
        throw UserError(option + ": parts are joined from their folders; leave out --out -, or the part");
    if (!request.film) return;
    if (wanted.number > 0 && scene.film.format == FilmFormat::y4m)
        throw UserError(option +
                        ": films in y4m are not joined; choose another --format, or draw it in one go");
    if (scene.film.format == FilmFormat::gif)
        throw UserError(option +
                        ": a GIF is made as a whole, with the colours of all its pictures; choose another "
                        "--format, or draw it in one go");
    if (scene.film.max_size)
        throw UserError(option +
                        ": film.max_size is a cap on the whole film, which is encoded as a whole to keep it; "
                        "add --max-size none, or draw it in one go");
}

// Text and numbers, one after the other.
class Digest {
  public:
    void add(const std::string& text) { sum_ = XXH64(text.data(), text.size(), sum_ + text.size()); }
    template <class Value>
    void add(const std::vector<Value>& values) {
        sum_ = XXH64(values.data(), values.size() * sizeof(Value), sum_ + values.size());
    }
    std::string text() const { return fmt::format("{:016x}", sum_); }

  private:
    std::uint64_t sum_ = 0;
};

void add_grains(Digest& digest, const Frame& frame) {
    digest.add(frame.id);
    digest.add(frame.species);
    std::vector<double> numbers;
    for (std::size_t i = 0; i < frame.size(); ++i)
        for (const double number : {frame.position[i].x(), frame.position[i].y(), frame.position[i].z()})
            numbers.push_back(number);
    digest.add(numbers);
}

}  // namespace

FilmInParts::FilmInParts(const PartsWanted& wanted, const FilmRequest& request, const FilmedScene& scene,
                         std::vector<double> times)
    : times_(std::move(times)), wanted_(wanted), scene_(scene), film_(request.film) {
    check(wanted, request, scene, times_.size());
    parts_ = film_parts(scene.film, times_, wanted.of);
    if (is_part()) {
        here_ = parts_[static_cast<std::size_t>(wanted.number) - 1];
    } else {
        here_.pictures = static_cast<std::int64_t>(times_.size());
        here_.frames = parts_.back().first_frame + parts_.back().frames;
    }
}

std::int64_t FilmInParts::known_from() const {
    constexpr double room = 1.001;
    const FilmTrails& trails = scene_.film.shows.trails;
    std::int64_t first = here_.first_picture;
    if (!trails.wanted()) return first;
    const double from = times_[static_cast<std::size_t>(first)] - room * trails.duration;
    while (first > 0 && times_[static_cast<std::size_t>(first) - 1] >= from) --first;
    return first;
}

FilmExtent FilmInParts::extent() const {
    FilmExtent extent;
    if (!is_part()) {
        for (std::size_t k = 1; k < parts_.size(); ++k) extent.groups.push_back(parts_[k].first_frame);
        return extent;
    }
    extent.earlier.assign(times_.begin(), times_.begin() + here_.first_picture);
    const std::int64_t poster = poster_picture(scene_.film, scene_.run.duration, times_);
    extent.poster = poster >= here_.first_picture && poster < here_.first_picture + here_.pictures;
    return extent;
}

std::string FilmInParts::folder_name() const {
    const std::size_t digits = std::to_string(wanted_.of).size();
    return is_part() ? fmt::format("-part-{:0{}}", wanted_.number, digits) : "-render";
}

std::vector<std::string> FilmInParts::warnings() const {
    if (!is_part() || !film_ || scene_.film.sheet[0] == 0) return {};
    return {"film.sheet: a contact sheet shows all of a film, and is left out of its parts"};
}

DrawnPart FilmInParts::record() const {
    DrawnPart record;
    record.number = wanted_.number;
    record.of = wanted_.of;
    record.first_picture = here_.first_picture;
    record.pictures = here_.pictures;
    record.all_pictures = static_cast<std::int64_t>(times_.size());
    record.first_frame = here_.first_frame;
    record.frames = here_.frames;
    record.all_frames = parts_.back().first_frame + parts_.back().frames;
    record.rate = scene_.film.rate;
    if (film_) record.file = film_file_name(scene_.film.format);
    record.format = word_of(scene_.film.format, film_format_words);
    return record;
}

std::string checksum_of_run(const FrameArchive& frames, const std::string& scene) {
    Digest digest;
    digest.add(scene);
    for (const Frame& moment : frames.moments())
        digest.add(std::vector<double>{static_cast<double>(moment.step), moment.time});
    add_grains(digest, frames.first_whole());
    try {
        add_grains(digest, frames.grains(frames.moments().size() - 1));
    } catch (const UserError&) {
        digest.add("damaged");
    }
    return digest.text();
}

std::string checksum_of_settings(const FilmedScene& scene, const std::vector<Shot>& shots,
                                 const std::vector<std::string>& captions) {
    FilmedScene drawn = scene;
    drawn.run.threads = 0;  // of this machine
    tell_engine(drawn);
    Digest digest;
    digest.add(written_scene(drawn));
    for (const std::string& caption : captions) digest.add(caption);
    std::vector<std::int64_t> numbers;
    for (const Shot& shot : shots) {
        numbers.push_back(shot.step);
        numbers.push_back(shot.segment);
    }
    digest.add(numbers);
    return digest.text();
}

}  // namespace grainreel
