// What the columns of other programs are called. One name may mean one thing in one program and another in
// the next; the list is asked in its order, and case does not count.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "engine/files/foreign/raw_file.hpp"
#include "engine/files/frames/frame_archive.hpp"

namespace grainreel {

// Names for one meaning, the best known first. "v:0" is the first component of the vector v.
const std::vector<std::string>& names_of(const std::string& meaning);

// All meanings that --columns takes.
std::vector<std::string> all_meanings();

// The place of the column with that meaning in the table; none where there is none. What the user says by
// --columns counts before the list. Throws UserError where the user names a column that the file lacks.
// file: for the message.
std::optional<std::size_t> column_for(const std::string& meaning, const RawTable& table,
                                      const ReadingOptions& options, const std::string& file);

// "id, type, x, y, z, c_rad": what a file has, for messages.
std::string names_in(const RawTable& table);

// Systems of units of other programs: how much one unit of each is in SI.

struct UnitSystem {
    std::string name;
    double length = 1;  // m
    double time = 1;    // s
    double mass = 1;    // kg
    bool real = true;   // false for lj, whose units are those of the model

    double velocity() const { return length / time; }
    double density() const { return mass / (length * length * length); }
    double force() const { return mass * length / (time * time); }
    double pressure() const { return mass / (length * time * time); }
};

// "si", "lj", "cgs", "micro", "nano", "real", "metal" (LAMMPS manual, command `units`). None for another
// name.
std::optional<UnitSystem> unit_system(const std::string& name);
std::vector<std::string> unit_names();

// A unit in a column's name, as in "x [mm]" or "radius (um)": m, s or m/s in one of it; none where the name
// has none that is known.
std::optional<double> unit_in_name(const std::string& column);

}  // namespace grainreel
