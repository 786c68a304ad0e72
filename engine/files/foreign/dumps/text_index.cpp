#include "engine/files/foreign/dumps/text_index.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <algorithm>
#include <cstring>
#include <set>
#include <string_view>

#include "engine/base/number_text.hpp"
#include "engine/base/text.hpp"
#include "engine/base/word_reader.hpp"

namespace grainreel {

namespace {

namespace fs = std::filesystem;

constexpr std::string_view mark = "ITEM:";

struct PassedRows {
    std::int64_t rows = 0;
    bool unended = false;  // the last one has no line feed
};

// Counts the rows. A line with words is a row; memchr does most of the work.
class RowCounter {
  public:
    RowCounter(LineReader& lines, const fs::path& file, const DumpHead& head)
        : lines_(lines), file_(file), head_(head) {}

    PassedRows pass() {
        while (passed_.rows < head_.rows) {
            const std::string_view text = lines_.lines();
            if (text.empty()) break;
            const bool unended = lines_.unended();
            const std::int64_t before = passed_.rows;
            pass_block(text);
            passed_.unended = unended && passed_.rows > before;
        }
        return passed_;
    }

  private:
    void pass_block(std::string_view text) {
        const char* p = text.data();
        const char* const end = p + text.size();
        std::int64_t count = 0;
        while (p < end && passed_.rows < head_.rows) {
            const auto* const feed =
                static_cast<const char*>(std::memchr(p, '\n', static_cast<std::size_t>(end - p)));
            if (*p == 'I' && std::string_view(p, static_cast<std::size_t>(feed - p)).starts_with(mark))
                refuse_count(lines_.number() + count);
            if (*p > ' ' || has_words(p, feed)) ++passed_.rows;
            ++count;
            p = feed + 1;
        }
        lines_.take(static_cast<std::size_t>(p - text.data()), count);
    }

    static bool has_words(const char* p, const char* end) {
        return std::string_view(p, static_cast<std::size_t>(end - p)).find_first_not_of(" \t\r\v\f") !=
               std::string_view::npos;
    }

    [[noreturn]] void refuse_count(std::int64_t line) const {
        refuse_line(
            file_, line,
            fmt::format("the frame of step {} ends here after {} rows, and line {} says {}; did a run stop "
                        "within a frame and go on later? Cut this frame out of the file",
                        head_.step.value_or(0), passed_.rows, head_.line, head_.rows));
    }

    LineReader& lines_;
    const fs::path& file_;
    const DumpHead& head_;
    PassedRows passed_;
};

}  // namespace

void TextIndex::go_on(LineReader& lines, const fs::path& file) {
    cut.reset();
    // If the last row had no line feed, it may have become longer, so its frame is read again.
    if (unended && !frames.empty()) {
        end = frames.back().place;
        end_line = frames.back().line;
        frames.pop_back();
        unended = false;
    }
    lines.seek(end, end_line);
    while (take_frame(lines, file)) {
    }
    stream_cut = lines.cut_off();
}

bool TextIndex::take_frame(LineReader& lines, const fs::path& file) {
    DumpHead head;
    const HeadEnd found = read_head(lines, file, head);
    if (found == HeadEnd::nothing) return false;
    if (found == HeadEnd::cut) {
        // A time or units alone after the last rows begin a next frame only if the frames before have a time.
        if (!frames.empty() && !head.step && (head.time || !head.units.empty()) && !timed)
            refuse_line(
                file, head.line,
                "items stand behind the rows of the last frame, and no frame begins with them; items stand "
                "before the rows");
        cut_at(head, {.in_head = true});
        return false;
    }
    if (!head.names_ended && (head.rows > 0 || (!frames.empty() && head.names != names))) {
        cut_at(head, {.in_head = true});
        return false;
    }
    check(head, file);
    const PassedRows passed = RowCounter(lines, file, head).pass();
    if (passed.rows < head.rows) {
        cut_at(head, {.rows = passed.rows, .in_row = passed.unended});
        return false;
    }
    const std::uint64_t behind = lines.place();
    const std::int64_t behind_line = lines.number();
    TextLine next;
    const bool more = lines.next_with_words(next);
    if (more && !next.text.starts_with(mark) && !(!next.ended && mark.starts_with(next.text)))
        refuse_line(file, next.number,
                    fmt::format("one row more than the {} that line {} says for step {}, or damage",
                                head.rows, head.line, head.step.value_or(0)));
    if (more) lines.back(next);
    const bool open_end = passed.unended || !head.names_ended;
    if (passed.unended && !last_row_is_whole(lines, file, head, frames)) {
        cut_at(head, {.rows = passed.rows, .in_number = true});
        return false;
    }
    if (frames.empty()) {
        names = head.names;
        pairs = head.pairs;
    }
    if (units.empty()) units = head.units;
    timed = timed || head.time;
    frames.push_back({head.place, behind, head.line, *head.step, head.time, head.rows});
    end = behind;
    end_line = behind_line;
    unended = open_end;
    return more;
}

void TextIndex::check(const DumpHead& head, const fs::path& file) const {
    if (frames.empty()) return;
    if (head.names != names || head.pairs != pairs)
        refuse_line(
            file, head.names_line,
            fmt::format("the columns change here: \"{}\", and \"{}\" before; make a file of each part",
                        excerpt(fmt::format("{}", fmt::join(head.names, " "))),
                        excerpt(fmt::format("{}", fmt::join(names, " ")))));
    if (!head.units.empty() && !units.empty() && head.units != units)
        refuse_line(file, head.line,
                    fmt::format("the units change from {} to {}; make a file of each part", excerpt(units),
                                excerpt(head.units)));
}

void TextIndex::cut_at(const DumpHead& head, const CutFrame& how) {
    cut = how;
    cut->line = head.line;
    cut->step = head.step;
    cut->of = head.rows;
}

namespace {

namespace fs = std::filesystem;

constexpr std::size_t most_words = 20000;  // number of words that are looked at
constexpr std::size_t many = 12;           // so many words do not have the same form by chance

// How a number is written: digits after the point, characters from the "e" or "d" on, and significant digits.
struct Form {
    std::size_t decimals = 0, exponent = 0, digits = 0;
    bool same(const Form& other) const { return decimals == other.decimals && exponent == other.exponent; }
};

Form form_of(std::string_view word) {
    Form form;
    const std::size_t e = word.find_first_of("eEdD");
    const std::string_view mantissa = word.substr(0, e);
    if (e != std::string_view::npos) form.exponent = word.size() - e;
    const std::size_t point = mantissa.find('.');
    if (point != std::string_view::npos) form.decimals = mantissa.size() - point - 1;
    for (const char c : mantissa) {
        if (form.digits == 0 && (c == '0' || c == '.' || c == '-')) continue;
        if (c != '.') ++form.digits;
    }
    return form;
}

struct Row {
    std::size_t fields = 0;
    std::string last{};
    bool blank_behind = false;
};

Row row_of(std::string_view text) {
    Row row;
    row.blank_behind = !text.empty() && (text.back() == ' ' || text.back() == '\t' || text.back() == '\r');
    WordReader words(text);
    std::string_view last;
    for (std::string_view word = words.next_in_line(); !word.empty();
         word = words.next_in_line(), ++row.fields)
        last = word;
    row.last = std::string(last);
    return row;
}

// Reads rows from where `lines` stands. Returns the last row; the last words of the others go to `others`.
Row read_last_words(LineReader& lines, std::int64_t rows, std::vector<std::string>& others) {
    TextLine line;
    Row row;
    for (std::int64_t k = 0; k < rows && lines.next_with_words(line); ++k) {
        if (k > 0 && others.size() < most_words) others.push_back(row.last);
        if (k < static_cast<std::int64_t>(most_words) || k + 2 >= rows) row = row_of(line.text);
    }
    return row;
}

}  // namespace

LastWord judge_last_word(std::string_view word, const std::vector<std::string>& others) {
    if (!number_in(word, Dialect::programs) || word.back() == '.') return LastWord::cut;
    const bool is_beginning = std::any_of(others.begin(), others.end(), [&](const std::string& other) {
        return other.size() > word.size() && other.starts_with(word);
    });
    const std::set<std::string_view> different(others.begin(), others.end());
    const bool few = others.size() >= 4 && 2 * different.size() <= others.size();
    if (different.contains(word) && !is_beginning) return LastWord::whole;
    if (few) return different.contains(word) ? LastWord::open : LastWord::cut;
    if (others.empty()) return LastWord::open;

    const Form form = form_of(word), first = form_of(others.front());
    bool one_form = first.decimals > 0 || first.exponent > 0, exponents = form.exponent > 0;
    std::size_t digits = 0;
    for (const std::string& other : others) {
        const Form its = form_of(other);
        one_form = one_form && its.same(first);
        exponents = exponents || its.exponent > 0;
        digits = std::max(digits, its.digits);
    }
    if (one_form && others.size() >= many) return form.same(first) ? LastWord::whole : LastWord::cut;
    if (!exponents && form.decimals > 0 && digits >= 5 && form.digits >= digits) return LastWord::whole;
    return LastWord::open;
}

bool last_row_is_whole(LineReader& lines, const fs::path& file, const DumpHead& head,
                       const std::vector<DumpFrame>& before) {
    std::vector<std::string> others;
    lines.seek(head.rows_place, head.rows_line);
    const Row last = read_last_words(lines, head.rows, others);
    if (!head.names.empty() && last.fields != head.names.size()) return last.fields > head.names.size();
    if (last.blank_behind) return true;
    if (others.size() < many && !before.empty()) {
        const DumpFrame& former = before.back();
        lines.seek(former.place, former.line);
        DumpHead above;
        if (read_head(lines, file, above) == HeadEnd::whole)
            others.push_back(read_last_words(lines, former.rows, others).last);
    }
    const LastWord judged = judge_last_word(last.last, others);
    return judged == LastWord::whole || (judged == LastWord::open && before.empty());
}

}  // namespace grainreel
