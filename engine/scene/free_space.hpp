// The room that a scene has for the grains it packs: that of its container or of the box start.region, on the
// inner side of its planes and outside its meshes. Also a search for leaks of a vessel.
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "engine/scene/scene.hpp"

namespace grainreel {

class FreeSpace {
  public:
    // Where the scene has planes, meshes beside the container, or a region, the room is measured at 100,000
    // evenly spread places (10,000 where each takes rays): volumes are then good to some 0.1 % of the
    // container's. Closed meshes in a container are solid; a region may lie inside a mesh.
    explicit FreeSpace(const Scene& scene);

    double volume() const { return volume_; }  // m3
    // Corners (m) of a box around the room, from which to draw places.
    const Vec3& low() const { return low_; }
    const Vec3& high() const { return high_; }
    // The height z (m) below which this share of the volume lies; share in [0, 1].
    double height_of_share(double share) const;
    // The share of the room up to a height (m), `margin` (m) from all walls, whose places fulfil a condition.
    // It is measured at evenly spread places; 0 where the room is too narrow for the margin.
    double share_of(double height, double margin, const std::function<bool(const Vec3&)>& condition) const;
    // Whether the place lies at least `margin` (m) from floor, lid, walls, planes and meshes.
    bool holds(const Vec3& place, double margin) const;

  private:
    bool in_room(const Vec3& place, double margin) const;  // in the room of container and region
    bool before_planes(const Vec3& place, double margin) const;
    bool off_meshes(const Vec3& place, double margin) const;
    void set_box(const Scene& scene);
    void measure();

    const Container container_;
    const std::optional<Region> region_;
    const std::vector<ScenePlane> planes_;
    std::vector<Shared<Surface>> meshes_;  // all but the container's mesh
    Vec3 low_{0, 0, 0}, high_{0, 0, 0};
    double volume_ = 0;
    bool measured_ = false;
    std::vector<double> heights_;  // m, z of the measured places that are in the room, rising; empty where
                                   // nothing is measured
};

// A place (m) near which a grain of this diameter (m) gets out of a vessel. Empty if none is found. Holes
// above the rim of an open vessel do not count; a closed vessel must be closed on all sides.
//
// There are two searches. The first walks from the room to the box around the vessel, in steps of a 32nd of
// its size, and finds every hole in walls of any kind that is wider than a step and lets grains of 0.7 times
// the diameter through. The second looks at each open edge: it finds edges where, a diameter beyond the edge,
// the room meets the space outside. Sheets in the room, seams whose vertices do not meet, and thick walls
// disturb neither search.
std::optional<Vec3> leak_of(const Surface& surface, const EnclosedRoom& room, double diameter);

}  // namespace grainreel
