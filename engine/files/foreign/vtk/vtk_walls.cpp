// Makes walls from the cells of a VTK file: surface cells become triangles, and each mesh becomes one wall.
#include "engine/files/foreign/vtk/vtk_frame.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <limits>
#include <set>
#include <span>

#include "engine/base/error.hpp"
#include "engine/files/foreign/vtk/vtk_numbers.hpp"

namespace grainreel {

namespace {

constexpr auto most_vertices = static_cast<std::size_t>(std::numeric_limits<std::int32_t>::max());

// A wall of these triangles, with only the points that they use. cells: the cell that each triangle is from.
RawWall wall_of(const VtkPiece& piece, const std::vector<VtkTriangle>& triangles,
                const std::vector<std::size_t>& cells) {
    RawWall wall;
    std::vector<std::int32_t> number(piece.points, -1);
    for (const VtkTriangle& triangle : triangles) {
        TriangleMesh::Triangle corners{};
        for (std::size_t k = 0; k < 3; ++k) {
            const auto point = static_cast<std::size_t>(triangle[k]);
            if (number[point] < 0) {
                number[point] = static_cast<std::int32_t>(wall.mesh.vertices.size());
                const double* place = piece.places.data() + 3 * point;
                wall.mesh.vertices.emplace_back(place[0], place[1], place[2]);
            }
            corners[k] = number[point];
        }
        wall.mesh.triangles.push_back(corners);
    }
    std::vector<VtkArray> data = piece.cell_data;
    wall.cells.rows = triangles.size();
    wall.cells.columns = columns_of(std::move(data), {cells.size(), false, cells});
    return wall;
}

const VtkArray* meshid_of(const VtkPiece& piece) {
    for (const VtkArray& array : piece.cell_data)
        if (array.name == "meshid" && array.components == 1) return &array;
    return nullptr;
}

}  // namespace

std::vector<std::size_t> mesh_parts(const std::vector<double>& meshid) {
    std::vector<std::size_t> counted, numbered;
    bool counts = true, numbers = true;
    std::set<double> seen;
    for (std::size_t i = 0; i < meshid.size(); ++i) {
        const bool first = i == 0, zero = meshid[i] == 0;
        counts = counts && (zero || (!first && meshid[i] == meshid[i - 1] + 1));
        counted.push_back(first ? 0 : counted.back() + (zero ? 1 : 0));
        const bool next = !first && meshid[i] != meshid[i - 1];
        numbers = numbers && (first || !next || !seen.contains(meshid[i]));
        numbered.push_back(first ? 0 : numbered.back() + (next ? 1 : 0));
        seen.insert(meshid[i]);
    }
    // If there are as many meshes as triangles, the column has ids of triangles and not of meshes.
    if (counts && !meshid.empty() && counted.back() + 1 < meshid.size()) return counted;
    if (numbers && !meshid.empty() && 2 * (numbered.back() + 1) <= meshid.size()) return numbered;
    return std::vector<std::size_t>(meshid.size(), 0);
}

std::vector<RawWall> walls_of(const VtkPiece& piece) {
    if (piece.points >= most_vertices)
        throw UserError("{}: a surface of {} points; at most 2^31 are read", piece.where, piece.points);
    std::vector<std::size_t> surfaces;
    for (std::size_t cell = 0; cell < piece.cells.size(); ++cell)
        if (is_surface(piece.cells.types[cell])) surfaces.push_back(cell);
    if (surfaces.empty()) return {};
    std::vector<std::size_t> parts(surfaces.size(), 0);
    if (const VtkArray* meshid = meshid_of(piece)) {
        std::vector<double> ids;
        for (const std::size_t cell : surfaces) ids.push_back(meshid->values[cell]);
        parts = mesh_parts(ids);
    }
    std::vector<RawWall> walls;
    std::vector<VtkTriangle> triangles;
    std::vector<std::size_t> cells;
    for (std::size_t i = 0; i < surfaces.size(); ++i) {
        split_cell(piece, surfaces[i], triangles);
        cells.resize(triangles.size(), surfaces[i]);
        if (i + 1 < surfaces.size() && parts[i + 1] == parts[i]) continue;
        if (!triangles.empty()) walls.push_back(wall_of(piece, triangles, cells));
        triangles.clear();
        cells.clear();
    }
    return walls;
}

bool join_walls(RawWall& wall, const RawWall& more) {
    const bool same = std::equal(wall.cells.columns.begin(), wall.cells.columns.end(),
                                 more.cells.columns.begin(), more.cells.columns.end(),
                                 [](const RawColumn& a, const RawColumn& b) { return a.name == b.name; });
    const std::size_t vertices = wall.mesh.vertices.size();
    if (!same || vertices + more.mesh.vertices.size() >= most_vertices) return false;
    wall.mesh.vertices.insert(wall.mesh.vertices.end(), more.mesh.vertices.begin(), more.mesh.vertices.end());
    for (TriangleMesh::Triangle triangle : more.mesh.triangles) {
        for (std::int32_t& corner : triangle) corner += static_cast<std::int32_t>(vertices);
        wall.mesh.triangles.push_back(triangle);
    }
    for (std::size_t i = 0; i < more.cells.columns.size(); ++i)
        wall.cells.columns[i].values.insert(wall.cells.columns[i].values.end(),
                                            more.cells.columns[i].values.begin(),
                                            more.cells.columns[i].values.end());
    wall.cells.rows += more.cells.rows;
    return true;
}

namespace {

using Corners = std::span<const std::int64_t>;

[[noreturn]] void refuse_cell(const VtkPiece& piece, std::size_t cell, const std::string& what) {
    throw UserError("{}: cell {} {}", piece.where, cell, what);
}

void cut_polygon(Corners corners, std::vector<VtkTriangle>& triangles) {
    for (std::size_t i = 2; i < corners.size(); ++i)
        triangles.push_back({corners[0], corners[i - 1], corners[i]});
}

void cut_strip(Corners corners, std::vector<VtkTriangle>& triangles) {
    for (std::size_t i = 2; i < corners.size(); ++i) {
        const std::size_t odd = i % 2;
        triangles.push_back({corners[i - 2 + odd], corners[i - 1 - odd], corners[i]});
    }
}

// The faces of a solid cell. The numbers count the cell's corners from 0; -1 is the fourth corner of a face
// with three.
struct Solid {
    std::uint8_t type;
    std::size_t corners;
    std::vector<std::array<int, 4>> faces;
};
const std::vector<Solid>& solids() {
    static const std::vector<Solid> all{
        {VtkCell::tetra, 4, {{0, 1, 3, -1}, {1, 2, 3, -1}, {2, 0, 3, -1}, {0, 2, 1, -1}}},
        {VtkCell::wedge, 6, {{0, 1, 2, -1}, {3, 5, 4, -1}, {0, 3, 4, 1}, {1, 4, 5, 2}, {2, 5, 3, 0}}},
        {VtkCell::pyramid, 5, {{0, 3, 2, 1}, {0, 1, 4, -1}, {1, 2, 4, -1}, {2, 3, 4, -1}, {3, 0, 4, -1}}}};
    return all;
}

void cut_solid(const Solid& solid, Corners corners, std::vector<VtkTriangle>& triangles) {
    for (const auto& face : solid.faces) {
        std::vector<std::int64_t> polygon;
        for (const int corner : face)
            if (corner >= 0) polygon.push_back(corners[corner]);
        cut_polygon(polygon, triangles);
    }
}

// A polyhedron is a stream: the number of faces, and for each the number of its corners and the corners.
void cut_polyhedron(const VtkPiece& piece, std::size_t cell, Corners stream,
                    std::vector<VtkTriangle>& triangles) {
    const auto fail = [&] {
        refuse_cell(piece, cell, fmt::format("is a polyhedron of wrong faces; {}", kWriteAgain));
    };
    if (stream.empty()) fail();
    std::size_t at = 1;
    for (std::int64_t face = 0; face < stream[0]; ++face) {
        if (at >= stream.size()) fail();
        const std::int64_t corners = stream[at++];
        if (corners < 0 || static_cast<std::size_t>(corners) > stream.size() - at) fail();
        const Corners polygon = stream.subspan(at, static_cast<std::size_t>(corners));
        for (const std::int64_t corner : polygon)
            if (corner < 0 || corner >= static_cast<std::int64_t>(piece.points)) fail();
        cut_polygon(polygon, triangles);
        at += polygon.size();
    }
}

void need_corners(const VtkPiece& piece, std::size_t cell, Corners corners, std::size_t count) {
    if (corners.size() != count)
        refuse_cell(piece, cell,
                    fmt::format("has {} corners where its type {} has {}; {}", corners.size(),
                                piece.cells.types[cell], count, kWriteAgain));
}

[[noreturn]] void refuse_type(const VtkPiece& piece, std::size_t cell, std::uint8_t type) {
    if (type == VtkCell::voxel || type == VtkCell::hexahedron)
        refuse_cell(piece, cell,
                    "is a hexahedron: the file holds a grid, not grains; give a file of points or of a "
                    "surface");
    refuse_cell(piece, cell,
                fmt::format("has type {}, whose surface is not read; write it as triangles", type));
}

}  // namespace

bool is_surface(std::uint8_t type) {
    return type > VtkCell::poly_line;
}

void split_cell(const VtkPiece& piece, std::size_t cell, std::vector<VtkTriangle>& triangles) {
    const Corners corners =
        Corners(piece.cells.corners)
            .subspan(piece.cells.begin_of(cell), piece.cells.end_of(cell) - piece.cells.begin_of(cell));
    const std::uint8_t type = piece.cells.types[cell];
    switch (type) {
        case VtkCell::triangle:
            need_corners(piece, cell, corners, 3);
            return cut_polygon(corners, triangles);
        case VtkCell::quad:
            need_corners(piece, cell, corners, 4);
            return cut_polygon(corners, triangles);
        case VtkCell::pixel: {
            need_corners(piece, cell, corners, 4);
            const std::array<std::int64_t, 4> around{corners[0], corners[1], corners[3], corners[2]};
            return cut_polygon(around, triangles);
        }
        case VtkCell::polygon:
            return cut_polygon(corners, triangles);
        case VtkCell::strip:
            return cut_strip(corners, triangles);
        case VtkCell::polyhedron:
            return cut_polyhedron(piece, cell, corners, triangles);
        default:
            break;
    }
    for (const Solid& solid : solids())
        if (solid.type == type) {
            need_corners(piece, cell, corners, solid.corners);
            return cut_solid(solid, corners, triangles);
        }
    refuse_type(piece, cell, type);
}

}  // namespace grainreel
