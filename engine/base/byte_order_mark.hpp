// The mark that spreadsheets put before a table in UTF-8 ("CSV UTF-8").
#pragma once

#include <string>
#include <string_view>

namespace grainreel {

// Takes it off the front of a text or of its first line.
inline void drop_byte_order_mark(std::string& text) {
    constexpr std::string_view mark = "\xef\xbb\xbf";
    if (text.starts_with(mark)) text.erase(0, mark.size());
}

}  // namespace grainreel
