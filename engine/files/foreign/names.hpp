// How other programs name their columns, and in which units they write. A name may have different
// meanings in two programs, so the lists of names have an order, and the first name that a file has wins.
// Case does not count. A name of a further program is added in names.cpp.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "engine/files/foreign/raw_file.hpp"
#include "engine/files/frames/state_archive.hpp"

namespace grainreel {

// All names for a meaning, the best known first. "v:0" is the first component of the vector v.
const std::vector<std::string>& names_of(const std::string& meaning);

// All meanings that --columns takes.
std::vector<std::string> all_meanings();

// The number of the column with that meaning in the table; none where there is none. What the user says by
// --columns has precedence over the list. Throws UserError where the user names a column that the file does
// not have. file: for the message.
std::optional<std::size_t> column_for(const std::string& meaning, const RawTable& table,
                                      const ReadingOptions& options, const std::string& file);

// The columns that say which two grains touch, as geoA and geoB do.
struct Partners {
    std::size_t first = 0, second = 0;
};
// None unless the table has a column of a force or an overlap too.
std::optional<Partners> partners_in(const RawTable& table);

// The names of all columns for messages: "id, type, x, y, z, c_rad".
std::string names_in(const RawTable& table);

// A system of units: how much each unit is in SI.
struct UnitSystem {
    std::string name;
    double length = 1;  // m
    double time = 1;    // s
    double mass = 1;    // kg
    bool real = true;   // false for lj, which has no relation to SI

    double velocity() const { return length / time; }
    double density() const { return mass / (length * length * length); }
    double force() const { return mass * length / (time * time); }
    double pressure() const { return mass / (length * time * time); }
};

// The system "si", "lj", "cgs", "micro", "nano", "real" or "metal" (LAMMPS manual, command `units`), or "mm":
// mm, g and s. None for another name.
std::optional<UnitSystem> unit_system(const std::string& name);
std::vector<std::string> unit_names();

// The unit in brackets after a column's name: "mm" for "x [mm]" and "x (mm)"; empty where there is none.
std::string unit_of_name(std::string_view name);

}  // namespace grainreel
