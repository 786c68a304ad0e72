// Watches files that another program may still be writing, and keeps the index of a large dump on disk for
// the next call. The index is ".NAME.grainreel-index" beside the dump. If it cannot be written there, it goes
// to the user's cache folder (grainreel/indices).
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "engine/files/foreign/bytes/byte_source.hpp"
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

// The hash of the last `bytes` bytes before a place, or of all if there are fewer.
std::uint64_t hash_before(const FileBytes& file, std::uint64_t place, std::size_t bytes);

// The index is kept if at least so many bytes of unpacked content were searched for frames.
inline constexpr std::uint64_t long_pass = std::uint64_t{64} << 20;

// Paths that the index of a file may have, in the order in which they are tried.
std::vector<std::filesystem::path> index_places(const std::filesystem::path& file);

struct KeptIndex {
    TextIndex index;
    bool of_now = false;  // the file is unchanged; else it became longer
};

// The kept index of a file; none where there is none, where it is damaged, or where it does not fit the file.
// It fits as long as inode, size, time of change and the hashes of the first and last bytes are the same. It
// also fits a file that only became longer; the caller then looks for frames from the old end on. state: the
// state of the file now.
std::optional<KeptIndex> kept_index(const std::filesystem::path& file, const FileState& state);

// Writes the index. If it cannot be written, there is no message, and the next call looks for the frames
// again. state: the state of the file before its frames were looked for.
void keep_index(const std::filesystem::path& file, const FileState& state, const TextIndex& index);

// The index as bytes, and back; none where they are damaged. They are in this header for tests.
std::string index_bytes(const TextIndex& index);
std::optional<TextIndex> index_of_bytes(std::string_view bytes);

}  // namespace grainreel
