#include "engine/files/foreign/dumps/text_rows.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <map>
#include <string_view>

#include "engine/base/number_text.hpp"
#include "engine/base/text.hpp"
#include "engine/base/word_reader.hpp"
#include "engine/files/foreign/bytes/decimal.hpp"
#include "engine/files/foreign/dumps/dump_parts.hpp"

namespace grainreel {

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
