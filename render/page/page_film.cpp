#include "render/page/page_film.hpp"

#include <fmt/format.h>
#include <stdlib.h>
#include <algorithm>
#include <cmath>

#include "engine/base/error.hpp"
#include "engine/base/system/own_folder.hpp"
#include "engine/base/team.hpp"
#include "engine/files/measures_csv.hpp"
#include "engine/plan/plan.hpp"
#include "engine/scene/text/units.hpp"
#include "render/film/codec/codec.hpp"
#include "render/film/codec/encoder.hpp"
#include "render/film/codec/ffmpeg.hpp"
#include "render/film/codec/film_file.hpp"

#include "engine/base/plain_file.hpp"
#include "render/film/sampling/film_frames.hpp"
#include "render/film/sampling/timeline.hpp"
#include "render/page/embed.hpp"
#include "render/scene/filmed_scene.hpp"

namespace grainreel {

namespace {

namespace fs = std::filesystem;

constexpr int most_threads_of_copy = 8;

// The MIME type; "" for a format that not every browser of today plays.
std::string type_of(FilmFormat format) {
    if (!plays_in_browsers(format)) return "";
    return format == FilmFormat::mp4 ? "video/mp4" : "video/webm";
}

std::string copy_filter(const EncoderSettings& copy) {
    return fmt::format(
        "scale={}:{}:in_color_matrix=bt709:out_color_matrix=bt709:out_range=limited,format=yuv420p",
        copy.width, copy.height);
}

std::vector<std::uint8_t> smaller_copy(const FilmedScene& scene, const fs::path& film,
                                       const std::function<void()>& picture_taken) {
    const ScratchFolder scratch("report");
    const int threads = std::clamp(usable_processors(), 1, most_threads_of_copy);
    FilmReader reader(film, threads);
    const EncoderSettings settings = settings_of_copy(scene, scratch.path() / "copy.mp4",
                                                      reader.codec().width, reader.codec().height, threads);
    FilterGraph graph(reader.codec(), copy_filter(settings));
    std::unique_ptr<Encoder> copy;
    const auto take_pictures = [&] {
        while (const AvFramePtr picture = graph.pull()) {
            if (!copy) copy = std::make_unique<Encoder>(settings);
            copy->add(*picture);
        }
    };
    while (AVFrame* frame = reader.next()) {
        graph.push(*frame);
        take_pictures();
        picture_taken();
    }
    graph.end();
    take_pictures();
    if (!copy) throw RunError("{}: holds no picture", film.string());
    copy->finish();
    return read_bytes(settings.path);
}

// Why the file is not the film that the run wrote; "" when it is. frames: number that was written, if known.
std::string damage_of(const fs::path& film, std::optional<std::int64_t> frames) {
    try {
        const std::int64_t whole = pictures_in(film);
        if (whole == 0) return "it holds no picture";
        if (frames && whole < *frames)
            return fmt::format("{} of the {} pictures that the run wrote are in it", whole, *frames);
        return "";
    } catch (const RunError& problem) {
        return problem.what();
    }
}

std::string size_text(std::size_t bytes) {
    return data_size_text(static_cast<double>(bytes));
}

}  // namespace

PageFilm page_film(const FilmedScene& scene, const fs::path& folder, std::optional<std::int64_t> frames,
                   const PageProgress& progress, std::size_t most_bytes) {
    PageFilm film;
    if (scene.film.format == FilmFormat::png) return film;
    const Codec& codec = codec_of(scene.film.format);
    const std::string name = std::string("movie.") + codec.extension;
    std::error_code error;
    const auto size = static_cast<std::size_t>(fs::file_size(folder / name, error));
    if (error || size == 0) {
        if (frames.value_or(0) > 0)
            film.note = {"The film is not on this page, since {1} is not in the run's folder.", {name}};
        return film;
    }
    quiet_ffmpeg();
    film.file = name;
    if (const std::string damage = damage_of(folder / name, frames); !damage.empty()) {
        film.note = {"The film is not on this page, since {1} is damaged ({2}).", {name, damage}};
        return film;
    }
    film.whole_in_folder = true;
    film.type = type_of(scene.film.format);
    if (!film.type.empty() && size <= most_bytes) {
        film.bytes = read_bytes(folder / name);
        return film;
    }
    const PageNote why = film.type.empty() ? PageNote("browsers do not play {1}", {std::string(codec.words)})
                                           : PageNote("the film has {1}", {size_text(size)});
    film.type = "video/mp4";
    film.note = {
        "This is a copy of at most 720 lines, since {1}; the film itself is {2} in the run's folder.",
        {why, name}};
    const auto planned = static_cast<double>(std::max<std::int64_t>(1, frames.value_or(1)));
    std::int64_t copied = 0;
    const auto picture_taken = [&] {
        go_on_or_stop(progress, std::min(1.0, static_cast<double>(++copied) / planned));
    };
    const std::uintmax_t kept = fs::file_size(folder / kPageCopy, error);
    try {
        // If the run's copy is too large, a new one would be as large, so none is made.
        if (error || kept == 0)
            film.bytes = smaller_copy(scene, folder / name, picture_taken);
        else if (kept <= most_bytes)
            film.bytes = read_bytes(folder / kPageCopy);
    } catch (const RunError& problem) {
        film.note = {
            "The film is not on this page, since {1}, and no copy could be made ({2}); it is {3} in the "
            "run's "
            "folder.",
            {why, std::string(problem.what()), name}};
        return film;
    }
    if (!film.bytes.empty() && film.bytes.size() <= most_bytes) return film;
    film.bytes.clear();
    film.note = {
        "The film is not on this page, since {1} and even a smaller copy is too large for it; it is {2} in "
        "the "
        "run's folder.",
        {why, name}};
    return film;
}

std::vector<std::uint8_t> page_poster(const fs::path& folder) {
    if (!is_there(folder / "poster.png")) return {};
    quiet_ffmpeg();
    try {
        FilmReader reader(folder / "poster.png");
        AVFrame* picture = reader.next();
        if (picture == nullptr) return {};
        return small_jpeg(reader.codec(), *picture);
    } catch (const RunError&) {
        return {};
    }
}

namespace {

// The times of the film's frames as planned, including frames that are repeated while a caption is held.
std::vector<double> planned_times(const FilmedScene& scene, double first) {
    const Plan plan = plan_with_film(scene);
    std::vector<double> times;
    CaptionHolds holds(scene.film);
    for (const Instant& instant : instants_of(scene, plan.clock, plan.steps)) {
        if (instant.time < first - 0.5 * plan.clock.step) continue;
        times.insert(times.end(), 1 + static_cast<std::size_t>(holds.begin_at(instant.time)), instant.time);
    }
    return times;
}

// Whether the run may have left out locked frames, because its bed repeats itself only every few periods.
bool may_lack_frames(const FilmedScene& scene) {
    return scene.drive.present && scene.film.periods == 0 &&
           std::any_of(scene.film.segments.begin(), scene.film.segments.end(),
                       [](const FilmSegment& segment) { return segment.kind == FilmSegment::Kind::locked; });
}

}  // namespace

std::optional<FilmTimes> kept_film_times(const std::filesystem::path& folder, std::int64_t frames) {
    const auto table = read_measures(folder / kFilmTimes);
    if (!table || frames <= 0 || static_cast<std::int64_t>(table->rows()) != frames) return std::nullopt;
    FilmTimes result;
    result.times = table->all("time_s");
    if (result.times.empty()) return std::nullopt;
    const bool finite = std::all_of(result.times.begin(), result.times.end(),
                                    [](double time) { return std::isfinite(time); });
    if (!finite || !std::is_sorted(result.times.begin(), result.times.end())) return std::nullopt;
    return result;
}

FilmTimes film_times(const FilmedScene& scene, std::int64_t frames, double first, bool whole) {
    FilmTimes result;
    try {
        result.times = planned_times(scene, first);
    } catch (const UserError&) {
        result.why_not = PageNote(
            "This version of the program would not run the scene, so it cannot tell which moments the "
            "film shows.");
        return result;
    }
    const auto planned = static_cast<std::int64_t>(result.times.size());
    if (frames == planned) return result;
    if (!whole && !may_lack_frames(scene) && frames < planned) {
        result.times.resize(static_cast<std::size_t>(std::max<std::int64_t>(0, frames)));
        return result;
    }
    result.times.clear();
    result.why_not = PageNote(
        "The film leaves out moments, and the run does not say which, so the film goes by itself. With "
        "film.periods in the scene it would be tied to charts and bed.");
    return result;
}

namespace {

constexpr const char* filter =
    "scale=min(960\\,iw):-2:in_color_matrix=bt709:out_color_matrix=bt601:"
    "out_range=full,format=yuvj420p";

std::vector<std::uint8_t> as_jpeg(AVFrame& picture) {
    const AVCodec* encoder = avcodec_find_encoder(AV_CODEC_ID_MJPEG);
    const CodecPtr codec(encoder ? avcodec_alloc_context3(encoder) : nullptr);
    const PacketPtr packet(av_packet_alloc());
    if (!codec || !packet) return {};
    codec->width = picture.width;
    codec->height = picture.height;
    codec->pix_fmt = AV_PIX_FMT_YUVJ420P;
    codec->time_base = {1, 1};
    codec->flags |= AV_CODEC_FLAG_QSCALE;
    constexpr int quality = 4;  // from 1 (best) to 31; small digits can be read
    codec->global_quality = quality * FF_QP2LAMBDA;
    picture.quality = codec->global_quality;
    if (avcodec_open2(codec.get(), encoder, nullptr) < 0) return {};
    if (avcodec_send_frame(codec.get(), &picture) < 0) return {};
    if (avcodec_receive_packet(codec.get(), packet.get()) < 0) return {};
    return {packet->data, packet->data + packet->size};
}

}  // namespace

std::vector<std::uint8_t> small_jpeg(const AVCodecContext& decoder, AVFrame& frame) {
    FilterGraph graph(decoder, filter);
    graph.push(frame);
    graph.end();
    const AvFramePtr small = graph.pull();
    return small ? as_jpeg(*small) : std::vector<std::uint8_t>();
}

}  // namespace grainreel
