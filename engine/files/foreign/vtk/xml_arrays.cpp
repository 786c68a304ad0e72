#include "engine/files/foreign/vtk/xml_arrays.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <charconv>
#include <cmath>
#include <utility>

#include "engine/base/error.hpp"
#include "engine/base/text.hpp"
#include "engine/base/word_reader.hpp"
#include "engine/files/foreign/bytes/byte_source.hpp"

namespace grainreel {

namespace {

namespace fs = std::filesystem;

VtkCompressor compressor_of(std::string_view name) {
    if (name.empty()) return VtkCompressor::none;
    if (name == "vtkZLibDataCompressor") return VtkCompressor::zlib;
    if (name == "vtkLZ4DataCompressor") return VtkCompressor::lz4;
    if (name == "vtkLZMADataCompressor") return VtkCompressor::lzma;
    return VtkCompressor::unknown;
}

VtkCoding coding_of(const fs::path& file, const XmlElement& root) {
    VtkCoding coding;
    const std::string_view order = root.attribute("byte_order");
    coding.big_endian = order == "BigEndian";
    if (!order.empty() && order != "BigEndian" && order != "LittleEndian")
        refuse_line(file, root.line,
                    fmt::format("byte_order=\"{}\"; it must be LittleEndian or BigEndian", excerpt(order)));
    const std::string_view header = root.attribute("header_type");
    coding.header_bytes = header == "UInt64" ? 8 : 4;
    if (!header.empty() && header != "UInt64" && header != "UInt32")
        refuse_line(file, root.line,
                    fmt::format("header_type=\"{}\"; it must be UInt32 or UInt64", excerpt(header)));
    coding.compressor_name = root.attribute("compressor");
    coding.compressor = compressor_of(coding.compressor_name);
    return coding;
}

void check_finite(const std::vector<double>& values, const VtkPlace& place) {
    for (std::size_t i = 0; i < values.size(); ++i)
        if (!std::isfinite(values[i]))
            refuse_vtk(place,
                       fmt::format("number {} of them, {}, is no place; remove the point or write its place",
                                   i + 1, values[i]));
}
void check_finite(const std::vector<std::int64_t>&, const VtkPlace&) {}

}  // namespace

XmlArrays::XmlArrays(const Content& content, const XmlTree& tree)
    : content_(content), tree_(tree), coding_(coding_of(content.file(), tree.root)) {}

VtkPlace XmlArrays::place_of(const XmlElement& array) const {
    return {&file(), array.line, std::string(array.attribute("Name"))};
}

std::uint64_t XmlArrays::count_in(const XmlElement& element, std::string_view attribute) const {
    const std::string_view text = trimmed(element.attribute(attribute));
    if (text.empty()) return 0;
    std::uint64_t count = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), count);
    // A count is limited, so that the bytes of three doubles for each item do not overflow.
    if (error != std::errc() || end != text.data() + text.size() || count > (std::uint64_t{1} << 48))
        refuse_line(file(), element.line, fmt::format("{}=\"{}\" is no count", attribute, excerpt(text)));
    return count;
}

VtkType XmlArrays::type_of(const XmlElement& array) const {
    const std::string_view word = array.attribute("type");
    const auto type = vtk_xml_type(word);
    if (!type)
        refuse_vtk(place_of(array), fmt::format("numbers of type \"{}\", which is not read", excerpt(word)));
    return *type;
}

bool XmlArrays::is_text(const XmlElement& array) const {
    const std::string_view format = array.attribute("format");
    return format.empty() || format == "ascii";
}

std::string XmlArrays::short_text(const XmlElement& array) const {
    const std::uint64_t size = array.end - array.begin;
    if (size > Content::kPiece) return {};
    return std::string(content_.from(array.begin).substr(0, static_cast<std::size_t>(size)));
}

StoredText XmlArrays::stored(const XmlElement& array) const {
    const std::string_view format = array.attribute("format");
    if (format == "binary") return {array.begin, array.end, true};
    if (format != "appended")
        refuse_vtk(place_of(array),
                   fmt::format("format=\"{}\"; it must be ascii, binary or appended", excerpt(format)));
    const std::uint64_t size = tree_.appended_end - tree_.appended_begin;
    if (size == 0) refuse_vtk(place_of(array), fmt::format("its appended data are missing; {}", kWriteAgain));
    const std::uint64_t offset = count_in(array, "offset");
    if (offset >= size)
        refuse_vtk(place_of(array), fmt::format("begins at {}, and the appended data end at {}; {}", offset,
                                                size, kWriteAgain));
    return {tree_.appended_begin + offset, tree_.appended_end, tree_.appended_base64};
}

namespace {

constexpr std::uint64_t some_numbers = std::uint64_t{4} << 20;  // for so many, memory is asked for at once

}  // namespace

// Reads the numbers in a piece of an array's text, which begins at `place`.
template <class T>
void XmlArrays::read_words(std::string_view text, std::uint64_t place, const XmlElement& array,
                           std::optional<std::uint64_t> count, bool finite, std::vector<T>& values) const {
    WordReader words(text);
    const auto line = [&](const char* at) {
        return content_.line_of(place + static_cast<std::uint64_t>(at - text.data()));
    };
    while (words.has_word()) {
        const char* begin = words.left().data();
        const std::optional<double> value = words.next_number();
        if (!value) {
            const std::string word = excerpt(words.next());
            refuse_vtk({&file(), line(begin), place_of(array).array},
                       fmt::format("\"{}\" is no number; {}", word, kWriteAgain));
        }
        if (finite && !std::isfinite(*value))
            refuse_line(file(), line(begin),
                        "a place that is no number; remove the point or write its place");
        if (count && values.size() == *count)
            refuse_vtk(
                {&file(), line(words.left().data()), place_of(array).array},
                fmt::format("has more numbers than the {} that it must have; {}", *count, kWriteAgain));
        if constexpr (std::is_integral_v<T>)
            values.push_back(std::abs(*value) < 9e15 ? static_cast<T>(*value) : T(-1));
        else
            values.push_back(*value);
    }
}

template <class T>
void XmlArrays::read_text(const XmlElement& array, std::optional<std::uint64_t> count, bool finite,
                          std::vector<T>& values) const {
    if (count) values.reserve(std::min(*count, some_numbers));
    std::uint64_t place = array.begin;
    while (place < array.end) {
        std::string_view text = content_.from(place).substr(0, static_cast<std::size_t>(array.end - place));
        if (place + text.size() < array.end) text = text.substr(0, text.find_last_of(" \t\n\v\f\r") + 1);
        if (text.empty())
            refuse_vtk({&file(), content_.line_of(place), place_of(array).array},
                       fmt::format("has a number of more than {} letters; {}", Content::kPiece, kWriteAgain));
        const std::size_t size = text.size();
        read_words(text, place, array, count, finite, values);
        place += size;
    }
    if (count && values.size() < *count)
        refuse_vtk({&file(), content_.line_of(array.end), place_of(array).array},
                   fmt::format("has {} numbers of the {} that it must have; {}", values.size(), *count,
                               kWriteAgain));
}

namespace {

// Turns the bytes of an array, which come in pieces, into at most `count` numbers.
template <class T>
class NumbersOfBytes {
  public:
    NumbersOfBytes(VtkType type, bool big_endian, std::uint64_t count, std::vector<T>& values)
        : type_(type), big_endian_(big_endian), left_(count), values_(values) {}

    void take(std::string_view bytes) {
        if (!split_.empty()) {
            split_ += bytes;
            const std::string joined = std::exchange(split_, {});
            take(joined);
            return;
        }
        const std::uint64_t width = type_ == VtkType::bit ? 1 : bytes_of(type_, 1);
        const std::uint64_t whole = bytes.size() / width;
        const std::uint64_t numbers =
            std::min<std::uint64_t>(left_, type_ == VtkType::bit ? 8 * whole : whole);
        widen(bytes, type_, big_endian_, numbers, values_);
        left_ -= numbers;
        split_ = bytes.substr(whole * width);
    }

  private:
    VtkType type_;
    bool big_endian_;
    std::uint64_t left_;
    std::vector<T>& values_;
    std::string split_{};  // the beginning of a number whose rest is in the next piece
};

}  // namespace

template <class T>
void XmlArrays::read(const XmlElement& array, std::optional<std::uint64_t> count, bool finite,
                     std::vector<T>& values) const {
    const VtkType type = type_of(array);
    if (count) check(array, *count);
    if (is_text(array)) return read_text(array, count, finite, values);
    if (count && *count == 0) return;
    const VtkPlace place = place_of(array);
    std::optional<std::uint64_t> wanted;
    if (count) wanted = bytes_of(type, *count);
    if (count) values.reserve(std::min(*count, some_numbers));
    NumbersOfBytes<T> numbers(type, coding_.big_endian, count.value_or(std::uint64_t{1} << 48), values);
    stored_array(content_, stored(array), coding_, wanted, place,
                 [&](std::string_view bytes) { numbers.take(bytes); });
    if (finite) check_finite(values, place);
}

void XmlArrays::check(const XmlElement& array, std::uint64_t count) const {
    const VtkType type = type_of(array);
    if (is_text(array)) {
        // Each number takes a digit and something between it and the next.
        if (count > (array.end - array.begin) / 2 + 1)
            refuse_vtk(
                place_of(array),
                fmt::format("must have {} numbers, for which its text is too short; {}", count, kWriteAgain));
        return;
    }
    if (count == 0) return;
    check_stored_array(content_, stored(array), coding_, bytes_of(type, count), place_of(array));
}

std::vector<double> XmlArrays::numbers(const XmlElement& array, std::optional<std::uint64_t> count,
                                       bool finite) const {
    std::vector<double> values;
    read(array, count, finite, values);
    return values;
}

std::vector<std::int64_t> XmlArrays::whole(const XmlElement& array,
                                           std::optional<std::uint64_t> count) const {
    std::vector<std::int64_t> values;
    read(array, count, false, values);
    return values;
}

namespace {

// Adds the numbers of grains and walls of a Piece. Returns false where the head alone does not tell them.
bool count_piece(const XmlArrays& arrays, const XmlElement& piece, RawMoment& moment) {
    const std::uint64_t points = arrays.count_in(piece, "NumberOfPoints");
    const std::uint64_t vertices = arrays.count_in(piece, "NumberOfVerts");
    const std::uint64_t lines = arrays.count_in(piece, "NumberOfLines");
    const std::uint64_t faces = arrays.count_in(piece, "NumberOfPolys");
    const bool strips = arrays.count_in(piece, "NumberOfStrips") > 0;
    // Lines could have more than two points, and strips and polygons fewer than three.
    if (strips || lines > 0 || (vertices > 0 && vertices != points) || (vertices > 0 && faces > 0))
        return false;
    if (faces > 0)
        moment.has_walls = true;
    else
        moment.grains += static_cast<std::int64_t>(points);
    return true;
}

}  // namespace

bool count_by_head(const VtkPartFile& part_file, bool time_known, VtkParts& parts) {
    FileStart start = unpacked_head(part_file.file);
    if (vtk_file_type(start.bytes) != "PolyData" || start.bytes.find("<AppendedData") == std::string::npos)
        return false;
    try {
        const Content head(part_file.file, std::move(start.bytes));
        const XmlTree tree = xml_tree(head);
        const XmlElement* set = tree.root.child("PolyData");
        if (set == nullptr) return false;
        // The time of the file may stand in the appended data, far behind the head.
        const bool own_time = set->child("FieldData") != nullptr || tree.root.child("FieldData") != nullptr;
        if (own_time && !time_known) return false;
        const XmlArrays arrays(head, tree);
        RawMoment moment;
        for (const XmlElement& piece : set->children)
            if (piece.name == "Piece" && !count_piece(arrays, piece, moment)) return false;
        parts.moment.grains += moment.grains;
        parts.moment.has_walls = parts.moment.has_walls || moment.has_walls;
        return true;
    } catch (const UserError&) {
        return false;  // reading the whole file tells what is wrong
    }
}

}  // namespace grainreel
