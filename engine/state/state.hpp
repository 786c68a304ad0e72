// A State is the output of the engine: the state of every grain and of the container at one step. This header
// needs neither the scene, nor laws, nor the step loop, so code that draws or writes frames does not depend
// on them.
#pragma once

#include <algorithm>
#include <cstdint>
#include <memory>
#include <numbers>
#include <optional>
#include <vector>

#include "engine/base/vector.hpp"
#include "engine/state/grain_shape.hpp"
#include "engine/state/pose.hpp"

namespace grainreel {

// The index of the wanted id in a list of rising ids; empty where the list lacks it.
inline std::optional<std::size_t> row_of_id(const std::vector<std::int32_t>& ids, std::int64_t wanted) {
    const auto found = std::lower_bound(ids.begin(), ids.end(), wanted);
    if (found == ids.end() || *found != wanted) return std::nullopt;
    return static_cast<std::size_t>(found - ids.begin());
}

struct State {
    std::int64_t step = 0;
    double time = 0;    // s since the drive started, negative before
    double cycles = 0;  // periods since the drive started
    double phase = 0;   // turns in [0, 1)

    // Poses of the bodies by their numbers (engine/state/pose.hpp): container, floor, planes and meshes of
    // the scene.
    std::vector<BodyPose> bodies = std::vector<BodyPose>(kFirstPlaneBody);
    BodyPose& container() { return bodies[kContainerBody]; }
    const BodyPose& container() const { return bodies[kContainerBody]; }
    BodyPose& floor() { return bodies[kFloorBody]; }
    const BodyPose& floor() const { return bodies[kFloorBody]; }
    // The pose of a body. It is the pose at rest if the frame, made by hand, has none.
    BodyPose body(std::size_t number) const { return number < bodies.size() ? bodies[number] : BodyPose(); }

    // One entry per grain, in order of id, in SI units. A velocity or spin of another program's file may be
    // unknown, also in one component alone; then it is NaN.
    std::vector<std::int32_t> id;
    std::vector<std::int32_t> species;
    std::vector<double> radius;  // of a grain with a shape: that of the sphere with its volume
    std::vector<double> mass;    // empty where all grains have the density of their species
    std::vector<Vec3> position, velocity, spin;
    std::vector<Quaternion> orientation;  // empty unless the scene asks for it
    std::vector<GrainShape> shape;        // empty where all grains are spheres; with shapes go orientations
    std::vector<std::int32_t>
        contact_number;  // number of contacts of a grain that carry force; empty where unknown

    std::size_t size() const { return id.size(); }
    // The row of the grain with this id; empty where there is no such grain.
    std::optional<std::size_t> row_of(std::int64_t wanted) const { return row_of_id(id, wanted); }
};

// The mass (kg) of a grain: its own, or that of a sphere with the density (kg/m3) of its species.
inline double mass_of(const State& frame, std::size_t grain, double density) {
    if (!frame.mass.empty()) return frame.mass[grain];
    const double r = frame.radius[grain];
    return density * 4.0 / 3.0 * std::numbers::pi * r * r * r;
}

using StatePtr = std::shared_ptr<const State>;

}  // namespace grainreel
