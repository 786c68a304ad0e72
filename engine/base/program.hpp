// Which build of a program this is.
#pragma once

#include <cstdlib>
#include <filesystem>
#include <string>

namespace grainreel {

// The build identity that the linker gave the program (the note NT_GNU_BUILD_ID of its file), in hexadecimal
// digits: a hash of all its code and data, so that it differs where anything does. A program without one is
// told by the size and time of its file. Empty where neither is known.
std::string build_identity();

// Where the user's programs keep what they can make again.

// $XDG_CACHE_HOME/grainreel, else ~/.cache/grainreel (XDG Base Directory Specification 0.8). Empty where
// neither names an absolute path. The folder need not be there.
inline std::filesystem::path cache_folder() {
    const auto folder = [](const char* variable) -> std::filesystem::path {
        const char* value = std::getenv(variable);
        const std::filesystem::path path = value == nullptr ? "" : value;
        return path.is_absolute() ? path : std::filesystem::path();
    };
    if (const auto given = folder("XDG_CACHE_HOME"); !given.empty()) return given / "grainreel";
    if (const auto home = folder("HOME"); !home.empty()) return home / ".cache" / "grainreel";
    return {};
}

}  // namespace grainreel
