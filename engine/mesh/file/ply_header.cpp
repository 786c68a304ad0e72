#include "engine/mesh/file/ply_header.hpp"

#include <fmt/format.h>

#include <array>
#include <optional>

#include "engine/base/text.hpp"
#include "engine/mesh/file/mesh_bytes.hpp"
#include "engine/mesh/file/words.hpp"

namespace grainreel {
namespace {

namespace fs = std::filesystem;

std::optional<PlyType> type_of(std::string_view word) {
    struct Name {
        std::string_view old, sized;
        PlyType type;
    };
    static constexpr std::array<Name, 8> names{{{"char", "int8", PlyType::int8},
                                                {"uchar", "uint8", PlyType::uint8},
                                                {"short", "int16", PlyType::int16},
                                                {"ushort", "uint16", PlyType::uint16},
                                                {"int", "int32", PlyType::int32},
                                                {"uint", "uint32", PlyType::uint32},
                                                {"float", "float32", PlyType::float32},
                                                {"double", "float64", PlyType::float64}}};
    for (const Name& name : names)
        if (word == name.old || word == name.sized) return name.type;
    return std::nullopt;
}

class Header {
  public:
    Header(const fs::path& file, std::string_view bytes) : file_(file), words_(bytes) {}

    PlyHeader read() {
        words_.skip_line();  // "ply"
        bool form_known = false;
        for (std::string_view word = words_.next(); word != "end_header"; word = words_.next()) {
            if (word.empty()) fail("the header of this PLY file has no end_header");
            if (word == "format")
                form_known = format();
            else if (word == "element")
                element();
            else if (word == "property")
                property();
            else if (word != "comment" && word != "obj_info")
                fail(fmt::format("\"{}\" begins no line of a PLY header", excerpt(word)));
            words_.skip_line();
        }
        if (!form_known) fail("the header of this PLY file names no format");
        words_.skip_line();
        header_.body = words_.left();
        header_.body_line = words_.line();
        for (const PlyElement& element : header_.elements) check_count(element);
        return std::move(header_);
    }

  private:
    [[noreturn]] void fail(const std::string& what) const { refuse_line(file_, words_.line(), what); }

    bool format() {
        using Form = PlyHeader::Form;
        const std::string_view word = words_.next_in_line();
        if (word == "ascii")
            header_.form = Form::ascii;
        else if (word == "binary_little_endian")
            header_.form = Form::little_endian;
        else if (word == "binary_big_endian")
            header_.form = Form::big_endian;
        else
            fail(fmt::format("\"{}\" is no format of PLY", excerpt(word)));
        return true;
    }

    void element() {
        const std::string_view name = words_.next_in_line(), count = words_.next_in_line();
        const std::optional<std::int64_t> number = whole_in(count);
        if (name.empty() || !number || *number < 0)
            fail(fmt::format("\"{}\" is no number of elements", excerpt(count)));
        header_.elements.push_back({std::string(name), static_cast<std::uint64_t>(*number), {}});
    }

    PlyType type() {
        const std::string_view word = words_.next_in_line();
        const std::optional<PlyType> type = type_of(word);
        if (!type) fail(fmt::format("\"{}\" is no type of a PLY property", excerpt(word)));
        return *type;
    }

    void property() {
        if (header_.elements.empty()) fail("a property stands before the first element");
        PlyProperty property;
        WordReader ahead = words_;
        property.list = ahead.next_in_line() == "list";
        if (property.list) {
            words_ = ahead;
            property.count_type = type();
            if (property.count_type >= PlyType::float32) fail("the length of a list cannot be a float");
        }
        property.type = type();
        property.name = words_.next_in_line();
        header_.elements.back().properties.push_back(property);
    }

    // Each number of a text takes at least two bytes, except the last.
    void check_count(const PlyElement& element) const {
        std::size_t bytes = 0;
        for (const PlyProperty& property : element.properties)
            bytes += header_.form == PlyHeader::Form::ascii
                         ? 2
                         : bytes_of(property.list ? property.count_type : property.type);
        if (bytes > 0 && element.count > (header_.body.size() + 1) / bytes)
            refuse_mesh(file_,
                        fmt::format("the header says {} of element {}, and the file has only {} bytes behind "
                                    "the header; it is not whole",
                                    element.count, excerpt(element.name), header_.body.size()));
    }

    const fs::path& file_;
    WordReader words_;
    PlyHeader header_;
};

}  // namespace

std::size_t bytes_of(PlyType type) {
    switch (type) {
        case PlyType::int8:
        case PlyType::uint8:
            return 1;
        case PlyType::int16:
        case PlyType::uint16:
            return 2;
        case PlyType::int32:
        case PlyType::uint32:
        case PlyType::float32:
            return 4;
        case PlyType::float64:
            return 8;
    }
    return 1;
}

std::size_t PlyElement::place_of(std::string_view property) const {
    for (std::size_t i = 0; i < properties.size(); ++i)
        if (properties[i].name == property) return i;
    return npos;
}

const PlyElement* PlyHeader::element(std::string_view name) const {
    for (const PlyElement& element : elements)
        if (element.name == name) return &element;
    return nullptr;
}

PlyHeader ply_header(const fs::path& file, std::string_view bytes) {
    return Header(file, bytes).read();
}

}  // namespace grainreel
