#include "engine/files/foreign/dumps/text_rows.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <cstring>
#include <map>
#include <string_view>

#include "engine/base/number_text.hpp"
#include "engine/base/text.hpp"
#include "engine/base/word_reader.hpp"
#include "engine/files/foreign/decimal.hpp"
#include "engine/files/foreign/dumps/dump_parts.hpp"

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
            refuse_line(file_, number_, "this line is longer than 16 MB; is this a text dump?");
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

namespace {

namespace fs = std::filesystem;

enum class Kind {
    number,  // a number of a compute or fix, perhaps not finite
    finite,  // a number that must be finite, such as a place
    word     // name of an element or a type
};

Kind kind_of(const std::string& name) {
    if (must_be_finite(name)) return Kind::finite;
    return same_word(name, "element") || same_word(name, "typelabel") ? Kind::word : Kind::number;
}

class RowReader {
  public:
    RowReader(LineReader& lines, const fs::path& file, const RowsToRead& wanted)
        : lines_(lines), file_(file), wanted_(wanted) {
        // A number takes at least two bytes of the file. The table gets no more rows than fit into the bytes;
        // if the head claims more, read() refuses the frame.
        const std::uint64_t width = 2 * std::max<std::uint64_t>(wanted.names.size(), 1);
        const std::uint64_t room = wanted.bytes / width + 1;
        table_.rows =
            static_cast<std::size_t>(std::min<std::uint64_t>(static_cast<std::uint64_t>(wanted.rows), room));
        for (const std::string& name : wanted.names) {
            table_.columns.push_back({name, std::vector<double>(table_.rows), {}});
            kinds_.push_back(wanted.pairs ? Kind::number : kind_of(name));
        }
        for (RawColumn& column : table_.columns) values_.push_back(column.values.data());
    }

    RawTable read() {
        std::size_t row = 0;
        while (row < table_.rows) {
            const std::string_view text = lines_.lines();
            if (text.empty()) break;
            row = read_block(text, row);
        }
        if (row < static_cast<std::size_t>(wanted_.rows))
            refuse_line(
                file_, lines_.number(),
                fmt::format("the frame has {} rows here and had {} before; did another program change the "
                            "file?",
                            row, wanted_.rows));
        return std::move(table_);
    }

  private:
    // Reads the rows of the text, but not more than the table has. Returns the number of the next row.
    std::size_t read_block(std::string_view text, std::size_t row) {
        const char* p = text.data();
        const char* const end = p + text.size();
        std::int64_t passed = 0;
        while (p < end && row < table_.rows) {
            line_ = lines_.number() + passed++;
            p = pass_blanks(p);
            if (*p != '\n') p = read_row(p, row++);
            ++p;
        }
        lines_.take(static_cast<std::size_t>(p - text.data()), passed);
        return row;
    }

    // Reads a row and returns its end. The end of a word is found independently of its number, so that the
    // processor can begin with the next word before this one is finished.
    const char* read_row(const char* p, std::size_t row) {
        const std::size_t columns = values_.size();
        for (std::size_t c = 0; c < columns; ++c) {
            const char* const end = word_end(p);
            double value;
            if (plain_decimal(p, value) != end || kinds_[c] == Kind::word) value = read_word({p, end}, c);
            values_[c][row] = value;
            p = pass_blanks(end);
        }
        if (*p != '\n') refuse_fields(columns + words_from(p));
        return p;
    }

    static const char* pass_blanks(const char* p) {
        while (*p == ' ' || *p == '\t' || *p == '\r' || *p == '\v' || *p == '\f') ++p;
        return p;
    }

    static std::size_t words_from(const char* p) {
        std::size_t count = 0;
        for (; *p != '\n'; ++count)
            p = pass_blanks(std::max(word_end(p), p + 1));  // a control character counts as a word
        return count;
    }

    // Reads a word that is no plain decimal number.
    double read_word(std::string_view word, std::size_t c) {
        if (word.empty()) refuse_fields(c);
        if (kinds_[c] == Kind::word) return index_of(word, c);
        const std::optional<double> value = number_in(word, Dialect::programs);
        if (!value)
            refuse_line(file_, line_,
                        fmt::format("\"{}\" is no number; one is expected in the column {}", excerpt(word),
                                    name_of(c)));
        if (kinds_[c] == Kind::finite && !std::isfinite(*value))
            refuse_line(
                file_, line_,
                fmt::format(
                    "{} is \"{}\", which is no finite number; the run went wrong before it wrote this, "
                    "use the frames before it",
                    name_of(c), excerpt(word)));
        return *value;
    }

    double index_of(std::string_view word, std::size_t c) {
        std::vector<std::string>& words = table_.columns[c].words;
        const auto [known, is_new] = indices_[c].try_emplace(std::string(word), words.size());
        if (is_new) words.emplace_back(word);
        return static_cast<double>(known->second);
    }

    std::string name_of(std::size_t c) const { return excerpt(table_.columns[c].name); }

    [[noreturn]] void refuse_fields(std::size_t count) const {
        refuse_line(
            file_, line_,
            fmt::format("this row has {} field{} and {} columns have names; is the file damaged here?", count,
                        count == 1 ? "" : "s", values_.size()));
    }

    LineReader& lines_;
    const fs::path& file_;
    const RowsToRead& wanted_;
    RawTable table_;
    std::vector<Kind> kinds_;
    std::vector<double*> values_;
    std::map<std::size_t, std::map<std::string, std::size_t>> indices_;
    std::int64_t line_ = 0;
};

}  // namespace

RawTable read_rows(LineReader& lines, const fs::path& file, const RowsToRead& wanted) {
    return RowReader(lines, file, wanted).read();
}

}  // namespace grainreel
