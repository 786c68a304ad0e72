#include "render/film/files/page_copy.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "engine/base/error.hpp"
#include "render/film/sampling/film_limits.hpp"
#include "render/scene/filmed_scene.hpp"

namespace grainreel {
namespace {

namespace fs = std::filesystem;

constexpr int lines_of_copy = 720;
constexpr double estimate_is_good_to = 2;  // a factor

AvFramePtr frame_of(int width, int height) {
    AvFramePtr frame(av_frame_alloc());
    if (!frame) throw RunError("film: no memory for a frame");
    frame->format = AV_PIX_FMT_YUV420P;
    frame->width = width;
    frame->height = height;
    frame->color_primaries = AVCOL_PRI_BT709;
    frame->color_trc = AVCOL_TRC_BT709;
    frame->colorspace = AVCOL_SPC_BT709;
    frame->color_range = AVCOL_RANGE_MPEG;
    frame->chroma_location = AVCHROMA_LOC_LEFT;
    if (av_frame_get_buffer(frame.get(), 0) < 0) throw RunError("film: no memory for a frame");
    return frame;
}

int even(double length) {
    return std::max(2, static_cast<int>(length / 2 + 0.5) * 2);
}

}  // namespace

bool plays_in_browsers(FilmFormat format) {
    return format == FilmFormat::mp4 || format == FilmFormat::webm;
}

bool may_need_copy(const Film& film, std::int64_t pictures) {
    if (film.format == FilmFormat::png) return false;
    return !plays_in_browsers(film.format) ||
           estimate_is_good_to * estimated_film_size(film, pictures) > static_cast<double>(kMostFilmOnPage);
}

EncoderSettings settings_of_copy(const FilmedScene& scene, const fs::path& path, int width, int height,
                                 int threads) {
    EncoderSettings settings;
    settings.path = path;
    settings.height = even(std::min(lines_of_copy, height) - 0.5);
    settings.width = even(static_cast<double>(width) * settings.height / height);
    settings.rate = scene.film.rate;
    settings.quality = least_legible;  // its digits still read
    settings.threads = threads;
    settings.title = scene.film.title;
    return settings;
}

PageCopy::PageCopy(const FilmedScene& scene, const fs::path& folder, int threads)
    : format_(scene.film.format),
      file_(folder / kPageCopy),
      work_(folder / fmt::format("{}.part", kPageCopy)),
      conversion_(scene.film.width, scene.film.height) {
    const EncoderSettings settings =
        settings_of_copy(scene, work_, scene.film.width, scene.film.height, threads);
    full_ = frame_of(conversion_.coded_width(), conversion_.coded_height());
    small_ = frame_of(settings.width, settings.height);
    scaler_.reset(sws_getContext(full_->width, full_->height, AV_PIX_FMT_YUV420P, small_->width,
                                 small_->height, AV_PIX_FMT_YUV420P, SWS_BICUBIC, nullptr, nullptr, nullptr));
    if (!scaler_) throw RunError("film: this libswscale does not scale YUV420P");
    encoder_.emplace(settings);
}

PageCopy::~PageCopy() {
    if (!encoder_) return;
    encoder_.reset();
    std::error_code ignored;
    fs::remove(work_, ignored);
}

void PageCopy::add(const Picture& picture) {
    conversion_.convert(picture, *full_);
    if (av_frame_make_writable(small_.get()) < 0) throw RunError("film: no memory for a frame");
    sws_scale(scaler_.get(), full_->data, full_->linesize, 0, full_->height, small_->data, small_->linesize);
    encoder_->add(*small_);
}

void PageCopy::finish(const fs::path& film) {
    std::error_code error;
    const std::uintmax_t size = fs::file_size(film, error);
    if (!error && plays_in_browsers(format_) && size <= kMostFilmOnPage) return;
    if (encoder_->frames() == 0) return;
    encoder_->finish();
    encoder_.reset();
    fs::rename(work_, file_, error);
    if (error) throw RunError(fmt::format("{}: cannot be renamed: {}", work_.string(), error.message()));
}

}  // namespace grainreel
