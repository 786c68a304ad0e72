// The container as faces that grains can touch. A closed container is convex, so whole planes serve: a grain
// in a corner touches two of them, and both contacts are real. With an open outlet the faces are thin plates
// that end at edges.
#pragma once

#include <string>
#include <vector>

#include "engine/base/vector.hpp"
#include "engine/scene/scene.hpp"
#include "engine/state/body.hpp"

namespace grainreel {

struct Face {
    enum class Kind { plane, cylinder };
    Kind kind = Kind::plane;
    std::string name;      // "floor", "left slant", ... for messages
    Vec3 point{0, 0, 0};   // m, on the plane; on the axis of a cylinder (vertical)
    Vec3 normal{0, 0, 1};  // unit, into the container; unused by a cylinder
    double radius = 0;     // m, of a cylinder
    Body body;             // that it belongs to

    // A plate that ends: a grain touches it at its nearest point, which may lie on an edge, from either side.
    bool ends = false;
    Vec3 along{0, 0, 0};  // unit, in the face and across its lower edge; zero for no such edge
    Vec3 edge{0, 0, 0};   // m, a point of the lower edge
    double gap = 0;       // m, half-width of a slot along x, or radius of a hole, about `point`; 0 for none
    bool round_gap = false;

    // For a face whose body turns; see set_reach().
    double reach = 0;  // m, of its farthest point from the axis

    // For a face whose body does not turn (Body::has_own_motion); else see distance_at() and velocity_of().
    Vec3 displacement(const Pose& drive) const { return body.place_at(drive); }
    Vec3 velocity_at(const Pose& drive) const { return body.velocity_at(drive); }
};

struct FaceDistance {
    double distance;  // m, from the grain's centre, negative outside
    Vec3 normal;      // unit, into the container; from the nearest point of a plate to the centre
};

// Vertical wall d = y_max - |y|; slant d = [y_max - |y| - (H - z) tan theta] cos theta.
//
// Distance to a face that ends: the vector from its nearest point is v = A u + B s. u is the distance from
// the endless face and A its direction. s <= 0 is how far the centre lies beyond the edge and B the direction
// back onto the face.
FaceDistance distance_to_plate(const Face& face, const Vec3& offset, const Vec3& centre);
inline FaceDistance distance_to(const Face& face, const Vec3& offset, const Vec3& centre) {
    if (face.ends) return distance_to_plate(face, offset, centre);
    const Vec3 from = centre - face.point - offset;
    if (face.kind == Face::Kind::plane) return {face.normal.dot(from), face.normal};
    const double out = std::sqrt(from.x() * from.x() + from.y() * from.y());
    if (out == 0) return {face.radius, Vec3(1, 0, 0)};
    return {face.radius - out, Vec3(-from.x() / out, -from.y() / out, 0)};
}

// The same at a pose of the drive, also of a face whose body turns or follows a path.
FaceDistance distance_at(const Face& face, const Pose& drive, const Vec3& centre);

// m/s, of the point (m) of a face at a pose of the drive, as above.
Vec3 velocity_of(const Face& face, const Pose& drive, const Vec3& point);

// The faces of a scene's container at rest; their bodies follow the scene's drive, but do not turn. Front and
// back are left out when the depth is periodic, the lid when the top is open (the walls then go on upwards
// without end).
std::vector<Face> container_faces(const Container& container, const Drive& drive);

// The scene's own planes, [[wall]].
std::vector<Face> free_faces(const std::vector<FreeWall>& walls);

// All faces of a scene at rest, in the order of their numbers: those of the container, which turn with it, of
// the planes, and of the tray below an outlet.
std::vector<Face> faces_of(const Scene& scene);

// 0 when the depth is not periodic.
double period_of_depth(const Container& container);

// Sets Face::reach of a container's faces, where the container turns. Walls that go on upwards without end
// count up to twice the height.
void set_reach(const Container& container, std::vector<Face>& faces);

// The faces of the tray that catches what flows out of an outlet; none without a tray. Its floor is an
// endless plane. Its walls are thin plates that end above, at their rim, so that they touch nothing in the
// container. They stand still and are there before the outlet opens.
std::vector<Face> tray_faces(const Scene& scene);

// What becomes of a container's faces when its outlet opens: the floor gets a slot or a hole, and the walls
// end below. Grains that have fallen through touch nothing but edges and the floor's underside.
//
// Every face stays under its number, so contacts and their histories go on: one that began on the floor goes
// on at the floor's edge.

// `faces` are those of container_faces(), perhaps with others behind them, which stay as they are.
void open_outlet(const Container& container, std::vector<Face>& faces);

// The walls of a scene as columns of measures and files name them: container and planes, in the order of the
// surroundings' faces, then the meshes, as parts of columns
// ("left_slant"). Each name comes once: the second of two walls of one name is "NAME_2".
std::vector<std::string> face_names(const Scene& scene);

}  // namespace grainreel
