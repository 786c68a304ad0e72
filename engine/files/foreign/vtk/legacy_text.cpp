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

constexpr std::uint64_t some_numbers = std::uint64_t{4} << 20;  // for so many, memory is asked for at once

constexpr bool is_blank(char c) {
    return c == ' ' || (c >= '\t' && c <= '\r');
}
constexpr bool is_letter(char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z');
}

}  // namespace

void LegacyText::refuse(const std::string& what) const {
    if (binary_) refuse_byte(content_.file(), last_, what);
    refuse_line(content_.file(), content_.line_of(last_), what);
}

void LegacyText::skip_blanks() {
    for (std::string_view text = rest(); !text.empty(); text = rest()) {
        const auto other = std::find_if_not(text.begin(), text.end(), is_blank);
        at_ += static_cast<std::uint64_t>(other - text.begin());
        if (other != text.end()) return;
    }
}

void LegacyText::skip_line() {
    for (std::string_view text = rest(); !text.empty(); text = rest()) {
        const std::size_t end = text.find('\n');
        at_ += end == std::string_view::npos ? text.size() : end + 1;
        if (end != std::string_view::npos) return;
    }
}

std::string LegacyText::line() {
    last_ = at_;
    std::string_view text = rest();
    const std::size_t end = text.find('\n');
    if (std::min(end, text.size()) >= Content::kPiece)
        refuse("this line is longer than 1 MB; is this a file of VTK?");
    text = text.substr(0, end);
    at_ += text.size() + (end == std::string_view::npos ? 0 : 1);
    if (text.ends_with('\r')) text.remove_suffix(1);
    return std::string(text);
}

std::string LegacyText::word() {
    skip_blanks();
    last_ = at_;
    std::string_view text = rest();
    const auto end = std::find_if(text.begin(), text.end(), is_blank);
    text = text.substr(0, static_cast<std::size_t>(end - text.begin()));
    if (text.size() >= Content::kPiece) refuse("this word is longer than 1 MB; is this a file of VTK?");
    at_ += text.size();
    return std::string(text);
}

std::string LegacyText::peek() {
    const std::uint64_t before = at_;
    std::string next = word();
    at_ = before;
    return next;
}

std::string LegacyText::word_in_line() {
    for (std::string_view text = rest(); !text.empty(); text = rest()) {
        const auto other =
            std::find_if(text.begin(), text.end(), [](char c) { return !is_blank(c) || c == '\n'; });
        at_ += static_cast<std::uint64_t>(other - text.begin());
        if (other != text.end()) return *other == '\n' ? std::string() : word();
    }
    return {};
}

bool LegacyText::at_end() {
    skip_blanks();
    return rest().empty();
}

std::uint64_t LegacyText::count(const char* what) {
    const std::string text = word();
    std::uint64_t value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc() || end != text.data() + text.size() || value > (std::uint64_t{1} << 48))
        refuse(fmt::format("\"{}\" is not {}; {}", excerpt(text), what, kWriteAgain));
    return value;
}

VtkType LegacyText::type(const char* what) {
    const std::string text = word();
    const auto type = vtk_legacy_type(text);
    if (!type) refuse(fmt::format("numbers of type \"{}\" for {}, which are not read", excerpt(text), what));
    return *type;
}

std::uint64_t LegacyText::stored(VtkType type, std::uint64_t count) {
    skip_line();
    const std::uint64_t size = bytes_of(type, count), left = content_.size() - at_;
    last_ = at_;
    if (size > left)
        refuse(fmt::format("an array of {} bytes begins here, and {} are left; {}", size, left, kWriteAgain));
    at_ += size;
    return last_;
}

template <class T>
void LegacyText::read_bytes(VtkType type, std::uint64_t count, std::vector<T>& values) {
    std::uint64_t place = stored(type, count);
    values.reserve(std::min(count, some_numbers));
    for (std::uint64_t left = count; left > 0;) {
        constexpr std::uint64_t at_once = Content::kPiece / 8;  // numbers; a multiple of 8, for bits
        const std::uint64_t numbers = std::min(left, at_once), bytes = bytes_of(type, numbers);
        widen(content_.from(place, static_cast<std::size_t>(bytes)), type, true, numbers, values);
        place += bytes;
        left -= numbers;
    }
}

// The words of a piece of text that are whole. The last one may go on in the next piece, unless nothing more
// comes.
std::string_view LegacyText::whole_words() const {
    const bool last = content_.ends_at(at_ + rest().size());
    std::string_view text = rest();
    if (last) return text;
    const auto end = std::find_if(text.rbegin(), text.rend(), is_blank);
    text = text.substr(0, static_cast<std::size_t>(text.rend() - end));
    if (text.empty())
        refuse_line(content_.file(), content_.line_of(at_),
                    "a word here is longer than 1 MB; is this a file of VTK?");
    return text;
}

// Refuses a count that the rest of the file cannot hold, where that is known without unpacking it.
void LegacyText::check_room(std::uint64_t count) const {
    // Each number takes a digit and something between it and the next.
    if (content_.knows_size() && count > (content_.size() - at_) / 2 + 1)
        refuse(
            fmt::format("{} numbers, for which the rest of the file is too short; {}", count, kWriteAgain));
}

void LegacyText::refuse_end(std::uint64_t index, std::uint64_t count) {
    last_ = at_;
    refuse(fmt::format("the file ends after {} of {} numbers; {}", index, count, kWriteAgain));
}

template <class T>
void LegacyText::read_words(std::uint64_t count, bool finite, std::vector<T>& values) {
    check_room(count);
    values.reserve(std::min(count, some_numbers));
    while (values.size() < count) {
        const std::string_view text = whole_words();
        if (text.empty()) refuse_end(values.size(), count);
        WordReader words(text);
        const std::uint64_t begin = at_;
        const auto mark = [&](const char* byte) {
            last_ = begin + static_cast<std::uint64_t>(byte - text.data());
        };
        while (values.size() < count && words.has_word()) {
            const char* const from = words.left().data();
            const std::optional<double> value = words.next_number();
            if (!value) {
                mark(from);
                refuse(fmt::format("\"{}\" after {} of {} numbers; {}", excerpt(words.next()), values.size(),
                                   count, kWriteAgain));
            }
            if (finite && !std::isfinite(*value)) {
                mark(from);
                refuse("a place that is no number; remove the point or write its place");
            }
            if constexpr (std::is_integral_v<T>)
                values.push_back(std::abs(*value) < 9e15 ? static_cast<T>(*value) : T(-1));
            else
                values.push_back(*value);
        }
        at_ = begin + static_cast<std::uint64_t>(words.left().data() - text.data());
    }
}

template <class T>
std::vector<T> LegacyText::numbers(VtkType type, std::uint64_t count, bool finite) {
    std::vector<T> values;
    if (!binary_) {
        read_words(count, finite, values);
        return values;
    }
    read_bytes(type, count, values);
    for (std::size_t i = 0; finite && i < values.size(); ++i)
        if (!std::isfinite(static_cast<double>(values[i])))
            refuse_byte(content_.file(), last_ + bytes_of(type, i),
                        "a place that is no number; remove the point or write its place");
    return values;
}

template std::vector<double> LegacyText::numbers<double>(VtkType, std::uint64_t, bool);
template std::vector<std::int64_t> LegacyText::numbers<std::int64_t>(VtkType, std::uint64_t, bool);

void LegacyText::skip(VtkType type, std::uint64_t count) {
    if (binary_) {
        stored(type, count);
        return;
    }
    check_room(count);
    for (std::uint64_t i = 0; i < count;) {
        const std::string_view text = whole_words();
        if (text.empty()) refuse_end(i, count);
        WordReader words(text);
        const std::uint64_t begin = at_;
        for (; i < count && words.has_word(); ++i) {
            const std::string_view next = words.next();
            // "nan" and "inf" are numbers too.
            if (!is_letter(next[0]) || std::string_view("nNiI").find(next[0]) != std::string_view::npos)
                continue;
            last_ = begin + static_cast<std::uint64_t>(next.data() - text.data());
            refuse(fmt::format("\"{}\" after {} of {} numbers; {}", excerpt(next), i, count, kWriteAgain));
        }
        at_ = begin + static_cast<std::uint64_t>(words.left().data() - text.data());
    }
}

void LegacyText::skip_words(std::uint64_t count) {
    skip_line();
    for (std::uint64_t i = 0; i < count; ++i) {
        const std::string_view text = content_.from(at_, 9);
        if (text.empty())
            refuse(fmt::format("the file ends after {} of {} words; {}", i, count, kWriteAgain));
        if (!binary_) {
            skip_line();
            continue;
        }
        // The two highest bits tell how many bytes the length has: 8, 4, 2 or 1.
        const std::size_t bytes = std::size_t{8} >> (static_cast<unsigned char>(text[0]) >> 6);
        std::uint64_t length = 0;
        for (std::size_t k = 0; k < bytes && k < text.size(); ++k)
            length = (length << 8) | (static_cast<unsigned char>(text[k]) & (k == 0 ? 63u : 255u));
        last_ = at_;
        if (length + bytes > content_.size() - at_)
            refuse(
                fmt::format("a text of {} bytes goes beyond the end of the file; {}", length, kWriteAgain));
        at_ += bytes + length;
    }
}

void LegacyText::skip_metadata() {
    skip_line();
    while (!rest().empty()) {
        const std::uint64_t before = at_;
        const std::string text = line();
        if (std::all_of(text.begin(), text.end(), is_blank)) return;
        const std::string_view first = std::string_view(text).substr(0, text.find_first_of(" \t"));
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
