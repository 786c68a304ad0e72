// What lies on a ray: grains, and the wall behind them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "engine/frame.hpp"
#include "engine/questions/answer.hpp"
#include "engine/questions/snapshot.hpp"
#include "engine/scene/scene.hpp"

namespace grainreel {

struct Ray {
    Vec3 origin{0, 0, 0};     // m
    Vec3 direction{1, 0, 0};  // of any length > 0

    Vec3 at(double t) const { return origin + t * direction; }
};

// The points p with normal . p >= distance are kept.
struct KeptHalf {
    Vec3 normal;
    double distance;  // m
};

struct GrainOnRay {
    std::size_t grain;  // place in the frame
    double from, to;    // of the ray, in lengths of its direction: where it is inside the grain
};

// Grains that the ray meets ahead of its origin, the nearest first. Of each only the part that lies in all
// halves counts, as a cut bed is drawn.
std::vector<GrainOnRay> grains_on(const Ray& ray, const Frame& frame, const std::vector<KeptHalf>& kept);

struct WallOnRay {
    std::string name;
    double at;  // of the ray
};
// The face of the container through which the ray leaves it; empty when it does not pass through the
// container, or leaves it above the walls of an open top.
std::optional<WallOnRay> wall_behind(const Ray& ray, const Scene& scene, const Frame& frame);

struct MeshOnRay {
    std::size_t mesh;       // of the scene
    std::int32_t triangle;  // of the mesh
    double at;              // of the ray
};
// Where the ray meets meshes, as they stand in the frame, the nearest first. Of each only what lies in all
// halves counts.
std::vector<MeshOnRay> meshes_on(const Ray& ray, const Scene& scene, const Frame& frame,
                                 const std::vector<KeptHalf>& kept);

// What lies along a ray through a moment: which grains, and which wall behind them.

// How the moment is looked at.
struct AlongRay {
    std::vector<KeptHalf> kept;              // of a cut
    std::vector<std::int32_t> seen_through;  // species that hide nothing
};

// shown: the grains of the snapshot where they are seen. The nearest first; through: what lies behind, too.
Answer along_ray_answer(const Snapshot& snapshot, const Frame& shown, const Ray& ray, const AlongRay& along,
                        bool through);

}  // namespace grainreel
