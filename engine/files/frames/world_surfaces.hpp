// The walls of a world as triangles, for formats that know nothing else: planes are cut where they meet each
// other and at the world's corners, cylinders have facets.
#pragma once

#include <string>
#include <vector>

#include "engine/files/frames/world.hpp"
#include "engine/frame.hpp"
#include "engine/mesh/triangle_mesh.hpp"

namespace grainreel {

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
