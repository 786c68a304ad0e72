// A film that must not be larger than so many bytes. It is made at its quality, and that is all when it fits.
// If it does not, two-pass encoding brings it to the cap, as long as the words on it can be read: what the
// film needs for that is found by encoding it at the least legible quality. Encoding anew needs the pictures
// once more, and they cannot be drawn again: the trajectory does not have the film's steps. So an exact copy
// of them, in the pixels of the codec, is kept on disk until the film is complete.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "render/film/codec/encoder.hpp"
#include "render/film/codec/film_writer.hpp"
#include "render/film/codec/work_folder.hpp"

namespace grainreel {

class CappedFilm final : public FilmWriter {
  public:
    // cap: bytes of the file, its container counted. Throws RunError.
    CappedFilm(const EncoderSettings& settings, std::int64_t cap);

    void add(const Picture& picture) override;
    // The film has at most `cap` bytes then, and at least nine tenths of them unless it is smaller at its
    // quality. Throws RunError when the cap is below the size of the film at the least legible quality, and
    // says what would fit; the film at its own quality is left then.
    void finish() override;

    std::string description() const override;
    std::vector<std::string> notes() const override { return notes_; }

  private:
    void fit(std::int64_t size);
    void fill(double overhead);
    [[noreturn]] void refuse(std::int64_t size, std::int64_t floor, double overhead) const;
    void take_fitted() const;
    std::string first_pass() const;
    // Bytes of the film encoded anew: as told, at the least legible quality, at that rate (bits/s).
    std::int64_t encode(EncoderSettings settings) const;
    std::int64_t encode_legible() const;
    std::int64_t encode_at(std::int64_t bit_rate, const std::string& log) const;

    EncoderSettings settings_;
    std::int64_t cap_;
    WorkFolder work_;
    std::unique_ptr<Encoder> film_, spool_;
    std::string description_, result_;
    std::vector<std::string> notes_;
};

}  // namespace grainreel
