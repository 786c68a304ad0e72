// Text that came from outside: whether it is UTF-8, and as much of it as a message can hold.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

namespace grainreel {

// The place of the first byte that is not part of UTF-8 (RFC 3629: no surrogates, no overlong forms); none
// when all of it is.
std::optional<std::size_t> first_byte_not_utf8(std::string_view text);

// Characters of a text that is UTF-8.
std::size_t letters_in(std::string_view text);

constexpr std::size_t kExcerpt = 60;  // characters of a user's text in a message

// For messages: at most so many characters of the text, with "..." for the rest. Bytes that are no UTF-8 and
// control characters are written as \xff.
std::string excerpt(std::string_view text, std::size_t most = kExcerpt);

// "\"Gr\\xf6sse\" is not UTF-8 at byte 3, 0xf6" for text that is not; empty for text that is.
std::string complaint_of_utf8(std::string_view text);

}  // namespace grainreel
