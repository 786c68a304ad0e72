// The container as faces that grains can touch. A closed container is convex, so its faces can be endless
// planes: a grain in a corner touches two of them, and both contacts are real. With an open outlet the faces
// are thin plates that end at edges.
#pragma once

#include <cmath>
#include <string>
#include <vector>

#include "engine/base/vector.hpp"
#include "engine/state/body.hpp"

namespace grainreel {

struct Container;   // engine/scene/scene.hpp
struct Drive;       // there too
struct ScenePlane;  // there too
struct Scene;       // there too

struct Face {
    enum class Kind { plane, cylinder };
    Kind kind = Kind::plane;
    std::string name;      // "floor", "left slant", ... used in messages
    Vec3 point{0, 0, 0};   // m, on the plane; on the axis of a cylinder (vertical)
    Vec3 normal{0, 0, 1};  // unit, into the container; unused by a cylinder
    double radius = 0;     // m, of a cylinder
    Body body;             // the body that the face belongs to

    // Whether the face is a plate that ends. A grain touches such a plate, from either side, at its nearest
    // point, which may lie on an edge.
    bool ends = false;
    Vec3 along{0, 0, 0};  // unit, in the face, from the edge where it ends into the face; zero if it has no
                          // such edge
    Vec3 edge{0, 0, 0};   // m, a point of this edge
    double gap = 0;       // m, half-width of a slot along x, or radius of a hole, about `point`; 0 for none
    bool round_gap = false;

    // Only for a face whose body turns; see set_reach().
    double reach = 0;  // m, distance of its farthest point from the axis

    // Only for a face whose body has no motion of its own (Body::has_own_motion()). For other faces see
    // distance_at() and velocity_of().
    Vec3 displacement(const DrivePose& drive) const { return body.place_at(drive); }
    Vec3 velocity_at(const DrivePose& drive) const { return body.velocity_at(drive); }
};

struct FaceDistance {
    double distance;  // m, from the grain's centre; negative outside
    Vec3 normal;      // unit, into the container; from the nearest point of a plate to the centre
};

// The distance to a vertical wall is d = y_max - |y|. The distance to a slant is d = [y_max - |y| - (H - z)
// tan theta] cos theta.
//
// For a face that ends, the vector from its nearest point is v = A u + B s. u is the distance from the
// endless face, and A is its direction. s <= 0 is how far the centre lies beyond the edge, and B is the
// direction back onto the face.
FaceDistance distance_to_plate(const Face& face, const Vec3& offset, const Vec3& centre);
inline FaceDistance distance_to(const Face& face, const Vec3& offset, const Vec3& centre) {
    if (face.ends) return distance_to_plate(face, offset, centre);
    const Vec3 from = centre - face.point - offset;
    if (face.kind == Face::Kind::plane) return {face.normal.dot(from), face.normal};
    const double out = std::sqrt(from.x() * from.x() + from.y() * from.y());
    if (out == 0) return {face.radius, Vec3(1, 0, 0)};
    return {face.radius - out, Vec3(-from.x() / out, -from.y() / out, 0)};
}

// The distance at a pose of the drive, also for a face whose body turns or follows a path.
FaceDistance distance_at(const Face& face, const DrivePose& drive, const Vec3& centre);

// The velocity (m/s) of a point (m) of a face at a pose of the drive, also if the face's body turns or
// follows a path.
Vec3 velocity_of(const Face& face, const DrivePose& drive, const Vec3& point);

// The faces of a scene's container at rest; their bodies follow the scene's drive, but do not turn. Front and
// back are left out when the depth is periodic. The lid is left out when the top is open, and the walls then
// go on upwards without end.
std::vector<Face> container_faces(const Container& container, const Drive& drive);

// The scene's own planes, [[wall]].
std::vector<Face> free_faces(const std::vector<ScenePlane>& walls);

// All faces of a scene at rest, in the order of their numbers. First come the container's faces, which turn
// with it, then the planes, then the faces of the tray below an outlet.
std::vector<Face> faces_of(const Scene& scene);

// Period of x (m), or 0 when the depth is not periodic.
double period_of_depth(const Container& container);

// Sets Face::reach of a container's faces, where the container turns. Walls that go on upwards without end
// count up to twice the height.
void set_reach(const Container& container, std::vector<Face>& faces);

// The faces of the tray that catches the grains from an outlet; none without a tray. Its floor is an endless
// plane. Its walls are thin plates that end above, at their rim, so that they touch nothing in the container.
// The tray stands still and is there before the outlet opens.
std::vector<Face> tray_faces(const Scene& scene);

// When the outlet of a container opens, the floor gets a slot or a hole, and the walls end below. Grains that
// have fallen through touch nothing but edges and the floor's underside.
//
// Every face stays under its number, so contacts and their histories go on. A contact that began on the floor
// goes on at the floor's edge.

// `faces` are those of container_faces(), perhaps with others after them, which stay as they are.
void open_outlet(const Container& container, std::vector<Face>& faces);

// The names of a scene's walls in the columns of measures and files: container, planes and tray, in the order
// of the surroundings' faces, then the meshes. Each is a part of a column's name ("left_slant"). No name
// comes twice: the second of two walls with the same name is "NAME_2".
std::vector<std::string> face_names(const Scene& scene);

}  // namespace grainreel
