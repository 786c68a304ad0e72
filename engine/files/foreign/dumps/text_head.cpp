// Reads the head of one frame of a text dump of LAMMPS or LIGGGHTS, item by item.
#include "engine/files/foreign/dumps/text_index.hpp"

#include <fmt/format.h>

#include <string_view>

#include "engine/base/number_text.hpp"
#include "engine/base/text.hpp"
#include "engine/base/word_reader.hpp"
#include "engine/files/foreign/dumps/dump_parts.hpp"

namespace grainreel {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view mark = "ITEM:";

class HeadReader {
  public:
    HeadReader(LineReader& lines, const fs::path& file, DumpHead& head)
        : lines_(lines), file_(file), head_(head) {}

    HeadEnd read() {
        bool passing = false;  // whether the lines of an unknown item are skipped now
        bool any = false;
        while (lines_.next_with_words(line_)) {
            if (!line_.text.starts_with(mark)) {
                if (passing) continue;
                // If the last line is "ITE", it is the beginning of an item.
                if (!line_.ended && mark.starts_with(line_.text)) return HeadEnd::cut;
                refuse_other_line();
            }
            if (!any) {
                head_.place = line_.place;
                head_.line = line_.number;
                any = true;
            }
            const Found found = item(WordReader(line_.text.substr(mark.size())));
            if (found == Found::cut) return HeadEnd::cut;
            if (found == Found::rows) return HeadEnd::whole;
            passing = found == Found::unknown;
        }
        return any ? HeadEnd::cut : HeadEnd::nothing;
    }

  private:
    enum class Found { item, rows, unknown, cut };

    [[noreturn]] void refuse(const std::string& what) const { refuse_line(file_, line_.number, what); }

    [[noreturn]] void refuse_other_line() const {
        const std::string next = !head_.step   ? "TIMESTEP"
                                 : !counted_   ? "NUMBER OF ATOMS"
                                 : !head_.box  ? "BOX BOUNDS"
                                 : head_.pairs ? "ENTRIES"
                                               : "ATOMS";
        refuse(fmt::format(
            "\"{}\" stands where an \"ITEM: {}\" is expected; is a line missing or too much before it?",
            excerpt(line_.text), next));
    }

    Found item(WordReader words) {
        const std::string_view first = words.next_in_line(), rest = words.left();
        const std::string_view second = WordReader(rest).next_in_line();
        if (first == "TIMESTEP") return step();
        if (first == "TIME") return time();
        if (first == "UNITS") return units();
        if (first == "NUMBER" && second == "OF") return count(words);
        if (first == "BOX" && second == "BOUNDS") return box(words);
        if (first == "GRID")
            refuse("a dump of a grid (dump grid), which holds no grains; give the dump of the grains");
        if (first == "ATOMS" || first == "ENTRIES" || (counted_ && !label_.empty() && first == label_))
            return names(first, words);
        return Found::unknown;
    }

    // Takes the line after an item. Returns false where the content ends before it.
    bool value() { return lines_.next(line_); }

    // Called for a line that is no value. If the content ends within this line, the frame is cut; otherwise
    // the line is wrong.
    Found wrong(const std::string& what) const {
        if (!line_.ended) return Found::cut;
        refuse(what);
    }

    Found step() {
        if (head_.step)
            refuse(
                fmt::format("a new frame begins, but the frame of step {} has no rows; is the file damaged?",
                            *head_.step));
        if (!value()) return Found::cut;
        WordReader words(line_.text);
        const std::string_view word = words.next_in_line();
        const std::optional<std::int64_t> step = whole_in(word);
        if (!step || !words.next_in_line().empty())
            return wrong(
                fmt::format("\"{}\" is no number of a step; a whole number is expected below \"ITEM: "
                            "TIMESTEP\"",
                            excerpt(line_.text)));
        head_.step = step;
        return Found::item;
    }

    Found time() {
        if (!value()) return Found::cut;
        const std::optional<double> time = number_in(WordReader(line_.text).next_in_line());
        if (!time) return wrong(fmt::format("\"{}\" is no time", excerpt(line_.text)));
        head_.time = time;
        return Found::item;
    }

    Found units() {
        if (!value()) return Found::cut;
        if (!line_.ended) return Found::cut;
        head_.units = std::string(WordReader(line_.text).next_in_line());
        return Found::item;
    }

    Found count(WordReader words) {
        words.next_in_line();
        label_ = std::string(words.next_in_line());
        head_.pairs = label_ != "ATOMS";
        if (!value()) return Found::cut;
        WordReader number(line_.text);
        const std::string_view word = number.next_in_line();
        const std::optional<std::int64_t> rows = whole_in(word);
        if (!rows || *rows < 0 || !number.next_in_line().empty())
            return wrong(fmt::format("\"{}\" is no number of {}", excerpt(line_.text),
                                     head_.pairs ? "entries" : "grains"));
        head_.rows = *rows;
        counted_ = true;
        return Found::item;
    }

    Found box(WordReader words) {
        words.next_in_line();
        BoxReader reader(words.left());
        for (int k = 0; k < 3; ++k) {
            if (!value()) return Found::cut;
            const std::string complaint = reader.take(line_.text);
            if (!complaint.empty()) return wrong(complaint);
        }
        if (const std::string complaint = reader.finish(head_.rows == 0); !complaint.empty())
            refuse(complaint);
        head_.box = reader.box();
        return Found::item;
    }

    Found names(std::string_view item, WordReader words) {
        if (!head_.step)
            refuse(fmt::format("rows without a step: \"ITEM: TIMESTEP\" is missing above line {}",
                               line_.number));
        if (!counted_)
            refuse(fmt::format("rows without their number: \"ITEM: NUMBER OF {}\" is missing above line {}",
                               excerpt(item), line_.number));
        constexpr std::size_t most_names = 10000;
        for (std::string_view name = words.next_in_line(); !name.empty(); name = words.next_in_line()) {
            if (head_.names.size() == most_names)
                refuse(fmt::format("more than {} columns; is this a dump?", most_names));
            head_.names.emplace_back(name);
        }
        head_.pairs = item != "ATOMS";
        head_.names_line = line_.number;
        head_.names_ended = line_.ended;
        head_.rows_place = lines_.place();
        head_.rows_line = lines_.number();
        return Found::rows;
    }

    LineReader& lines_;
    const fs::path& file_;
    DumpHead& head_;
    TextLine line_;
    bool counted_ = false;
    std::string label_;  // the word after NUMBER OF: what is counted
};

}  // namespace

HeadEnd read_head(LineReader& lines, const fs::path& file, DumpHead& head) {
    head = {};
    return HeadReader(lines, file, head).read();
}

}  // namespace grainreel
