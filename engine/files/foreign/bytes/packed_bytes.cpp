#include "engine/files/foreign/bytes/packed_bytes.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "engine/base/error.hpp"

namespace grainreel {
namespace {

constexpr std::size_t piece_size = std::size_t{1} << 18;  // bytes

}  // namespace

PackedBytes::PackedBytes(std::unique_ptr<FileBytes> file)
    : file_(std::move(file)), piece_(std::make_unique<char[]>(piece_size)) {}

std::size_t PackedBytes::read(char* to, std::size_t size) {
    std::size_t done = 0;
    while (done < size) {
        const std::size_t got = unpack(to + done, size - done);
        if (got == 0) break;
        done += got;
    }
    place_ += done;
    return done;
}

void PackedBytes::seek(std::uint64_t place) {
    if (place < place_) {
        held_ = used_ = 0;
        read_ = place_ = 0;
        cut_off_ = false;
        begin_again();
    }
    std::unique_ptr<char[]> passed_over;
    while (place_ < place) {
        if (!passed_over) passed_over = std::make_unique<char[]>(piece_size);
        const std::size_t size =
            static_cast<std::size_t>(std::min<std::uint64_t>(place - place_, piece_size));
        if (read(passed_over.get(), size) == 0) break;
    }
}

bool PackedBytes::fill() {
    if (left() > 0) return true;
    used_ = 0;
    held_ = file_->read_at(read_, piece_.get(), piece_size);
    read_ += held_;
    return held_ > 0;
}

void PackedBytes::damaged(const std::string& why) const {
    throw UserError(
        fmt::format("{}: byte {}: the packed content is damaged ({}); copy the file again, or unpack what "
                    "is sound by hand",
                    shown(file_->path()), read_ - left(), why));
}

}  // namespace grainreel
