// Files that lists of VTK name: relative to the folder of the list, and by programs on Windows with
// backslashes.
#pragma once

#include <algorithm>
#include <filesystem>
#include <string>
#include <string_view>

#include "engine/base/plain_file.hpp"

namespace grainreel {

// The name as the list has it where a file is there, or where it has no backslash; else with slashes.
inline std::string named_file(const std::filesystem::path& folder, std::string_view name) {
    std::string file(name);
    if (file.find('\\') == std::string::npos || is_plain(folder / file)) return file;
    std::replace(file.begin(), file.end(), '\\', '/');
    return file;
}

}  // namespace grainreel
