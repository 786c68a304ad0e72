// Text that came from outside: whether it is UTF-8, and as much of it as a message can hold.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace grainreel {

// The place of the first byte that is not part of UTF-8 (RFC 3629: no surrogates, no overlong forms); none
// when all of it is.
std::optional<std::size_t> first_byte_not_utf8(std::string_view text);

// Characters of a text that is UTF-8.
std::size_t letters_in(std::string_view text);

constexpr std::size_t kExcerpt = 60;  // characters of a user's text in a message

// For messages: at most so many characters of the text, with "..." for the rest. Control characters are
// written as TOML has them, \u001b, and bytes that are no UTF-8 as \xff.
std::string excerpt(std::string_view text, std::size_t most = kExcerpt);

// The first control character of the text: the ASCII and the C1 ones, and U+2028 and U+2029, which end lines.
std::optional<unsigned> first_control_character(std::string_view text);

// All of the text, with control characters and what is no UTF-8 written out as in an excerpt, but for the
// characters in `kept`. A terminal obeys nothing in it.
std::string visible(std::string_view text, std::string_view kept = "");

// A message of one line, as it goes to the terminal and to logs: visible, and without the middle of words
// that are longer than a path, and of a whole that is longer than a screen. What somebody typed, or a file
// held, may stand in it at any length.
std::string message_text(std::string_view text);

// "\"Gr\\xf6sse\" is not UTF-8 at byte 3, 0xf6" for text that is not; empty for text that is.
std::string complaint_of_utf8(std::string_view text);

// The mark that spreadsheets put before a table in UTF-8 ("CSV UTF-8").

inline constexpr std::string_view byte_order_mark = "\xef\xbb\xbf";

// Takes it off the front of a text or of its first line.
inline void drop_byte_order_mark(std::string& text) {
    if (text.starts_with(byte_order_mark)) text.erase(0, byte_order_mark.size());
}
inline void drop_byte_order_mark(std::string_view& text) {
    if (text.starts_with(byte_order_mark)) text.remove_prefix(byte_order_mark.size());
}

// Which name somebody meant who mistyped one.

// The nearest of `names` to `word`, by insertions, deletions, substitutions and swaps of neighbours
// (Damerau's distance). Empty when none is near: more than two slips, and more than a third of the word.
std::optional<std::string> nearest_name(std::string_view word, const std::vector<std::string>& names);

// Words for a POSIX shell.

// A word as a shell needs it typed: in single quotes where it has anything but letters, digits and harmless
// signs.
std::string shell_word(const std::string& word);
// Several, with spaces between them.
std::string shell_words(const std::vector<std::string>& words);

// Names of things as names of files.

// Text as a part of a file's name: letters, digits, "-", "." and "_" alone, at most `most` of them.
std::string file_name_part(const std::string& text, std::size_t most = 60);

}  // namespace grainreel
