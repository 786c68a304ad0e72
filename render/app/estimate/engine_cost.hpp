// Estimates the work of the engine for a run, and keeps the measured speed of this machine. Work is counted
// in steps of a grain in the lattice by which the machine is measured (lattice_speed()); each grain there
// has six contacts and is at rest.
//
// The cost of a grain's step depends on its number of contacts. A bed at rest has 4.5 contacts for each
// grain, and so has a bed whose acceleration stays below gravity. A bed that is thrown up has fewer: 2.6 at
// 1.2 g, 0.6 at 2 g, 0.2 at 3 g, all means over a period.
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>

#include "engine/plan/plan.hpp"
#include "render/scene/filmed_scene.hpp"

namespace grainreel {

struct EngineCost {
    // Work, in grain-steps of the lattice.
    double packing = 0, run = 0;
    // Number of time steps.
    double packing_steps = 0, run_steps = 0;
};

// Estimates the cost. The run includes rows of measures, instruments and fields.
EngineCost engine_cost(const FilmedScene& scene, const Plan& plan);

// Mean number of contacts of a grain over the run.
double mean_contacts(const FilmedScene& scene, const Plan& plan);

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
