// Packings that runs have left in the user's cache folder ($XDG_CACHE_HOME/grainreel/packings), where a later
// run of the same start finds them.
//
// A packing has its key in its file and a checksum over all of it. The file's name is a hash of the key. So
// what is damaged, foreign or of another program is never taken, whoever wrote it. A file gets its name when
// it is whole, so runs at the same time do each other no harm.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>

namespace grainreel {

// Where the packing of a key is, or would be. Empty where the user has no cache folder.
std::filesystem::path place_of_packing(const std::string& key);

// Packings that were not used for longest are removed first.
void note_packing_used(const std::filesystem::path& place);

// Keeps what `write` writes to the name that it is given, and removes what was not used for longest while all
// together are larger than the limit. Never throws: returns why it could not be kept, in words, or nothing.
std::string keep_packing(const std::filesystem::path& place,
                         const std::function<void(const std::filesystem::path&)>& write);

// What the folder holds.
struct PackingsKept {
    std::filesystem::path folder;
    std::size_t packings = 0;
    std::uintmax_t bytes = 0, most_bytes = 0;  // of all together, and how many are kept
};
PackingsKept packings_kept();

}  // namespace grainreel
