// How far meshes reach in the course of a run, and what they take of the light that falls on the ground.
#pragma once

#include <cmath>
#include <cstdint>
#include <vector>

#include "engine/frame.hpp"
#include "render/scene/filmed_scene.hpp"

namespace grainreel {

// m: the outermost points of all meshes together along many directions, at rest and wherever their turns and
// paths bring them. Steady velocities, which have no end, and the drive are left out. Empty without meshes.
std::vector<Vec3> mesh_reach(const FilmedScene& scene);

// The surfaces of meshes as small patches that throw shadows. A vessel lets most of the light through, as all
// walls do.
class MeshShadows {
  public:
    explicit MeshShadows(const FilmedScene& scene);

    bool any() const { return !patches_.empty(); }
    double lowest() const { return lowest_; }  // m, lowest z of any mesh without the drive; 0 without meshes

    // Calls visit(place, area that is taken from light which comes from `to_light`) for each patch; m, m2.
    template <class Visit>
    void visit(const Frame& frame, const Vec3& to_light, const Visit& visit) const {
        for (const Patch& patch : patches_) {
            const BodyPose pose = frame.body(patch.body);
            visit(pose.moved(patch.at), std::abs(to_light.dot(pose.rotation * patch.area)));
        }
    }

  private:
    struct Patch {
        Vec3 at;    // m, at rest
        Vec3 area;  // m2, along its normal, times the share of the light that it takes
        std::size_t body;
    };
    // along: patches wanted along each side.
    void add(const Surface& surface, std::int32_t t, double along, double share, std::size_t body);

    std::vector<Patch> patches_;
    double lowest_ = 0;
};

}  // namespace grainreel
