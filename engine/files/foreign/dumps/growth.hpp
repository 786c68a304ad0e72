// A file that another program may go on writing: whether it is still the one that was read, only longer.
#pragma once

#include <cstdint>
#include <filesystem>

#include "engine/files/foreign/bytes/file_bytes.hpp"

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

}  // namespace grainreel
