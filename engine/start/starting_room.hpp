// The space where centres of first grains may be drawn: the free space without the glued grains.
#pragma once

#include <string>
#include <vector>

#include "engine/base/random.hpp"
#include "engine/scene/free_space.hpp"
#include "engine/scene/scene.hpp"
#include "engine/step/grid/neighbours.hpp"

namespace grainreel {

// m3, of the grains of a species that are there from the start, by its mean diameter.
double solid_volume_at_start(const Species& species);

class StartingRoom {
  public:
    explicit StartingRoom(const Scene& scene);

    // A centre between two heights (m) that keeps this margin (m) to the walls, as far as a vessel or a
    // region with narrow places allows it. A grain of this radius (m) is not wedged between a mesh and
    // another wall there. Throws UserError where there is hardly any room.
    Vec3 random_centre(double bottom, double top, double margin, double radius, Random& random) const;

    const FreeSpace space;
    const double filled;  // share of the space, from its bottom, in which the scene's grains lie loosely

  private:
    double narrower(double margin, int draws) const;
    bool is_clear(const Vec3& centre, double margin) const;
    bool is_wedged(const Vec3& centre, double radius) const;

    const bool simple_;  // no mesh and no region: every layer has room
    const std::vector<SceneMesh>& meshes_;
    const std::string place_;  // place in the scene, for messages
    const std::vector<Face> faces_;
    const GluedGrains glued_;
    const GluedSearch search_;
};

}  // namespace grainreel
