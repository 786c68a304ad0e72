// The surroundings that a scene gives its grains: faces, glued grains, meshes, gravity and exits. They are
// made from a scene and its plan. The step loop only reads them. In a run only open_outlet() changes them
// later, while the loop stands still.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "engine/base/vector.hpp"
#include "engine/state/body.hpp"
#include "engine/state/container_faces.hpp"
#include "engine/state/drive_motion.hpp"
#include "engine/state/glued_grains.hpp"
#include "engine/state/traffic.hpp"

namespace grainreel {

struct Plan;    // engine/plan/plan.hpp
struct Scene;   // engine/scene/scene.hpp
class Surface;  // engine/mesh/surface.hpp

// A mesh in the run. Where faces and meshes are numbered together, the meshes come after the faces.
struct MeshWall {
    std::string name;
    std::shared_ptr<const Surface> surface;
    Body body;
    Vec3 point{0, 0, 0};  // m, place at rest of the point about which the mesh's moments are taken
};

struct Surroundings {
    std::vector<Face> faces;
    GluedGrains glued;  // glued to these faces
    std::vector<MeshWall> meshes;
    DriveMotion motion;
    Vec3 gravity{0, 0, 0};  // m/s2
    double period = 0;      // m, along x; 0 where x is not periodic
    // m: the first neighbour lists hold grains up to this distance beyond contact. Later lists use a distance
    // that suits the motion.
    double skin = 0;
    // Regions in which grains leave. open_outlet() may add one. A simulation has none while it packs.
    std::vector<Exit> exits;
};

// The name of a wall in messages. `wall` numbers the faces from 0 and then the meshes. For a ContactView it
// is -1 - second.
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
