// A data set of VTK as its files hold it: points, cells on them, numbers at both. What of it is a grain, a
// wall or a contact is decided in vtk_frame.hpp, once for all of VTK's formats.
//
// Source: Kitware, The VTK User's Guide, 11th edition (2010), chapter "VTK File Formats".
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "engine/files/frames/world.hpp"

namespace grainreel {

struct VtkArray {
    std::string name;
    std::size_t components = 1;
    std::vector<double> values;  // tuple after tuple
};

// Numbers of VTK's cell types.
struct VtkCell {
    enum Type : std::uint8_t {
        empty = 0,
        vertex = 1,
        poly_vertex = 2,
        line = 3,
        poly_line = 4,
        triangle = 5,
        strip = 6,
        polygon = 7,
        pixel = 8,
        quad = 9,
        tetra = 10,
        voxel = 11,
        hexahedron = 12,
        wedge = 13,
        pyramid = 14,
        polyhedron = 42
    };
};

// One cell after the other. The corners of a polyhedron are a stream: faces, then for each its corners'
// number and the corners.
struct VtkCells {
    std::vector<std::uint8_t> types;
    std::vector<std::int64_t> ends;  // of each cell in `corners`
    std::vector<std::int64_t> corners;

    std::size_t size() const { return types.size(); }
    std::size_t begin_of(std::size_t cell) const {
        return cell == 0 ? 0 : static_cast<std::size_t>(ends[cell - 1]);
    }
    std::size_t end_of(std::size_t cell) const { return static_cast<std::size_t>(ends[cell]); }
};

struct VtkPiece {
    std::string where;  // "bed.vtu:12": for messages
    std::size_t points = 0;
    std::vector<double> places;  // x, y, z of each; empty where only the cells were asked for
    VtkCells cells;              // in the order of the cell data
    std::vector<VtkArray> point_data, cell_data;
};

// All of a file.
struct VtkContents {
    std::string format{};   // "VTK XML, PolyData"
    std::string program{};  // that wrote it; empty where the file does not say
    std::optional<double> time{};
    std::optional<std::int64_t> step{};
    std::vector<VtkPiece> pieces{};
    std::vector<std::string> species{};  // names of the types 1, 2, ..., as our export writes them
    std::vector<std::string> news{};     // for the user, without the file's name
};

// Whether the numbers are wanted, or only what says how many grains, walls and contacts there are.
enum class VtkPart { cells, all };

}  // namespace grainreel
