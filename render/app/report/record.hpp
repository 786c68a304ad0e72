// What every run.json says of the program that wrote it.
#pragma once

#include "engine/files/run_json.hpp"

namespace grainreel {

// Version, build and libraries.
ProgramInfo program_info();

}  // namespace grainreel
