#include "engine/state/container_faces.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <set>

#include "engine/base/error.hpp"
#include "engine/base/mathematics.hpp"
#include "engine/scene/bed.hpp"
#include "engine/scene/output.hpp"

namespace grainreel {

namespace {

Face plane(const std::string& name, const Vec3& point, const Vec3& normal) {
    Face face;
    face.name = name;
    face.point = point;
    face.normal = normal;
    return face;
}

void add_side_walls(const Container& c, std::vector<Face>& faces) {
    if (c.shape == Container::Shape::cylinder) {
        Face wall;
        wall.kind = Face::Kind::cylinder;
        wall.name = "wall";
        wall.radius = c.half_width;
        faces.push_back(wall);
        return;
    }
    faces.push_back(plane("left wall", {0, -c.half_width, 0}, {0, 1, 0}));
    faces.push_back(plane("right wall", {0, c.half_width, 0}, {0, -1, 0}));
    if (c.shape == Container::Shape::wedge && c.half_angle > 0) {
        const double cosine = math::cos(c.half_angle), sine = math::sin(c.half_angle);
        faces.push_back(plane("left slant", {0, -c.half_width, c.slant_height}, {0, cosine, sine}));
        faces.push_back(plane("right slant", {0, c.half_width, c.slant_height}, {0, -cosine, sine}));
    }
    if (!c.periodic_depth) {
        faces.push_back(plane("back", {-c.depth / 2, 0, 0}, {1, 0, 0}));
        faces.push_back(plane("front", {c.depth / 2, 0, 0}, {-1, 0, 0}));
    }
}

}  // namespace

FaceDistance distance_to_plate(const Face& face, const Vec3& offset, const Vec3& centre) {
    const Vec3 from = centre - face.point - offset;
    const bool round = face.kind == Face::Kind::cylinder;
    Vec3 out(round || face.round_gap ? from.x() : 0, from.y(), 0);
    const double rho = out.norm();
    out = rho > 0 ? Vec3(out / rho) : Vec3(0, 1, 0);
    const Vec3 apart = round ? Vec3((rho - face.radius) * out) : Vec3(face.normal.dot(from) * face.normal);
    const Vec3 back = face.gap > 0
                          ? Vec3(std::min(0.0, rho - face.gap) * out)
                          : Vec3(std::min(0.0, face.along.dot(centre - face.edge - offset)) * face.along);
    const Vec3 v = apart + back;
    const double distance = v.norm();
    return {distance, distance > 0 ? Vec3(v / distance) : face.normal};
}

FaceDistance distance_at(const Face& face, const DrivePose& drive, const Vec3& centre) {
    if (!face.body.has_own_motion()) return distance_to(face, face.displacement(drive), centre);
    const BodyPose pose = face.body.at(drive);
    FaceDistance found = distance_to(face, Vec3::Zero(), pose.at_rest(centre));
    found.normal = pose.rotation * found.normal;
    return found;
}

Vec3 velocity_of(const Face& face, const DrivePose& drive, const Vec3& point) {
    return face.body.has_own_motion() ? face.body.at(drive).velocity_at(point) : face.velocity_at(drive);
}

// If the container is a mesh, the mesh is its wall, and there are no faces.
std::vector<Face> container_faces(const Container& container, const Drive& drive) {
    std::vector<Face> faces;
    if (container.shape == Container::Shape::none || container.shape == Container::Shape::mesh) return faces;
    faces.push_back(plane("floor", {0, 0, 0}, {0, 0, 1}));
    add_side_walls(container, faces);
    if (container.lid) faces.push_back(plane("lid", {0, 0, container.height}, {0, 0, -1}));
    const std::vector<Body> bodies = bodies_of(drive, {});
    for (Face& face : faces) face.body = bodies[face.name == "floor" ? kFloorBody : kContainerBody];
    return faces;
}

std::vector<Face> free_faces(const std::vector<ScenePlane>& walls) {
    std::vector<Face> faces;
    const std::vector<Body> bodies = bodies_of({}, walls);
    for (std::size_t w = 0; w < walls.size(); ++w) {
        faces.push_back(plane(walls[w].name, walls[w].point, walls[w].normal));
        faces.back().body = bodies[kFirstPlaneBody + w];
    }
    return faces;
}

std::vector<Face> faces_of(const Scene& scene) {
    std::vector<Face> faces = container_faces(scene.container, scene.drive);
    for (Face& face : faces) face.body.turn = scene.container.turn;
    set_reach(scene.container, faces);
    for (const std::vector<Face>& more : {free_faces(scene.walls), tray_faces(scene)})
        faces.insert(faces.end(), more.begin(), more.end());
    return faces;
}

double period_of_depth(const Container& container) {
    return container.periodic_depth && container.shape != Container::Shape::cylinder ? container.depth : 0.0;
}

void set_reach(const Container& container, std::vector<Face>& faces) {
    if (!container.turn) return;
    const bool round = container.shape == Container::Shape::cylinder;
    const double depth = round ? 2 * container.half_width : container.depth;
    const double top = (container.lid ? 1 : 2) * container.height;
    double reach = 0;
    for (const double x : {-0.5 * depth, 0.5 * depth})
        for (const double y : {-container.half_width, container.half_width})
            for (const double z : {0.0, top}) {
                const Vec3 from = Vec3(x, y, z) - container.turn->through;
                reach = std::max(reach, from.cross(container.turn->axis).norm());
            }
    for (Face& face : faces) face.reach = reach;
}

std::vector<Face> tray_faces(const Scene& scene) {
    if (!scene.container.tray) return {};
    const Container tray = tray_container(scene);
    const Vec3 down(0, 0, -scene.container.tray->depth), rim = down + tray.height * Vec3::UnitZ();
    std::vector<Face> faces = container_faces(tray, Drive{});
    for (Face& face : faces) {
        face.name = "tray " + face.name;
        face.body = {kTrayBody, false, Vec3(0, 0, 0)};
        face.point += down;
        if (face.kind == Face::Kind::plane && face.normal.z() != 0) continue;  // the floor does not end
        face.ends = true;
        face.along = Vec3(0, 0, -1);
        face.edge = face.point;
        face.edge.z() = rim.z();
    }
    return faces;
}

namespace {

// Half-width (m) of a gap that leaves nothing of the floor. The walls' lower edges are then the edges of the
// outlet.
constexpr double kNoFloorLeft = 1e9;
// Relative width of the floor that rounding may leave where outlet and floor are equally wide in the scene.
constexpr double kRounding = 1e-9;

void open_floor(const Container& container, Face& floor) {
    const Outlet& outlet = *container.outlet;
    const bool hole = outlet.shape == Outlet::Shape::hole;
    floor.ends = true;
    floor.round_gap = hole;
    floor.gap = outlet.half_width;
    const bool round = container.shape == Container::Shape::cylinder;
    if (hole == round && outlet.half_width >= (1 - kRounding) * container.floor_half_width())
        floor.gap = kNoFloorLeft;
}

// Vertical walls end at the floor. In a wedge they end where the slants begin, and the slants end at the
// floor.
void end_wall(const Container& container, Face& wall) {
    wall.ends = true;
    wall.along = Vec3(0, 0, 1);
    wall.edge = wall.point;
    if (wall.kind == Face::Kind::cylinder || container.shape != Container::Shape::wedge) return;
    const double side = wall.normal.y() < 0 ? 1 : -1;
    if (wall.normal.z() > 0) {
        wall.along = Vec3(0, side * math::sin(container.half_angle), math::cos(container.half_angle));
        wall.edge = Vec3(0, side * container.floor_half_width(), 0);
    } else if (wall.normal.y() != 0) {
        wall.edge.z() = container.slant_height;
    }
}

}  // namespace

void open_outlet(const Container& container, std::vector<Face>& faces) {
    GRAINREEL_CHECK(container.outlet);
    for (Face& face : faces) {
        if (face.body.number == kFloorBody)
            open_floor(container, face);
        else if (face.body.number == kContainerBody && face.normal.z() >= 0)  // the lid stays whole
            end_wall(container, face);
    }
}

std::vector<std::string> face_names(const Scene& scene) {
    std::vector<std::string> names;
    std::set<std::string> taken;
    const auto add = [&](const std::string& name) {
        std::string part = column_part(name);
        std::replace(part.begin(), part.end(), ' ', '_');
        const std::string first = part;
        for (int number = 2; !taken.insert(part).second; ++number) part = fmt::format("{}_{}", first, number);
        names.push_back(part);
    };
    for (const Face& face : faces_of(scene)) add(face.name);
    for (const SceneMesh& mesh : scene.meshes) add(mesh.name);
    return names;
}

}  // namespace grainreel
