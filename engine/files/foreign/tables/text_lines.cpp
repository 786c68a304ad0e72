#include "engine/files/foreign/tables/text_lines.hpp"

#include <fmt/format.h>
#include <sys/stat.h>
#include <algorithm>
#include <cstring>

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

TextFrames::TextFrames(const std::filesystem::path& file) : file_(file), lines_(file) {}

TextFrames::Seen TextFrames::look() const {
    struct stat status {};
    if (::stat(file_.c_str(), &status) != 0)
        throw UserError(fmt::format("{}: is gone; it was there a moment ago", file_.string()));
    return {static_cast<std::uint64_t>(status.st_size), static_cast<std::uint64_t>(status.st_ino)};
}

void TextFrames::find_frames() {
    seen_ = look();
    go_on(false);
    if (!moments_.empty()) return;
    throw UserError(
        fmt::format("{}:{}: the file ends within its first frame, so that no frame of it is whole; "
                    "was it copied or written to the end?",
                    file_.string(), lines_.number()));
}

void TextFrames::go_on(bool growing) {
    lines_.go_to(next_.byte, next_.lines);
    for (;;) {
        RawMoment moment;
        const Place begin = next_;
        const Passed passed = pass_over(lines_, moment);
        if (passed == Passed::end) break;
        // A line without a line feed may be cut within its last number. It is taken only if it ends the
        // file's first and only frame.
        open_end_ = passed == Passed::frame && !lines_.ended();
        if (passed == Passed::cut || (open_end_ && (growing || !moments_.empty()))) {
            open_end_ = false;
            if (!growing) leave_out(lines_);
            break;
        }
        moments_.push_back(moment);
        places_.push_back(begin);
        next_ = {lines_.next_begin(), lines_.number()};
        if (open_end_)
            news_.push_back(
                fmt::format("{}: its last line has no end; its last number may be cut", file_.string()));
    }
    if (lines_.cut_off() && !growing)
        news_.push_back(
            fmt::format("{}: its packed bytes end too early; the frames before are whole", file_.string()));
}

void TextFrames::leave_out(const TextLines& lines) {
    news_.push_back(fmt::format("{}: its last frame is cut off in line {} and is left out", file_.string(),
                                lines.number()));
}

bool TextFrames::grow() {
    const Seen now = look();
    if (now.file != seen_.file || now.size < seen_.size)
        throw UserError(fmt::format("{}: was {} while it was read; begin again", file_.string(),
                                    now.file != seen_.file ? "replaced" : "cut shorter"));
    if (now.size == seen_.size) return false;
    const std::lock_guard lock(reading_);
    const std::size_t before = moments_.size();
    if (open_end_) {  // the file's last line may have become longer since
        next_ = places_.back();
        places_.pop_back();
        moments_.pop_back();
        open_end_ = false;
    }
    seen_ = now;
    news_.clear();
    lines_ = TextLines(file_);
    go_on(true);
    return moments_.size() > before;
}

RawFrame TextFrames::read(std::size_t index) const {
    const std::lock_guard lock(reading_);
    const Place& place = places_.at(index);
    lines_.go_to(place.byte, place.lines);
    return read_frame(lines_, moments_[index]);
}

}  // namespace grainreel
