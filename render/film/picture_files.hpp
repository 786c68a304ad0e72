// What the encoding thread does with a drawn picture: the film, numbered PNG files, the poster.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "engine/frame.hpp"
#include "engine/scene/scene.hpp"
#include "render/draw/picture.hpp"
#include "render/film/encoder.hpp"
#include "render/film/film_maker.hpp"
#include "render/film/png.hpp"

namespace grainreel {

struct DrawnFrame {
    Picture picture;
    FramePtr frame;
    std::string playback;
};

// What a PNG file says of the picture in it.
std::vector<PngText> texts_of(const std::string& scene, const std::string& title, const Frame& frame,
                              const std::string& playback);

class PictureFiles {
  public:
    // Creates movie.mp4 and the folder of frames. Throws RunError.
    PictureFiles(const Scene& scene, const FilmOptions& options);

    // Takes the next picture and gives a picture back whose buffer may be drawn over. Throws RunError.
    Picture add(DrawnFrame drawn);

    // The poster, if it is still to come. Throws RunError.
    void close_poster();
    // Closes the film for streaming, after close_poster(). Throws RunError.
    void finish();

    std::string encoder() const { return encoder_ ? encoder_->description() : ""; }
    std::vector<std::string> notes() const {
        return encoder_ ? encoder_->notes() : std::vector<std::string>{};
    }

  private:
    void consider_poster(const DrawnFrame& drawn);
    void write(const std::filesystem::path& path, const DrawnFrame& drawn) const;

    std::filesystem::path folder_;
    std::string name_, title_;
    bool frames_wanted_;
    double poster_time_;  // s after the first frame
    double first_time_ = 0;
    std::int64_t count_ = 0;
    bool poster_done_;
    DrawnFrame last_;  // kept because it is the poster when the next one comes too late
    std::unique_ptr<Encoder> encoder_;
};

}  // namespace grainreel
