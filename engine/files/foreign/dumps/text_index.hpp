// What stands above the rows of one frame of a text dump: "ITEM: TIMESTEP", "ITEM: NUMBER OF ATOMS", ... up
// to "ITEM: ATOMS id type x y z" or, in a dump of pairs, "ITEM: ENTRIES c_1[1] c_1[2]".
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "engine/files/foreign/dumps/text_rows.hpp"
#include "engine/files/frames/world.hpp"

namespace grainreel {

struct DumpHead {
    std::uint64_t place = 0;  // of the first item
    std::int64_t line = 0;
    std::optional<std::int64_t> step{};
    std::optional<double> time{};
    std::string units{};  // empty where the frame does not say
    std::optional<WorldCell> box{};
    std::int64_t rows = 0;
    bool pairs = false;                // a dump local: rows are no grains
    std::vector<std::string> names{};  // of the columns; none in dumps of before 2010
    std::int64_t names_line = 0;
    bool names_ended = true;       // whether a line feed stands behind them
    std::uint64_t rows_place = 0;  // of the first row
    std::int64_t rows_line = 0;
};

enum class HeadEnd {
    whole,    // the rows come next
    nothing,  // the content ended before
    cut       // the content ended within the head
};

// Throws UserError with the line where something stands that is no head. Where the result is cut, `head` has
// what was whole.
HeadEnd read_head(LineReader& lines, const std::filesystem::path& file, DumpHead& head);

// Where the frames of a text dump lie. One pass over the file finds them; it reads the heads and counts the
// rows.

struct DumpFrame {
    std::uint64_t place = 0, end = 0;  // from the first item to behind the last row, in the unpacked content
    std::int64_t line = 0;             // of the first item
    std::int64_t step = 0;
    std::optional<double> time{};
    std::int64_t rows = 0;
};

// A frame at the end of the content that is not whole.
struct CutFrame {
    std::int64_t line = 0;  // where it begins
    std::optional<std::int64_t> step{};
    bool in_head = false;
    std::int64_t rows = 0, of = 0;  // how many there are
    bool in_row = false;            // the last row is not whole
    bool in_number = false;  // the last row has all its fields, but what the last one is cannot be known
};

struct TextIndex {
    std::vector<DumpFrame> frames;
    std::vector<std::string> names;  // of the columns, as the file says; none in old dumps
    bool pairs = false;              // a dump local
    bool timed = false;              // a frame has a time
    std::string units;
    // Behind the last whole frame.
    std::uint64_t end = 0;
    std::int64_t end_line = 1;
    bool unended = false;  // the last frame's last row has no line feed behind it
    std::optional<CutFrame> cut{};
    bool stream_cut = false;  // the packed stream ends before its end

    // Frames behind those that are known. Throws UserError with the line where the content is none of a dump.
    void go_on(LineReader& lines, const std::filesystem::path& file);

  private:
    bool take_frame(LineReader& lines, const std::filesystem::path& file);
    void check(const DumpHead& head, const std::filesystem::path& file) const;
    void cut_at(const DumpHead& head, const CutFrame& how);
};

// Whether the last row of a text is whole that has no line feed behind it. A program that writes a dump ends
// each row with one, so that a missing one means: the row is being written, or the run died, or the file went
// through the hands of an editor or another program, which left it out.

struct DumpFrame;

enum class LastWord { whole, cut, open };

// What the last word of a text is, judged by the words above it in its column. It is
//  cut where it is no number yet ("1.5e", "-", "0.");
//  whole where another row has the same word, and cut where the column has few different words, such as
//  radii,
//    and this is none of them ("0.0" among 0.0015 and 0.0019);
//  whole or cut by its form where all others have one form, as "%.8f" and "%.16e" write;
//  whole where it has as many digits as any other, for "%g" writes no more than six;
//  open else: "0.38212" may be a number of five digits, or one of six that is cut.
LastWord judge_last_word(std::string_view word, const std::vector<std::string>& others);

// head: of the frame whose rows end the content; before: the frames before it. What stays open is whole in
// the only frame of a file, for a file that was made by hand is read then. Behind other frames it is not.
bool last_row_is_whole(LineReader& lines, const std::filesystem::path& file, const DumpHead& head,
                       const std::vector<DumpFrame>& before);

}  // namespace grainreel
