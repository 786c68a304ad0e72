// A data set of VTK as its files hold it: points, cells on them, numbers at both. What of it is a grain, a
// wall or a contact is decided in vtk_frame.hpp, once for all of VTK's formats.
//
// Source: Kitware, The VTK User's Guide, 11th edition (2010), chapter "VTK File Formats".
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "engine/files/foreign/raw_file.hpp"
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

// Columns of RawTable out of VTK's arrays.

// Which tuples of the arrays are rows of a table: all in their order, or those listed. kNoTuple: a row of
// NaN.
struct VtkRows {
    std::size_t count = 0;
    bool all = true;
    std::vector<std::size_t> tuples{};
};
inline constexpr std::size_t kNoTuple = static_cast<std::size_t>(-1);

// Columns under the arrays' names, "v:0", "v:1", "v:2" of vectors.
std::vector<RawColumn> columns_of(std::vector<VtkArray>&& arrays, const VtkRows& rows);
// The columns "x", "y", "z" (with the tail, "1" gives "x1") of points.
std::vector<RawColumn> place_columns(const std::vector<double>& places, const VtkRows& rows,
                                     const char* tail);

// Adds rows. Throws UserError where the table has rows already, and other columns than these.
void add_rows(RawTable& table, std::vector<RawColumn>&& columns, std::size_t rows, const std::string& where);

// What of a VTK data set is a grain, a contact or a wall. Points with vertex cells, or all points where there
// are no cells, are grains. Lines of two points are contacts. Triangles, polygons, strips and the faces of
// solid cells are walls.

// How much of everything there is, by the cells alone.
struct VtkCount {
    std::int64_t grains = 0, contacts = 0;
    bool walls = false;
    std::int64_t points_left_out = 0;  // without a cell, beside others that have vertex cells
    std::int64_t lines_left_out = 0;   // of one point, or of more than two
};

// Throws UserError for cells whose surface is not read.
VtkCount count_of(const std::vector<VtkPiece>& pieces);

// Throws UserError also where a piece has other columns than the one before it.
RawFrame frame_of(VtkContents&& contents);

// Adds what another file of the same moment holds. A column that only one of them has is NaN in the other's
// rows.
void merge_frames(RawFrame& frame, RawFrame&& more);

// A file of one frame, by the function that reads its kind. Throws UserError.
std::unique_ptr<RawFile> open_vtk_file(const std::filesystem::path& file,
                                       VtkContents (*read)(const std::filesystem::path& file, VtkPart part));

// Legacy files of VTK (.vtk), text and binary, versions 1 to 5.1: PolyData and UnstructuredGrid.

RawFormat vtk_legacy_format();

// Throws UserError with file and line (text) or byte (binary): damage, grids, cells whose surface is not
// read.
VtkContents read_vtk_legacy(const std::filesystem::path& file, VtkPart part);

bool takes_vtk_legacy(const FileHead& head);

}  // namespace grainreel
