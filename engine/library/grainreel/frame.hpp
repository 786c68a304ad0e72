/// @file
/// One moment: every grain and every body.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "grainreel/vector.hpp"

namespace grainreel::v1 {

/// Where a body (container, floor, plane, mesh) is and how it moves.
struct Pose {
    Vector place{};       ///< m, of the body's origin, which at rest is the origin of the scene.
    Rotation rotation{};  ///< About that origin.
    Vector velocity{};    ///< m/s, of the origin.
    Vector spin{};        ///< rad/s.
};

/// The grains of one moment, as arrays with one entry for each grain by rising id, and the poses of the
/// bodies.
struct Frame {
    /// Steps since the drive started. In frames that you make, leave all of them at 0, or let them rise from
    /// frame to frame: readers take two frames with one step for one.
    std::int64_t step = 0;
    double time = 0;    ///< s since the drive started; NaN where it is not known.
    double cycles = 0;  ///< Periods since the drive started.

    std::vector<std::int32_t> id{};       ///< Each once, rising.
    std::vector<std::int32_t> species{};  ///< Places in the list of species, counted from 0.
    std::vector<double> radius{};         ///< m.
    std::vector<Vector> position{};       ///< m.
    std::vector<Vector> velocity{};       ///< m/s.
    std::vector<Vector> spin{};           ///< rad/s.
    std::vector<Rotation> orientation{};  ///< Empty where it is not known, or not kept by the scene.

    /// Container and floor, then the planes of the scene, then its meshes. A frame that you make has none, so
    /// that all bodies are at rest, or two for container and floor and then one for each wall of its World.
    /// With fewer it is refused. Poses beyond these are not used.
    std::vector<Pose> bodies{};

    /// kg, of each grain; empty where all grains have the density of their species.
    std::vector<double> mass{};

    /// How many grains there are.
    std::size_t size() const { return id.size(); }

    /// Adds a grain at rest; its id is one more than the last one. position and radius in m. In a frame with
    /// masses it has none yet.
    void add(const Vector& position, double radius, std::int32_t species = 0);
};

}  // namespace grainreel::v1
