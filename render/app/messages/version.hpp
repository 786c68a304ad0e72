// The versions of this program and its libraries, and what its binary was made from, for --version and
// run.json.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "engine/files/run_json.hpp"

// What this binary was made from. The build writes the values into a source of their own
// (render/app/build_info.cmake), so a commit, or the first change after it, compiles nothing else.
namespace grainreel::build_info {

extern const char* const version;
extern const char* const commit;  // "-dirty": with changes on top; "unknown": not from a repository
extern const char* const compiler;
extern const char* const flags;

}  // namespace grainreel::build_info

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
