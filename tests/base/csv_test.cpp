// Tests of tables of cells: how lines are split, which lines are rows, and where messages and writers look.
#include "engine/base/csv.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <sstream>
#include <string>
#include <vector>

#include "engine/base/error.hpp"

namespace grainreel {
namespace {

using testing::ElementsAre;
using Words = std::vector<std::string>;

Words words_of(const std::string& line, const CsvForm& form) {
    std::vector<CsvCell> cells;
    split_cells(line, form, cells);
    Words words;
    for (const CsvCell& cell : cells) words.emplace_back(cell.text);
    return words;
}

std::vector<std::size_t> columns_of(const std::string& line, const CsvForm& form) {
    std::vector<CsvCell> cells;
    split_cells(line, form, cells);
    std::vector<std::size_t> columns;
    for (const CsvCell& cell : cells) columns.push_back(cell.column);
    return columns;
}

TEST(CsvCells, StandBetweenSeparators) {
    const CsvForm commas;
    EXPECT_THAT(words_of("1,2.5,x", commas), ElementsAre("1", "2.5", "x"));
    EXPECT_THAT(words_of(" 1 ,\t2 , ", commas), ElementsAre("1", "2", ""));
    EXPECT_THAT(words_of(",,", commas), ElementsAre("", "", ""));
    EXPECT_THAT(words_of("alone", commas), ElementsAre("alone"));
    EXPECT_THAT(words_of("", commas), ElementsAre());
    EXPECT_THAT(words_of("1;2,5", {.separator = ';'}), ElementsAre("1", "2,5"));
    EXPECT_THAT(words_of("a b\t\t c\t", {.separator = '\t'}), ElementsAre("a b", "", "c", ""));
    EXPECT_THAT(words_of("  1 \t 2  3 ", {.separator = ' '}), ElementsAre("1", "2", "3"));
}

TEST(CsvCells, ClosedRowsHaveNoCellAfterTheLastSeparator) {
    EXPECT_THAT(words_of("1,2,", {.closed = true}), ElementsAre("1", "2"));
    EXPECT_THAT(words_of("1,2", {.closed = true}), ElementsAre("1", "2"));
    EXPECT_THAT(words_of("1,,", {.closed = true}), ElementsAre("1", ""));
}

TEST(CsvCells, MayStandInQuotes) {
    const CsvForm quotes{.quotes = true};
    EXPECT_THAT(words_of("\"a,b\",'c', \" d \" ,e", quotes), ElementsAre("a,b", "c", " d ", "e"));
    EXPECT_THAT(words_of("\"a\"\"b\",c", quotes), ElementsAre("a\"\"b", "c"));
    EXPECT_THAT(words_of("\"open,c", quotes), ElementsAre("\"open", "c"));
    EXPECT_THAT(words_of("\"a,b\"", {}), ElementsAre("\"a", "b\""));
}

TEST(CsvCells, KnowTheColumnOfTheirFirstCharacter) {
    EXPECT_THAT(columns_of("1,  2.5,,x", {}), ElementsAre(1, 5, 9, 10));
    EXPECT_THAT(columns_of("  1  2", {.separator = ' '}), ElementsAre(3, 6));
    EXPECT_THAT(columns_of("\"a\", \"b\"", {.quotes = true}), ElementsAre(2, 7));
}

struct Seen {
    std::vector<Words> rows;
    std::vector<std::int64_t> lines;
    std::vector<std::uintmax_t> bytes;
    std::vector<bool> ended;
};

Seen rows_of(const std::string& text, const CsvForm& form = {}) {
    std::istringstream stream(text);
    CsvRows rows(stream, "table.csv", form);
    Seen seen;
    while (rows.next()) {
        seen.rows.push_back(rows.words());
        seen.lines.push_back(rows.line());
        seen.bytes.push_back(rows.bytes());
        seen.ended.push_back(rows.ended());
    }
    return seen;
}

// A writer that continues a file keeps the bytes up to the end of a row. So these must be exact, with the
// mark and carriage returns that are in no cell.
TEST(CsvRows, CountLinesAndBytes) {
    const Seen seen = rows_of("a,b\n1,2\n\n3,4\n5,6");
    EXPECT_THAT(seen.rows, ElementsAre(Words{"a", "b"}, Words{"1", "2"}, Words{"3", "4"}, Words{"5", "6"}));
    EXPECT_THAT(seen.lines, ElementsAre(1, 2, 4, 5));
    EXPECT_THAT(seen.bytes, ElementsAre(4, 8, 13, 16));
    EXPECT_THAT(seen.ended, ElementsAre(true, true, true, false));

    const Seen windows = rows_of(
        "\xef\xbb\xbf"
        "a,b\r\n1,2\r\n");
    EXPECT_THAT(windows.rows, ElementsAre(Words{"a", "b"}, Words{"1", "2"}));
    EXPECT_THAT(windows.bytes, ElementsAre(8, 13));
}

TEST(CsvRows, PassOverRemarks) {
    const std::string text = "# a,b\n 1,2\n % c\n3,4\n";
    EXPECT_THAT(rows_of(text, {.remarks = "#%"}).rows, ElementsAre(Words{"1", "2"}, Words{"3", "4"}));
    EXPECT_THAT(rows_of(text, {.remarks = "#%"}).lines, ElementsAre(2, 4));
    EXPECT_EQ(rows_of(text).rows.size(), 4u);
}

TEST(CsvRows, FailWithTheirPlace) {
    std::istringstream stream("a,b\n\n1,x\n");
    CsvRows rows(stream, "table.csv");
    rows.next();
    rows.next();
    const auto words = [&](auto... where) {
        try {
            rows.fail(where...);
        } catch (const UserError& error) {
            return std::string(error.what());
        }
    };
    EXPECT_EQ(words("is wrong"), "table.csv:3: is wrong");
    EXPECT_EQ(words(rows.cells()[1].column, "is wrong"), "table.csv:3:3: is wrong");
}

}  // namespace
}  // namespace grainreel
