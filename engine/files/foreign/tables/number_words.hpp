// Words and numbers as programs write them into text files.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace grainreel {

// "1.5", "+1.5", ".5", "1.5d0" (Fortran), "nan", "inf", "-1.#IND" (NaN); numbers too small for a double are
// 0. None where the word is no number as a whole.
std::optional<double> number_of(std::string_view word);
// "324", "+324"; none for anything else and for what needs more than 64 bits.
std::optional<std::int64_t> whole_number_of(std::string_view word);

// Without blanks at both ends.
std::string_view trimmed(std::string_view text);
// Takes the first word off the text; empty at its end.
std::string_view take_word(std::string_view& text);
// All words of a line between blanks and tabs.
void split_words(std::string_view line, std::vector<std::string_view>& words);
std::vector<std::string_view> words_of(std::string_view line);
// How many words those are, up to `most`.
std::size_t count_words(std::string_view line, std::size_t most);
// The numbers of a line; none where one of its words is no number.
std::optional<std::vector<double>> numbers_of(std::string_view line);

// In ASCII letters.
std::string lower_case(std::string_view text);

// A word of a file for a message: in quotes, cut where it is long, without what a terminal cannot show.
std::string in_quotes(std::string_view word);

}  // namespace grainreel
