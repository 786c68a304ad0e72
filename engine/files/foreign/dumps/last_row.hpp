// Whether the last row of a text is whole that has no line feed behind it. A program that writes a dump ends
// each row with one, so that a missing one means: the row is being written, or the run died, or the file went
// through the hands of an editor or another program, which left it out.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "engine/files/foreign/dumps/line_reader.hpp"
#include "engine/files/foreign/dumps/text_head.hpp"

namespace grainreel {

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
