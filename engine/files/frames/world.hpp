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

}  // namespace grainreel
