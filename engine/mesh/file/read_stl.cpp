// Reads the triangles of an STL file, ASCII or binary.
#include <fmt/format.h>

#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <vector>

#include "engine/base/number_text.hpp"
#include "engine/base/text.hpp"
#include "engine/base/vector.hpp"
#include "engine/base/word_reader.hpp"
#include "engine/mesh/file/mesh_readers.hpp"

namespace grainreel {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t head = 84, row = 50,
                      first_corner = 12;  // bytes; a row has the normal and three corners, 12 bytes each

static_assert(std::endian::native == std::endian::little);

// Gives equal corners one number, because STL repeats the corners for each triangle.
class VertexPool {
  public:
    explicit VertexPool(std::size_t triangles) {
        vertices_.reserve(triangles / 2 + 4);
        std::size_t size = 64;
        while (size < triangles + triangles / 2) size *= 2;
        table_.assign(size, -1);
    }

    std::int32_t number_of(Vec3 place) {
        place += Vec3(0, 0, 0);  // makes 0 of -0, which would have another hash
        std::size_t slot = hash(place) & (table_.size() - 1);
        while (table_[slot] >= 0) {
            if (vertices_[table_[slot]] == place) return table_[slot];
            slot = (slot + 1) & (table_.size() - 1);
        }
        const auto number = static_cast<std::int32_t>(vertices_.size());
        table_[slot] = number;
        vertices_.push_back(place);
        if (2 * vertices_.size() > table_.size()) grow();
        return number;
    }
    std::vector<Vec3>& vertices() { return vertices_; }

  private:
    static std::size_t hash(const Vec3& place) {
        std::uint64_t mixed = 0;
        for (int k = 0; k < 3; ++k) {
            mixed = (mixed ^ std::bit_cast<std::uint64_t>(place[k])) * 0x9e3779b97f4a7c15u;
            mixed ^= mixed >> 29;
        }
        mixed *= 0xbf58476d1ce4e5b9u;
        return static_cast<std::size_t>(mixed ^ (mixed >> 32));
    }

    void grow() {
        table_.assign(2 * table_.size(), -1);
        for (std::size_t i = 0; i < vertices_.size(); ++i) {
            std::size_t slot = hash(vertices_[i]) & (table_.size() - 1);
            while (table_[slot] >= 0) slot = (slot + 1) & (table_.size() - 1);
            table_[slot] = static_cast<std::int32_t>(i);
        }
    }

    std::vector<Vec3> vertices_;
    std::vector<std::int32_t> table_;  // open addressing; -1 marks a free place
};

// Reads the words of an ASCII STL.
class AsciiStl {
  public:
    AsciiStl(const fs::path& file, std::string_view bytes)
        : file_(file), words_(bytes), pool_(bytes.size() / fewest_bytes) {}

    TriangleMesh read() {
        TriangleMesh mesh;
        for (std::string_view word = words_.next(); !word.empty(); word = words_.next()) {
            const bool begins = same_word(word, "solid");
            if (begins || same_word(word, "endsolid")) {
                open_ = begins;
                words_.skip_line();  // a name, which may be any words
            } else if (same_word(word, "facet"))
                mesh.triangles.push_back(facet());
            else
                unexpected(word, "facet");
        }
        if (open_)
            refuse_line(file_, words_.line(),
                        "the file ends within a solid, where \"endsolid\" must stand; was it copied or "
                        "written to the end?");
        mesh.vertices = std::move(pool_.vertices());
        return mesh;
    }

  private:
    static constexpr std::size_t fewest_bytes = 100;  // approximate least size of a facet

    [[noreturn]] void unexpected(std::string_view word, const char* wanted) {
        if (word.empty())
            refuse_line(file_, words_.line(),
                        fmt::format("the file ends within a facet, where \"{}\" must stand", wanted));
        refuse_line(file_, words_.line(),
                    fmt::format("\"{}\" where \"{}\" must stand", excerpt(word), wanted));
    }
    void expect(const char* wanted) {
        const std::string_view word = words_.next();
        if (!same_word(word, wanted)) unexpected(word, wanted);
    }

    TriangleMesh::Triangle facet() {
        skip_normal();
        expect("loop");
        TriangleMesh::Triangle triangle{};
        for (std::int32_t& corner : triangle) {
            expect("vertex");
            Vec3 place;
            for (int k = 0; k < 3; ++k) place[k] = coordinate();
            corner = pool_.number_of(place);
        }
        const std::string_view word = words_.next();
        if (same_word(word, "vertex"))
            refuse_line(file_, words_.line(), "a facet with a fourth corner; write triangles");
        if (!same_word(word, "endloop")) unexpected(word, "endloop");
        expect("endfacet");
        return triangle;
    }

    // Skips the normal, whatever stands there. If the triangle has no area, it is usually "nan".
    void skip_normal() {
        std::string_view word = words_.next();
        while (!same_word(word, "outer")) {
            if (word.empty() || same_word(word, "vertex") || same_word(word, "facet"))
                unexpected(word, "outer");
            word = words_.next();
        }
    }

    double coordinate() {
        const std::string_view word = words_.next();
        const std::optional<double> value = number_in(word);
        if (!value) refuse_line(file_, words_.line(), no_coordinate(word));
        if (std::abs(*value) > largest_coordinate) refuse_line(file_, words_.line(), too_far(*value));
        return *value;
    }

    const fs::path& file_;
    WordReader words_;
    VertexPool pool_;
    bool open_ = false;  // between solid and endsolid
};

Vec3 corner_at(const fs::path& file, std::string_view bytes, std::size_t at) {
    float values[3];
    std::memcpy(values, bytes.data() + at, sizeof values);
    for (std::size_t k = 0; k < 3; ++k) {
        const std::size_t byte = at + k * sizeof(float);
        if (!std::isfinite(values[k]))
            refuse_byte(file, byte, "has a coordinate that is no finite number; export the mesh again");
        if (std::abs(values[k]) > largest_coordinate) refuse_byte(file, byte, too_far(values[k]));
    }
    return Vec3(values[0], values[1], values[2]);
}

}  // namespace

TriangleMesh read_binary_stl(const fs::path& file, std::string_view bytes) {
    const std::size_t count = (bytes.size() - head) / row;
    VertexPool pool(count);
    TriangleMesh mesh;
    mesh.triangles.resize(count);
    for (std::size_t i = 0; i < count; ++i)
        for (std::size_t k = 0; k < 3; ++k)
            mesh.triangles[i][k] =
                pool.number_of(corner_at(file, bytes, head + i * row + (k + 1) * first_corner));
    mesh.vertices = std::move(pool.vertices());
    for (Vec3& vertex : mesh.vertices)
        for (int k = 0; k < 3; ++k) vertex[k] = decimal_of(static_cast<float>(vertex[k]));
    return mesh;
}

TriangleMesh read_ascii_stl(const fs::path& file, std::string_view bytes) {
    return AsciiStl(file, bytes).read();
}

}  // namespace grainreel
