// What a record of frames says of its world, whoever wrote it and in which format: species, cell, bodies. It
// needs no scene, and most of it may be unknown.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "engine/base/vector.hpp"
#include "engine/files/file_facts.hpp"
#include "engine/files/frames/frame_archive.hpp"
#include "engine/files/trajectory.hpp"
#include "engine/frame.hpp"
#include "engine/mesh/triangle_mesh.hpp"
#include "engine/scene/scene.hpp"
#include "engine/state/container_faces.hpp"

namespace grainreel {

inline constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();

struct WorldSpecies {
    std::string name;
    double diameter = kUnknown;  // m, the mean
    double density = kUnknown;   // kg/m3
    std::int64_t count = 0;      // grains at the start; 0 where that is not known
};

// A body by its shapes at rest. Where it is in a frame says the frame (Frame::bodies), by the body's number.
struct WorldBody {
    std::string name;
    std::vector<Face> faces;
    TriangleMesh mesh;
};

// The box that the grains are in, which may be tilted. An edge of 0 m: nothing is known along it.
struct WorldCell {
    Vec3 origin{0, 0, 0};  // m
    std::array<Vec3, 3> edges{Vec3(0, 0, 0), Vec3(0, 0, 0), Vec3(0, 0, 0)};
    std::array<bool, 3> periodic{};  // along each edge
};

struct World {
    std::string title;
    std::string program_version;  // of the program that wrote it
    std::vector<WorldSpecies> species;
    std::optional<WorldCell> cell;
    Vec3 low{0, 0, 0}, high{0, 0, 0};  // m, corners of what the walls take up; equal where that is not known
    std::vector<WorldBody> bodies;     // by number; container and floor first, or none where nothing is known
    std::size_t most_grains = 0;       // that a frame can have, all that ever come counted
    bool traffic = false;              // grains come and go
    bool container_turns = false;      // with its floor: their poses have a rotation
    bool time_known = true;
    FileFacts facts = {};  // words for whoever reads the file
};

// Container, floor, planes, meshes and species of a scene.
World world_of(const Scene& scene);

// For those who need a scene of a world that has none: its species, in no container, and its meshes where it
// has no planes.
Scene scene_of(const World& world);

// What a trajectory's file says of its world, and what a writer of one takes from a world.

World world_of(const TrajectoryInfo& info);
TrajectoryInfo trajectory_info(const World& world, const FrameSupply& supply);

// Frames that are not whole, and those that the file's header does not count; a sentence each. name: the
// file's.
std::vector<std::string> faults_of(const TrajectoryReader& trajectory, const std::string& name);

// The walls of a world as triangles, for formats that know nothing else: planes are cut where they meet each
// other and at the world's corners, cylinders have facets.

struct WorldSurface {
    std::string name;      // of the face or the mesh
    std::size_t body = 0;  // whose pose moves it
    TriangleMesh shape;    // m, at rest
};

// All surfaces, at rest, those without triangles left out.
std::vector<WorldSurface> surfaces_of(const World& world);

// Where a surface is in a frame.
TriangleMesh moved(const WorldSurface& surface, const Frame& frame);

}  // namespace grainreel
