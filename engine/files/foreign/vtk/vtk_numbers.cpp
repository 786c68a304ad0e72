#include "engine/files/foreign/vtk/vtk_numbers.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <string>
#include <utility>

#include "engine/base/error.hpp"
#include "engine/base/text.hpp"
#include "engine/base/word_reader.hpp"
#include "engine/files/foreign/bytes/byte_source.hpp"

namespace grainreel {

namespace {

static_assert(std::endian::native == std::endian::little);

template <class Names>
std::optional<VtkType> type_among(const Names& names, std::string_view word, bool any_case) {
    for (const auto& [name, type] : names)
        if (any_case ? same_word(word, name) : word == name) return type;
    return std::nullopt;
}

template <class T>
T turned(const char* from) {
    std::array<char, sizeof(T)> bytes;
    std::reverse_copy(from, from + sizeof(T), bytes.begin());
    return std::bit_cast<T>(bytes);
}

template <class T, class To>
void widen_as(const char* from, bool big_endian, std::size_t count, To* to) {
    for (std::size_t i = 0; i < count; ++i, from += sizeof(T)) {
        T value;
        if (big_endian)
            value = turned<T>(from);
        else
            std::memcpy(&value, from, sizeof value);
        if constexpr (std::is_integral_v<To> && std::is_floating_point_v<T>)
            to[i] = std::abs(value) < T(9e18) ? static_cast<To>(value) : To(-1);
        else
            to[i] = static_cast<To>(value);
    }
}

template <class To>
void widen_any(std::string_view bytes, VtkType type, bool big, std::size_t count, std::vector<To>& values) {
    const std::size_t before = values.size();
    values.resize(before + count);
    To* to = values.data() + before;
    const char* from = bytes.data();
    switch (type) {
        case VtkType::int8:
            return widen_as<std::int8_t>(from, big, count, to);
        case VtkType::uint8:
            return widen_as<std::uint8_t>(from, big, count, to);
        case VtkType::int16:
            return widen_as<std::int16_t>(from, big, count, to);
        case VtkType::uint16:
            return widen_as<std::uint16_t>(from, big, count, to);
        case VtkType::int32:
            return widen_as<std::int32_t>(from, big, count, to);
        case VtkType::uint32:
            return widen_as<std::uint32_t>(from, big, count, to);
        case VtkType::int64:
            return widen_as<std::int64_t>(from, big, count, to);
        case VtkType::uint64:
            return widen_as<std::uint64_t>(from, big, count, to);
        case VtkType::float32:
            return widen_as<float>(from, big, count, to);
        case VtkType::float64:
            return widen_as<double>(from, big, count, to);
        case VtkType::bit:
            for (std::size_t i = 0; i < count; ++i)
                to[i] = static_cast<To>((static_cast<unsigned char>(from[i / 8]) >> (7 - i % 8)) & 1);
    }
}

}  // namespace

std::optional<VtkType> vtk_xml_type(std::string_view word) {
    static constexpr std::array<std::pair<std::string_view, VtkType>, 11> names{
        {{"Int8", VtkType::int8},
         {"UInt8", VtkType::uint8},
         {"Int16", VtkType::int16},
         {"UInt16", VtkType::uint16},
         {"Int32", VtkType::int32},
         {"UInt32", VtkType::uint32},
         {"Int64", VtkType::int64},
         {"UInt64", VtkType::uint64},
         {"Float32", VtkType::float32},
         {"Float64", VtkType::float64},
         {"Bit", VtkType::bit}}};
    return type_among(names, word, false);
}

std::optional<VtkType> vtk_legacy_type(std::string_view word) {
    static constexpr std::array<std::pair<std::string_view, VtkType>, 16> names{
        {{"float", VtkType::float32},
         {"double", VtkType::float64},
         {"int", VtkType::int32},
         {"unsigned_int", VtkType::uint32},
         {"long", VtkType::int64},
         {"unsigned_long", VtkType::uint64},
         {"vtktypeint64", VtkType::int64},
         {"vtktypeuint64", VtkType::uint64},
         {"short", VtkType::int16},
         {"unsigned_short", VtkType::uint16},
         {"char", VtkType::int8},
         {"signed_char", VtkType::int8},
         {"unsigned_char", VtkType::uint8},
         {"vtkidtype", VtkType::int32},
         {"long_long", VtkType::int64},
         {"bit", VtkType::bit}}};
    return type_among(names, word, true);
}

std::uint64_t bytes_of(VtkType type, std::uint64_t count) {
    switch (type) {
        case VtkType::bit:
            return count / 8 + (count % 8 != 0);
        case VtkType::int8:
        case VtkType::uint8:
            return count;
        case VtkType::int16:
        case VtkType::uint16:
            return 2 * count;
        case VtkType::int32:
        case VtkType::uint32:
        case VtkType::float32:
            return 4 * count;
        default:
            return 8 * count;
    }
}

void widen(std::string_view bytes, VtkType type, bool big_endian, std::size_t count,
           std::vector<double>& values) {
    widen_any(bytes, type, big_endian, count, values);
}

void widen(std::string_view bytes, VtkType type, bool big_endian, std::size_t count,
           std::vector<std::int64_t>& values) {
    widen_any(bytes, type, big_endian, count, values);
}

namespace fs = std::filesystem;

std::string text_of(const VtkPlace& place) {
    const std::string file = place.file == nullptr ? std::string() : shown(*place.file);
    return place.line > 0 ? fmt::format("{}:{}", file, place.line) : file;
}

void refuse_vtk(const VtkPlace& place, const std::string& what) {
    if (place.array.empty()) throw UserError("{}: {}", text_of(place), what);
    throw UserError("{}: array \"{}\": {}", text_of(place), excerpt(place.array), what);
}

std::int64_t line_of_byte(std::string_view text, std::size_t byte) {
    const std::string_view before = text.substr(0, byte);
    return 1 + std::count(before.begin(), before.end(), '\n');
}

}  // namespace grainreel
