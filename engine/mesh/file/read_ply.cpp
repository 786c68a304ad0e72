// Reads the vertices and faces of a PLY file, as text or as binary numbers of either byte order. The file's
// header describes the numbers after it.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <optional>
#include <string>
#include <vector>

#include "engine/base/number_text.hpp"
#include "engine/base/text.hpp"
#include "engine/base/word_reader.hpp"
#include "engine/mesh/file/mesh_readers.hpp"

namespace grainreel {
namespace {

namespace fs = std::filesystem;

// The floats must stand last: the readers take every type below float32 as a whole number.
enum class PlyType : std::uint8_t { int8, uint8, int16, uint16, int32, uint32, float32, float64 };

struct PlyProperty {
    std::string name;
    PlyType type = PlyType::int8;
    bool list = false;
    PlyType count_type = PlyType::uint8;  // type of a list's count
};

struct PlyElement {
    std::string name;
    std::uint64_t count = 0;
    std::vector<PlyProperty> properties;
    static constexpr std::size_t npos = static_cast<std::size_t>(-1);
    // Gives npos if there is no property with that name.
    std::size_t place_of(std::string_view property) const {
        for (std::size_t i = 0; i < properties.size(); ++i)
            if (properties[i].name == property) return i;
        return npos;
    }
};

struct PlyHeader {
    enum class Form { ascii, little_endian, big_endian };
    Form form = Form::ascii;
    std::vector<PlyElement> elements;
    std::string_view body;       // the bytes after the header
    std::int64_t body_line = 1;  // number of the line in which the body begins
    const PlyElement* element(std::string_view name) const {
        for (const PlyElement& element : elements)
            if (element.name == name) return &element;
        return nullptr;
    }
};

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

// Reads the header. Throws UserError with the line where the header is wrong, and without it if the rest of
// the file is too short for the counts in the header.
class PlyHeaderReader {
  public:
    PlyHeaderReader(const fs::path& file, std::string_view bytes) : file_(file), words_(bytes) {}

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

    // Each number of a text takes at least two bytes (a digit and a blank), except the last.
    void check_count(const PlyElement& element) const {
        std::size_t bytes = 0;
        for (const PlyProperty& property : element.properties)
            bytes += header_.form == PlyHeader::Form::ascii
                         ? 2
                         : bytes_of(property.list ? property.count_type : property.type);
        if (bytes > 0 && element.count > (header_.body.size() + 1) / bytes)
            refuse_file(file_,
                        fmt::format("the header says {} of element {}, and the file has only {} bytes behind "
                                    "the header; it is not whole",
                                    element.count, excerpt(element.name), header_.body.size()));
    }

    const fs::path& file_;
    WordReader words_;
    PlyHeader header_;
};

// The numbers of a text file, which are words.
class AsciiBody {
  public:
    AsciiBody(const fs::path& file, const PlyHeader& header)
        : file_(file), words_(header.body), before_(header.body_line - 1) {}

    double next(PlyType type) {
        const std::string_view word = words_.next();
        if (word.empty()) fail("the file ends before all elements that its header names; it is not whole");
        const std::optional<double> value = number_in(word);
        if (!value) fail(no_coordinate(word));
        if (type < PlyType::float32 && *value != std::floor(*value))
            fail(fmt::format("\"{}\" is not a whole number", excerpt(word)));
        return *value;
    }
    void skip(PlyType) { words_.next(); }  // a nan among normals and colours does no harm
    // The most values of a list that the rest of the file could hold.
    double most(PlyType) const { return static_cast<double>(words_.left().size()); }
    [[noreturn]] void fail(const std::string& what) const {
        refuse_line(file_, before_ + words_.line(), what);
    }

  private:
    const fs::path& file_;
    WordReader words_;
    std::int64_t before_;
};

// The numbers of a binary file, in this machine's byte order or in the other one.
class BinaryBody {
  public:
    BinaryBody(const fs::path& file, const PlyHeader& header, std::string_view all)
        : file_(file),
          all_(all),
          at_(all.size() - header.body.size()),
          swapped_(header.form == PlyHeader::Form::big_endian) {}

    double next(PlyType type) {
        switch (type) {
            case PlyType::int8:
                return take<std::int8_t>();
            case PlyType::uint8:
                return take<std::uint8_t>();
            case PlyType::int16:
                return take<std::int16_t>();
            case PlyType::uint16:
                return take<std::uint16_t>();
            case PlyType::int32:
                return take<std::int32_t>();
            case PlyType::uint32:
                return take<std::uint32_t>();
            case PlyType::float32:
                return decimal_of(take<float>());
            case PlyType::float64:
                return take<double>();
        }
        return 0;
    }
    void skip(PlyType type) { next(type); }
    double most(PlyType type) const { return static_cast<double>((all_.size() - at_) / bytes_of(type)); }
    [[noreturn]] void fail(const std::string& what) const { refuse_byte(file_, last_, what); }

  private:
    template <class T>
    T take() {
        last_ = at_;
        if (all_.size() - at_ < sizeof(T))
            fail("the file ends before all elements that its header names; it is not whole");
        char bytes[sizeof(T)];
        std::memcpy(bytes, all_.data() + at_, sizeof bytes);
        if (swapped_) std::reverse(bytes, bytes + sizeof bytes);
        at_ += sizeof bytes;
        T value;
        std::memcpy(&value, bytes, sizeof value);
        return value;
    }

    const fs::path& file_;
    std::string_view all_;
    std::size_t at_, last_ = 0;
    bool swapped_;
};

template <class Body>
class Ply {
  public:
    Ply(const PlyHeader& header, std::size_t corners, Body body)
        : header_(header), corners_(corners), body_(std::move(body)) {}

    TriangleMesh read() {
        for (const PlyElement& element : header_.elements) {
            if (element.properties.empty()) continue;
            const bool vertex = &element == header_.element("vertex"),
                       face = &element == header_.element("face");
            if (vertex) mesh_.vertices.reserve(element.count);
            if (face) mesh_.triangles.reserve(element.count);
            for (std::uint64_t i = 0; i < element.count; ++i) {
                if (vertex)
                    read_vertex(element);
                else
                    skip_lists_but(element, face ? corners_ : PlyElement::npos);
            }
        }
        return std::move(mesh_);
    }

  private:
    void read_vertex(const PlyElement& element) {
        Vec3 place(0, 0, 0);
        for (const PlyProperty& property : element.properties) {
            const bool named = !property.list && property.name.size() == 1;
            const int k = named ? property.name[0] - 'x' : -1;
            if (k < 0 || k > 2) {
                skip(property);
                continue;
            }
            const double value = body_.next(property.type);
            if (!std::isfinite(value))
                body_.fail("has a coordinate that is no finite number; export the mesh again");
            if (std::abs(value) > largest_coordinate) body_.fail(too_far(value));
            place[k] = value;
        }
        mesh_.vertices.push_back(place);
    }

    // Reads property number `face` as the corners of a face, and skips all others; npos skips all.
    void skip_lists_but(const PlyElement& element, std::size_t face) {
        for (std::size_t i = 0; i < element.properties.size(); ++i) {
            if (i == face)
                read_face(element.properties[i]);
            else
                skip(element.properties[i]);
        }
    }

    std::int64_t length(const PlyProperty& list) {
        const double count = body_.next(list.count_type);
        if (!(count >= 0) || count > body_.most(list.type))
            body_.fail(
                fmt::format("a list of {:.0f} numbers, which the rest of the file cannot hold", count));
        return static_cast<std::int64_t>(count);
    }

    void skip(const PlyProperty& property) {
        const std::int64_t count = property.list ? length(property) : 1;
        for (std::int64_t i = 0; i < count; ++i) body_.skip(property.type);
    }

    void read_face(const PlyProperty& list) {
        const std::int64_t count = length(list);
        if (count < 3) body_.fail(fmt::format("a face with {} corners; it must have three", count));
        const auto vertices = static_cast<double>(header_.element("vertex")->count);
        std::int32_t first = 0, before = 0;
        for (std::int64_t i = 0; i < count; ++i) {
            const double index = body_.next(list.type);
            if (!(index >= 0 && index < vertices) || index != std::floor(index))
                body_.fail(
                    fmt::format("a face names vertex {:g}; they are 0 to {:.0f}", index, vertices - 1));
            const auto corner = static_cast<std::int32_t>(index);
            if (i == 0) first = corner;
            if (i >= 2) mesh_.triangles.push_back({first, before, corner});
            before = corner;
        }
    }

    const PlyHeader& header_;
    std::size_t corners_;  // place of the list of corners among the properties of a face
    Body body_;
    TriangleMesh mesh_;
};

std::size_t corners_of(const PlyElement& face) {
    for (const char* name : {"vertex_indices", "vertex_index"}) {
        const std::size_t place = face.place_of(name);
        if (place != PlyElement::npos && face.properties[place].list) return place;
    }
    return PlyElement::npos;
}

}  // namespace

TriangleMesh read_ply(const fs::path& file, std::string_view bytes) {
    const PlyHeader header = PlyHeaderReader(file, bytes).read();
    const PlyElement *const vertex = header.element("vertex"), *const face = header.element("face");
    if (vertex == nullptr) refuse_file(file, "this PLY file has no element vertex");
    for (const char* name : {"x", "y", "z"})
        if (vertex->place_of(name) == PlyElement::npos)
            refuse_file(file, fmt::format("the vertices of this PLY file have no property {}", name));
    if (face == nullptr) refuse_file(file, "this PLY file has no element face; write triangles or polygons");
    const std::size_t corners = corners_of(*face);
    if (corners == PlyElement::npos)
        refuse_file(file, "the faces of this PLY file have no list vertex_indices");
    if (header.form == PlyHeader::Form::ascii)
        return Ply<AsciiBody>(header, corners, AsciiBody(file, header)).read();
    return Ply<BinaryBody>(header, corners, BinaryBody(file, header, bytes)).read();
}

}  // namespace grainreel
