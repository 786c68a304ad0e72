#include "render/picture/container/mesh_shadows.hpp"

#include <algorithm>
#include <cmath>

#include "render/picture/container/mesh_reach.hpp"
#include "render/picture/mesh/scene_meshes.hpp"

namespace grainreel {
namespace {

constexpr double kPatches = 6000;        // of one mesh, about
constexpr double kVesselOpacity = 0.12;  // of each wall that light passes
constexpr int kMostAlong = 64;           // patches along the side of one triangle

}  // namespace

MeshShadows::MeshShadows(const FilmedScene& scene) {
    for (std::size_t m = 0; m < scene.meshes.size(); ++m) {
        const SceneMesh& mesh = scene.meshes[m];
        if (!mesh.surface) continue;
        const Surface& surface = *mesh.surface;
        const double opacity = look_of(scene, mesh) == MeshLook::vessel ? kVesselOpacity : 1;
        const std::int32_t apart = surface.size() / static_cast<std::int32_t>(4 * kPatches) + 1;
        double all = 0;
        for (std::int32_t t = 0; t < surface.size(); t += apart) all += surface.area(t);
        // A closed body takes light on its way in, and not once more on its way out.
        const double share = (opacity == 1 && surface.facts().closed() ? 0.5 : 1) * opacity * apart;
        for (std::int32_t t = 0; t < surface.size(); t += apart)
            add(surface, t, std::sqrt(kPatches * surface.area(t) / std::max(all, 1e-300)), share,
                static_cast<std::size_t>(first_mesh_body(scene)) + m);
    }
    const std::vector<Vec3> reach = mesh_reach(scene);
    if (!reach.empty()) lowest_ = reach.front().z();
    for (const Vec3& point : reach) lowest_ = std::min(lowest_, point.z());
}

// As `along` x `along` equal ones, half of them upside down.
void MeshShadows::add(const Surface& surface, std::int32_t t, double wanted, double share, std::size_t body) {
    const int along = std::clamp(static_cast<int>(std::lround(wanted)), 1, kMostAlong);
    const Vec3 &a = surface.corner(t, 0), u = surface.corner(t, 1) - a, v = surface.corner(t, 2) - a;
    const Vec3 area = share * surface.area(t) / (along * along) * surface.normal(t);
    for (int i = 0; i < along; ++i)
        for (int j = 0; j < along; ++j) {
            const bool upright = i + j < along;
            const double x = (i + 1.0 / 3) / along, y = (j + 1.0 / 3) / along;
            patches_.push_back({a + (upright ? x : 1 - x) * u + (upright ? y : 1 - y) * v, area, body});
        }
}

}  // namespace grainreel
