// outflow.csv: one row for each grain that left the run, in the order in which they left.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <vector>

#include "engine/base/clock.hpp"
#include "engine/base/plain_file.hpp"
#include "engine/frame.hpp"
#include "engine/scene/scene.hpp"
#include "engine/state/traffic.hpp"

namespace grainreel {

class OutflowWriter {
  public:
    // Throws RunError when the file cannot be made.
    explicit OutflowWriter(const std::filesystem::path& path);

    // Goes on with a file that is there, behind the rows up to `time` (s); what comes after them is cut off.
    OutflowWriter(const std::filesystem::path& path, double time);

    // How many bytes stay of the file then, and how many rows. Throws UserError where it is no such file.
    struct Kept {
        std::uintmax_t bytes = 0;
        std::int64_t rows = 0;
    };
    static Kept kept_until(const std::filesystem::path& path, double time);

    // time_s, id, type (from 1, as in final.csv), radius in m, place in m, velocity in m/s. The rows are on
    // disk when this returns. Throws RunError when they could not be written.
    void write(const std::vector<Departure>& gone, const Clock& clock);

    std::int64_t rows() const { return rows_; }

  private:
    OutflowWriter(const std::filesystem::path& path, const Kept& kept)
        : file_(path, kept.bytes), rows_(kept.rows) {}

    TextFile file_;
    std::int64_t rows_ = 0;
};

// How much has left a run until any time: the rows of outflow.csv, summed up.

// Whether grains may leave a run of this scene, through an outlet or into an exit: whether it has an
// outflow.csv.
bool grains_leave(const Scene& scene);

class OutflowSums {
  public:
    explicit OutflowSums(const Scene& scene);

    // The whole rows of a run's file; none when there is no such file. Throws UserError when the file is no
    // outflow.csv of this scene.
    static std::optional<OutflowSums> read(const std::filesystem::path& file, const Scene& scene);

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
