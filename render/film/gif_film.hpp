// A GIF, whose 256 colours are chosen when all pictures are known: until then they lie on disk as an exact
// copy, movie.work/spool.mkv, which plays when the run is killed.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "render/film/encoder.hpp"
#include "render/film/film_writer.hpp"
#include "render/film/work_folder.hpp"

namespace grainreel {

class GifFilm final : public FilmWriter {
  public:
    explicit GifFilm(const EncoderSettings& settings);

    void add(const Picture& picture) override { spool_->add(picture); }
    void finish() override;

    std::string description() const override { return description_; }
    std::vector<std::string> notes() const override { return {}; }

  private:
    EncoderSettings settings_;
    WorkFolder work_;
    std::unique_ptr<Encoder> spool_;
    std::string description_;
};

}  // namespace grainreel
