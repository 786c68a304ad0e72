#include "render/film/sampling/film_frames.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <algorithm>
#include <cmath>

#include "engine/base/error.hpp"
#include "engine/base/plain_file.hpp"
#include "engine/scene/text/units.hpp"
#include "render/film/codec/codec.hpp"
#include "render/film/codec/film_writer.hpp"
#include "render/film/sampling/sampler.hpp"
#include "render/picture/gl/addresses.hpp"
#include "render/picture/words/layout.hpp"
#include "render/picture/words/missing_letters.hpp"
#include "render/scene/filmed_scene.hpp"

namespace grainreel {

std::vector<FilmPart> film_parts(const Film& film, const std::vector<double>& times, int parts) {
    const auto pictures = static_cast<std::int64_t>(times.size());
    GRAINREEL_CHECK(parts > 0 && pictures / least_pictures_of_part >= parts);
    std::vector<FilmPart> all(static_cast<std::size_t>(parts));
    CaptionHolds holds(film);
    std::int64_t picture = 0, frame = 0;
    for (int k = 0; k < parts; ++k) {
        FilmPart& part = all[k];
        part.first_picture = picture;
        part.first_frame = frame;
        for (const std::int64_t end = pictures * (k + 1) / parts; picture < end; ++picture)
            frame += 1 + holds.begin_at(times[picture]);
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

void FilmTimesTable::add(const State& picture, std::int64_t frames) {
    rows_.insert(rows_.end(), static_cast<std::size_t>(frames), {picture.step, picture.time});
}

void FilmTimesTable::write(const std::filesystem::path& path, std::int64_t frames) const {
    std::string text = "frame,step,time_s\n";
    for (std::size_t k = 0; k < rows_.size() && static_cast<std::int64_t>(k) < frames; ++k)
        text += fmt::format("{},{},{}\n", k, rows_[k].step, rows_[k].time);
    replace_file(path, text);
}

namespace {

// Nothing can be made out in a film with fewer bits for each pixel. The bound is about a third of what the
// emptiest film needs at the least legible quality. Two balls at 640x360 were measured to take 0.013. Four
// times the pixels take only 2.8 times the bytes, so a film of larger pictures takes fewer bits a pixel.
constexpr double least_bits_a_pixel = 0.002;

// Bits a pixel of the default film, a wedge of which grains fill a quarter, at quality 20. MP4 was measured
// on all its 352 frames. The ratios of the others to MP4 were measured on its 29 frames from 0 to 2.4 s, one
// a period.
double bits_a_pixel(FilmFormat format) {
    switch (format) {
        case FilmFormat::mp4:
            return 0.065;
        case FilmFormat::webm:
            return 0.086;
        case FilmFormat::av1:
            return 0.082;
        case FilmFormat::gif:
            return 0.53;
        case FilmFormat::ffv1:
            return 1.1;
        case FilmFormat::png:
            return 1.5;
        case FilmFormat::y4m:
            break;
    }
    return 12;  // exact for yuv420p
}

bool has_quality(FilmFormat format) {
    return format == FilmFormat::mp4 || format == FilmFormat::webm || format == FilmFormat::av1;
}

double pixels_of(const Film& film, std::int64_t frames) {
    return static_cast<double>(film.width) * film.height * static_cast<double>(frames);
}

// Bytes of a film by its pixels, format and quality: a quality number (crf) that is higher by 6 halves them.
double size_at(const Film& film, std::int64_t frames, int quality) {
    const double halvings = has_quality(film.format) ? (20 - quality) / 6.0 : 0;
    return bits_a_pixel(film.format) * std::exp2(halvings) * pixels_of(film, frames) / 8;
}

// Warns where small digits may be misread, and where the film may not fit under its cap because its digits
// must stay legible.
void warn_of_digits(const FilmedScene& scene, std::int64_t frames, std::vector<std::string>& warnings) {
    const Film& film = scene.film;
    if (!has_quality(film.format)) return;
    if (film.quality > least_legible && film.words != WordPlace::none)
        warnings.push_back(fmt::format("{}: above a quality of {} small digits on the frames may read wrong",
                                       scene.where("film.quality"), least_legible));
    const double needed = size_at(film, frames, std::max(film.quality, least_legible));
    if (film.max_size && needed > static_cast<double>(*film.max_size))
        warnings.push_back(
            fmt::format("{}: the film needs about {} for its digits to read right, and may not fit "
                        "under {}",
                        scene.where("film.max_size"), data_size_text(needed),
                        data_size_text(static_cast<double>(*film.max_size))));
}

std::string key_of_segment(std::size_t segment, const char* key) {
    return fmt::format("film.segment[{}].{}", segment, key);
}

[[noreturn]] void fail_frames(const FilmedScene& scene, std::size_t segment, double frames) {
    const bool any = segment < scene.film.segments.size();
    const bool locked = any && scene.film.segments[segment].kind == FilmSegment::Kind::locked;
    const std::string key = any ? key_of_segment(segment, locked ? "every" : "playback") : "run.duration";
    const std::string how =
        locked ? fmt::format("raise '{}'", key)
        : any  ? fmt::format("raise '{}', now {:.4g},", key, scene.film.segments[segment].playback)
               : std::string("lower 'film.rate'");
    throw UserError(
        "{}: the film would have {:.4g} frames, and the most are {}; {} or shorten 'run.duration'",
        scene.where(key), frames, most_frames, how);
}

[[noreturn]] void fail_moments(const FilmedScene& scene, std::size_t segment, double moments) {
    const bool averages = scene.film.segments.at(segment).average > 0;
    const std::string key = key_of_segment(segment, averages ? "average" : "exposures");
    throw UserError(
        "{}: the film's pictures would be made of {:.4g} earlier moments, and the most are {}; "
        "lower '{}' or make the film shorter",
        scene.where(key), moments, most_moments, key);
}

}  // namespace

double estimated_film_size(const Film& film, std::int64_t frames) {
    const double bytes = size_at(film, frames, film.quality);
    return film.max_size ? std::min(bytes, static_cast<double>(*film.max_size)) : bytes;
}

void check_schedule(const FilmedScene& scene, const std::vector<SegmentCount>& counts) {
    double shots = 0, moments = 0;  // doubles, since the sums may be very large
    std::size_t longest = 0, most = 0;
    const auto moments_of = [&](std::size_t i) {
        return static_cast<double>(counts[i].shots) * static_cast<double>(counts[i].moments_a_shot);
    };
    for (std::size_t i = 0; i < counts.size(); ++i) {
        shots += static_cast<double>(counts[i].shots);
        moments += moments_of(i);
        if (counts[i].shots > counts[longest].shots) longest = i;
        if (moments_of(i) > moments_of(most)) most = i;
    }
    if (shots > static_cast<double>(most_frames)) fail_frames(scene, longest, shots);
    if (moments > static_cast<double>(most_moments)) fail_moments(scene, most, moments);
}

void check_max_size(const FilmedScene& scene, std::int64_t frames) {
    const Film& film = scene.film;
    if (!film.max_size || frames == 0) return;
    const double pixels = pixels_of(film, frames), cap = static_cast<double>(*film.max_size);
    if (8 * cap >= least_bits_a_pixel * pixels) return;
    const double needed = size_at(film, frames, least_legible);
    throw UserError(
        "{}: {} for {} frames of {}x{} are {:.1g} bits a pixel, too few for digits to be read; a bed "
        "of grains needs about {}. What fits: {}; or raise it",
        scene.where("film.max_size"), data_size_text(cap), frames, film.width, film.height, 8 * cap / pixels,
        data_size_text(needed), smaller_film(film.width, film.height, frames, cap / needed));
}

void check_addresses(const Film& film) {
    constexpr double bytes_a_pixel = 64;  // 42 were measured between 160x90 and 1920x1080
    const double needed = static_cast<double>(kAddressesOfFilm) + bytes_a_pixel * pixels_of(film, 1);
    if (has_addresses(static_cast<std::size_t>(needed))) return;
    throw UserError(
        "the film needs {} of address space, and a limit (ulimit -v) leaves less; raise the limit, or "
        "leave out the film with --no-film",
        data_size_text(needed));
}

std::vector<std::string> film_warnings(const FilmedScene& scene, std::int64_t frames) {
    const Film& film = scene.film;
    std::vector<std::string> warnings;
    if (const std::vector<std::string> names = plan_layout(scene).left_out; !names.empty())
        warnings.push_back(fmt::format("{}: {}x{} has no room for {}, left out; make it wider or show less",
                                       scene.where("film.size"), film.width, film.height,
                                       fmt::join(names, ", ")));
    if (std::string line = missing_letters_warning(texts_of_film(scene)); !line.empty())
        warnings.push_back(std::move(line));
    warn_of_digits(scene, frames, warnings);
    if (film.purpose != "journal") return warnings;
    constexpr int most_lines = 720, least_rate = 15, most_seconds = 300;
    if (film.height > most_lines)
        warnings.push_back(fmt::format("{}: Elsevier takes films of {} lines at most, this one has {}",
                                       scene.where("film.size"), most_lines, film.height));
    if (film.rate < least_rate)
        warnings.push_back(
            fmt::format("{}: Elsevier takes films of {} frames/s at least, this one has {:.4g}",
                        scene.where("film.rate"), least_rate, film.rate));
    const double seconds = static_cast<double>(frames) / film.rate;
    if (seconds > most_seconds)
        warnings.push_back(
            fmt::format("{}: the film plays for {:.0f} s; Elsevier and Wiley take {} s at most",
                        scene.where("film.segment"), seconds, most_seconds));
    return warnings;
}

}  // namespace grainreel
