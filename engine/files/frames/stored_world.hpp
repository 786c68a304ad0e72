// The world around the grains of an archive: species, cell and walls. Files of every format have one, even
// without a scene, but much of it may be unknown. world_of() makes it from a scene or from the header of a
// trajectory; surfaces_of() turns its walls into triangles.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "engine/base/numbers.hpp"
#include "engine/base/triangle_mesh.hpp"
#include "engine/base/vector.hpp"
#include "engine/files/file_facts.hpp"
#include "engine/files/trajectory/trajectory.hpp"
#include "engine/state/state.hpp"

namespace grainreel {

struct Face;  // engine/state/container_faces.hpp; who makes, copies or changes a StoredWorld includes it
struct StateSupply;  // engine/files/frames/state_archive.hpp
struct Scene;        // engine/scene/scene.hpp

inline constexpr double kGlassDensity = 2500;  // kg/m3; taken where the density is not known

struct WorldSpecies {
    std::string name;
    double diameter = kUnknown;  // m, the mean
    double density = kUnknown;   // kg/m3
    std::int64_t count = 0;      // number of grains at the start, or 0 where it is not known
};

// The shapes of a body at rest. Frame::bodies says where the body is in a frame, by the body's number.
struct WorldBody {
    std::string name;
    std::vector<Face> faces;
    TriangleMesh mesh;
};

// The box that the grains are in, which may be tilted. An edge of length 0 means that the box is not known in
// that direction.
struct WorldCell {
    Vec3 origin{0, 0, 0};  // m
    std::array<Vec3, 3> edges{Vec3(0, 0, 0), Vec3(0, 0, 0), Vec3(0, 0, 0)};
    std::array<bool, 3> periodic{};  // along each edge
};

struct StoredWorld {
    std::string title;
    std::string program_version;  // version of the program that wrote the file
    std::vector<WorldSpecies> species;
    std::optional<WorldCell> cell;
    Vec3 low{0, 0, 0}, high{0, 0, 0};  // m, corners of the box around all walls; equal where it is not known
    std::vector<WorldBody> bodies;     // by number; container and floor first, or none where nothing is known
    std::size_t most_grains = 0;       // the most that a frame can have; grains that come later count too
    bool traffic = false;              // grains come and go
    bool container_turns = false;      // container and floor: their poses have a rotation
    bool time_known = true;
    bool steps_known = true;  // whether the files have the numbers of steps
    int first_id = 0;         // 1 where grains are counted from 1
    FileFacts facts = {};     // texts for people who read the file
};

// Container, floor, planes, meshes and species of a scene.
StoredWorld world_of(const Scene& scene);

// A scene for a world that has none, for code that needs one. It has the species and no container, and it has
// the meshes if the world has no planes.
Scene scene_of(const StoredWorld& world);

// The cell of a frame of a trajectory, and back. An edge that is not periodic has the length 0 there.
TrajectoryCell trajectory_cell(const WorldCell& cell);
WorldCell world_cell(const TrajectoryCell& cell);

// What the header of a trajectory says of its world, and the header for a trajectory of this world.
StoredWorld world_of(const TrajectoryInfo& info);
TrajectoryInfo trajectory_info(const StoredWorld& world, const StateSupply& supply);

// Up to two sentences for the user: one if the last frame is not whole, and one if there are frames that the
// file's header does not count. name: of the file.
std::vector<std::string> faults_of(const TrajectoryReader& trajectory, const std::string& name);

// One wall as triangles, for formats that know nothing else. Planes are cut where they meet each other and at
// the world's corners; cylinders become facets.
struct WorldSurface {
    std::string name;      // name of the face or the mesh
    std::size_t body = 0;  // number of the body that moves it
    TriangleMesh shape;    // m, at rest
};

// All walls at rest, without those that have no triangles.
std::vector<WorldSurface> surfaces_of(const StoredWorld& world);

// The wall where it is in a frame.
TriangleMesh moved(const WorldSurface& surface, const State& frame);

}  // namespace grainreel
