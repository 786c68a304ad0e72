#include "engine/files/foreign/vtk/legacy_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>

#include "engine/base/text.hpp"
#include "engine/base/word_reader.hpp"
#include "engine/files/foreign/vtk/vtk_numbers.hpp"

namespace grainreel {
namespace {

constexpr bool is_blank(char c) {
    return c == ' ' || (c >= '\t' && c <= '\r');
}
constexpr bool is_letter(char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z');
}

}  // namespace

void LegacyText::refuse(const std::string& what) const {
    if (binary_) refuse_vtk_byte(file_, last_, what);
    refuse_vtk_line(file_, line_of_byte(bytes_, last_), what);
}

std::size_t LegacyText::place_of(const char* byte) const {
    return static_cast<std::size_t>(byte - bytes_.data());
}

std::string_view LegacyText::line() {
    const std::size_t end = std::min(bytes_.find('\n', at_), bytes_.size());
    std::string_view text = bytes_.substr(at_, end - at_);
    last_ = at_;
    at_ = std::min(end + 1, bytes_.size());
    if (text.ends_with('\r')) text.remove_suffix(1);
    return text;
}

std::string_view LegacyText::word() {
    const std::string_view next = WordReader(bytes_.substr(at_)).next();
    last_ = place_of(next.data());
    at_ = last_ + next.size();
    return next;
}

std::string_view LegacyText::peek() {
    const std::size_t before = at_;
    const std::string_view next = word();
    at_ = before;
    return next;
}

std::string_view LegacyText::word_in_line() {
    while (at_ < bytes_.size() && is_blank(bytes_[at_]) && bytes_[at_] != '\n') ++at_;
    if (at_ == bytes_.size() || bytes_[at_] == '\n') return {};
    return word();
}

bool LegacyText::at_end() {
    WordReader words(bytes_.substr(at_));
    const bool more = words.has_word();
    at_ = place_of(words.left().data());
    return !more;
}

std::uint64_t LegacyText::count(const char* what) {
    const std::string_view text = word();
    std::uint64_t value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc() || end != text.data() + text.size() || value > (std::uint64_t{1} << 48))
        refuse(fmt::format("\"{}\" is not {}; {}", excerpt(text), what, kWriteAgain));
    return value;
}

VtkType LegacyText::type(const char* what) {
    const std::string_view text = word();
    const auto found = vtk_legacy_type(text);
    if (!found) refuse(fmt::format("numbers of type \"{}\" for {}, which are not read", excerpt(text), what));
    return *found;
}

void LegacyText::check_room(std::uint64_t count) const {
    // Each number takes a digit and something between it and the next.
    if (count > (bytes_.size() - at_) / 2 + 1)
        refuse(
            fmt::format("{} numbers, for which the rest of the file is too short; {}", count, kWriteAgain));
}

std::string_view LegacyText::stored(VtkType type, std::uint64_t count) {
    line();
    const std::uint64_t size = bytes_of(type, count);
    last_ = at_;
    if (size > bytes_.size() - at_)
        refuse(fmt::format("an array of {} bytes begins here, and {} are left; {}", size, bytes_.size() - at_,
                           kWriteAgain));
    at_ += size;
    return bytes_.substr(last_, size);
}

template <class T>
std::vector<T> LegacyText::numbers(VtkType type, std::uint64_t count, bool finite) {
    std::vector<T> values;
    if (binary_) {
        const std::string_view bytes = stored(type, count);
        widen(bytes, type, true, count, values);
        for (std::size_t i = 0; finite && i < values.size(); ++i)
            if (!std::isfinite(static_cast<double>(values[i])))
                refuse_vtk_byte(file_, last_ + bytes_of(type, i),
                                "a place that is no number; remove the point or write its place");
        return values;
    }
    check_room(count);
    values.reserve(count);
    WordReader words(bytes_.substr(at_));
    for (std::uint64_t i = 0; i < count; ++i) {
        const std::optional<double> value = words.next_number();
        if (!value || (finite && !std::isfinite(*value))) refuse_number(i, count, words);
        if constexpr (std::is_integral_v<T>)
            values.push_back(std::abs(*value) < 9e15 ? static_cast<T>(*value) : T(-1));
        else
            values.push_back(*value);
    }
    at_ = place_of(words.left().data());
    return values;
}

// Number `index` of `count` cannot be taken. words: stands before it where it is no number, and behind it
// where it is none of a place.
void LegacyText::refuse_number(std::uint64_t index, std::uint64_t count, WordReader words) {
    const std::size_t behind = place_of(words.left().data());
    words = WordReader(bytes_.substr(at_));
    for (std::uint64_t k = 0; k < index; ++k) words.next();
    const bool more = words.has_word();
    last_ = place_of(words.left().data());
    if (!more) refuse(fmt::format("the file ends after {} of {} numbers; {}", index, count, kWriteAgain));
    if (behind > last_) refuse("a place that is no number; remove the point or write its place");
    refuse(
        fmt::format("\"{}\" after {} of {} numbers; {}", excerpt(words.next()), index, count, kWriteAgain));
}

template std::vector<double> LegacyText::numbers<double>(VtkType, std::uint64_t, bool);
template std::vector<std::int64_t> LegacyText::numbers<std::int64_t>(VtkType, std::uint64_t, bool);

void LegacyText::skip(VtkType type, std::uint64_t count) {
    if (binary_) {
        stored(type, count);
        return;
    }
    check_room(count);
    for (std::uint64_t i = 0; i < count; ++i) {
        const std::string_view next = word();
        if (next.empty())
            refuse(fmt::format("the file ends after {} of {} numbers; {}", i, count, kWriteAgain));
        // "nan" and "inf" are numbers too.
        if (is_letter(next[0]) && std::string_view("nNiI").find(next[0]) == std::string_view::npos)
            refuse(fmt::format("\"{}\" after {} of {} numbers; {}", excerpt(next), i, count, kWriteAgain));
    }
}

void LegacyText::skip_words(std::uint64_t count) {
    line();
    for (std::uint64_t i = 0; i < count; ++i) {
        if (at_ == bytes_.size())
            refuse(fmt::format("the file ends after {} of {} words; {}", i, count, kWriteAgain));
        if (!binary_) {
            line();
            continue;
        }
        // The two highest bits tell how many bytes the length has: 8, 4, 2 or 1.
        const std::size_t bytes = std::size_t{8} >> (static_cast<unsigned char>(bytes_[at_]) >> 6);
        std::uint64_t length = 0;
        for (std::size_t k = 0; k < bytes && at_ + k < bytes_.size(); ++k)
            length = (length << 8) | (static_cast<unsigned char>(bytes_[at_ + k]) & (k == 0 ? 63u : 255u));
        last_ = at_;
        if (length + bytes > bytes_.size() - at_)
            refuse(
                fmt::format("a text of {} bytes goes beyond the end of the file; {}", length, kWriteAgain));
        at_ += bytes + length;
    }
}

void LegacyText::skip_metadata() {
    line();
    while (at_ < bytes_.size()) {
        const std::size_t before = at_;
        const std::string_view text = line();
        if (std::all_of(text.begin(), text.end(), is_blank)) return;
        const std::string_view first = text.substr(0, text.find_first_of(" \t"));
        if (is_legacy_keyword(first)) {
            at_ = before;
            return;
        }
    }
}

bool is_legacy_keyword(std::string_view word) {
    constexpr std::array<std::string_view, 22> words{"points",          "vertices",
                                                     "lines",           "polygons",
                                                     "triangle_strips", "cells",
                                                     "cell_types",      "point_data",
                                                     "cell_data",       "field",
                                                     "scalars",         "vectors",
                                                     "normals",         "tensors",
                                                     "tensors6",        "metadata",
                                                     "global_ids",      "pedigree_ids",
                                                     "lookup_table",    "color_scalars",
                                                     "edge_flags",      "texture_coordinates"};
    return std::any_of(words.begin(), words.end(),
                       [&](std::string_view each) { return same_word(word, each); });
}

std::string legacy_name(std::string_view word) {
    std::string name;
    for (std::size_t i = 0; i < word.size(); ++i) {
        unsigned code = 0;
        if (word[i] == '%' && i + 2 < word.size() &&
            std::from_chars(word.data() + i + 1, word.data() + i + 3, code, 16).ptr == word.data() + i + 3) {
            name += static_cast<char>(code);
            i += 2;
        } else {
            name += word[i];
        }
    }
    return name;
}

}  // namespace grainreel
