// final.csv: the state of every grain as a table, one row per grain. Numbers have enough digits to read back
// the same bits, so a scene may start from the table.
//
//   id,type,radius,x,y,z,vx,vy,vz,wx,wy,wz[,qx,qy,qz,qw]
//
// SI units: radius and position m, velocity m/s, spin (angular velocity) rad/s; `type` counts the scene's
// species from 1 and `id` the grains from 0, as in trajectory.nc; the orientation is a unit quaternion, and
// its columns exist only if the run kept it. Earlier versions had a column `species`, counted from 0, instead
// of `type`; it is read too.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string_view>

#include "engine/state/state.hpp"

namespace grainreel {

inline constexpr const char* kFinalTable = "final.csv";

// The mark of final.csv that run.json keeps, so that a cut or damaged table is not used. The table itself is
// plain CSV, and nothing in it says where it ends.
struct TableMark {
    std::int64_t grains = 0;
    std::uint64_t checksum = 0;  // XXH64 of the file's bytes
};

TableMark mark_of_table(std::int64_t grains, std::string_view bytes);

// Reads the mark of a run's final.csv from the run.json in its folder. Empty if that file has none.
std::optional<TableMark> mark_in_run_json(const std::filesystem::path& run_json);

// Checks a table of `grains` grains that lies beside a run.json. Throws UserError if it is a final.csv that
// its run wrote with another number of grains or with other bytes. A table of another name belongs to no run,
// and may be changed.
void check_as_written(const std::filesystem::path& table, std::int64_t grains);

// Whether a file that begins with these bytes is such a table, by its first line.
bool begins_grain_table(std::string_view bytes);

// Writes a table and returns its mark for run.json. Throws RunError if the file cannot be written; its former
// content then stays.
TableMark write_grain_table(const std::filesystem::path& path, const State& frame);

// Reads a table. The frame's step, time and wall poses stay at their defaults, because the table does not
// hold them.
// Throws UserError with line and column when the file is missing, is not such a table, or holds a value that
// no grain can have (a radius of 0, an infinite speed, an id twice). Also throws UserError when it is a
// final.csv that does not match the mark in the run.json beside it.
State read_grain_table(const std::filesystem::path& path);

}  // namespace grainreel
