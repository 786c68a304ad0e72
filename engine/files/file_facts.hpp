// What every NetCDF file of a run says about the run, so that it can be read without the scene.
//
// It must not depend on the run's length or on how often it was resumed: a file that is continued keeps its
// header.
#pragma once

#include <string>
#include <utility>
#include <vector>

namespace grainreel {

struct Scene;  // engine/scene/scene.hpp

struct FileFacts {
    std::vector<std::pair<std::string, std::string>> attributes;  // names and texts of the file's attributes
    std::vector<double> densities;                                // kg/m3, by species
    std::string walls;  // what negative numbers mean in contacts: "-1 floor, -2 left_wall"
};

// seen_from_container: places and velocities are relative to the container, as in fields.nc. Otherwise they
// are relative to the laboratory.
FileFacts file_facts(const Scene& scene, bool seen_from_container = false);

}  // namespace grainreel
