// What every run.json says of the program that wrote it.
#pragma once

#include <string>

#include "engine/output/run_json.hpp"

namespace grainreel {

// Version, build and libraries, the command, and that it started now.
void describe_program(RunRecord& record, const std::string& command);

}  // namespace grainreel
