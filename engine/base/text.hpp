// Text from outside and text for people: UTF-8, excerpts for messages, names that somebody mistyped, words
// for a shell and names for files. Text from a user or a file goes into a message only through these
// functions.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace grainreel {

// The place of the first byte that is not valid UTF-8 (RFC 3629: no surrogates, no overlong forms); none when
// the whole text is valid.
std::optional<std::size_t> first_byte_not_utf8(std::string_view text);

// Number of characters of a text in UTF-8.
std::size_t letters_in(std::string_view text);

constexpr std::size_t kExcerpt = 60;  // characters of a user's text in a message

// The text for a message, with at most `most` characters and "..." in place of the rest. Control characters
// are written as in TOML, \u001b, and bytes that are not UTF-8 as \xff.
std::string excerpt(std::string_view text, std::size_t most = kExcerpt);

// The first control character of the text: one of ASCII or C1, or U+2028 or U+2029, which end lines.
std::optional<unsigned> first_control_character(std::string_view text);

// The whole text with control characters and wrong bytes written out as in an excerpt, so that a terminal
// obeys nothing in it. Characters in `kept` stay as they are.
std::string visible(std::string_view text, std::string_view kept = "");

// A message of one line as it goes to the terminal and to logs. It is made visible(); words longer than a
// path lose their middle, and so does a message longer than a screen. The message may contain text from a
// user or a file at any length.
std::string message_text(std::string_view text);

// "\"Gr\\xf6sse\" is not UTF-8 at byte 3, 0xf6" for a text that is not valid; empty for one that is.
std::string complaint_of_utf8(std::string_view text);

// The byte order mark that spreadsheets put before a table in UTF-8 ("CSV UTF-8").
inline constexpr std::string_view byte_order_mark = "\xef\xbb\xbf";

// Removes the mark from the front of a text or of its first line.
inline void drop_byte_order_mark(std::string& text) {
    if (text.starts_with(byte_order_mark)) text.erase(0, byte_order_mark.size());
}
inline void drop_byte_order_mark(std::string_view& text) {
    if (text.starts_with(byte_order_mark)) text.remove_prefix(byte_order_mark.size());
}

// The name that a mistyped `word` probably means: the nearest of `names` by insertions, deletions,
// substitutions and swaps of neighbours (Damerau's distance). None where more than two letters and more than
// a third of the word are wrong.
std::optional<std::string> nearest_name(std::string_view word, const std::vector<std::string>& names);

// The text without blanks at both ends, as a view of the given text.
std::string_view trimmed(std::string_view text, std::string_view blanks = " \t\r\n\v\f");

// A word as it must be typed into a POSIX shell: in single quotes, unless it has only letters, digits and
// harmless signs.
std::string shell_word(const std::string& word);
// Several such words with spaces between them.
std::string shell_words(const std::vector<std::string>& words);

// A text as part of a file's name: only letters, digits, "-", "." and "_", and at most `most` of them.
std::string file_name_part(const std::string& text, std::size_t most = 60);

}  // namespace grainreel
