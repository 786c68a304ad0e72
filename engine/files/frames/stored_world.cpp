#include "engine/files/frames/stored_world.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>

#include "engine/base/mathematics.hpp"
#include "engine/files/frames/state_archive.hpp"
#include "engine/mesh/surface.hpp"
#include "engine/scene/bed.hpp"
#include "engine/state/container_faces.hpp"

namespace grainreel {

StoredWorld world_of(const Scene& scene) {
    StoredWorld world;
    world.title = scene.title;
    for (const Species& species : scene.species)
        world.species.push_back({species.name, species.diameter.mean, species.density, species.count});
    WorldCell& cell = world.cell.emplace();
    const Extent extent = extent_of(scene);
    world.low = extent.low;
    world.high = extent.high;
    cell.origin = extent.low;
    if (scene.container.periodic_depth) {
        cell.edges[0].x() = scene.container.depth;
        cell.periodic[0] = true;
    }
    world.bodies = {{"container", {}, {}}, {"floor", {}, {}}};
    for (const ScenePlane& wall : scene.walls) world.bodies.push_back({wall.name, {}, {}});
    for (const SceneMesh& mesh : scene.meshes) world.bodies.push_back({mesh.name, {}, mesh.shape()});
    world.container_turns = scene.container.turn.has_value();
    for (const Face& face : faces_of(scene))
        if (face.body.number >= 0)
            world.bodies.at(static_cast<std::size_t>(face.body.number)).faces.push_back(face);
    world.most_grains = static_cast<std::size_t>(scene.grains());
    world.facts = file_facts(scene);
    return world;
}

namespace {

// The meshes of a world at rest. Planes have lower numbers than meshes, and only the poses of planes are
// known. So a scene can number the meshes only if there are no planes.
std::vector<SceneMesh> meshes_of(const StoredWorld& world) {
    std::vector<SceneMesh> meshes;
    for (std::size_t body = kFirstPlaneBody; body < world.bodies.size(); ++body) {
        const WorldBody& one = world.bodies[body];
        if (one.mesh.empty()) return {};
        SceneMesh& mesh = meshes.emplace_back();
        mesh.name = one.name;
        MeshFacts facts;
        facts.triangles = facts.read = static_cast<std::int64_t>(one.mesh.triangles.size());
        facts.vertices = static_cast<std::int64_t>(one.mesh.vertices.size());
        mesh.surface.of = std::make_shared<const Surface>(one.mesh, facts, one.name);
    }
    return meshes;
}

}  // namespace

Scene scene_of(const StoredWorld& world) {
    Scene scene;
    scene.title = world.title;
    scene.container.shape = Container::Shape::none;
    scene.meshes = meshes_of(world);
    for (const WorldSpecies& one : world.species) {
        Species species;
        species.name = one.name;
        species.count = one.count;
        species.diameter.mean = one.diameter;
        species.density = one.density;
        scene.species.push_back(species);
    }
    return scene;
}

namespace {

constexpr double kRight = 90;  // degrees

// The angle between two edges; right where one of them has no length.
double degrees_between(const Vec3& a, const Vec3& b) {
    const double lengths = a.norm() * b.norm(), along = a.dot(b);
    if (!(lengths > 0) || along == 0) return kRight;
    return math::acos(std::clamp(along / lengths, -1.0, 1.0)) * 180 / std::numbers::pi;
}

double cosine(double degrees) {
    return degrees == kRight ? 0 : math::cos(degrees * std::numbers::pi / 180);
}

}  // namespace

TrajectoryCell trajectory_cell(const WorldCell& cell) {
    TrajectoryCell made;
    made.origin = cell.origin;
    for (int i = 0; i < 3; ++i) {
        const auto edge = static_cast<std::size_t>(i);
        if (cell.periodic[edge]) made.length[i] = cell.edges[edge].norm();
    }
    made.angles =
        Vec3(degrees_between(cell.edges[1], cell.edges[2]), degrees_between(cell.edges[0], cell.edges[2]),
             degrees_between(cell.edges[0], cell.edges[1]));
    return made;
}

// The first edge is along x, and the second has no z (AMBER trajectory convention).
WorldCell world_cell(const TrajectoryCell& cell) {
    WorldCell made;
    made.origin = cell.origin;
    const double cos_a = cosine(cell.angles[0]), cos_b = cosine(cell.angles[1]),
                 cos_c = cosine(cell.angles[2]);
    const double sin_c = std::sqrt(1 - cos_c * cos_c), across = (cos_a - cos_b * cos_c) / sin_c;
    const std::array<Vec3, 3> along{Vec3(1, 0, 0), Vec3(cos_c, sin_c, 0),
                                    Vec3(cos_b, across, std::sqrt(1 - cos_b * cos_b - across * across))};
    for (int i = 0; i < 3; ++i) {
        const auto edge = static_cast<std::size_t>(i);
        if (cell.length[i] != 0) made.edges[edge] = cell.length[i] * along[edge];
        made.periodic[edge] = cell.length[i] > 0;
    }
    return made;
}

StoredWorld world_of(const TrajectoryInfo& info) {
    StoredWorld world;
    world.title = info.title;
    world.program_version = info.program_version;
    for (std::size_t s = 0; s < info.species.size(); ++s) {
        WorldSpecies& species = world.species.emplace_back();
        species.name = info.species[s];
        if (s < info.facts.densities.size()) species.density = info.facts.densities[s];
    }
    world.cell = world_cell(info.cell);
    world.steps_known = info.steps_known;
    world.first_id = info.first_id;
    world.bodies = {{"container", {}, {}}, {"floor", {}, {}}};
    for (const std::string& name : info.bodies) world.bodies.push_back({name, {}, {}});
    for (const auto& [body, shape] : info.meshes) world.bodies.at(body).mesh = shape;
    world.container_turns = info.container_turns;
    world.most_grains = info.capacity;
    world.traffic = info.traffic;
    world.facts = info.facts;
    return world;
}

TrajectoryInfo trajectory_info(const StoredWorld& world, const StateSupply& supply) {
    TrajectoryInfo info;
    info.title = world.title;
    info.program_version = world.program_version;
    for (const WorldSpecies& species : world.species) info.species.push_back(species.name);
    info.capacity = world.most_grains;
    info.traffic = world.traffic;
    for (std::size_t body = kFirstPlaneBody; body < world.bodies.size(); ++body)
        info.bodies.push_back(world.bodies[body].name);
    for (std::size_t body = 0; body < world.bodies.size(); ++body)
        if (const TriangleMesh& shape = world.bodies[body].mesh; !shape.empty())
            info.meshes.push_back({body, shape});
    info.container_turns = world.container_turns;
    info.orientation = supply.orientations;
    info.shapes = supply.shapes;
    info.contact_numbers = supply.contact_numbers;
    info.masses = supply.masses;
    info.velocities = supply.velocities;
    info.spins = supply.spins;
    if (world.cell) info.cell = trajectory_cell(*world.cell);
    info.steps_known = world.steps_known;
    info.first_id = world.first_id;
    info.facts = world.facts;
    const bool known =
        std::all_of(world.species.begin(), world.species.end(),
                    [](const WorldSpecies& species) { return std::isfinite(species.density); });
    if (info.facts.densities.empty() && known)
        for (const WorldSpecies& species : world.species) info.facts.densities.push_back(species.density);
    return info;
}

std::vector<std::string> faults_of(const TrajectoryReader& trajectory, const std::string& name) {
    std::vector<std::string> faults;
    if (trajectory.cut_off())
        faults.push_back(fmt::format(
            "{}: frame {} (the first is 0) is not whole, and is left out; the run was killed while "
            "it wrote that frame, or the copy of the file was cut off",
            name, trajectory.frames()));
    if (trajectory.uncounted() > 0)
        faults.push_back(
            fmt::format("{}: counts {} frames and holds {} more; they are left out. The run goes on, or the "
                        "file's header "
                        "is damaged",
                        name, trajectory.frames(), trajectory.uncounted()));
    return faults;
}

namespace {

constexpr int kFacets = 96;  // facets of a cylinder; the rim of a hole has half as many

using Polygon = std::vector<Vec3>;

struct HalfSpace {
    Vec3 normal;      // points into the part that is kept
    double distance;  // normal . x >= distance
};

// The part of a polygon in a half-space (Sutherland and Hodgman 1974, Comm. ACM 17, 32).
Polygon clipped(const Polygon& polygon, const HalfSpace& side) {
    Polygon kept;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
        const Vec3 &from = polygon[i], &to = polygon[(i + 1) % polygon.size()];
        const double a = side.normal.dot(from) - side.distance, b = side.normal.dot(to) - side.distance;
        if (a >= 0) kept.push_back(from);
        if ((a >= 0) != (b >= 0)) kept.push_back(from + a / (a - b) * (to - from));
    }
    return kept;
}

void add_fan(const Polygon& polygon, TriangleMesh& mesh) {
    const auto first = static_cast<std::int32_t>(mesh.vertices.size());
    if (polygon.size() < 3) return;
    mesh.vertices.insert(mesh.vertices.end(), polygon.begin(), polygon.end());
    for (std::int32_t k = 1; k + 1 < static_cast<std::int32_t>(polygon.size()); ++k)
        mesh.triangles.push_back({first, first + k, first + k + 1});
}

Vec3 across(const Vec3& normal) {
    return normal.cross(std::abs(normal.x()) < 0.9 ? Vec3::UnitX() : Vec3::UnitY()).normalized();
}

// The part of a plane's polygon outside a round hole: a ring of narrow polygons about the hole's middle.
void add_around_hole(const Polygon& polygon, const Face& face, TriangleMesh& mesh) {
    const Vec3 u = across(face.normal), v = face.normal.cross(u);
    constexpr int sectors = kFacets / 2;
    for (int k = 0; k < sectors; ++k) {
        const double from = 2 * std::numbers::pi * k / sectors, to = 2 * std::numbers::pi * (k + 1) / sectors;
        const Vec3 a = math::cos(from) * u + math::sin(from) * v, b = math::cos(to) * u + math::sin(to) * v;
        const Vec3 rim = (face.point + face.gap * a + face.point + face.gap * b) / 2;
        Polygon part = clipped(polygon, {face.normal.cross(a), face.normal.cross(a).dot(face.point)});
        part = clipped(part, {-face.normal.cross(b), -face.normal.cross(b).dot(face.point)});
        const Vec3 out = (a + b).normalized();
        part = clipped(part, {out, out.dot(rim)});
        add_fan(part, mesh);
    }
}

void add_plane(const Face& face, const std::vector<HalfSpace>& sides, double size, TriangleMesh& mesh) {
    const Vec3 u = across(face.normal), v = face.normal.cross(u);
    Polygon polygon;
    for (const auto& [a, b] : {std::pair(-1, -1), {1, -1}, {1, 1}, {-1, 1}})
        polygon.push_back(face.point + size * (a * u + b * v));
    for (const HalfSpace& side : sides) polygon = clipped(polygon, side);
    if (face.along.norm() > 0) polygon = clipped(polygon, {face.along, face.along.dot(face.edge)});
    if (face.gap > 0 && face.round_gap) return add_around_hole(polygon, face, mesh);
    if (face.gap > 0) {
        // A slot along x, with the plane on both sides.
        const Vec3 y(0, 1, 0);
        add_fan(clipped(polygon, {y, face.point.y() + face.gap}), mesh);
        add_fan(clipped(polygon, {-y, -(face.point.y() - face.gap)}), mesh);
        return;
    }
    add_fan(polygon, mesh);
}

void add_cylinder(const Face& face, double low, double high, TriangleMesh& mesh) {
    const auto first = static_cast<std::int32_t>(mesh.vertices.size());
    for (int k = 0; k < kFacets; ++k) {
        const double angle = 2 * std::numbers::pi * k / kFacets;
        const Vec3 out(face.radius * math::cos(angle), face.radius * math::sin(angle), 0);
        mesh.vertices.push_back(Vec3(face.point.x(), face.point.y(), low) + out);
        mesh.vertices.push_back(Vec3(face.point.x(), face.point.y(), high) + out);
    }
    constexpr std::int32_t count = 2 * kFacets;
    for (std::int32_t k = 0; k < count; k += 2) {
        const std::int32_t a = first + k, b = first + (k + 2) % count;
        mesh.triangles.push_back({a, a + 1, b + 1});
        mesh.triangles.push_back({a, b + 1, b});
    }
}

// The half-spaces that cut a face: the other infinite planes and the sides of the world.
std::vector<HalfSpace> sides_for(const StoredWorld& world, const Face& face,
                                 const std::vector<const Face*>& all) {
    const double margin = 1e-9 * (world.high - world.low).norm();
    std::vector<HalfSpace> sides;
    for (const Face* other : all) {
        if (other == &face || other->kind != Face::Kind::plane || other->ends ||
            other->body.number >= kFirstPlaneBody)
            continue;
        sides.push_back({other->normal, other->normal.dot(other->point) - margin});
    }
    for (int axis = 0; axis < 3; ++axis) {
        sides.push_back({Vec3::Unit(axis), world.low[axis] - margin});
        sides.push_back({-Vec3::Unit(axis), -world.high[axis] - margin});
    }
    return sides;
}

// The half-spaces that cut a plane to a disc inside a cylinder.
std::vector<HalfSpace> inside_cylinder(const Face& cylinder) {
    std::vector<HalfSpace> sides;
    for (int k = 0; k < kFacets; ++k) {
        const double angle = 2 * std::numbers::pi * (k + 0.5) / kFacets;
        const Vec3 in(-math::cos(angle), -math::sin(angle), 0);
        sides.push_back(
            {in, in.dot(cylinder.point) - cylinder.radius * math::cos(std::numbers::pi / kFacets)});
    }
    return sides;
}

}  // namespace

std::vector<WorldSurface> surfaces_of(const StoredWorld& world) {
    std::vector<WorldSurface> surfaces;
    std::vector<const Face*> all;
    for (const WorldBody& body : world.bodies)
        for (const Face& face : body.faces) all.push_back(&face);
    const double size = std::max(1e-6, (world.high - world.low).norm()) * 2;
    for (std::size_t number = 0; number < world.bodies.size(); ++number) {
        const WorldBody& body = world.bodies[number];
        if (!body.mesh.empty()) surfaces.push_back({body.name, number, body.mesh});
        for (const Face& face : body.faces) {
            WorldSurface surface{face.name, number, {}};
            if (face.kind == Face::Kind::cylinder) {
                add_cylinder(face, world.low.z(), world.high.z(), surface.shape);
            } else {
                std::vector<HalfSpace> sides = sides_for(world, face, all);
                for (const Face* other : all)
                    if (other->kind == Face::Kind::cylinder && face.body.number < kFirstPlaneBody)
                        for (const HalfSpace& side : inside_cylinder(*other)) sides.push_back(side);
                add_plane(face, sides, size, surface.shape);
            }
            if (!surface.shape.empty()) surfaces.push_back(std::move(surface));
        }
    }
    return surfaces;
}

TriangleMesh moved(const WorldSurface& surface, const State& frame) {
    TriangleMesh mesh = surface.shape;
    const BodyPose pose = frame.body(surface.body);
    for (Vec3& vertex : mesh.vertices) vertex = pose.moved(vertex);
    return mesh;
}

}  // namespace grainreel
