// outflow.csv: one row for each grain that left the run, in the order in which they left.
#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

#include "engine/base/clock.hpp"
#include "engine/base/plain_file.hpp"
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

}  // namespace grainreel
