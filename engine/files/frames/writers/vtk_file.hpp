// Files of VTK in XML: .vtp (PolyData) and .vti (ImageData). Arrays lie in the appended section, raw, each
// packed by zlib in blocks.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "engine/files/frames/world.hpp"
#include "engine/frame.hpp"

namespace grainreel {

struct VtkList {
    std::string name;
    std::string type;  // "Float64", "Float32", "Int64", "Int32", "UInt8"
    int components = 1;
    std::string bytes;  // the numbers as they lie in memory, little endian

    static VtkList doubles(std::string name, const std::vector<double>& values, int components = 1);
    static VtkList floats(std::string name, const std::vector<double>& values, int components = 1);
    static VtkList integers(std::string name, const std::vector<std::int64_t>& values);
};

// What a file says as a whole (FieldData).
struct VtkFacts {
    std::optional<double> time;                                           // s, as TimeValue
    std::optional<std::int64_t> step;                                     // as CYCLE
    std::vector<std::pair<std::string, std::vector<std::string>>> words;  // "species": names
};

// A piece of PolyData. Connectivity and offsets as VTK has them, for one of vertices, lines and triangles.
struct VtkPolyData {
    enum class Cells { vertices, lines, triangles };
    Cells cells = Cells::vertices;
    std::vector<double> points;  // x y z
    std::vector<std::int64_t> connectivity;
    std::int64_t points_a_cell = 1;
    std::vector<VtkList> point_data, cell_data;
    VtkFacts facts;
};

// A grid of equal cells, a value or a vector for each; x runs fastest.
struct VtkImage {
    std::array<std::size_t, 3> cells{1, 1, 1};
    std::array<double, 3> origin{}, spacing{1, 1, 1};  // m; the origin is the lowest corner
    std::vector<VtkList> cell_data;
    VtkFacts facts;
};

// The file's text and bytes. Packs the blocks on as many threads; 0: as many as there are processors. The
// bytes do not depend on that.
std::string vtk_bytes(const VtkPolyData& data, int threads = 0);
std::string vtk_bytes(const VtkImage& image, int threads = 0);

// An unpacked file's name and time, for a .pvd.
struct VtkEntry {
    double time = 0;
    int part = 0;
    std::string file;
};
std::string pvd_text(const std::vector<VtkEntry>& entries);

// The contacts of a frame for VTK: lines with forces, and what they add up to on each grain.

// A line from the first grain's centre to the second's, or to the point of contact on a wall. Across a
// periodic edge it ends at the image of the second one. Arrays of lines: normal_force (N, 0 or more),
// tangential_force and force (N, both on the second one), id1, id2 (of a wall -1 - its number), to_wall.
VtkPolyData contact_lines(const Frame& frame, const std::vector<ContactRecord>& contacts, const World& world);

// Where points and tangential forces are not known: lines between grains, with normal_force, id1, id2 and
// to_wall.
VtkPolyData contact_lines(const Frame& frame, const std::vector<Touch>& touches, const World& world);

// N, the sum of all contact forces on each grain.
std::vector<Vec3> forces_on_grains(const Frame& frame, const std::vector<ContactRecord>& contacts,
                                   const World& world);

}  // namespace grainreel
