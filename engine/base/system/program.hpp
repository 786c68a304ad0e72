// Which build of the program runs, how its user called it, and the folder for files that it can make again.
#pragma once

#include <cstdlib>
#include <filesystem>
#include <string>

namespace grainreel {

// The build identity that the linker gave the program (the note NT_GNU_BUILD_ID of its file) in hexadecimal
// digits. It is a hash of all code and data, so two different programs have different ones. For a program
// without it, the size and time of its file; empty where these are not known either.
std::string build_identity();

// The program's name as its user types it, for messages that name a command: "grainreel". A script that calls
// the program for its user, such as ./movie, gives its own name in the variable GRAINREEL_CALLED.
std::string program_call();

// The cache folder of this program: $XDG_CACHE_HOME/grainreel, else ~/.cache/grainreel (XDG Base Directory
// Specification 0.8). Empty where neither names an absolute path. The folder may not exist yet.
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
