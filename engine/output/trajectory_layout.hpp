// The variables of trajectory.nc, named once for the one who writes and the one who reads.
#pragma once

#include <netcdf.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include <fmt/format.h>

#include "engine/output/checksum.hpp"

namespace grainreel {

struct TrajectoryVariable {
    const char* name;
    int type;               // of <netcdf.h>
    const char* dimension;  // the last one, of a vector; null of a single number
    const char* units;      // empty for none
};

// Of every frame, in the order in which `frame_checksum` takes them.
inline constexpr std::array frame_variables{
    TrajectoryVariable{"time", NC_DOUBLE, nullptr, "second"},
    TrajectoryVariable{"cycles", NC_DOUBLE, nullptr, "period of the drive"},
    TrajectoryVariable{"phase", NC_DOUBLE, nullptr, "turn"},
    TrajectoryVariable{"step", NC_DOUBLE, nullptr, "step"},
    TrajectoryVariable{"grains", NC_INT, nullptr, ""},
    TrajectoryVariable{"wall_offset", NC_DOUBLE, "spatial", "meter"},
    TrajectoryVariable{"wall_velocity", NC_DOUBLE, "spatial", "meter/second"},
    TrajectoryVariable{"floor_offset", NC_DOUBLE, "spatial", "meter"},
    TrajectoryVariable{"floor_velocity", NC_DOUBLE, "spatial", "meter/second"},
    TrajectoryVariable{"cell_origin", NC_DOUBLE, "cell_spatial", "meter"},
    TrajectoryVariable{"cell_lengths", NC_DOUBLE, "cell_spatial", "meter"},
    TrajectoryVariable{"cell_angles", NC_DOUBLE, "cell_angular", "degree"}};

// Of every grain of a frame, in the order in which `grain_checksum` takes them.
inline constexpr std::array grain_variables{
    TrajectoryVariable{"id", NC_INT, nullptr, ""},
    TrajectoryVariable{"type", NC_INT, nullptr, ""},
    TrajectoryVariable{"radius", NC_DOUBLE, nullptr, "meter"},
    TrajectoryVariable{"coordinates", NC_DOUBLE, "spatial", "meter"},
    TrajectoryVariable{"velocities", NC_FLOAT, "spatial", "meter/second"},
    TrajectoryVariable{"spin", NC_FLOAT, "spatial", "radian/second"}};

// Of every body beyond container and floor, in files that have some; in `frame_checksum` behind the others.
inline constexpr std::array body_variables{
    TrajectoryVariable{"body_place", NC_DOUBLE, "spatial", "meter"},
    TrajectoryVariable{"body_rotation", NC_DOUBLE, "quaternion", ""},
    TrajectoryVariable{"body_velocity", NC_DOUBLE, "spatial", "meter/second"},
    TrajectoryVariable{"body_spin", NC_DOUBLE, "spatial", "radian/second"}};

// In files of runs that grains enter or leave: 1 where a place has a grain now; last in `grain_checksum`.
inline constexpr TrajectoryVariable present_variable{"present", NC_INT, nullptr, ""};

// Only when asked for.
inline constexpr TrajectoryVariable orientation_variable{"orientation", NC_FLOAT, "quaternion", ""};

// Files of earlier versions have none.
inline constexpr TrajectoryVariable contact_number_variable{"contact_number", NC_INT, nullptr, ""};

inline constexpr const char *frame_checksum = "frame_checksum", *grain_checksum = "grain_checksum";

// What both sums of a frame begin with: which frame it is, of which file.
inline Checksum begin_checksum(std::size_t frame, std::size_t places, const std::vector<std::string>& species,
                               bool orientation) {
    Checksum sum;
    const std::array<std::uint64_t, 3> numbers{frame, places, orientation ? 1u : 0u};
    const std::string names = fmt::format("{}", fmt::join(species, "\n"));
    sum.add(numbers.data(), numbers.size());
    sum.add(names.data(), names.size());
    return sum;
}

}  // namespace grainreel
