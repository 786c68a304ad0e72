#include "engine/handover/triangle_walls.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <numbers>

#include "engine/base/error.hpp"
#include "engine/base/mathematics.hpp"

namespace grainreel {

namespace fs = std::filesystem;

namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kInside = 1e-6;   // distance of walls from the box's sides, as a share of its size
constexpr double kOctagon = 0.92;  // a bit less than apothem / radius of an octagon
constexpr double kSagitta =
    0.005;  // sagitta of a cylinder's facets (their distance from the round), in smallest radii of grains
constexpr int kFewest = 36, kMost = 180;  // facets of a cylinder

struct Room {
    Vec3 low, high;
};

// How far (m) driven walls move from rest in each direction.
Vec3 stroke_of(const CarriedScene& carried) {
    if (carried.drive.empty() || carried.rides()) return Vec3::Zero();
    return 2.05 * carried.scene.drive.largest_amplitude() * carried.scene.drive.direction.cwiseAbs();
}

double largest_grain(const CarriedScene& carried) {
    double largest = 0;
    for (const CarriedType& type : carried.types) largest = std::max(largest, type.largest);
    return largest;
}

double smallest_grain(const CarriedScene& carried) {
    double smallest = INFINITY;
    for (const CarriedType& type : carried.types) smallest = std::min(smallest, type.smallest);
    return smallest;
}

// The box in which a wall must be at rest so that it stays in the run's box while it moves.
Room room_of(const CarriedScene& carried, const TriangleWall& wall) {
    const double inside = kInside * (carried.high - carried.low).maxCoeff();
    const double time = static_cast<double>(carried.last) * carried.step;
    const Vec3 way = wall.velocity * time, stroke = wall.driven ? stroke_of(carried) : Vec3::Zero();
    Room room{carried.low + inside * Vec3::Ones() + stroke - way.cwiseMin(0),
              carried.high - inside * Vec3::Ones() - stroke - way.cwiseMax(0)};
    if (carried.periodic) {
        room.low.x() = carried.low.x();
        room.high.x() = carried.high.x();
    }
    return room;
}

// The distance (m) from the axis of turning within which points stay in the box however the wall turns.
double turning_radius(const Room& room, const TriangleWall& wall) {
    double radius = INFINITY;
    for (int k = 0; k < 3; ++k) {
        const double across = std::sqrt(std::max(0.0, 1 - wall.axis[k] * wall.axis[k]));
        if (across < 1e-9) continue;
        radius = std::min(radius,
                          std::min(room.high[k] - wall.through[k], wall.through[k] - room.low[k]) / across);
    }
    return radius;
}

Polygon cut_to_room(Polygon polygon, const Room& room, const TriangleWall& wall) {
    polygon = cut_to_box(std::move(polygon), room.low, room.high);
    if (wall.rate.empty()) return polygon;
    const double apothem = kOctagon * turning_radius(room, wall);
    const Vec3 u = wall.axis.unitOrthogonal(), v = wall.axis.cross(u);
    for (int k = 0; k < 8; ++k) {
        const Vec3 out = math::cos(k * kPi / 4) * u + math::sin(k * kPi / 4) * v;
        polygon = cut(polygon, wall.through + apothem * out, -out);
    }
    return polygon;
}

int facets_of(const CarriedScene& carried, double radius) {
    const double sagitta = kSagitta * smallest_grain(carried) / 2;
    const double wanted = kPi / std::sqrt(2 * sagitta / radius);
    return static_cast<int>(std::clamp(std::ceil(wanted / 4) * 4, double{kFewest}, double{kMost}));
}

void shape_tube(const CarriedScene& carried, const Face& face, const Room& room, TriangleWall& wall) {
    const int facets = facets_of(carried, face.radius);
    double low = room.low.z(), high = room.high.z();
    if (face.ends && face.along.z() > 0) low = std::max(low, face.edge.z());
    if (face.ends && face.along.z() < 0) high = std::min(high, face.edge.z());
    if (!wall.rate.empty() && std::abs(wall.axis.z()) < 1 - 1e-9) {
        // The face extends only so far that its corners stay in the box when it turns.
        const double radius = turning_radius(room, wall);
        const double up = std::sqrt(std::max(0.0, radius * radius - 1.1 * face.radius * face.radius));
        low = std::max(low, wall.through.z() - up);
        high = std::min(high, wall.through.z() + up);
    }
    add_tube(face.point, face.radius, low, high, facets, wall.shape);
    wall.curvature = 1.05 * 360 / facets;
}

void shape_plane(const CarriedScene& carried, const Face& face, const Room& room, TriangleWall& wall) {
    if (face.ends && face.gap > 0 && face.round_gap) {
        const Vec3 level(0, 0, face.point.z());
        if (face.gap >= std::min((room.high - face.point).head<2>().minCoeff(),
                                 (face.point - room.low).head<2>().minCoeff()))
            return;
        Vec3 low = room.low, high = room.high;
        low.z() = high.z() = level.z();
        add_plate_with_hole(face.point, face.gap, low, high, facets_of(carried, face.gap), wall.shape);
        return;
    }
    const Vec3 middle = (room.low + room.high) / 2;
    const Polygon all = cut_to_room(
        square_on(face.point, face.normal, middle, 4 * (room.high - room.low).norm()), room, wall);
    if (face.ends && face.gap > 0) {
        for (const double side : {-1.0, 1.0})
            add_polygon(cut(all, face.point + Vec3(0, side * face.gap, 0), Vec3(0, side, 0)), wall.shape);
    } else {
        add_polygon(face.ends ? cut(all, face.edge, face.along) : all, wall.shape);
    }
}

// Takes the wall's motions from its body.
void set_motion(const CarriedScene& carried, const Body& body, TriangleWall& wall) {
    if (carried.rides()) return;
    wall.driven = body.driven && !carried.drive.empty();
    wall.velocity = body.velocity;
    if (!body.turn) return;
    wall.rate = turn_formula(*body.turn).rate;
    wall.axis = body.turn->axis;
    wall.through = body.turn->through;
}

TriangleWall wall_of(const CarriedScene& carried, const Face& face, std::size_t number, bool opened) {
    TriangleWall wall;
    wall.id = fmt::format("{}{}", opened ? "open" : "face", number);
    wall.file = "walls/" + wall.id + ".stl";
    set_motion(carried, face.body, wall);
    const Room room = room_of(carried, wall);
    if ((room.high - room.low).minCoeff() <= 0)
        throw UserError(
            "{}: the wall \"{}\" would leave the room that the run is in; end the run "
            "earlier",
            carried.scene.file, face.name);
    if (face.kind == Face::Kind::cylinder)
        shape_tube(carried, face, room, wall);
    else
        shape_plane(carried, face, room, wall);
    return wall;
}

TriangleWall wall_of(const CarriedScene& carried, const CarriedMesh& carried_mesh) {
    const SceneMesh& mesh = carried.scene.meshes[carried_mesh.number];
    TriangleWall wall;
    wall.id = fmt::format("mesh{}", carried_mesh.number);
    wall.file = "walls/" + wall.id + ".stl";
    wall.surface = carried_mesh.surface;
    const std::vector<Body> bodies = bodies_of(carried.scene);
    const std::int32_t body = first_mesh_body(carried.scene) + static_cast<std::int32_t>(carried_mesh.number);
    set_motion(carried, bodies[body], wall);
    wall.shape = mesh.shape();
    wall.curvature = smooth_bend(wall.shape);
    return wall;
}

void write_stl(const fs::path& file, const TriangleMesh& mesh) {
    std::string text = "solid wall\n";
    for (const TriangleMesh::Triangle& triangle : mesh.triangles) {
        std::array<Vec3, 3> p;
        for (std::size_t k = 0; k < 3; ++k) p[k] = mesh.vertices[triangle[k]];
        const Vec3 normal = (p[1] - p[0]).cross(p[2] - p[0]).normalized();
        text += fmt::format("facet normal {} {} {}\nouter loop\n", normal.x(), normal.y(), normal.z());
        for (const Vec3& corner : p)
            text += fmt::format("vertex {} {} {}\n", corner.x(), corner.y(), corner.z());
        text += "endloop\nendfacet\n";
    }
    std::ofstream out(file, std::ios::binary);
    out << text << "endsolid wall\n";
    out.close();
    if (!out) throw RunError("{}: cannot be written; is the disk full?", file.string());
}

void include(CarriedScene& carried, const Vec3& low, const Vec3& high) {
    carried.low = carried.low.cwiseMin(low);
    carried.high = carried.high.cwiseMax(high);
}

}  // namespace

std::vector<TriangleWall> triangle_walls(const CarriedScene& carried, bool opened) {
    std::vector<TriangleWall> walls;
    const std::vector<Face>& faces = opened ? carried.opened : carried.faces;
    for (std::size_t f = 0; f < faces.size(); ++f) {
        TriangleWall wall = wall_of(carried, faces[f], f, opened);
        if (!wall.shape.empty()) walls.push_back(std::move(wall));
    }
    for (const CarriedMesh& mesh : carried.meshes) walls.push_back(wall_of(carried, mesh));
    return walls;
}

TriangleMesh exit_plane(const CarriedScene& carried) {
    TriangleMesh mesh;
    const Container& container = carried.scene.container;
    if (!container.outlet || container.tray) return mesh;
    const double inside = kInside * (carried.high - carried.low).maxCoeff();
    const Vec3 low = carried.low + inside * Vec3::Ones(), high = carried.high - inside * Vec3::Ones();
    const double z = -container.outlet->exit_depth;
    add_polygon({Vec3(low.x(), low.y(), z), Vec3(high.x(), low.y(), z), Vec3(high.x(), high.y(), z),
                 Vec3(low.x(), high.y(), z)},
                mesh);
    return mesh;
}

void make_room_for_walls(CarriedScene& carried) {
    const Container& c = carried.scene.container;
    const double margin = largest_grain(carried);
    const Vec3 stroke = stroke_of(carried) + margin * Vec3::Ones(), kept_low = carried.low,
               kept_high = carried.high;
    if (c.shape != Container::Shape::none) {
        const double x = c.shape == Container::Shape::cylinder ? c.half_width : c.depth / 2;
        include(carried, Vec3(-x, -c.half_width, c.base()) - stroke,
                Vec3(x, c.half_width, c.height) + stroke);
    }
    for (const SceneMesh& mesh : carried.scene.meshes)
        include(carried, mesh.low - stroke, mesh.high + stroke);
    if (c.outlet) include(carried, Vec3(0, 0, -c.outlet->exit_depth - 2 * margin), Vec3(0, 0, 0));
    for (const Face& face : carried.faces) {
        if (!face.body.turn) continue;
        const Vec3 axis = face.body.turn->axis, through = face.body.turn->through;
        const double radius = (1.05 * face.reach + margin) / kOctagon;
        const Vec3 across = (Vec3::Ones() - axis.cwiseProduct(axis)).cwiseMax(0).cwiseSqrt() * radius;
        include(carried, through - across, through + across);
    }
    if (carried.periodic) {
        carried.low.x() = kept_low.x();
        carried.high.x() = kept_high.x();
    }
}

void write_triangle_walls(const fs::path& folder, const CarriedScene& carried) {
    std::error_code ignored;
    fs::create_directories(folder / "walls", ignored);
    for (const bool opened : {false, true}) {
        if (opened && carried.opened.empty()) continue;
        for (const TriangleWall& wall : triangle_walls(carried, opened))
            write_stl(folder / wall.file, wall.shape);
    }
    if (const TriangleMesh exit = exit_plane(carried); !exit.empty())
        write_stl(folder / "walls/exit.stl", exit);
}

}  // namespace grainreel
