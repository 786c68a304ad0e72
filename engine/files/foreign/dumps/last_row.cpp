#include "engine/files/foreign/dumps/last_row.hpp"

#include <algorithm>
#include <set>

#include "engine/files/foreign/dumps/text_index.hpp"
#include "engine/files/foreign/numbers/decimal.hpp"
#include "engine/mesh/file/words.hpp"

namespace grainreel {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t most_words = 20000;  // that are looked at
constexpr std::size_t many = 12;           // words whose common form is no chance

struct Form {
    std::size_t decimals = 0, exponent = 0, digits = 0;  // digits: significant ones
    bool same(const Form& other) const { return decimals == other.decimals && exponent == other.exponent; }
};

Form form_of(std::string_view word) {
    Form form;
    const std::size_t e = word.find_first_of("eE");
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
    Words words(text);
    std::string_view last;
    for (std::string_view word = words.next_in_line(); !word.empty();
         word = words.next_in_line(), ++row.fields)
        last = word;
    row.last = std::string(last);
    return row;
}

// From where `lines` stands. Returns the last row; the last words of those before it go to `others`.
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
    double value = 0;
    if (!any_number(word, value) || word.back() == '.') return LastWord::cut;
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
