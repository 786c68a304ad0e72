// What this binary was made from. The build writes the values into a source file of their own
// (render/app/build_info.cmake), so a new commit makes only that file compile again.
#pragma once

namespace grainreel::build_info {

extern const char* const version;
extern const char* const commit;  // ends in "-dirty" if files were changed; "unknown" without a repository
extern const char* const compiler;
extern const char* const flags;

}  // namespace grainreel::build_info
