// Finds what an unpacked archive or a Python wheel keeps beside the program: fonts and the table of units.
// The files are looked for from the program's own place, so the folder may be moved. render/package/archive
// fills it.
#pragma once

#include <filesystem>

namespace grainreel {

// The folder share/grainreel of the archive that this program was unpacked from; empty for a program that was
// built here or installed by a package. Links to the program are resolved.
const std::filesystem::path& own_files();

// Tells udunits and Fontconfig, which read the environment, where the archive's files are. A variable that
// the user has set stays, if its file is there. Call it before any thread starts.
void use_own_files();

}  // namespace grainreel
