#include "engine/state/container_faces.hpp"

#include <algorithm>
#include <cmath>

#include "engine/state/face_reach.hpp"
#include "engine/state/tray_faces.hpp"

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
        const double cosine = std::cos(c.half_angle), sine = std::sin(c.half_angle);
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

FaceDistance distance_at(const Face& face, const Pose& drive, const Vec3& centre) {
    if (!face.body.has_own_motion()) return distance_to(face, face.displacement(drive), centre);
    const BodyPose pose = face.body.at(drive);
    FaceDistance found = distance_to(face, Vec3::Zero(), pose.at_rest(centre));
    found.normal = pose.rotation * found.normal;
    return found;
}

Vec3 velocity_of(const Face& face, const Pose& drive, const Vec3& point) {
    return face.body.has_own_motion() ? face.body.at(drive).velocity_at(point) : face.velocity_at(drive);
}

// A mesh is the wall of its vessel, which has no faces then.
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

std::vector<Face> free_faces(const std::vector<FreeWall>& walls) {
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

}  // namespace grainreel
