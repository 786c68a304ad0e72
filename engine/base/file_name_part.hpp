// Names of things as names of files.
#pragma once

#include <string>

namespace grainreel {

// Text as a part of a file's name: letters, digits, "-", "." and "_" alone, at most `most` of them.
std::string file_name_part(const std::string& text, std::size_t most = 60);

}  // namespace grainreel
