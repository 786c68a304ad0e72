// The container as faces that grains can touch. Every container here is convex, so whole planes serve:
// a grain in a corner touches two of them, and both contacts are real.
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

    Vec3 displacement(const Pose& drive) const { return body.place_at(drive); }
    Vec3 velocity_at(const Pose& drive) const { return body.velocity_at(drive); }
};

struct FaceDistance {
    double distance;  // m, from the grain's centre, negative outside
    Vec3 normal;      // unit, into the container
};

// Vertical wall d = y_max - |y|; slant d = [y_max - |y| - (H - z) tan theta] cos theta.
inline FaceDistance distance_to(const Face& face, const Vec3& offset, const Vec3& centre) {
    const Vec3 from = centre - face.point - offset;
    if (face.kind == Face::Kind::plane) return {face.normal.dot(from), face.normal};
    const double out = std::sqrt(from.x() * from.x() + from.y() * from.y());
    if (out == 0) return {face.radius, Vec3(1, 0, 0)};
    return {face.radius - out, Vec3(-from.x() / out, -from.y() / out, 0)};
}

// The faces of a scene's container at rest; their bodies follow the scene's drive. Front and back are left
// out when the depth is periodic, the lid when the top is open (the walls then go on upwards without end).
std::vector<Face> container_faces(const Container& container, const Drive& drive);

// The scene's own planes, [[wall]].
std::vector<Face> free_faces(const std::vector<FreeWall>& walls);

// 0 when the depth is not periodic.
double period_of_depth(const Container& container);

}  // namespace grainreel
