// Packings that runs have left in the user's cache folder ($XDG_CACHE_HOME/grainreel/packings), where a later
// run of the same start finds them.
//
// The file of a packing holds its key and a checksum over the whole file. The file's name is a hash of the
// key. So files that are damaged, foreign or of another program are never used. A file gets its name when it
// is whole, so runs at the same time do not disturb each other.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>

namespace grainreel {

// The path for the packing of a key, whether it is there or not. Empty if the user has no cache folder.
std::filesystem::path place_of_packing(const std::string& key);

// Whether there is a file at that path which the user alone may have put there. No other packing may be used.
bool is_own_packing(const std::filesystem::path& place);

// Notes that a packing has been used. Packings that were not used for the longest time are removed first.
void note_packing_used(const std::filesystem::path& place);

// Keeps a packing: calls `write` with the name of the file to write. While all packings together exceed the
// limit, removes those that were not used for the longest time. Never throws. Returns the reason, in words,
// if the packing could not be kept, else nothing.
std::string keep_packing(const std::filesystem::path& place,
                         const std::function<void(const std::filesystem::path&)>& write);

// The content of the folder.
struct PackingsKept {
    std::filesystem::path folder;
    std::size_t packings = 0;
    std::uintmax_t bytes = 0, most_bytes = 0;  // size of all packings together, and its limit
};
PackingsKept packings_kept();

}  // namespace grainreel
