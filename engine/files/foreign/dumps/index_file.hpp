// Files that another program may still be writing, and the index of a large dump that is kept between two
// calls. The index is ".NAME.grainreel-index" beside the file, or in the user's cache folder
// (grainreel/indices) where it cannot be written there.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "engine/files/foreign/byte_source.hpp"
#include "engine/files/foreign/dumps/text_index.hpp"

namespace grainreel {

// Watches whether a file is still the one that was read, perhaps longer.
class Growth {
  public:
    explicit Growth(const std::filesystem::path& file);

    // Looks at the file again. Returns whether it changed. Throws UserError where it became shorter, has
    // other bytes at places that were read, or where another file has its name now.
    bool look();
    const FileState& state() const { return state_; }

  private:
    std::filesystem::path file_;
    FileState state_;
    std::uint64_t end_hash_ = 0;  // hash of the last bytes before state_.size
};

// Hash of at most so many bytes before a place.
std::uint64_t hash_before(const FileBytes& file, std::uint64_t place, std::size_t bytes);

// From so many bytes of unpacked content on, finding the frames of a file takes so long that its index is
// kept.
inline constexpr std::uint64_t long_pass = std::uint64_t{64} << 20;

// Paths that the index of a file may have, in the order in which they are tried.
std::vector<std::filesystem::path> index_places(const std::filesystem::path& file);

struct KeptIndex {
    TextIndex index;
    bool of_now = false;  // the file is unchanged; else it became longer
};

// The kept index of a file; none where there is none, or where it is damaged or fits another state of the
// file. It fits as long as inode, size, time of change and the hashes of the first and last bytes are the
// same. It also serves a file that only became longer: then frames are looked for from the old end on. state:
// of the file now.
std::optional<KeptIndex> kept_index(const std::filesystem::path& file, const FileState& state);

// Writes the index. If it cannot be written, there is no message, and the next call looks for the frames
// again. state: of the file before its frames were looked for.
void keep_index(const std::filesystem::path& file, const FileState& state, const TextIndex& index);

// The index as bytes, and back; none where they are damaged. These are for tests.
std::string index_bytes(const TextIndex& index);
std::optional<TextIndex> index_of_bytes(std::string_view bytes);

}  // namespace grainreel
