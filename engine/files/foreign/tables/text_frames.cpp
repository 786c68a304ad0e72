#include "engine/files/foreign/tables/text_frames.hpp"

#include <sys/stat.h>

#include <fmt/format.h>

#include "engine/base/error.hpp"

namespace grainreel {

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
        // A line without an end may be cut within its last number. Where it ends the only frame it is taken.
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
    if (open_end_) {  // the line may have gone on
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
