#include "engine/base/text.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <cctype>
#include <numeric>

namespace grainreel {

namespace {

bool follows(std::string_view text, std::size_t at) {
    return at < text.size() && (static_cast<unsigned char>(text[at]) & 0xc0) == 0x80;
}

// Number of bytes of the character at `at`, or 0 where there is no valid one. RFC 3629, section 4.
std::size_t length_of_character(std::string_view text, std::size_t at) {
    const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
    const unsigned first = byte(at);
    if (first < 0x80) return 1;
    const std::size_t length = first >= 0xf0 ? 4 : first >= 0xe0 ? 3 : 2;
    if (first < 0xc2 || first > 0xf4) return 0;
    for (std::size_t i = 1; i < length; ++i)
        if (!follows(text, at + i)) return 0;
    const unsigned second = byte(at + 1);
    const bool overlong = (first == 0xe0 && second < 0xa0) || (first == 0xf0 && second < 0x90);
    const bool surrogate = first == 0xed && second > 0x9f;
    const bool beyond = first == 0xf4 && second > 0x8f;
    return overlong || surrogate || beyond ? 0 : length;
}

}  // namespace

std::optional<std::size_t> first_byte_not_utf8(std::string_view text) {
    for (std::size_t at = 0; at < text.size();) {
        const std::size_t length = length_of_character(text, at);
        if (length == 0) return at;
        at += length;
    }
    return std::nullopt;
}

std::size_t letters_in(std::string_view text) {
    return static_cast<std::size_t>(std::count_if(
        text.begin(), text.end(), [](char c) { return (static_cast<unsigned char>(c) & 0xc0) != 0x80; }));
}

namespace {

// The code of the control character at `at`, which is `length` bytes long: C0, DEL, C1, or one of the two
// ends of lines that Unicode adds. None for another character.
std::optional<unsigned> control_at(std::string_view text, std::size_t at, std::size_t length) {
    const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[at + i]); };
    if (length == 1 && (byte(0) < 0x20 || byte(0) == 0x7f)) return byte(0);
    if (length == 2 && byte(0) == 0xc2 && byte(1) < 0xa0) return byte(1);
    if (length == 3 && byte(0) == 0xe2 && byte(1) == 0x80 && (byte(2) == 0xa8 || byte(2) == 0xa9))
        return 0x2000u + (byte(2) & 0x3fu);
    return std::nullopt;
}

// The character at `at` as it may be shown, and its number of bytes in the text.
struct Shown {
    std::string text;
    std::size_t length = 1;
};
Shown shown_at(std::string_view text, std::size_t at) {
    const std::size_t length = length_of_character(text, at);
    if (length == 0) return {fmt::format("\\x{:02x}", static_cast<unsigned char>(text[at])), 1};
    if (const auto control = control_at(text, at, length))
        return {fmt::format("\\u{:04x}", *control), length};
    return {std::string(text.substr(at, length)), length};
}

// The end of the character in which `from` lies.
std::size_t end_of_character(std::string_view text, std::size_t from) {
    while (follows(text, from)) ++from;
    return from;
}

// The text without its middle if it has more than `most` bytes. Two thirds of what stays are its beginning.
std::string without_middle(std::string_view text, std::size_t most) {
    if (text.size() <= most) return std::string(text);
    const std::size_t head = end_of_character(text, most * 2 / 3),
                      tail = end_of_character(text, text.size() - most / 3);
    return fmt::format("{}...{}", text.substr(0, head), text.substr(tail));
}

}  // namespace

std::string excerpt(std::string_view text, std::size_t most) {
    std::string result;
    std::size_t characters = 0;
    for (std::size_t at = 0; at < text.size(); ++characters) {
        if (characters == most) return result + "...";
        const Shown shown = shown_at(text, at);
        result += shown.text;
        at += shown.length;
    }
    return result;
}

std::optional<unsigned> first_control_character(std::string_view text) {
    for (std::size_t at = 0; at < text.size();) {
        const std::size_t length = length_of_character(text, at);
        if (const auto control = control_at(text, at, length)) return control;
        at += length == 0 ? 1 : length;
    }
    return std::nullopt;
}

std::string visible(std::string_view text, std::string_view kept) {
    std::string result;
    for (std::size_t at = 0; at < text.size();) {
        if (kept.find(text[at]) != std::string_view::npos) {
            result += text[at++];
            continue;
        }
        const Shown shown = shown_at(text, at);
        result += shown.text;
        at += shown.length;
    }
    return result;
}

std::string message_text(std::string_view text) {
    constexpr std::size_t longest_word = 300, longest = 4000;  // bytes
    std::string result;
    for (std::size_t at = 0; at < text.size();) {
        const std::size_t end = std::min(text.size(), text.find(' ', at));
        result += without_middle(visible(text.substr(at, end - at)), longest_word);
        if (end < text.size()) result += ' ';
        at = end + 1;
    }
    return without_middle(result, longest);
}

std::string complaint_of_utf8(std::string_view text) {
    const std::optional<std::size_t> bad = first_byte_not_utf8(text);
    if (!bad) return "";
    return fmt::format("\"{}\" is not UTF-8 at byte {}, 0x{:02x}", excerpt(text), *bad + 1,
                       static_cast<unsigned char>(text[*bad]));
}

namespace {

std::size_t edit_distance(std::string_view a, std::string_view b) {
    std::vector<std::size_t> before(b.size() + 1), above(b.size() + 1), row(b.size() + 1);
    std::iota(above.begin(), above.end(), std::size_t{0});
    for (std::size_t i = 1; i <= a.size(); ++i) {
        row[0] = i;
        for (std::size_t j = 1; j <= b.size(); ++j) {
            const std::size_t substituted = above[j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1);
            row[j] = std::min({above[j] + 1, row[j - 1] + 1, substituted});
            const bool swapped = i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1];
            if (swapped) row[j] = std::min(row[j], before[j - 2] + 1);
        }
        std::swap(before, above);
        std::swap(above, row);
    }
    return above[b.size()];
}

}  // namespace

std::optional<std::string> nearest_name(std::string_view word, const std::vector<std::string>& names) {
    const auto nearest = std::min_element(names.begin(), names.end(), [&](const auto& a, const auto& b) {
        return edit_distance(word, a) < edit_distance(word, b);
    });
    const std::size_t most = std::max<std::size_t>(2, word.size() / 3);
    if (nearest == names.end() || edit_distance(word, *nearest) > most) return std::nullopt;
    return *nearest;
}

std::string_view trimmed(std::string_view text, std::string_view blanks) {
    const std::size_t first = text.find_first_not_of(blanks);
    if (first == std::string_view::npos) return {};
    return text.substr(first, text.find_last_not_of(blanks) - first + 1);
}

std::string shell_word(const std::string& word) {
    const std::string plain = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-+=./:,@%";
    if (!word.empty() && word.find_first_not_of(plain) == std::string::npos) return word;
    std::string result = "'";
    for (const char c : word) result += c == '\'' ? "'\\''" : std::string(1, c);
    return result + "'";
}

std::string shell_words(const std::vector<std::string>& words) {
    std::string line;
    for (const std::string& word : words) line += (line.empty() ? "" : " ") + shell_word(word);
    return line;
}

std::string file_name_part(const std::string& text, std::size_t most) {
    std::string name;
    for (const char c : text) {
        const auto byte = static_cast<unsigned char>(c);
        const bool plain = byte < 0x80 && (std::isalnum(byte) || c == '-' || c == '.' || c == '_');
        if (c != ' ') name += plain ? c : '-';
    }
    if (name.empty() || name.front() == '.') name.insert(0, 1, '_');
    return name.substr(0, most);
}

}  // namespace grainreel
