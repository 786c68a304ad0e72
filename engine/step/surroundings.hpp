// The surroundings that a scene gives its grains: faces, glued grains, meshes, gravity and exits. They are
// made from a scene and its plan. The step loop reads them and never changes them.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "engine/mesh/surface.hpp"
#include "engine/plan/plan.hpp"
#include "engine/scene/scene.hpp"
#include "engine/state/body.hpp"
#include "engine/state/container_faces.hpp"
#include "engine/state/glued_grains.hpp"
#include "engine/state/traffic.hpp"

namespace grainreel {

// A mesh in the run. Where faces and meshes are numbered together, the meshes come after the faces.
struct MeshWall {
    std::string name;
    std::shared_ptr<const Surface> surface;
    Body body;
    Vec3 point{0, 0, 0};  // m, at rest, about which its moment counts
};

struct Surroundings {
    std::vector<Face> faces;
    GluedGrains glued;  // glued to these faces
    std::vector<MeshWall> meshes;
    WallMotion motion;
    Vec3 gravity{0, 0, 0};  // m/s2
    double period = 0;      // m, of x; 0 for none
    double skin =
        0;  // m, how far beyond contact the first neighbour lists reach; later ones adapt to the motion
    std::vector<Exit> exits;  // regions in which grains leave; may change between two runs
};

// The name of a wall in messages. `wall` counts faces first and then meshes, as in ContactView (wall = -1 -
// second).
inline std::string wall_name(const Surroundings& around, std::int32_t wall) {
    const auto number = static_cast<std::size_t>(wall);
    const std::size_t faces = around.faces.size();
    return number < faces ? "the " + around.faces[number].name
                          : "\"" + around.meshes[number - faces].name + "\"";
}

Surroundings make_surroundings(const Scene& scene, const Plan& plan);

// Opens the outlet of a scene that has one. From then on, grains that have fallen deep enough leave.
void open_outlet(const Scene& scene, Surroundings& around);

}  // namespace grainreel
