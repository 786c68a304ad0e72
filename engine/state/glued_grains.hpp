// Grains glued to the faces of a container. They make walls rough.
//
// A glued grain is a part of its face, and not a grain of infinite mass. A free grain touches it as it
// touches a wall: the contact has a history, and its force and work are those of the face. So code that
// counts, saves or measures grains does not see them, and they cost nothing in scenes without them. They
// follow from the scene alone, so no file holds them.
#pragma once

#include <cstdint>
#include <vector>

#include "engine/base/system/processor.hpp"
#include "engine/scene/scene.hpp"
#include "engine/state/container_faces.hpp"
#include "engine/state/grains.hpp"

namespace grainreel {

struct GluedGrains {
    LargeArray<Place> place;         // centres relative to the point of their face, and radii; m
    std::vector<std::int32_t> face;  // number of each glued grain's face

    std::size_t size() const { return place.size(); }
    bool empty() const { return place.empty(); }
    // Centre (m) of a glued grain at a pose of the drive.
    Vec3 centre(std::size_t g, const std::vector<Face>& faces, const DrivePose& pose) const {
        const Face& on = faces[face[g]];
        return place[g].position + on.point + on.displacement(pose);
    }
};

// The glued grains of the scene's container; none without container.wall_grains. Their centres lie in the
// face, in a triangular lattice, and each is moved at random in the face (Stream::wall_grains). No glued
// grain reaches into an outlet. `faces` are those of container_faces(), perhaps with others after them.
GluedGrains glue_grains(const Scene& scene, const std::vector<Face>& faces);

}  // namespace grainreel
