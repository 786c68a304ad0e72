#include "render/report/page_film.hpp"

#include <stdlib.h>

#include <fmt/format.h>

#include "engine/base/error.hpp"
#include "engine/scene/text/data_size.hpp"
#include "render/film/codec/codec.hpp"
#include "render/film/codec/encoder.hpp"
#include "render/film/codec/film_reader.hpp"
#include "render/film/codec/filter_graph.hpp"
#include "render/report/embed/read_bytes.hpp"

namespace grainreel {
namespace {

namespace fs = std::filesystem;

constexpr int lines_of_copy = 720;
constexpr int quality_of_copy = least_legible;  // its digits still read
constexpr const char* poster_filter =
    "scale=min(960\\,iw):-2:in_color_matrix=bt709:out_color_matrix=bt601:"
    "out_range=full,format=yuvj420p";

// What every browser of today plays; "" for the other formats.
std::string type_of(FilmFormat format) {
    if (format == FilmFormat::mp4) return "video/mp4";
    return format == FilmFormat::webm ? "video/webm" : "";
}

// A folder that is gone when the page is made.
class ScratchFolder {
  public:
    ScratchFolder() {
        std::string name = (fs::temp_directory_path() / "grainreel-report-XXXXXX").string();
        if (::mkdtemp(name.data()) == nullptr)
            throw RunError("report: cannot make a folder for work in " + name);
        path_ = name;
    }
    ~ScratchFolder() {
        std::error_code ignored;
        fs::remove_all(path_, ignored);
    }
    ScratchFolder(const ScratchFolder&) = delete;
    ScratchFolder& operator=(const ScratchFolder&) = delete;
    fs::path file(const char* name) const { return path_ / name; }

  private:
    fs::path path_;
};

// Even numbers, as H.264 wants them.
std::string copy_filter(int height) {
    return fmt::format(
        "scale=-2:{}:in_color_matrix=bt709:out_color_matrix=bt709:out_range=limited,format=yuv420p",
        std::min(lines_of_copy, height) / 2 * 2);
}

std::vector<std::uint8_t> smaller_copy(const Scene& scene, const fs::path& film) {
    const ScratchFolder scratch;
    FilmReader reader(film);
    FilterGraph graph(reader.codec(), copy_filter(reader.codec().height));
    EncoderSettings settings;
    settings.path = scratch.file("copy.mp4");
    settings.rate = scene.film.rate;
    settings.quality = quality_of_copy;
    std::unique_ptr<Encoder> copy;
    const auto take_pictures = [&] {
        while (const AvFramePtr picture = graph.pull()) {
            settings.width = picture->width;
            settings.height = picture->height;
            if (!copy) copy = std::make_unique<Encoder>(settings);
            copy->add(*picture);
        }
    };
    while (AVFrame* frame = reader.next()) {
        graph.push(*frame);
        take_pictures();
    }
    graph.end();
    take_pictures();
    if (!copy) throw RunError(fmt::format("{}: holds no picture", film.string()));
    copy->finish();
    return read_bytes(settings.path);
}

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
    constexpr int quality = 4;  // of 1 to 31, the best first; small digits read
    codec->global_quality = quality * FF_QP2LAMBDA;
    picture.quality = codec->global_quality;
    if (avcodec_open2(codec.get(), encoder, nullptr) < 0) return {};
    if (avcodec_send_frame(codec.get(), &picture) < 0) return {};
    if (avcodec_receive_packet(codec.get(), packet.get()) < 0) return {};
    return {packet->data, packet->data + packet->size};
}

std::string size_text(std::size_t bytes) {
    return data_size_text(static_cast<double>(bytes));
}

}  // namespace

PageFilm page_film(const Scene& scene, const fs::path& folder) {
    quiet_ffmpeg();
    PageFilm film;
    if (scene.film.format == FilmFormat::png) return film;
    const Codec& codec = codec_of(scene.film.format);
    const std::string name = std::string("movie.") + codec.extension;
    std::error_code error;
    const auto size = static_cast<std::size_t>(fs::file_size(folder / name, error));
    if (error || size == 0) return film;
    film.file = name;
    film.type = type_of(scene.film.format);
    if (!film.type.empty() && size <= kMostFilmOnPage) {
        film.bytes = read_bytes(folder / name);
        return film;
    }
    const std::string why = film.type.empty() ? fmt::format("browsers do not play {}", codec.words)
                                              : fmt::format("the film has {}", size_text(size));
    film.type = "video/mp4";
    try {
        film.bytes = smaller_copy(scene, folder / name);
    } catch (const RunError& problem) {
        film.note = fmt::format(
            "The film is not on this page, since {}, and no copy could be made ({}); it lies "
            "beside the page.",
            why, problem.what());
        return film;
    }
    film.note =
        fmt::format("This is a copy of at most {} lines, since {}; the film itself lies beside this page.",
                    lines_of_copy, why);
    if (film.bytes.size() <= kMostFilmOnPage) return film;
    film.bytes.clear();
    film.note = fmt::format(
        "The film is not on this page, since {} and even a smaller copy is too large for it; it "
        "lies beside the page.",
        why);
    return film;
}

std::vector<std::uint8_t> page_poster(const fs::path& folder) {
    quiet_ffmpeg();
    std::error_code ignored;
    if (!fs::exists(folder / "poster.png", ignored)) return {};
    try {
        FilmReader reader(folder / "poster.png");
        AVFrame* picture = reader.next();
        if (picture == nullptr) return {};
        FilterGraph graph(reader.codec(), poster_filter);
        graph.push(*picture);
        graph.end();
        const AvFramePtr small = graph.pull();
        return small ? as_jpeg(*small) : std::vector<std::uint8_t>();
    } catch (const RunError&) {
        return {};
    }
}

}  // namespace grainreel
