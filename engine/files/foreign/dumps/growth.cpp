#include "engine/files/foreign/dumps/growth.hpp"

#include <fmt/format.h>
#include <xxhash.h>

#include <algorithm>
#include <vector>

#include "engine/base/error.hpp"

namespace grainreel {
namespace {

constexpr std::size_t compared = 4096;  // bytes

}  // namespace

std::uint64_t hash_before(const FileBytes& file, std::uint64_t place, std::size_t bytes) {
    const std::uint64_t from = place - std::min<std::uint64_t>(place, bytes);
    std::vector<char> read(static_cast<std::size_t>(place - from));
    const std::size_t got = file.read_at(from, read.data(), read.size());
    return XXH64(read.data(), got, got);
}

Growth::Growth(const std::filesystem::path& file) : file_(file) {
    const FileBytes bytes(file_);
    state_ = bytes.state();
    end_hash_ = hash_before(bytes, state_.size, compared);
}

bool Growth::look() {
    const FileBytes bytes(file_);
    const FileState now = bytes.state();
    if (now == state_) return false;
    if (!now.same_file(state_))
        throw UserError(fmt::format("{}: another file has this name now; begin again with it", shown(file_)));
    if (now.size < state_.size)
        throw UserError(
            fmt::format("{}: became shorter, from {} to {} bytes, while it was followed; begin again with "
                        "it",
                        shown(file_), state_.size, now.size));
    if (hash_before(bytes, state_.size, compared) != end_hash_)
        throw UserError(
            fmt::format("{}: was written anew while it was followed; begin again with it", shown(file_)));
    state_ = now;
    end_hash_ = hash_before(bytes, state_.size, compared);
    return true;
}

}  // namespace grainreel
