// Mesh files that tests write.
#pragma once

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>
#include <vector>

#include "engine/mesh/load_mesh.hpp"
#include "tests/support/temporary_folder.hpp"

namespace grainreel {

template <class T>
void append(std::string& bytes, T value, bool big_endian = false) {
    std::string part(reinterpret_cast<const char*>(&value), sizeof value);
    bytes += big_endian ? std::string(part.rbegin(), part.rend()) : part;
}

// `count`: what the header says.
inline std::string binary_stl(const TriangleMesh& mesh, std::string head, std::uint32_t count,
                              std::uint16_t attribute = 0) {
    head.resize(80, ' ');
    append(head, count);
    for (const TriangleMesh::Triangle& triangle : mesh.triangles) {
        for (int k = 0; k < 3; ++k) append(head, 0.0f);
        for (const std::int32_t corner : triangle)
            for (int k = 0; k < 3; ++k)
                append(head, static_cast<float>(mesh.vertices[static_cast<std::size_t>(corner)][k]));
        append(head, attribute);
    }
    return head;
}

// Each "\n" as another end of a line.
inline std::string with_ends(std::string_view text, std::string_view end) {
    std::string out;
    for (const char c : text) out += c == '\n' ? end : std::string_view(&c, 1);
    return out;
}

// A square of 0.25 m in two triangles, as text of an STL file, between its first and its last line.
inline constexpr const char* plate_facets =
    "  facet normal 0 0 1\n    outer loop\n      vertex 0 0 0\n      vertex 0.25 0 0\n      vertex 0.25 0.25 "
    "0\n"
    "    endloop\n  endfacet\n"
    "  facet normal 0 0 1\n    outer loop\n      vertex 0 0 0\n      vertex 0.25 0.25 0\n      vertex 0 0.25 "
    "0\n"
    "    endloop\n  endfacet\n";

inline TriangleMesh plate() {
    return {{{0, 0, 0}, {0.25, 0, 0}, {0.25, 0.25, 0}, {0, 0.25, 0}}, {{0, 1, 2}, {0, 2, 3}}};
}

}  // namespace grainreel
