// Turns a data set of VTK (points, cells on them, numbers at both) into a frame. The readers of VTK's formats
// only make VtkContents; which points and cells are grains, walls and contacts is decided here.
//
// Source: Kitware, The VTK User's Guide, 11th edition (2010), chapter "VTK File Formats".
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "engine/files/foreign/raw_file.hpp"
#include "engine/files/frames/stored_world.hpp"

namespace grainreel {

struct VtkArray {
    std::string name;
    std::size_t components = 1;
    std::vector<double> values;  // tuple after tuple
};

// The numbers of VTK's types of cells.
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

// Cells, one after the other. The corners of a polyhedron are a stream: the number of faces, and then for
// each face the number of its corners and the corners.
struct VtkCells {
    std::vector<std::uint8_t> types;
    std::vector<std::int64_t> ends;  // end of each cell in `corners`
    std::vector<std::int64_t> corners;

    std::size_t size() const { return types.size(); }
    std::size_t begin_of(std::size_t cell) const {
        return cell == 0 ? 0 : static_cast<std::size_t>(ends[cell - 1]);
    }
    std::size_t end_of(std::size_t cell) const { return static_cast<std::size_t>(ends[cell]); }
};

struct VtkPiece {
    std::string where;  // "bed.vtu:12", for messages
    std::size_t points = 0;
    std::vector<double> places;  // x, y, z of each point; empty if only the cells were asked for
    VtkCells cells;              // in the order of the cell data
    std::vector<VtkArray> point_data, cell_data;
};

// All that a file holds.
struct VtkContents {
    std::string format{};   // "VTK XML, PolyData"
    std::string program{};  // the program that wrote it; empty if the file does not say
    std::optional<double> time{};
    std::optional<std::int64_t> step{};
    std::vector<VtkPiece> pieces{};
    std::vector<std::string> species{};  // names of the types 1, 2, ... in files of our export
    std::vector<std::string> news{};     // for the user, without the file's name
};

// Whether all is read, or only the cells, which tell how many grains, walls and contacts there are.
enum class VtkPart { cells, all };

// Which tuples of the arrays become rows of a table: all in their order, or those listed. kNoTuple makes a
// row of NaN.
struct VtkRows {
    std::size_t count = 0;
    bool all = true;
    std::vector<std::size_t> tuples{};
};
inline constexpr std::size_t kNoTuple = static_cast<std::size_t>(-1);

// Columns with the names of the arrays; those of vectors are "v:0", "v:1", "v:2".
std::vector<RawColumn> columns_of(std::vector<VtkArray>&& arrays, const VtkRows& rows);
// The columns "x", "y", "z" of points. `tail` is added to the names: "1" gives "x1".
std::vector<RawColumn> place_columns(const std::vector<double>& places, const VtkRows& rows,
                                     const char* tail);

// Adds rows. Throws UserError where the table has rows with other columns.
void add_rows(RawTable& table, std::vector<RawColumn>&& columns, std::size_t rows, const std::string& where);

// How many grains, contacts and walls there are, by the cells only. Points with vertex cells are grains, and
// so are all points where there are no cells. Lines of two points are contacts. Triangles, polygons, strips
// and the faces of solid cells are walls.
struct VtkCount {
    std::int64_t grains = 0, contacts = 0;
    bool walls = false;
    std::int64_t points_left_out = 0;  // points without vertex cell, in pieces that have only vertex cells
    std::int64_t lines_left_out = 0;   // lines of one point or of more than two
};

// Throws UserError for cells whose surface is not read.
VtkCount count_of(const std::vector<VtkPiece>& pieces);

// Makes the frame. Throws UserError as count_of() does, and where a piece has other columns than the one
// before it.
RawFrame frame_of(VtkContents&& contents);

// Adds the frame of another file of the same moment. A column that only one of them has is NaN in the rows of
// the other.
void merge_frames(RawFrame& frame, RawFrame&& more);

// Opens a file of one frame with the function that reads its kind. Throws UserError.
std::unique_ptr<RawFile> open_vtk_file(const std::filesystem::path& file,
                                       VtkContents (*read)(const std::filesystem::path& file, VtkPart part));

// Legacy files of VTK (.vtk), text and binary, versions 1 to 5.1: PolyData and UnstructuredGrid.
RawFormat vtk_legacy_format();

// Throws UserError with file and line (text) or byte (binary) for damage, grids, and cells whose surface
// cannot be read.
VtkContents read_vtk_legacy(const std::filesystem::path& file, VtkPart part);

bool takes_vtk_legacy(const FileStart& head);

// The walls in the surface cells of a data set: one wall with the cell data as its columns. For dumps of
// LIGGGHTS, which have an array "meshid", a wall for each mesh. Empty where there are no surface cells.
// Throws UserError for cells whose surface cannot be read.
std::vector<RawWall> walls_of(const VtkPiece& piece);

// The number of the mesh that each triangle belongs to, by the column "meshid". LIGGGHTS numbers the
// triangles of each mesh from 0, so a new mesh begins at each 0. Other programs may give all triangles of a
// mesh one number. If the column fits neither way, all numbers are 0.
std::vector<std::size_t> mesh_parts(const std::vector<double>& meshid);

// Adds the second wall to the first. Returns false, and adds nothing, where their columns differ or they have
// too many points together.
bool join_walls(RawWall& wall, const RawWall& more);

using VtkTriangle = std::array<std::int64_t, 3>;  // points of the piece

// Whether a cell is neither a point, a line nor empty.
bool is_surface(std::uint8_t type);

// Adds the triangles of a surface, or of the faces of a solid cell. The order of corners is VTK's (The VTK
// User's Guide, "VTK File Formats", figures of the linear cell types). Polygons are cut from their first
// corner; every second triangle of a strip is turned round. Throws UserError for cells that are no surface or
// have too few corners.
void split_cell(const VtkPiece& piece, std::size_t cell, std::vector<VtkTriangle>& triangles);

}  // namespace grainreel
