// A film that must not be larger than so many bytes. It is made at its quality, and that is all when it fits.
// If it does not, two-pass encoding brings it to the cap. The second pass needs the pictures once more, and
// they cannot be drawn again: the trajectory does not have the film's steps. So an exact copy of them, in the
// pixels of the codec, is kept on disk until the film is complete.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "render/film/encoder.hpp"
#include "render/film/film_writer.hpp"
#include "render/film/work_folder.hpp"

namespace grainreel {

class CappedFilm final : public FilmWriter {
  public:
    // cap: bytes of the file, its container counted. Throws RunError.
    CappedFilm(const EncoderSettings& settings, std::int64_t cap);

    void add(const Picture& picture) override;
    // The film has at most `cap` bytes then, and at least nine tenths of them unless it is smaller at its
    // quality. Throws RunError when the cap is too small for a film that anybody would like to see; the film
    // at its quality is left then.
    void finish() override;

    std::string description() const override;
    std::vector<std::string> notes() const override { return notes_; }

  private:
    void fit(std::int64_t size);
    std::string first_pass() const;
    std::int64_t encode(std::int64_t bit_rate, const std::string& log) const;

    EncoderSettings settings_;
    std::int64_t cap_;
    WorkFolder work_;
    std::unique_ptr<Encoder> film_, spool_;
    std::string description_, result_;
    std::vector<std::string> notes_;
};

}  // namespace grainreel
