// Reads tables of cells: our own CSV files, and those that people and other programs write. A reader says by
// CsvForm how the cells stand in a line. What a cell means is the reader's business.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <istream>
#include <string>
#include <string_view>
#include <vector>

namespace grainreel {

// How a table of cells is written.
struct CsvForm {
    char separator = ',';        // ' ' stands for any number of blanks and tabs
    bool quotes = false;         // cells may stand in "" or '', and a doubled quote within stands for one
    bool closed = false;         // each row ends with a separator, after which there is no cell
    std::string_view remarks{};  // lines that begin with one of these characters are passed over
};

struct CsvCell {
    std::string_view text;   // without the blanks and quotes around it; doubled quotes are left as they are
    std::size_t column = 1;  // of its first character, from 1, for messages
};

// Splits a line into its cells. An empty line has none. The cells are views of the line.
void split_cells(std::string_view line, const CsvForm& form, std::vector<CsvCell>& cells);

// The rows of a table, one after the other. A byte order mark and carriage returns are dropped. Blank lines
// and remarks are passed over.
class CsvRows {
  public:
    // file: the file's name for messages.
    CsvRows(std::istream& text, std::filesystem::path file, CsvForm form = {});

    // Goes to the next row. Returns false at the end of the text.
    bool next();

    // The present row. Its text and cells are valid until the next call of next().
    std::string_view text() const { return text_; }
    const std::vector<CsvCell>& cells() const { return cells_; }
    std::vector<std::string> words() const;  // the cells' texts
    // Whether a line feed ends it. If none does, the row may be cut off.
    bool ended() const { return ended_; }

    // Number of the line that was read last, from 1.
    std::int64_t line() const { return line_; }
    // Number of bytes up to the next line. A writer that continues the file after this row keeps so many.
    std::uintmax_t bytes() const { return bytes_; }

    // These throw UserError "FILE:LINE: what" and "FILE:LINE:COLUMN: what".
    [[noreturn]] void fail(const std::string& what) const;
    [[noreturn]] void fail(std::size_t column, const std::string& what) const;

  private:
    std::istream& stream_;
    std::filesystem::path file_;
    CsvForm form_;
    std::string line_text_;
    std::string_view text_;
    std::vector<CsvCell> cells_;
    bool ended_ = false;
    std::int64_t line_ = 0;
    std::uintmax_t bytes_ = 0;
};

}  // namespace grainreel
