// Which build of a program this is.
#pragma once

#include <string>

namespace grainreel {

// The build identity that the linker gave the program (the note NT_GNU_BUILD_ID of its file), in hexadecimal
// digits: a hash of all its code and data, so that it differs where anything does. A program without one is
// told by the size and time of its file. Empty where neither is known.
std::string build_identity();

}  // namespace grainreel
