// A file that another program may go on writing: whether it is still the one that was read, only longer.
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

class Growth {
  public:
    explicit Growth(const std::filesystem::path& file);

    // Looks at the file again. Returns whether it changed. Throws UserError where another file has the name
    // now, and where it became shorter or other bytes stand where some were read.
    bool look();
    const FileState& state() const { return state_; }

  private:
    std::filesystem::path file_;
    FileState state_;
    std::uint64_t end_hash_ = 0;  // of the last bytes before state_.size
};

// Hash of the bytes before a place, at most so many.
std::uint64_t hash_before(const FileBytes& file, std::uint64_t place, std::size_t bytes);

// The index of a large dump, kept between two calls: ".NAME.grainreel-index" beside the file, or in the
// user's cache folder ($XDG_CACHE_HOME or ~/.cache, grainreel/indices) where it cannot be written there.
//
// It belongs to the file as long as inode, size, time of change and the hashes of the first and of the last
// bytes are the same. Where the file only became longer it serves too, and the pass goes on at its end.

// Content from which on the pass is long enough to keep what it found. Bytes, unpacked
inline constexpr std::uint64_t long_pass = std::uint64_t{64} << 20;

// Where the index of a file may lie, in the order in which it is looked for and written.
std::vector<std::filesystem::path> index_places(const std::filesystem::path& file);

struct KeptIndex {
    TextIndex index;
    bool of_now = false;  // nothing was written into the file since; else it became longer
};

// None where there is none, and where it is damaged or of another state of the file; that one is left for the
// next writing. state: of the file now.
std::optional<KeptIndex> kept_index(const std::filesystem::path& file, const FileState& state);

// Says nothing where it cannot be written: the next call then makes the pass again. state: of the file before
// the pass.
void keep_index(const std::filesystem::path& file, const FileState& state, const TextIndex& index);

// The same as bytes, and back; none where they are damaged. For tests.
std::string index_bytes(const TextIndex& index);
std::optional<TextIndex> index_of_bytes(std::string_view bytes);

}  // namespace grainreel
