#include "engine/files/foreign/vtk/xml_arrays.hpp"

#include <fmt/format.h>
#include <charconv>
#include <cmath>
#include <limits>

#include "engine/base/error.hpp"
#include "engine/base/text.hpp"
#include "engine/base/word_reader.hpp"
#include "engine/files/foreign/byte_source.hpp"

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
        refuse_vtk_line(
            file, root.line,
            fmt::format("byte_order=\"{}\"; it must be LittleEndian or BigEndian", excerpt(order)));
    const std::string_view header = root.attribute("header_type");
    coding.header_bytes = header == "UInt64" ? 8 : 4;
    if (!header.empty() && header != "UInt64" && header != "UInt32")
        refuse_vtk_line(file, root.line,
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

XmlArrays::XmlArrays(const fs::path& file, std::string_view bytes, const XmlTree& tree)
    : file_(file), bytes_(bytes), tree_(tree), coding_(coding_of(file, tree.root)) {}

VtkPlace XmlArrays::place_of(const XmlElement& array) const {
    return {&file_, array.line, std::string(array.attribute("Name"))};
}

std::uint64_t XmlArrays::count_in(const XmlElement& element, std::string_view attribute) const {
    const std::string_view text = trimmed(element.attribute(attribute));
    if (text.empty()) return 0;
    std::uint64_t count = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), count);
    // A count is limited, so that the bytes of three doubles for each item do not overflow.
    if (error != std::errc() || end != text.data() + text.size() || count > (std::uint64_t{1} << 48))
        refuse_vtk_line(file_, element.line, fmt::format("{}=\"{}\" is no count", attribute, excerpt(text)));
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

std::string_view XmlArrays::text_of_array(const XmlElement& array) const {
    return bytes_.substr(array.begin, array.end - array.begin);
}

XmlArrays::Stored XmlArrays::stored(const XmlElement& array) const {
    const std::string_view format = array.attribute("format");
    if (format == "binary") return {text_of_array(array), true};
    if (format != "appended")
        refuse_vtk(place_of(array),
                   fmt::format("format=\"{}\"; it must be ascii, binary or appended", excerpt(format)));
    const std::uint64_t size = tree_.appended_end - tree_.appended_begin;
    if (size == 0) refuse_vtk(place_of(array), fmt::format("its appended data are missing; {}", kWriteAgain));
    const std::uint64_t offset = count_in(array, "offset");
    if (offset >= size)
        refuse_vtk(place_of(array), fmt::format("begins at {}, and the appended data end at {}; {}", offset,
                                                size, kWriteAgain));
    return {bytes_.substr(tree_.appended_begin + offset, size - offset), tree_.appended_base64};
}

template <class T>
void XmlArrays::read_text(const XmlElement& array, std::optional<std::uint64_t> count, bool finite,
                          std::vector<T>& values) const {
    const std::string_view text = text_of_array(array);
    WordReader words(text);
    const auto line_of = [&](const char* byte) {
        return line_of_byte(bytes_, static_cast<std::size_t>(byte - bytes_.data()));
    };
    const auto line = [&] { return line_of(words.left().data()); };
    if (count) values.reserve(*count);
    while (words.has_word()) {
        const char* const begin = words.left().data();
        const std::optional<double> value = words.next_number();
        if (!value)
            refuse_vtk({&file_, line(), place_of(array).array},
                       fmt::format("\"{}\" is no number; {}", excerpt(words.next()), kWriteAgain));
        if (finite && !std::isfinite(*value))
            refuse_vtk_line(file_, line_of(begin),
                            "a place that is no number; remove the point or write its place");
        if (count && values.size() == *count)
            refuse_vtk(
                {&file_, line(), place_of(array).array},
                fmt::format("has more numbers than the {} that it must have; {}", *count, kWriteAgain));
        if constexpr (std::is_integral_v<T>)
            values.push_back(std::abs(*value) < 9e15 ? static_cast<T>(*value) : T(-1));
        else
            values.push_back(*value);
    }
    if (count && values.size() < *count)
        refuse_vtk({&file_, line(), place_of(array).array},
                   fmt::format("has {} numbers of the {} that it must have; {}", values.size(), *count,
                               kWriteAgain));
}

template <class T>
void XmlArrays::read(const XmlElement& array, std::optional<std::uint64_t> count, bool finite,
                     std::vector<T>& values) const {
    const VtkType type = type_of(array);
    if (count) check(array, *count);
    if (is_text(array)) return read_text(array, count, finite, values);
    if (count && *count == 0) return;
    const VtkPlace place = place_of(array);
    const Stored found = stored(array);
    std::optional<std::uint64_t> wanted;
    if (count) wanted = bytes_of(type, *count);
    const std::string bytes = stored_array(found.text, found.base64, coding_, wanted, place);
    const std::uint64_t holds = type == VtkType::bit ? 8 * bytes.size() : bytes.size() / bytes_of(type, 1);
    widen(bytes, type, coding_.big_endian, count.value_or(holds), values);
    if (finite) check_finite(values, place);
}

void XmlArrays::check(const XmlElement& array, std::uint64_t count) const {
    const VtkType type = type_of(array);
    if (is_text(array)) {
        // Each number takes a digit and something between it and the next.
        if (count > text_of_array(array).size() / 2 + 1)
            refuse_vtk(
                place_of(array),
                fmt::format("must have {} numbers, for which its text is too short; {}", count, kWriteAgain));
        return;
    }
    if (count == 0) return;
    const Stored found = stored(array);
    check_stored_array(found.text, found.base64, coding_, bytes_of(type, count), place_of(array));
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
    const FileStart head = unpacked_head(part_file.file);
    if (vtk_file_type(head.bytes) != "PolyData" || head.bytes.find("<AppendedData") == std::string::npos)
        return false;
    try {
        const XmlTree tree = xml_tree(part_file.file, head.bytes);
        const XmlElement* set = tree.root.child("PolyData");
        if (set == nullptr) return false;
        // The time of the file may stand in the appended data, far behind the head.
        const bool own_time = set->child("FieldData") != nullptr || tree.root.child("FieldData") != nullptr;
        if (own_time && !time_known) return false;
        const XmlArrays arrays(part_file.file, head.bytes, tree);
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
