// What the engine does for a run, counted in steps of a grain of the lattice that the machine is measured by
// (lattice_speed.hpp): six contacts each, all at rest.
//
// A step of a grain costs by how many contacts it has. A bed at rest has 4.5 contacts a grain, and so has one
// that is shaken more gently than gravity. A bed that is thrown up has few: 2.6 at 1.2 g, 0.6 at 2 g, 0.2 at
// 3 g, all means over a period.
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>

#include "engine/plan/plan.hpp"
#include "render/scene/filmed_scene.hpp"

namespace grainreel {

struct EngineCost {
    // Grain-steps of the lattice.
    double packing = 0, run = 0;
    // Steps of the scene's grains.
    double packing_steps = 0, run_steps = 0;
};

// Rows of measures, instruments and fields are in the run.
EngineCost engine_cost(const FilmedScene& scene, const Plan& plan);

// Contacts a grain, the mean over the run.
double mean_contacts(const FilmedScene& scene, const Plan& plan);

// How fast this machine computes and draws, measured once and kept in the cache folder.

// How fast films of one look are made.
struct FilmSpeed {
    double seconds = 0;    // of processor time, to draw and encode a frame of one moment
    double drawing = 0.5;  // share of it that is drawing
};

// A file for each processor, version and vector width in $XDG_CACHE_HOME/grainreel or ~/.cache/grainreel. A
// file that is missing, damaged or of anything else counts as empty; where none can be written, nothing is
// kept.
class SpeedCache {
  public:
    SpeedCache();  // reads it

    std::optional<double> engine(int threads) const;  // grain-steps a second of lattice_speed
    std::optional<FilmSpeed> film(const std::string& look) const;
    void keep_engine(int threads, double grain_steps);
    void keep_film(const std::string& look, const FilmSpeed& speed);
    void save() const;

    const std::filesystem::path& path() const { return path_; }  // empty: there is no home

  private:
    void read();

    std::filesystem::path path_;
    std::string machine_;
    std::map<int, double> engine_;
    std::map<std::string, FilmSpeed> films_;
};

}  // namespace grainreel
