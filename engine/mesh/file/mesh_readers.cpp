#include "engine/mesh/file/mesh_readers.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>

#include "engine/base/word_reader.hpp"
#include "engine/mesh/file/mesh_bytes.hpp"

namespace grainreel {
namespace {

namespace fs = std::filesystem;

constexpr const char* known = "give an STL, OBJ or PLY file";

// The size that a binary STL with the file's count of triangles must have; 0 for files that are too short for
// one.
struct BinaryStl {
    std::uint64_t triangles = 0, bytes = 0;
};

BinaryStl as_binary_stl(std::string_view bytes) {
    if (bytes.size() < 84) return {};
    std::uint32_t count = 0;
    std::memcpy(&count, bytes.data() + 80, sizeof count);
    return {count, 84 + 50 * std::uint64_t{count}};
}

// Text has no zero bytes; a binary STL always has some, in its attributes.
bool is_text(std::string_view bytes) {
    return bytes.substr(0, 4096).find('\0') == std::string_view::npos;
}

std::string_view first_word(std::string_view bytes) {
    WordReader words(bytes);
    std::string_view word = words.next();
    while (word.starts_with('#')) {
        words.skip_line();
        word = words.next();
    }
    return word;
}

[[noreturn]] void refuse_binary(const fs::path& file, std::string_view bytes, bool solid) {
    if (bytes.size() < 84)
        refuse_file(file, fmt::format("is no mesh: {} bytes that are no text; {}", bytes.size(), known));
    const BinaryStl stl = as_binary_stl(bytes);
    const std::string sizes = fmt::format("says {} triangles, which take {} bytes; the file has {}",
                                          stl.triangles, stl.bytes, bytes.size());
    if (solid) refuse_byte(file, 80, fmt::format("this binary STL {}; export it again", sizes));
    refuse_byte(file, 80,
                fmt::format("is no mesh, or a damaged one: as a binary STL it {}; {}", sizes, known));
}

}  // namespace

const char* name_of(MeshFormat format) {
    switch (format) {
        case MeshFormat::binary_stl:
            return "binary STL";
        case MeshFormat::ascii_stl:
            return "ASCII STL";
        case MeshFormat::obj:
            return "OBJ";
        case MeshFormat::ply:
            return "PLY";
    }
    return "";
}

MeshFormat format_of(const fs::path& file, std::string_view bytes) {
    if (bytes.size() > 3 && bytes.starts_with("ply") && std::strchr("\r\n \t", bytes[3]) != nullptr &&
        bytes[3] != '\0')
        return MeshFormat::ply;
    const BinaryStl stl = as_binary_stl(bytes);
    if (stl.bytes == bytes.size()) return MeshFormat::binary_stl;
    const std::string_view word = first_word(bytes);
    const bool solid = same_word(word, "solid");
    if (!is_text(bytes)) refuse_binary(file, bytes, solid);
    if (solid) return MeshFormat::ascii_stl;
    if (is_obj_word(word)) return MeshFormat::obj;
    refuse_line(file, 1, fmt::format("this text is no mesh: neither STL, OBJ nor PLY; {}", known));
}

TriangleMesh read_mesh(MeshFormat format, const fs::path& file, std::string_view bytes) {
    switch (format) {
        case MeshFormat::binary_stl:
            return read_binary_stl(file, bytes);
        case MeshFormat::ascii_stl:
            return read_ascii_stl(file, bytes);
        case MeshFormat::obj:
            return read_obj(file, bytes);
        case MeshFormat::ply:
            return read_ply(file, bytes);
    }
    return {};
}

std::string too_far(double coordinate) {
    return fmt::format("a coordinate of {:g}; the largest that is taken is {:g}", coordinate,
                       largest_coordinate);
}

std::string no_coordinate(std::string_view word) {
    return no_number(word) + (word.empty() ? "" : "; correct it, or export the mesh again");
}

}  // namespace grainreel
