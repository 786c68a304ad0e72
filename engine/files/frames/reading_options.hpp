// What a user says of files of other programs, where these do not say it themselves.
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace grainreel {

struct ReadingOptions {
    // --columns "radius=c_rad,type=mol": the file's column for a meaning. Meanings are id, type, x, y, z, vx,
    // vy, vz, wx, wy, wz, radius, diameter, density, mass, qw, qx, qy, qz, step, time, id1, id2, force.
    std::map<std::string, std::string> columns{};
    // --radius 2mm, or 1=2mm,2=5mm by type. m
    std::optional<double> radius{};
    std::map<std::string, double> radius_of_type{};
    std::optional<double> time_step{};  // --time-step, s
    std::string units{};                // --units lj|si|cgs|micro; empty: as the file says, else SI
    std::map<std::string, std::string> species{};  // --species "1=small,2=big": name of a type
    std::optional<double> density{};               // --density, kg/m3
    bool one = false;                              // --one: this file alone, without its series
    std::vector<std::string> contacts{};           // --contacts: files or patterns of contacts
    std::vector<std::string> walls{};              // --walls: files or patterns of surfaces
    std::optional<double> walls_scale{};           // m in one unit of the walls' files
    std::filesystem::path container{};             // --container scene.toml: its walls and its drive
    bool moves_with_container = false;             // --moves-with container
};

}  // namespace grainreel
