// A GIF, whose 256 colours are chosen when all pictures are known: until then they lie on disk as an exact
// copy, movie.work/spool.mkv, which plays when the run is killed. Under a cap it gets fewer colours.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "render/film/codec/encoder.hpp"
#include "render/film/codec/film_writer.hpp"
#include "render/film/codec/work_folder.hpp"

namespace grainreel {

struct GifColours {
    int count;
    const char *dither, *words;
};

class GifFilm final : public FilmWriter {
  public:
    // cap: bytes of the file.
    explicit GifFilm(const EncoderSettings& settings, std::optional<std::int64_t> cap = {});

    void add(const Picture& picture) override { spool_->add(picture); }
    // Throws RunError also when the cap is below what the fewest colours need, and says what would fit; the
    // film in all its colours is left then.
    void finish() override;

    std::string description() const override { return description_; }
    std::vector<std::string> notes() const override { return {}; }
    // Beside the GIF: the exact copy, which is all there is without finish().
    static const char* spool_name() { return "movie.work/spool.mkv"; }

  private:
    std::int64_t write(const GifColours& colours, const std::filesystem::path& path);
    void take(const std::filesystem::path& made);

    EncoderSettings settings_;
    std::optional<std::int64_t> cap_;
    WorkFolder work_;
    std::unique_ptr<Encoder> spool_;
    std::string description_;
};

}  // namespace grainreel
