// Systems of units of other programs: how much one unit of each is in SI.
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace grainreel {

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
