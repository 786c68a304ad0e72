// What a ray through the bed at one moment meets: grains, and the wall behind them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "engine/questions/answer.hpp"
#include "engine/questions/snapshot.hpp"
#include "engine/scene/scene.hpp"
#include "engine/state/state.hpp"

namespace grainreel {

struct Ray {
    Vec3 origin{0, 0, 0};     // m
    Vec3 direction{1, 0, 0};  // its length may be any number > 0

    Vec3 at(double t) const { return origin + t * direction; }
};

// A half of space that a cut keeps: the points p with normal . p >= distance.
struct KeptHalf {
    Vec3 normal;
    double distance;  // m
};

struct GrainOnRay {
    std::size_t grain;  // place in the frame
    double from, to;    // where the ray is inside the grain, in lengths of its direction
};

// The grains that the ray meets ahead of its origin, the nearest first. Only the part of a grain that lies
// in all kept halves counts, because the rest is not drawn.
std::vector<GrainOnRay> grains_on(const Ray& ray, const State& frame, const std::vector<KeptHalf>& kept);

struct WallOnRay {
    std::string name;
    double at;  // along the ray, in lengths of its direction
};
// The face of the container through which the ray leaves it; empty when it does not pass through the
// container, or leaves it above the walls of an open top.
std::optional<WallOnRay> wall_behind(const Ray& ray, const Scene& scene, const State& frame);

struct MeshOnRay {
    std::size_t mesh;       // index in the scene
    std::int32_t triangle;  // index in the mesh
    double at;              // along the ray, in lengths of its direction
};
// Where the ray meets meshes, as they stand in the frame, the nearest first. Only parts that lie in all
// halves count.
std::vector<MeshOnRay> meshes_on(const Ray& ray, const Scene& scene, const State& frame,
                                 const std::vector<KeptHalf>& kept);

// Answers which grains lie along a ray through a moment, and which wall is behind them.

// How the moment is drawn: what is cut away, and what can be seen through.
struct AlongRay {
    std::vector<KeptHalf> kept;              // halves that a cut keeps
    std::vector<std::int32_t> seen_through;  // species that are drawn transparent, so that they hide nothing
};

// `shown` has the grains of the snapshot at the places where they are drawn. The nearest comes first. With
// `through` the answer goes on behind the first grain that is not transparent.
Answer along_ray_answer(const Snapshot& snapshot, const State& shown, const Ray& ray, const AlongRay& along,
                        bool through);

}  // namespace grainreel
