// Paths that name many files.
#pragma once

#include <filesystem>

namespace grainreel {

// Whether a text is a pattern (* ? [) and no file has that name.
inline bool is_pattern(const std::filesystem::path& path) {
    std::error_code ignored;
    return path.string().find_first_of("*?[") != std::string::npos && !std::filesystem::exists(path, ignored);
}

}  // namespace grainreel
