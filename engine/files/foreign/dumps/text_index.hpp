// Reads the heads of text dumps, and finds where the frames of a file lie. This takes one pass over the file,
// which reads heads and counts rows. The rows themselves are read in text_rows.hpp.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "engine/files/foreign/dumps/text_rows.hpp"
#include "engine/files/frames/stored_world.hpp"

namespace grainreel {

// What stands above the rows of a frame: "ITEM: TIMESTEP", "ITEM: NUMBER OF ATOMS", ... up to "ITEM: ATOMS id
// type x y z" or, in a dump of pairs, "ITEM: ENTRIES c_1[1] c_1[2]".
struct DumpHead {
    std::uint64_t place = 0;  // where the first item begins
    std::int64_t line = 0;
    std::optional<std::int64_t> step{};
    std::optional<double> time{};
    std::string units{};  // empty where the frame does not name them
    std::optional<WorldCell> box{};
    std::int64_t rows = 0;
    bool pairs = false;                // a dump local, whose rows are not grains
    std::vector<std::string> names{};  // names of the columns; none in dumps of before 2010
    std::int64_t names_line = 0;
    bool names_ended = true;       // whether their line ends with a line feed
    std::uint64_t rows_place = 0;  // where the first row begins
    std::int64_t rows_line = 0;
};

enum class HeadEnd {
    whole,    // the rows follow
    nothing,  // the content ended before the head
    cut       // the content ended within the head
};

// Reads a head. Throws UserError with the line where something else stands there. If the result is `cut`,
// `head` has what could be read.
HeadEnd read_head(LineReader& lines, const std::filesystem::path& file, DumpHead& head);

struct DumpFrame {
    // Where the frame begins and ends, in bytes of the unpacked content.
    std::uint64_t place = 0, end = 0;
    std::int64_t line = 0;  // number of the line of its first item
    std::int64_t step = 0;
    std::optional<double> time{};
    std::int64_t rows = 0;
};

// A frame at the end of the content that is not whole.
struct CutFrame {
    std::int64_t line = 0;  // where it begins
    std::optional<std::int64_t> step{};
    bool in_head = false;
    std::int64_t rows = 0, of = 0;  // rows that are there, and rows that the head claims
    bool in_row = false;            // the last row is not whole
    bool in_number = false;         // the last row has all fields, but its last number may be cut
};

struct TextIndex {
    std::vector<DumpFrame> frames;
    std::vector<std::string> names;  // names of the columns as in the file; none in old dumps
    bool pairs = false;              // a dump local
    bool timed = false;              // a frame has a time
    std::string units;
    // Place and line after the last whole frame.
    std::uint64_t end = 0;
    std::int64_t end_line = 1;
    bool unended = false;  // the last row of the last frame has no line feed
    std::optional<CutFrame> cut{};
    bool stream_cut = false;  // the packed file is cut off

    // Finds the frames after those that are known. Throws UserError with the line where the content is no
    // dump, or its columns or units change.
    void go_on(LineReader& lines, const std::filesystem::path& file);

  private:
    bool take_frame(LineReader& lines, const std::filesystem::path& file);
    void check(const DumpHead& head, const std::filesystem::path& file) const;
    void cut_at(const DumpHead& head, const CutFrame& how);
};

enum class LastWord { whole, cut, open };

// Judges the last word of a text without a line feed by the words above it in its column. Programs end each
// row of a dump with a line feed. If it is missing, the row is still being written, or the run died, or an
// editor left it out. The word is
//  - cut where it is not a number yet ("1.5e", "-", "0.");
//  - whole where another row has the same word, and none has a longer one that begins with it;
//  - cut where the column has only a few different words, such as radii, and this is not one of them;
//  - whole or cut by its form where there are twelve others or more, all of one form, as "%.8f" and "%.16e"
//    write;
//  - whole where it has five digits or more, at least as many as any other, because "%g" writes at most six;
//  - otherwise open: "0.38212" may be a number of five digits, or one of six that is cut.
LastWord judge_last_word(std::string_view word, const std::vector<std::string>& others);

// Whether the last row of the content is whole. head: the head of its frame; before: the frames before that
// one. Where the last word stays open, the row counts as whole in the only frame of a file, which may have
// been made by hand, and as cut after other frames.
bool last_row_is_whole(LineReader& lines, const std::filesystem::path& file, const DumpHead& head,
                       const std::vector<DumpFrame>& before);

}  // namespace grainreel
