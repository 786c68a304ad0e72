// The mark that spreadsheets put before a table in UTF-8 ("CSV UTF-8").
#pragma once

#include <string>
#include <string_view>

namespace grainreel {

inline constexpr std::string_view byte_order_mark = "\xef\xbb\xbf";

// Takes it off the front of a text or of its first line.
inline void drop_byte_order_mark(std::string& text) {
    if (text.starts_with(byte_order_mark)) text.erase(0, byte_order_mark.size());
}
inline void drop_byte_order_mark(std::string_view& text) {
    if (text.starts_with(byte_order_mark)) text.remove_prefix(byte_order_mark.size());
}

}  // namespace grainreel
