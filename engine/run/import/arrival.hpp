// Writes the files of a run from the frames of another program, one frame after the other: trajectory.nc and
// measures.csv, and contacts.nc and ranges.csv where they are wanted.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "engine/base/clock.hpp"
#include "engine/files/contacts_file.hpp"
#include "engine/files/frames/state_archive.hpp"
#include "engine/files/measures_csv.hpp"
#include "engine/files/trajectory/trajectory.hpp"
#include "engine/run/import/import_measures.hpp"
#include "engine/run/import/import_ranges.hpp"
#include "engine/scene/scene.hpp"
#include "engine/state/body.hpp"
#include "engine/state/drive_motion.hpp"
#include "engine/state/state.hpp"

namespace grainreel {

struct ArrivalFacts {
    TrajectoryInfo header;
    StateSupply supply{};  // what the frames have
    Clock clock{};
    bool in_container = false;  // places and velocities of the frames are against the moving container
    bool weighed = false;       // whether masses are known, so that kinetic energies are measured
    bool ranges = false;        // whether close() writes ranges.csv
    // Columns of measures.csv whose values take() gets.
    std::vector<std::string> more_columns{};
};

class Arrival {
  public:
    // scene: that of the run; it must outlive this object. Throws RunError where a file cannot be made.
    Arrival(const std::filesystem::path& folder, const Scene& scene, ArrivalFacts facts);

    // Completes a frame that has step, time and grains as a run of the scene would write it: with the drive's
    // clock, the poses of the bodies, and the grains in the room.
    void complete(State& frame) const;
    // Writes a completed frame and its contacts. more: the values of more_columns. Throws RunError where it
    // cannot be written.
    void take(const State& frame, const std::vector<Link>& touches, const std::vector<double>& more = {});
    // Writes what is known only after the last frame.
    void close();

    // Contacts that take() left out of contacts.nc.
    struct LeftOut {
        std::int64_t of = 0;             // number of all contacts
        std::int64_t without_grain = 0;  // one of its grains is not in the frame
        std::int64_t apart =
            0;  // its grains do not touch there: across a periodic side, or at another moment
    };
    const LeftOut& contacts_left_out() const { return left_out_; }

    std::int64_t frames() const { return trajectory_.frames(); }
    std::int64_t rows() const { return table_.rows(); }  // of measures.csv

  private:
    const std::filesystem::path folder_;
    const Scene& scene_;
    const ArrivalFacts facts_;
    const DriveMotion motion_;
    const std::vector<Body> bodies_;
    TrajectoryWriter trajectory_;
    std::optional<ContactsWriter> contacts_;
    ImportMeasures measures_;
    const Measures::Names names_;  // of all columns of measures.csv
    MeasuresWriter table_;
    ImportRanges ranges_;
    LeftOut left_out_;
};

}  // namespace grainreel
