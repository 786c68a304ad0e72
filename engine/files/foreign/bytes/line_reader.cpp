#include "engine/files/foreign/bytes/line_reader.hpp"

#include <algorithm>
#include <cstring>

#include "engine/base/text.hpp"
#include "engine/base/word_reader.hpp"

namespace grainreel {

namespace {

constexpr std::size_t buffer_size = std::size_t{1} << 19;   // bytes; it fits into a processor's cache
constexpr std::size_t longest_line = std::size_t{1} << 24;  // bytes
constexpr std::size_t behind = 64;                          // bytes that may be read after the last line

bool only_blanks(std::string_view text) {
    return text.find_first_not_of(" \t\r\v\f") == std::string_view::npos;
}

}  // namespace

LineReader::LineReader(const std::filesystem::path& file)
    : file_(file), source_(open_bytes(file)), buffer_(buffer_size + behind) {}

bool LineReader::fill() {
    if (at_end_) return false;
    if (used_ > 0) {
        std::memmove(buffer_.data(), buffer_.data() + used_, held_ - used_);
        buffer_place_ += used_;
        held_ -= used_;
        used_ = 0;
    }
    if (held_ + behind >= buffer_.size()) {
        if (buffer_.size() > longest_line)
            refuse_line(file_, number_, "this line is longer than 16 MB; is this a text file?");
        buffer_.resize(2 * buffer_.size());
    }
    const std::size_t room = buffer_.size() - behind - held_;
    const std::size_t got = source_->read(buffer_.data() + held_, room);
    held_ += got;
    if (got < room) at_end_ = true;
    return got > 0;
}

bool LineReader::next(TextLine& line) {
    std::size_t searched = used_;
    const char* end = nullptr;
    while (true) {
        const char* const from = buffer_.data() + searched;
        end = static_cast<const char*>(std::memchr(from, '\n', held_ - searched));
        if (end != nullptr) break;
        const std::size_t left = held_ - used_;
        if (!fill()) break;
        searched = used_ + left;
    }
    if (end == nullptr && used_ == held_) return false;
    line.ended = end != nullptr;
    const char* const begin = buffer_.data() + used_;
    if (end == nullptr) end = buffer_.data() + held_;
    line.place = place();
    line.number = number_;
    used_ = static_cast<std::size_t>(end - buffer_.data()) + (line.ended ? 1 : 0);
    if (line.ended) ++number_;
    if (end > begin && end[-1] == '\r') --end;
    line.text = {begin, static_cast<std::size_t>(end - begin)};
    if (line.place == 0) drop_byte_order_mark(line.text);
    return true;
}

bool LineReader::next_with_words(TextLine& line) {
    while (next(line))
        if (!only_blanks(line.text)) return true;
    return false;
}

void LineReader::back(const TextLine& line) {
    used_ = static_cast<std::size_t>(line.place - buffer_place_);
    number_ = line.number;
}

std::string_view LineReader::lines() {
    unended_ = false;
    while (true) {
        const std::string_view held(buffer_.data() + used_, held_ - used_);
        const std::size_t last = held.rfind('\n');
        if (last != std::string_view::npos) return held.substr(0, last + 1);
        if (fill()) continue;
        if (used_ == held_) return {};
        unended_ = true;
        buffer_[held_] = '\n';  // the buffer is longer than held_ can be
        return {buffer_.data() + used_, held_ - used_ + 1};
    }
}

void LineReader::take(std::size_t bytes, std::int64_t lines) {
    used_ = std::min(used_ + bytes, held_);
    number_ += lines;
}

void LineReader::seek(std::uint64_t place, std::int64_t number) {
    if (place >= buffer_place_ && place <= buffer_place_ + held_) {
        used_ = static_cast<std::size_t>(place - buffer_place_);
    } else {
        source_->seek(place);
        buffer_place_ = place;
        used_ = held_ = 0;
        at_end_ = false;
    }
    number_ = number;
}

}  // namespace grainreel
