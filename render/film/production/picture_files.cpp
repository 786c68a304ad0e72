#include "render/film/production/picture_files.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <bit>
#include <utility>

#include "engine/base/error.hpp"
#include "engine/base/plain_file.hpp"
#include "render/film/sampling/film_frames.hpp"
#include "render/film/sampling/sampler.hpp"
#include "render/scene/filmed_scene.hpp"

namespace grainreel {

namespace {

// Whether a poster is written while the film is still being made, so that a killed run has one: at the first
// frame, and from 32 frames on each time their number has doubled.
bool poster_in_passing(std::int64_t count) {
    return count == 1 || (count >= 32 && std::has_single_bit(static_cast<std::uint64_t>(count)));
}

std::string flash_remedy(const Film& film) {
    const std::vector<FilmSegment> segments = segments_of(film);
    const auto locked = [](const FilmSegment& segment) { return segment.kind == FilmSegment::Kind::locked; };
    if (std::none_of(segments.begin(), segments.end(), locked))
        return "slow it down (film.segment playback) or lock it to a phase";
    if (std::all_of(segments.begin(), segments.end(), locked))
        return "give the species colours nearer in brightness (species.colour), or show 6 frames a second or "
               "fewer "
               "(film.rate)";
    return "slow it down (film.segment playback), and give the species colours nearer in brightness "
           "(species.colour)";
}

}  // namespace

std::vector<PngText> texts_of(const std::string& scene, const std::string& title, const State& frame,
                              const std::string& playback) {
    return {{"Title", title},
            {"Scene", scene},
            {"Time", fmt::format("{:.9g} s", frame.time)},
            {"Drive phase", fmt::format("{:.9g}", frame.phase)},
            {"Step", std::to_string(frame.step)},
            {"Playback", playback},
            {"Software", "grainreel"}};
}

void make_frames_folder(const std::filesystem::path& run) {
    const std::filesystem::path frames = run / "frames";
    if (const std::error_code error = make_plain_folder(frames))
        throw RunError("{}: cannot make the folder: {}", frames.string(), error.message());
}

PictureFiles::PictureFiles(const FilmedScene& scene, const FilmOptions& options)
    : folder_(options.folder),
      check_folder_(options.check_folder),
      name_(scene.name),
      title_(scene.film.title),
      frames_wanted_(options.frames || (options.film && scene.film.format == FilmFormat::png)),
      transparent_(scene.film.transparent),
      poster_time_(poster_time(scene.film, scene.run.duration)),
      is_first_(options.extent.earlier.empty()),
      first_frame_(frames_of(scene.film, options.extent.earlier)),
      groups_(options.extent.groups),
      poster_done_(!options.film || !options.extent.poster),
      flashes_(scene.film.rate),
      flash_remedy_(flash_remedy(scene.film)) {
    if (!is_first_) first_time_ = options.extent.earlier.front();
    if (frames_wanted_) make_frames_folder(folder_);
    if (!options.film) return;
    film_ = make_film_writer(scene, {folder_, options.to_stdout, options.encoder_threads});
    if (!options.to_stdout) {
        film_file_ = film_file_name(scene.film.format);
        left_file_ = left_film_name(scene.film.format);
        open_copy(scene, options);
    }
    if (scene.film.sheet[0] > 0) sheet_ = std::make_unique<ContactSheet>(scene.film);
}

// Opens the page's copy. What an earlier film left is removed in any case.
void PictureFiles::open_copy(const FilmedScene& scene, const FilmOptions& options) {
    std::error_code ignored;
    std::filesystem::remove(folder_ / kPageCopy, ignored);
    if (!options.page_copy || !may_need_copy(scene.film, options.pictures)) return;
    try {
        copy_ = std::make_unique<PageCopy>(scene, folder_, options.encoder_threads);
    } catch (const RunError&) {
        // The page then makes the copy itself, or says that it could not.
    }
}

void PictureFiles::with_copy(const std::function<void(PageCopy&)>& act) {
    if (!copy_) return;
    try {
        act(*copy_);
    } catch (const RunError&) {
        copy_.reset();
    }
}

Picture PictureFiles::add(DrawnShot drawn) {
    if (count_ == 0 && is_first_) first_time_ = drawn.frame->time;
    if (frames_wanted_) write(folder_ / "frames" / fmt::format("{:06}.png", first_frame_ + frames()), drawn);
    if (film_ && next_group_ < groups_.size() && groups_[next_group_] == frames()) {
        film_->begin_group();
        ++next_group_;
    }
    if (film_) film_->add(drawn.picture);
    with_copy([&](PageCopy& copy) { copy.add(drawn.picture); });
    ++count_;
    flashes_.add(drawn.picture);
    if (sheet_) sheet_->add(drawn.picture, drawn.frame->time);
    if (!poster_done_) consider_poster(drawn);
    std::swap(last_, drawn);
    return std::move(drawn.picture);
}

void PictureFiles::consider_poster(const DrawnShot& drawn) {
    if (last_.frame && drawn.frame->time - first_time_ > poster_time_) {
        close_poster();
    } else if (poster_in_passing(count_)) {
        write_poster(drawn);
    }
}

std::vector<std::string> PictureFiles::notes() const {
    std::vector<std::string> notes = film_ ? film_->notes() : std::vector<std::string>{};
    if (film_ && flashes_.too_much_at())
        notes.push_back(
            fmt::format("the film flashes more than three times a second, first at {:.3g} s of it, which can "
                        "set off seizures; {}",
                        *flashes_.too_much_at(), flash_remedy_));
    return notes;
}

void PictureFiles::close_poster() {
    if (poster_done_ || !last_.frame) return;
    poster_done_ = true;
    write_poster(last_);
}

void PictureFiles::write_poster(const DrawnShot& drawn) {
    write(folder_ / "poster.png", drawn);
    poster_written_ = true;
}

void PictureFiles::finish() {
    check_folder_();
    if (sheet_ && count_ > 0)
        write_png(folder_ / "sheet.png", sheet_->draw(last_.picture),
                  {{"Title", title_}, {"Scene", name_}, {"Software", "grainreel"}});
    if (film_) film_->finish();
    with_copy([&](PageCopy& copy) { copy.finish(folder_ / film_file_); });
    complete_ = true;
}

void PictureFiles::leave() {
    film_file_ = left_file_;
    left_encoder_ = encoder();
    film_.reset();
    copy_.reset();
}

void PictureFiles::write(const std::filesystem::path& path, const DrawnShot& drawn) const {
    check_folder_();
    write_png(path, drawn.picture, texts_of(name_, title_, *drawn.frame, drawn.playback), transparent_);
}

namespace {

namespace fs = std::filesystem;

constexpr int lines_of_copy = 720;
constexpr double estimate_is_good_to = 2;  // a film may become larger than estimated by this factor

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
    settings.quality = least_legible;  // digits can still be read
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
    if (error) throw RunError("{}: cannot be renamed: {}", work_.string(), error.message());
}

}  // namespace grainreel
