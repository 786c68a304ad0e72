// What the encoding thread does with drawn pictures: it puts them into the film and its copy for the page,
// into numbered PNG files, the poster and the contact sheet.
#pragma once

#include <atomic>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "engine/state/state.hpp"
#include "render/film/codec/encoder.hpp"
#include "render/film/codec/ffmpeg.hpp"
#include "render/film/codec/film_writer.hpp"
#include "render/film/codec/png.hpp"
#include "render/film/production/film_maker.hpp"
#include "render/film/production/flash_watch.hpp"
#include "render/picture/base/picture.hpp"
#include "render/picture/panels/contact_sheet.hpp"
#include "render/scene/filmed_scene.hpp"

namespace grainreel {

// A copy of a film, small enough for a page: H.264 in MP4, 720 lines at most. It is encoded beside the film,
// from the same pictures.

inline constexpr const char* kPageCopy = "movie_720.mp4";
inline constexpr std::size_t kMostFilmOnPage = 6'000'000;  // bytes

// Makes the folder of numbered pictures, or takes the one that is there. Throws RunError.
void make_frames_folder(const std::filesystem::path& run);

// Whether browsers play films of that format.
bool plays_in_browsers(FilmFormat format);

// Whether a film of so many pictures may need a copy, because browsers do not play it or it may be larger
// than a page takes.
bool may_need_copy(const Film& film, std::int64_t pictures);

// Settings of the encoder for the copy of a film. width, height: pixels of the film.
EncoderSettings settings_of_copy(const FilmedScene& scene, const std::filesystem::path& path, int width,
                                 int height, int threads);

class PageCopy {
  public:
    // Creates the file under a temporary name. Throws RunError.
    PageCopy(const FilmedScene& scene, const std::filesystem::path& folder, int threads);
    // Removes the file when finish() was not called.
    ~PageCopy();
    PageCopy(const PageCopy&) = delete;
    PageCopy& operator=(const PageCopy&) = delete;

    void add(const Picture& picture);
    // Gives the copy its final name. If browsers play the film itself and it is small enough, the copy is not
    // needed and the destructor removes it. Throws RunError.
    void finish(const std::filesystem::path& film);

  private:
    FilmFormat format_;
    std::filesystem::path file_, work_;
    ColourConversion conversion_;
    AvFramePtr full_, small_;
    ScalerPtr scaler_;
    std::optional<Encoder> encoder_;
};

struct DrawnShot {
    Picture picture;
    StatePtr frame;
    std::string playback;
};

// The texts that a PNG file holds about its picture.
std::vector<PngText> texts_of(const std::string& scene, const std::string& title, const State& frame,
                              const std::string& playback);

class PictureFiles {
  public:
    // Creates the film's file and the folder of frames. Throws RunError.
    PictureFiles(const FilmedScene& scene, const FilmOptions& options);

    // Takes the next picture and gives a picture back whose buffer may be drawn over. Throws RunError.
    Picture add(DrawnShot drawn);

    // Writes the poster if that was not done yet. Throws RunError.
    void close_poster();
    // Completes the film and the contact sheet, after close_poster(). Throws RunError.
    void finish();
    // Is called in place of finish() when the film is broken off: closes the file with what was written.
    void leave();

    std::int64_t frames() const { return count_; }  // taken so far; may be asked by another thread
    bool complete() const { return complete_; }
    std::string film_file() const { return film_file_; }  // name of the film's file; empty without one
    bool has_frames() const { return frames_wanted_; }
    bool has_poster() const { return poster_written_; }
    bool has_sheet() const { return complete_ && sheet_ != nullptr && count_ > 0; }
    std::string encoder() const { return film_ ? film_->description() : left_encoder_; }
    std::vector<std::string> notes() const;

  private:
    void open_copy(const FilmedScene& scene, const FilmOptions& options);
    // Does something with the copy. When that fails the copy is removed, and the film goes on.
    void with_copy(const std::function<void(PageCopy&)>& act);
    void consider_poster(const DrawnShot& drawn);
    void write(const std::filesystem::path& path, const DrawnShot& drawn) const;
    void write_poster(const DrawnShot& drawn);

    std::filesystem::path folder_;
    std::function<void()> check_folder_;
    std::string name_, title_;
    bool frames_wanted_, transparent_;
    double poster_time_;              // s after the first frame
    double first_time_ = 0;           // s, time of the whole film's first picture
    const bool is_first_;             // no other part of the film comes before
    const std::int64_t first_frame_;  // number in the whole film of the first frame taken here
    const std::vector<std::int64_t> groups_;
    std::size_t next_group_ = 0;
    std::atomic<std::int64_t> count_ = 0;
    bool poster_done_, poster_written_ = false, complete_ = false;
    FlashWatch flashes_;
    std::string flash_remedy_;
    // The last picture. It becomes the poster when the next picture comes after the poster's time.
    DrawnShot last_;
    std::unique_ptr<FilmWriter> film_;
    std::unique_ptr<PageCopy> copy_;
    std::string film_file_, left_file_, left_encoder_;
    std::unique_ptr<ContactSheet> sheet_;
};

}  // namespace grainreel
