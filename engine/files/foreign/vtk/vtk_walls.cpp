#include "engine/files/foreign/vtk/vtk_walls.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <set>

#include "engine/base/error.hpp"
#include "engine/files/foreign/vtk/vtk_columns.hpp"
#include "engine/files/foreign/vtk/vtk_surface.hpp"

namespace grainreel {
namespace {

constexpr auto most_vertices = static_cast<std::size_t>(std::numeric_limits<std::int32_t>::max());

// Triangles of some cells, with the points that they use and no others.
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
    // As many parts as triangles are ids of triangles.
    if (counts && !meshid.empty() && counted.back() + 1 < meshid.size()) return counted;
    if (numbers && !meshid.empty() && 2 * (numbered.back() + 1) <= meshid.size()) return numbered;
    return std::vector<std::size_t>(meshid.size(), 0);
}

std::vector<RawWall> walls_of(const VtkPiece& piece) {
    if (piece.points >= most_vertices)
        throw UserError(
            fmt::format("{}: a surface of {} points; at most 2^31 are read", piece.where, piece.points));
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

}  // namespace grainreel
