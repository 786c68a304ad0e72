// Writes VTK's XML files, .vtp (PolyData) and .vti (ImageData), and makes the lines of contacts for them.
// Arrays lie raw in the appended section, each packed by zlib in blocks.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "engine/files/frames/stored_world.hpp"
#include "engine/state/contact.hpp"
#include "engine/state/state.hpp"

namespace grainreel {

struct VtkList {
    std::string name;
    std::string type;  // "Float64", "Float32", "Int64", "Int32", "UInt8"
    int components = 1;
    std::string bytes;  // the numbers as they lie in memory, little endian

    static VtkList doubles(std::string name, const std::vector<double>& values, int components = 1);
    static VtkList integers(std::string name, const std::vector<std::int64_t>& values);
};

// Facts about the whole file (FieldData).
struct VtkFacts {
    std::optional<double> time;                                           // s, as TimeValue
    std::optional<std::int64_t> step;                                     // as CYCLE
    std::vector<std::pair<std::string, std::vector<std::string>>> words;  // "species": names
};

// A piece of PolyData with cells of one kind: vertices, lines or triangles.
struct VtkPolyData {
    enum class Cells { vertices, lines, triangles };
    Cells cells = Cells::vertices;
    std::vector<double> points;  // x, y, z of each
    // Points of the cells, points_a_cell of each.
    std::vector<std::int64_t> connectivity;
    std::int64_t points_a_cell = 1;
    std::vector<VtkList> point_data, cell_data;
    VtkFacts facts;
};

// A grid of equal cells with a value or a vector in each; x runs fastest.
struct VtkImage {
    std::array<std::size_t, 3> cells{1, 1, 1};
    std::array<double, 3> origin{}, spacing{1, 1, 1};  // m; the origin is the lowest corner
    std::vector<VtkList> cell_data;
    VtkFacts facts;
};

// The whole content of the file. Blocks are packed on so many threads (0: as many as there are processors);
// the bytes do not depend on their number.
std::string vtk_bytes(const VtkPolyData& data, int threads = 0);
std::string vtk_bytes(const VtkImage& image, int threads = 0);

// A file's name and time, for the list in a .pvd.
struct VtkEntry {
    double time = 0;
    int part = 0;
    std::string file;
};
std::string pvd_text(const std::vector<VtkEntry>& entries);

// The contacts of a frame as lines from the first grain's centre to the second's, or to the point of contact
// on a wall. Across a periodic edge a line ends at the image of the second grain. The lines have these
// arrays: normal_force (N, 0 or more), tangential_force and force (N, both on the second body), id1, id2 (for
// a wall, minus 1 minus its number) and to_wall.
VtkPolyData contact_lines(const State& frame, const std::vector<SavedContact>& contacts,
                          const StoredWorld& world);

// The same where points and tangential forces are not known: lines between grains only, with normal_force,
// id1, id2 and to_wall.
VtkPolyData contact_lines(const State& frame, const std::vector<Link>& touches, const StoredWorld& world);

// The sum of all contact forces on each grain, N.
std::vector<Vec3> forces_on_grains(const State& frame, const std::vector<SavedContact>& contacts,
                                   const StoredWorld& world);

}  // namespace grainreel
