// Films that are made once all pictures are there, from an exact copy of the pictures on disk: films with a
// cap on their bytes, and GIFs.
//
// A film with a cap is first made at its quality. If it fits, nothing more is done. If it does not, two-pass
// encoding brings it to the cap, as long as the words on it can be read. How many bytes this needs is found
// by encoding the film at the least legible quality. Encoding anew needs the pictures once more, and they
// cannot be drawn again, since the trajectory lacks the film's steps. So an exact copy of them (the "spool"),
// in the pixels of the codec, is kept on disk until the film is complete.
#pragma once

#include <sys/stat.h>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "engine/base/error.hpp"
#include "engine/base/plain_file.hpp"
#include "render/film/codec/encoder.hpp"
#include "render/film/codec/film_writer.hpp"

namespace grainreel {

// A folder next to the film for files that are needed while it is made. It is removed when this object is
// destroyed, unless another folder has its name by then.
class WorkFolder {
  public:
    // Throws RunError.
    explicit WorkFolder(const std::filesystem::path& film) : path_(film.parent_path() / "movie.work") {
        const std::error_code error = make_plain_folder(path_);
        if (error) throw RunError("{}: cannot make the folder: {}", path_.string(), error.message());
        made_ = identity();
    }
    ~WorkFolder() {
        if (!kept_) remove();
    }
    WorkFolder(const WorkFolder&) = delete;
    WorkFolder& operator=(const WorkFolder&) = delete;

    std::filesystem::path file(const char* name) const { return path_ / name; }
    // Keeps the folder until remove(), since it holds the only copy of the film.
    void keep() { kept_ = true; }
    void remove() {
        std::error_code ignored;
        if (identity() == made_) std::filesystem::remove_all(path_, ignored);
        kept_ = true;
    }

  private:
    // Device and inode number of what has the folder's name now; zeros when nothing has it.
    std::pair<dev_t, ino_t> identity() const {
        struct stat named {};
        return ::stat(path_.c_str(), &named) == 0 ? std::pair(named.st_dev, named.st_ino)
                                                  : std::pair<dev_t, ino_t>();
    }

    std::filesystem::path path_;
    std::pair<dev_t, ino_t> made_;
    bool kept_ = false;
};

class CappedFilm final : public FilmWriter {
  public:
    // cap: bytes of the file, its container counted. Throws RunError.
    CappedFilm(const EncoderSettings& settings, std::int64_t cap);

    void add(const Picture& picture) override;
    // Completes the film. It then has at most `cap` bytes, and at least nine tenths of `cap` unless it is
    // smaller at its own quality. Throws RunError, which says what would fit, when the cap is below the
    // film's size at the least legible quality; the film at its own quality then stays.
    void finish() override;

    std::string description() const override;
    std::vector<std::string> notes() const override { return notes_; }

  private:
    void fit(std::int64_t size);
    void fill(double overhead);
    [[noreturn]] void refuse(std::int64_t size, std::int64_t floor, double overhead) const;
    void take_fitted() const;
    std::string first_pass() const;
    // These encode the film anew and return its size in bytes. They use the given settings, the least legible
    // quality, or a rate in bits/s.
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

// A GIF's 256 colours are chosen when all pictures are known. Until then the pictures lie on disk as an exact
// copy, movie.work/spool.mkv, which plays when the run is killed. Under a cap the GIF gets fewer colours.
struct GifColours {
    int count;
    const char *dither, *words;
};

class GifFilm final : public FilmWriter {
  public:
    // cap: bytes of the file.
    explicit GifFilm(const EncoderSettings& settings, std::optional<std::int64_t> cap = {});

    void add(const Picture& picture) override { spool_->add(picture); }
    // Throws RunError also when the cap is below what the fewest colours need. The error says what would fit,
    // and the film in all its colours stays.
    void finish() override;

    std::string description() const override { return description_; }
    std::vector<std::string> notes() const override { return {}; }
    // Name of the exact copy beside the GIF. Without finish() only this copy exists.
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
