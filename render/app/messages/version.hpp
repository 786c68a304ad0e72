// The versions of this program and its libraries, for --version and run.json.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "engine/files/run_json.hpp"

namespace grainreel {

// Name and version of the libraries in use; of most shared libraries, the version that is loaded. FFmpeg is
// left out: ffmpeg_versions() (render/film/codec/ffmpeg.hpp) has its versions.
std::vector<std::pair<std::string, std::string>> library_versions();

// Where the program is: "installed in /usr/bin" or "built in /home/me/grainreel/build/release".
std::string where_program_is();

// Several lines about the program: where it is, its commit, compiler and libraries.
std::string version_text();

// Version, build and libraries, for run.json.
ProgramInfo program_info();

}  // namespace grainreel
