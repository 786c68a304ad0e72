#include "engine/files/foreign/tables/text_frames.hpp"

#include <fmt/format.h>

#include "engine/base/text.hpp"
#include "engine/base/word_reader.hpp"

namespace grainreel {

namespace {

std::string_view without_end(std::string_view line) {
    if (!line.empty() && line.back() == '\r') line.remove_suffix(1);
    return line;
}

bool blank(std::string_view line) {
    return line.find_first_not_of(" \t\r") == std::string_view::npos;
}

}  // namespace

std::vector<std::string_view> lines_of(const FileStart& head, std::size_t most) {
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

TextFrames::TextFrames(const std::filesystem::path& file) : RawFile(file), growth_(file), lines_(file) {}

void TextFrames::fault(const TextLine& line, const std::string& what) const {
    refuse_line(file_, line.number, what);
}

void TextFrames::find_frames() {
    go_on(false);
    if (moments_.empty())
        fault(line_,
              "the file ends within its first frame, so that no frame of it is whole; was it copied or "
              "written to "
              "the end?");
}

void TextFrames::go_on(bool growing) {
    lines_.seek(next_.byte, next_.line);
    for (;;) {
        RawMoment moment;
        const Place begin = next_;
        const Passed passed = pass_over(lines_, line_, moment);
        if (passed == Passed::end) break;
        // A line without a line feed may be cut within its last number. It is taken only if it ends the
        // file's first and only frame.
        open_end_ = passed == Passed::frame && !line_.ended;
        if (passed == Passed::cut || (open_end_ && (growing || !moments_.empty()))) {
            open_end_ = false;
            if (!growing)
                news_.push_back(fmt::format("{}: its last frame is cut off in line {} and is left out",
                                            file_.string(), line_.number));
            break;
        }
        moment.open = open_end_;
        moments_.push_back(moment);
        places_.push_back(begin);
        next_ = {lines_.place(), lines_.number()};
        if (open_end_)
            news_.push_back(
                fmt::format("{}: its last line has no end; its last number may be cut", file_.string()));
    }
    if (lines_.cut_off() && !growing)
        news_.push_back(
            fmt::format("{}: its packed bytes end too early; the frames before are whole", file_.string()));
}

bool TextFrames::grow() {
    if (!growth_.look()) return false;
    const std::lock_guard lock(reading_);
    const std::size_t before = moments_.size();
    if (open_end_) {  // the file's last line may have become longer since
        next_ = places_.back();
        places_.pop_back();
        moments_.pop_back();
        open_end_ = false;
    }
    news_.clear();
    lines_ = LineReader(file_);
    go_on(true);
    return moments_.size() > before;
}

RawFrame TextFrames::read(std::size_t index) const {
    const std::lock_guard lock(reading_);
    const Place& place = places_.at(index);
    lines_.seek(place.byte, place.line);
    return read_frame(lines_, moments_[index]);
}

}  // namespace grainreel
