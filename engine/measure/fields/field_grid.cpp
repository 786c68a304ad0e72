#include "engine/measure/fields/field_grid.hpp"

#include <algorithm>
#include <cmath>

#include "engine/base/mathematics.hpp"
#include "engine/measure/walls/wall_bodies.hpp"
#include "engine/mesh/room.hpp"
#include "engine/mesh/surface.hpp"
#include "engine/scene/bed.hpp"
#include "engine/state/container_faces.hpp"

namespace grainreel {

std::vector<double> GridAxis::middles() const {
    std::vector<double> all;
    for (std::int64_t k = 0; k < count; ++k) all.push_back(middle(k));
    return all;
}

int FieldGrid::dimensions() const {
    return static_cast<int>(
        std::count_if(axes.begin(), axes.end(), [](const GridAxis& axis) { return axis.resolved; }));
}

namespace {

// Makes whole cells from wall to wall, none larger than wanted.
GridAxis axis_between(double low, double high, double wanted) {
    GridAxis axis;
    axis.count = std::max<std::int64_t>(1, std::llround(std::ceil((high - low) / wanted * (1 - 1e-12))));
    axis.cell = (high - low) / static_cast<double>(axis.count);
    axis.low = low;
    return axis;
}

void pad(GridAxis& axis, double reach) {
    const std::int64_t more = std::llround(std::ceil(reach / axis.cell));
    axis.low -= static_cast<double>(more) * axis.cell;
    axis.count += 2 * more;
}

}  // namespace

FieldGrid make_field_grid(const Scene& scene, const FieldOutput& fields) {
    const Extent extent = extent_of(scene);
    const bool has_walls = scene.container.shape != Container::Shape::none;
    FieldGrid grid;
    grid.axes[0].resolved = fields.grid == FieldOutput::Grid::xyz;
    const FieldKernel kernel(fields.kernel, kernel_width(fields.width, 0.5 * largest_diameter(scene)),
                             grid.axes[0].resolved ? 3 : 2);
    for (int k = 0; k < 3; ++k) {
        const bool resolved = grid.axes[k].resolved;
        const double length = extent.high[k] - extent.low[k];
        GridAxis axis = axis_between(extent.low[k], extent.high[k], resolved ? fields.cell : length);
        axis.resolved = resolved;
        axis.periodic = k == 0 && scene.container.periodic_depth;
        if (has_walls && resolved && !axis.periodic) pad(axis, kernel.cutoff());
        grid.axes[k] = axis;
    }
    return grid;
}

namespace {

constexpr double gaussian_cutoff = 3;  // widths

// Cutoff of Lucy's kernel, divided by the standard deviation along one axis. The mean of r2 is 5/28 of the
// squared cutoff in two dimensions and 1/4 in three, and all axes have equal shares of it.
double lucy_cutoff(int dimensions) {
    return dimensions == 2 ? std::sqrt(56.0 / 5) : std::sqrt(12.0);
}

}  // namespace

double kernel_value(FieldOutput::Kernel kind, double q) {
    if (kind == FieldOutput::Kernel::gaussian) return math::exp(-0.5 * math::square(gaussian_cutoff * q));
    return (1 + 3 * q) * math::cube(1 - q);
}

FieldKernel::FieldKernel(FieldOutput::Kernel kind, double width, int dimensions)
    : is_product_(kind == FieldOutput::Kernel::gaussian),
      width_(width),
      cutoff_(width * (kind == FieldOutput::Kernel::lucy ? lucy_cutoff(dimensions) : gaussian_cutoff)),
      places_(kEntries / (cutoff_ * cutoff_)) {
    for (int k = 0; k <= kEntries; ++k)
        values_.push_back(kernel_value(kind, std::sqrt(static_cast<double>(k) / kEntries)));
    values_.insert(values_.end(), {0.0, 0.0});
}

// Shares of the cells inside the container, from exact areas of straight and round cuts.

namespace {

using Corner = std::array<double, 2>;  // y and z, m

// Cuts a polygon by a face. The side that the face's normal points to stays.
std::vector<Corner> cut(const std::vector<Corner>& polygon, const Face& face) {
    const auto height = [&](const Corner& c) {
        return face.normal.y() * (c[0] - face.point.y()) + face.normal.z() * (c[1] - face.point.z());
    };
    std::vector<Corner> left;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
        const Corner &from = polygon[i], &to = polygon[(i + 1) % polygon.size()];
        const double a = height(from), b = height(to);
        if (a >= 0) left.push_back(from);
        if ((a < 0) == (b < 0)) continue;
        const double share = a / (a - b);
        left.push_back({from[0] + share * (to[0] - from[0]), from[1] + share * (to[1] - from[1])});
    }
    return left;
}

double area(const std::vector<Corner>& polygon) {
    double twice = 0;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
        const Corner &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
        twice += a[0] * b[1] - b[0] * a[1];
    }
    return 0.5 * twice;
}

// Planes that are seen edge-on in the y-z plane.
std::vector<Face> upright_faces(const Scene& scene) {
    std::vector<Face> faces = container_faces(scene.container, scene.drive);
    std::erase_if(faces, [](const Face& f) { return f.kind != Face::Kind::plane || f.normal.x() != 0; });
    if (scene.drive.present && scene.drive.moves == Drive::Moves::floor)
        for (Face& face : faces)
            if (face.name == "floor") face.point -= scene.drive.largest_amplitude() * Vec3(0, 0, 1);
    return faces;
}

double share_between(const GridAxis& axis, std::int64_t k, double low, double high) {
    const double begin = axis.low + static_cast<double>(k) * axis.cell;
    return std::clamp((std::min(high, begin + axis.cell) - std::max(low, begin)) / axis.cell, 0.0, 1.0);
}

// Area that a disc about the origin shares with the rectangle from the origin to (x, y), with the sign of x
// y.
double quarter_area(double radius, double x, double y) {
    const double sign = (x < 0 ? -1.0 : 1.0) * (y < 0 ? -1.0 : 1.0);
    const double a = std::min(std::abs(x), radius), b = std::min(std::abs(y), radius);
    const auto under_arc = [&](double to) {
        return 0.5 * (to * std::sqrt(radius * radius - to * to) + radius * radius * math::asin(to / radius));
    };
    const double corner =
        std::sqrt(radius * radius - b * b);  // up to this x the rectangle is lower than the arc
    return sign * (a <= corner ? a * b : corner * b + under_arc(a) - under_arc(corner));
}

double disc_share(double radius, const GridAxis& x, std::int64_t i, const GridAxis& y, std::int64_t j) {
    const double x0 = x.low + static_cast<double>(i) * x.cell, x1 = x0 + x.cell;
    const double y0 = y.low + static_cast<double>(j) * y.cell, y1 = y0 + y.cell;
    const double shared = quarter_area(radius, x1, y1) - quarter_area(radius, x0, y1) -
                          quarter_area(radius, x1, y0) + quarter_area(radius, x0, y0);
    return std::clamp(shared / (x.cell * y.cell), 0.0, 1.0);
}

}  // namespace

std::vector<double> inside_shares(const FieldGrid& grid, const Scene& scene) {
    const Container& container = scene.container;
    const auto& [x, y, z] = grid.axes;
    std::vector<double> shares(static_cast<std::size_t>(grid.cells()), 1.0);
    if (container.shape == Container::Shape::none) return shares;
    if (container.shape == Container::Shape::mesh) return shares_inside_mesh(grid, scene);
    const bool round = container.shape == Container::Shape::cylinder;
    const std::vector<Face> faces = upright_faces(scene);
    for (std::int64_t k = 0; k < z.count; ++k) {
        const double below_top = share_between(z, k, -1e300, container.height);
        for (std::int64_t j = 0; j < y.count; ++j) {
            const double y0 = y.low + static_cast<double>(j) * y.cell;
            const double z0 = z.low + static_cast<double>(k) * z.cell, z1 = z0 + below_top * z.cell;
            std::vector<Corner> polygon{{y0, z0}, {y0 + y.cell, z0}, {y0 + y.cell, z1}, {y0, z1}};
            for (const Face& face : faces) polygon = cut(polygon, face);
            const double upright = std::clamp(area(polygon) / (y.cell * z.cell), 0.0, 1.0);
            for (std::int64_t i = 0; i < x.count; ++i)
                shares[grid.index(i, j, k)] =
                    upright * (round ? disc_share(container.half_width, x, i, y, j)
                                     : share_between(x, i, -container.depth / 2, container.depth / 2));
        }
    }
    return shares;
}

// Shares of the cells inside a vessel that is a mesh. Along a row through a cell, the length inside is exact.
// The share is the mean over 16 rows.

namespace {

constexpr int kRows = 4;  // rows per cell, along y and along z

// A part of a row that is inside the vessel.
struct Piece {
    double from, to;  // m, x
};

// Between two crossings of the surface a row is inside or outside as a whole.
std::vector<Piece> pieces_inside(const Container& vessel, const Surface& surface, double low, double high,
                                 double y, double z) {
    std::vector<Surface::Hit> hits;
    surface.all_hits(Vec3(low, y, z), Vec3(1, 0, 0), hits);
    std::vector<double> ends{low};
    for (const Surface::Hit& hit : hits)
        if (low + hit.distance < high) ends.push_back(low + hit.distance);
    ends.push_back(high);
    std::vector<Piece> pieces;
    for (std::size_t k = 0; k + 1 < ends.size(); ++k)
        if (ends[k + 1] > ends[k] && vessel.room->holds(Vec3(0.5 * (ends[k] + ends[k + 1]), y, z)))
            pieces.push_back({ends[k], ends[k + 1]});
    return pieces;
}

double overlap(const Piece& piece, double begin, double end) {
    return std::max(0.0, std::min(piece.to, end) - std::max(piece.from, begin));
}

}  // namespace

std::vector<double> shares_inside_mesh(const FieldGrid& grid, const Scene& scene) {
    const auto& [x, y, z] = grid.axes;
    std::vector<double> shares(static_cast<std::size_t>(grid.cells()), 0.0);
    const std::optional<std::size_t> mesh = vessel_of(scene);
    if (!mesh) return shares;
    const double end = x.low + static_cast<double>(x.count) * x.cell;
    for (std::int64_t row = 0; row < z.count * y.count * kRows * kRows; ++row) {
        const std::int64_t k = row / (y.count * kRows * kRows), in_k = row % (y.count * kRows * kRows);
        const std::int64_t j = in_k / (kRows * kRows);
        const auto part = [](std::int64_t n) { return (static_cast<double>(n) + 0.5) / kRows; };
        const double at_y = y.low + (static_cast<double>(j) + part(in_k % kRows)) * y.cell;
        const double at_z = z.low + (static_cast<double>(k) + part(in_k / kRows % kRows)) * z.cell;
        if (at_z > scene.container.height) continue;
        for (const Piece& piece :
             pieces_inside(scene.container, *scene.meshes[*mesh].surface, x.low, end, at_y, at_z))
            for (std::int64_t i = 0; i < x.count; ++i) {
                const double begin = x.low + static_cast<double>(i) * x.cell;
                shares[grid.index(i, j, k)] +=
                    overlap(piece, begin, begin + x.cell) / (x.cell * kRows * kRows);
            }
    }
    return shares;
}

}  // namespace grainreel
