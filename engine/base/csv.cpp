#include "engine/base/csv.hpp"

#include <algorithm>
#include <utility>

#include "engine/base/error.hpp"
#include "engine/base/text.hpp"
#include "engine/base/word_reader.hpp"

namespace grainreel {
namespace {

// Characters that may stand around a cell. A tab does not where it separates cells.
std::string_view blanks_for(const CsvForm& form) {
    return form.separator == '\t' ? " \r\v\f" : " \t\r\v\f";
}

// The place of the next separator from `from` on, or the end of the line.
std::size_t separator_after(std::string_view line, std::size_t from, const CsvForm& form) {
    const std::size_t place =
        form.separator == ' ' ? line.find_first_of(" \t", from) : line.find(form.separator, from);
    return std::min(place, line.size());
}

// The place of the quote that ends the cell whose quote stands at `open`; npos where none does.
std::size_t closing_quote(std::string_view line, std::size_t open) {
    const char quote = line[open];
    std::size_t close = line.find(quote, open + 1);
    while (close != std::string_view::npos && close + 1 < line.size() && line[close + 1] == quote)
        close = line.find(quote, close + 2);  // a doubled quote stands for one
    return close;
}

}  // namespace

void split_cells(std::string_view line, const CsvForm& form, std::vector<CsvCell>& cells) {
    cells.clear();
    const std::string_view blanks = blanks_for(form);
    const std::size_t last = line.find_last_not_of(blanks);
    if (last == std::string_view::npos) return;
    line = line.substr(0, last + 1);
    for (std::size_t from = 0; from <= line.size();) {
        const std::size_t first = std::min(line.find_first_not_of(blanks, from), line.size());
        const bool quote = form.quotes && first < line.size() && (line[first] == '"' || line[first] == '\'');
        const std::size_t close = quote ? closing_quote(line, first) : std::string_view::npos;
        const std::size_t end =
            separator_after(line, close == std::string_view::npos ? first : close + 1, form);
        if (close == std::string_view::npos)
            cells.push_back({trimmed(line.substr(first, end - first), blanks), first + 1});
        else
            cells.push_back({line.substr(first + 1, close - first - 1), first + 2});
        from = end + 1;
    }
    if (form.closed && cells.size() > 1 && cells.back().text.empty()) cells.pop_back();
}

CsvRows::CsvRows(std::istream& text, std::filesystem::path file, CsvForm form)
    : stream_(text), file_(std::move(file)), form_(form) {}

bool CsvRows::next() {
    while (std::getline(stream_, line_text_)) {
        ++line_;
        ended_ = !stream_.eof();
        bytes_ += line_text_.size() + (ended_ ? 1 : 0);
        text_ = line_text_;
        if (line_ == 1) drop_byte_order_mark(text_);
        if (text_.ends_with('\r')) text_.remove_suffix(1);
        const std::string_view filled = trimmed(text_);
        if (filled.empty() || form_.remarks.find(filled.front()) != std::string_view::npos) continue;
        split_cells(text_, form_, cells_);
        return true;
    }
    return false;
}

std::vector<std::string> CsvRows::words() const {
    std::vector<std::string> words;
    for (const CsvCell& cell : cells_) words.emplace_back(cell.text);
    return words;
}

void CsvRows::fail(const std::string& what) const {
    refuse_line(file_, line_, what);
}

void CsvRows::fail(std::size_t column, const std::string& what) const {
    throw UserError("{}:{}:{}: {}", file_.string(), line_, column, what);
}

}  // namespace grainreel
