// A copy of a film, small enough for a page: H.264 in MP4, 720 lines at most. It is encoded beside the film,
// from the same pictures.
#pragma once

#include <filesystem>
#include <optional>

#include "render/film/codec/encoder.hpp"
#include "render/film/codec/ffmpeg.hpp"
#include "render/picture/base/picture.hpp"
#include "render/scene/filmed_scene.hpp"

namespace grainreel {

inline constexpr const char* kPageCopy = "movie_720.mp4";
inline constexpr std::size_t kMostFilmOnPage = 6'000'000;  // bytes

// Whether browsers play films of that format.
bool plays_in_browsers(FilmFormat format);

// Whether a film of so many pictures may need a copy: one that browsers do not play, or larger than a page
// takes.
bool may_need_copy(const Film& film, std::int64_t pictures);

// Settings for a copy of the film with that height.
EncoderSettings settings_of_copy(const FilmedScene& scene, const std::filesystem::path& path, int width,
                                 int height, int threads);

class PageCopy {
  public:
    // Creates the file under a name for work. Throws RunError.
    PageCopy(const FilmedScene& scene, const std::filesystem::path& folder, int threads);
    // Without finish(): the file goes.
    ~PageCopy();
    PageCopy(const PageCopy&) = delete;
    PageCopy& operator=(const PageCopy&) = delete;

    void add(const Picture& picture);
    // Under its own name; removed where the film beside it will do. Throws RunError.
    void finish(const std::filesystem::path& film);

  private:
    FilmFormat format_;
    std::filesystem::path file_, work_;
    ColourConversion conversion_;
    AvFramePtr full_, small_;
    ScalerPtr scaler_;
    std::optional<Encoder> encoder_;
};

}  // namespace grainreel
