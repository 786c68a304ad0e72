// outflow.csv: a row for each grain that left the run, in the order in which they left. It is written row by
// row, and its rows are summed to tell how much has left until any time.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <vector>

#include "engine/base/plain_file.hpp"
#include "engine/measure/flow/flowed_out.hpp"
#include "engine/scene/scene.hpp"
#include "engine/state/traffic.hpp"

namespace grainreel {

struct Clock;  // engine/base/clock.hpp

class OutflowWriter {
  public:
    // Throws RunError when the file cannot be made.
    explicit OutflowWriter(const std::filesystem::path& path);

    // Continues a file. The rows up to `time` (s) stay, and later rows are cut off.
    OutflowWriter(const std::filesystem::path& path, double time);

    // How many bytes and rows of the file stay if it is continued. Throws UserError where it is no
    // outflow.csv.
    struct Kept {
        std::uintmax_t bytes = 0;
        std::int64_t rows = 0;
    };
    static Kept kept_until(const std::filesystem::path& path, double time);

    // Writes rows of time_s, id, type (from 1, as in final.csv), radius in m, place in m and velocity in m/s.
    // They are on disk when this returns. Throws RunError when they could not be written.
    void write(const std::vector<Departure>& gone, const Clock& clock);

    std::int64_t rows() const { return rows_; }

  private:
    OutflowWriter(const std::filesystem::path& path, const Kept& kept)
        : file_(path, kept.bytes), rows_(kept.rows) {}

    TextFile file_;
    std::int64_t rows_ = 0;
};

// Whether grains may leave a run of this scene, through an outlet or an exit. If so, the run has an
// outflow.csv.
bool grains_leave(const Scene& scene);

// How much has left a run until any time.
class OutflowSums {
  public:
    explicit OutflowSums(const Scene& scene);

    // Reads the whole rows of a file; none when there is no such file. Throws UserError when it is not an
    // outflow.csv of this scene.
    static std::optional<OutflowSums> read(const std::filesystem::path& file, const Scene& scene);

    // Adds a grain that left at a time (s). Grains are added in the order of time. radius: m.
    void add(double time, std::int32_t species, double radius);
    // What left at that time (s) or before.
    FlowedOut until(double time) const;
    const std::vector<double>& times() const { return times_; }  // s, when each grain left, rising
    const std::vector<double>& masses() const { return mass_; }  // kg, of that grain and all before it

  private:
    std::vector<double> densities_;  // kg/m3, by species
    std::vector<double> times_;      // s, when each grain left, rising
    std::vector<double> mass_;       // kg, of that grain and all before it
};

}  // namespace grainreel
