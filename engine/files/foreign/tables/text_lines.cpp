#include "engine/files/foreign/tables/text_lines.hpp"

#include <algorithm>
#include <cstring>

#include <fmt/format.h>

#include "engine/base/error.hpp"
#include "engine/base/text.hpp"

namespace grainreel {

namespace {

constexpr std::size_t piece = std::size_t{1} << 18;         // bytes read at once
constexpr std::size_t longest_line = std::size_t{1} << 26;  // bytes

std::string_view without_end(std::string_view line) {
    if (!line.empty() && line.back() == '\r') line.remove_suffix(1);
    return line;
}

bool blank(std::string_view line) {
    return line.find_first_not_of(" \t\r") == std::string_view::npos;
}

}  // namespace

TextLines::TextLines(const std::filesystem::path& file) : file_(file), source_(open_bytes(file)) {}

bool TextLines::fill() {
    if (at_ > 0) {
        std::memmove(buffer_.data(), buffer_.data() + at_, filled_ - at_);
        place_ += at_;
        filled_ -= at_;
        at_ = 0;
    }
    if (filled_ > longest_line)
        throw UserError(fmt::format("{}:{}: the line is longer than {} MB; is this a text file?",
                                    file_.string(), number_ + 1, longest_line >> 20));
    if (buffer_.size() < filled_ + piece) buffer_.resize(std::max(filled_ + piece, 2 * filled_));
    const std::size_t got = source_->read(buffer_.data() + filled_, buffer_.size() - filled_);
    filled_ += got;
    return got > 0;
}

bool TextLines::next() {
    std::size_t looked = 0;
    for (;;) {
        const char* from = buffer_.data() + at_;
        const std::size_t left = filled_ - at_;
        const void* found = left > looked ? std::memchr(from + looked, '\n', left - looked) : nullptr;
        if (!found) {
            looked = left;
            if (fill()) continue;
            if (left == 0) return false;
        }
        ended_ = found != nullptr;
        from = buffer_.data() + at_;
        const std::size_t length =
            ended_ ? static_cast<std::size_t>(static_cast<const char*>(found) - from) : filled_ - at_;
        begin_ = place_ + at_;
        at_ += length + (ended_ ? 1 : 0);
        text_ = without_end({from, length});
        if (begin_ == 0) drop_byte_order_mark(text_);
        ++number_;
        return true;
    }
}

bool TextLines::next_filled() {
    while (next())
        if (!blank(text_)) return true;
    return false;
}

void TextLines::go_to(std::uint64_t byte, std::uint64_t lines) {
    if (byte >= place_ && byte <= place_ + filled_) {
        at_ = static_cast<std::size_t>(byte - place_);
    } else {
        source_->seek(byte);
        place_ = byte;
        at_ = filled_ = 0;
    }
    number_ = lines;
    text_ = {};
    ended_ = true;
}

void TextLines::fault(const std::string& what) const {
    throw UserError(fmt::format("{}:{}: {}", file_.string(), number_, what));
}

std::vector<std::string_view> lines_of(const FileHead& head, std::size_t most) {
    std::string_view rest = head.bytes;
    drop_byte_order_mark(rest);
    std::vector<std::string_view> lines;
    while (!rest.empty() && lines.size() < most) {
        const std::size_t length = rest.find('\n');
        if (length == std::string_view::npos && head.bytes.size() >= kHeadBytes) break;
        const std::string_view line = without_end(rest.substr(0, length));
        if (!blank(line)) lines.push_back(line);
        if (length == std::string_view::npos) break;
        rest.remove_prefix(length + 1);
    }
    return lines;
}

}  // namespace grainreel
