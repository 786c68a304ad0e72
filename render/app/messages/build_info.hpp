// What this binary was made from. The build writes the values into a source of their own
// (render/app/build_info.cmake), so a commit, or the first change after it, compiles nothing else.
#pragma once

namespace grainreel::build_info {

extern const char* const version;
extern const char* const commit;  // "-dirty": with changes on top; "unknown": not from a repository
extern const char* const compiler;
extern const char* const flags;

}  // namespace grainreel::build_info
