// What every NetCDF file of a run says of the run itself, so that it can be read without the scene beside it.
//
// It depends neither on the run's length nor on how often it was resumed: files of a run that goes on keep
// their heads.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "engine/scene/scene.hpp"

namespace grainreel {

struct FileFacts {
    std::vector<std::pair<std::string, std::string>> attributes;  // of the file: names, texts
    std::vector<double> densities;                                // kg/m3, by species
    std::string walls;  // what a negative number stands for in contacts: "-1 floor, -2 left_wall"
};

// seen_from_container: places and velocities are against the container, as fields are; else those of the
// room.
FileFacts file_facts(const Scene& scene, bool seen_from_container = false);

}  // namespace grainreel
