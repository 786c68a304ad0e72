#include "engine/files/foreign/bytes/content.hpp"

#include <algorithm>
#include <utility>

namespace grainreel {

namespace {

constexpr std::size_t most_in_memory = std::size_t{24} << 20;  // bytes

}  // namespace

Content::Content(const std::filesystem::path& file) : file_(file), source_(open_bytes(file)) {
    const std::uint64_t on_disk = FileBytes(file).state().size;
    std::size_t piece = static_cast<std::size_t>(std::min<std::uint64_t>(on_disk + 1, kPiece));
    while (window_.size() < most_in_memory) {
        const std::size_t had = window_.size();
        if (window_.capacity() < had + piece)
            window_.reserve(std::min(std::max(2 * had, had + piece), most_in_memory + kPiece));
        window_.resize(had + piece);
        const std::size_t got = source_->read(window_.data() + had, piece);
        window_.resize(had + got);
        if (got < piece) {
            size_ = window_.size();
            source_.reset();
            return;
        }
        piece = kPiece;
    }
    if (packing_of(file) == Packing::none) size_ = on_disk;
}

Content::Content(std::filesystem::path file, std::string bytes)
    : file_(std::move(file)), window_(std::move(bytes)), size_(window_.size()) {}

std::uint64_t Content::size() const {
    if (size_ != npos) return size_;
    for (bool grows = true; grows;) {
        // The last bytes stay, since they are asked for next.
        const std::size_t keep = std::min(window_.size(), kPiece);
        read_window(window_begin_ + window_.size() - keep, keep + kPiece);
        grows = window_.size() > keep;
    }
    return size_ = window_begin_ + window_.size();
}

// The window ends where the source is, so that what follows it is read without going back.
void Content::read_window(std::uint64_t place, std::size_t least) const {
    const std::uint64_t end = window_begin_ + window_.size();
    if (place >= window_begin_ && place <= end) {
        window_.erase(0, static_cast<std::size_t>(place - window_begin_));
    } else {
        window_.clear();
        source_->seek(place);
    }
    window_begin_ = place;
    const std::size_t had = window_.size();
    if (had >= least) return;
    window_.resize(least);
    const std::size_t got = source_->read(window_.data() + had, least - had);
    window_.resize(had + got);
    if (got < least - had) size_ = window_begin_ + window_.size();
}

std::string_view Content::from(std::uint64_t place, std::size_t least) const {
    const std::uint64_t end = window_begin_ + window_.size();
    const bool held = place >= window_begin_ && place <= end && (end - place >= least || end == size_);
    // One piece more than is asked for, so that short steps forward do not move the window each time.
    if (!held && source_) read_window(place, std::max(least, kPiece) + kPiece);
    if (place < window_begin_ || place - window_begin_ > window_.size()) return {};
    return std::string_view(window_).substr(static_cast<std::size_t>(place - window_begin_));
}

void Content::each_piece(std::uint64_t begin, std::uint64_t end,
                         const std::function<void(std::string_view)>& take) const {
    while (begin < end) {
        const std::string_view piece = from(begin).substr(0, static_cast<std::size_t>(end - begin));
        if (piece.empty()) return;
        const std::size_t size = piece.size();
        take(piece);
        begin += size;
    }
}

bool Content::ends_at(std::uint64_t place) const {
    if (size_ != npos) return place >= size_;
    if (place < window_begin_ + window_.size()) return false;
    // The window is kept, since its bytes are asked for again.
    read_window(window_begin_, window_.size() + 1);
    return place >= window_begin_ + window_.size();
}

std::int64_t Content::line_of(std::uint64_t place) const {
    std::int64_t line = 1;
    each_piece(0, place,
               [&](std::string_view piece) { line += std::count(piece.begin(), piece.end(), '\n'); });
    return line;
}

}  // namespace grainreel
