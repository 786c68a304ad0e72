// How much has left a run until any time: the rows of outflow.csv, summed up.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <vector>

#include "engine/frame.hpp"
#include "engine/scene/scene.hpp"

namespace grainreel {

// Whether grains may leave a run of this scene, through an outlet or into an exit: whether it has an
// outflow.csv.
bool grains_leave(const Scene& scene);

class OutflowRecord {
  public:
    explicit OutflowRecord(const Scene& scene);

    // The whole rows of a run's file; none when there is no such file. Throws UserError when the file is no
    // outflow.csv of this scene.
    static std::optional<OutflowRecord> read(const std::filesystem::path& file, const Scene& scene);

    // A grain that left, in the order of time (s). radius: m.
    void add(double time, std::int32_t species, double radius);
    // Those that left at that time (s) or before.
    FlowedOut until(double time) const;

  private:
    std::vector<double> densities_;  // kg/m3, of the species
    std::vector<double> times_;      // s, one a grain, rising
    std::vector<double> mass_;       // kg, of it and all before
};

}  // namespace grainreel
