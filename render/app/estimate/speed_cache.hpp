// Keeps how fast this machine computes and draws, so that `check` measures it once.
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>

namespace grainreel {

// How fast films of one look are made.
struct FilmSpeed {
    double seconds = 0;    // s of processor time to draw and encode a frame of one moment
    double drawing = 0.5;  // share of drawing in seconds
};

// How fast this machine computes and draws, measured once and kept in a file of $XDG_CACHE_HOME/grainreel or
// ~/.cache/grainreel. There is one file for each processor, version and vector width. A file that is missing,
// damaged or of another kind counts as empty. When no file can be written, nothing is kept.
class SpeedCache {
  public:
    SpeedCache();  // reads the file

    std::optional<double> engine(int threads) const;  // grain-steps a second of lattice_speed
    std::optional<FilmSpeed> film(const std::string& look) const;
    void keep_engine(int threads, double grain_steps);
    void keep_film(const std::string& look, const FilmSpeed& speed);
    void save() const;

    const std::filesystem::path& path() const { return path_; }  // empty when there is no home folder

  private:
    void read();

    std::filesystem::path path_;
    std::string machine_;
    std::map<int, double> engine_;
    std::map<std::string, FilmSpeed> films_;
};

}  // namespace grainreel
