#include "engine/state/tray_faces.hpp"

#include "engine/scene/bed.hpp"

namespace grainreel {

std::vector<Face> tray_faces(const Scene& scene) {
    if (!scene.container.tray) return {};
    const Container tray = tray_container(scene);
    const Vec3 down(0, 0, -scene.container.tray->depth), rim = down + tray.height * Vec3::UnitZ();
    std::vector<Face> faces = container_faces(tray, Drive{});
    for (Face& face : faces) {
        face.name = "tray " + face.name;
        face.body = {kTrayBody, false, Vec3(0, 0, 0)};
        face.point += down;
        if (face.kind == Face::Kind::plane && face.normal.z() != 0) continue;  // the floor
        face.ends = true;
        face.along = Vec3(0, 0, -1);
        face.edge = face.point;
        face.edge.z() = rim.z();
    }
    return faces;
}

}  // namespace grainreel
