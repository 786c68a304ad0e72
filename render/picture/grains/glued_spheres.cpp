#include "render/picture/grains/glued_spheres.hpp"

#include "engine/state/glued_grains.hpp"
#include "render/picture/base/palette.hpp"
#include "render/scene/filmed_scene.hpp"

namespace grainreel {
namespace {

constexpr double kGreyer = 0.55;  // share of the neutral colour

}  // namespace

GluedSpheres::GluedSpheres(const FilmedScene& scene) {
    if (!scene.container.wall_grains) return;
    const std::vector<Face> faces = container_faces(scene.container, scene.drive);
    const GluedGrains glued = glue_grains(scene, faces);
    for (std::size_t g = 0; g < glued.size(); ++g) {
        const Face& face = faces[static_cast<std::size_t>(glued.face[g])];
        const Vec3 at = glued.centre(g, faces, {});
        const bool plane = face.kind == Face::Kind::plane;
        const Vec3 inward = plane ? face.normal : Vec3(-Vec3(at.x(), at.y(), 0).normalized());
        glued_.push_back({at, inward, glued.place[g].radius, static_cast<std::size_t>(face.body.number),
                          plane && face.normal.y() != 0});
    }
    const Colour species = scene.film.shows.colour.of_grains()
                               ? neutral_grain
                               : scene.colours[scene.container.wall_grains->species];
    colour_ = to_albedo(mix(species, neutral_grain, kGreyer));
}

std::vector<GluedSpheres::Seen> GluedSpheres::seen(const View& view, const Frame& frame) const {
    std::vector<Seen> all;
    for (const Glued& one : glued_) {
        const BodyPose pose = frame.body(one.body);
        const Vec3 centre = pose.moved(one.at_rest);
        if (one.at_side || view.faces(centre, pose.rotation * one.inward))
            all.push_back({centre, one.radius});
    }
    return all;
}

}  // namespace grainreel
