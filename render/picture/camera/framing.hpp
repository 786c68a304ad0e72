// What the camera's automatic framing shows: which part of the container, and which points have to be in the
// picture.
#pragma once

#include <vector>

#include "engine/base/vector.hpp"
#include "render/scene/filmed_scene.hpp"

namespace grainreel {

struct FramedPart {
    double top = 0;    // m above the floor's rest position
    bool cut = false;  // the container is higher, and runs out of the picture there
};
// The part that film.camera.frame asks for. It is the whole container where the part is hardly lower, and for
// a camera that looks steeply down or up, which would come too close to the walls.
FramedPart framed_part(const FilmedScene& scene);
FramedPart whole_container(const FilmedScene& scene);

// The middle of the box that is framed. A camera turns about it, and scale bars hold at its depth.
Vec3 framed_middle(const FilmedScene& scene);

// Every point that has to stay in the picture of a camera at this azimuth (degrees): corners of the drawn
// container as far as it is framed, at rest and at both ends of its stroke as drawn, and the marks beside it.
// meshes: the points of mesh_reach(), which take a while to find. stroke: drawn_stroke(), which takes a while
// too where the drive changes.
std::vector<Vec3> framing_points(const FilmedScene& scene, double azimuth, const FramedPart& part,
                                 const std::vector<Vec3>& meshes, const Vec3& stroke);
std::vector<Vec3> framing_points(const FilmedScene& scene, double azimuth, const FramedPart& part,
                                 const std::vector<Vec3>& meshes);
std::vector<Vec3> framing_points(const FilmedScene& scene, double azimuth);
std::vector<Vec3> framing_points(const FilmedScene& scene);  // at the camera's own azimuth

}  // namespace grainreel
