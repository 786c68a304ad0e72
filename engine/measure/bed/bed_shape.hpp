// Formulas for the structure of the bed: its solid fraction, the directions of its contacts (Fabric), and the
// height of a single large grain in it. They do not need the step loop.
#pragma once

#include <cstddef>
#include <optional>

#include "engine/base/vector.hpp"
#include "engine/scene/scene.hpp"
#include "engine/state/grains.hpp"

namespace grainreel {

// Volume of the grains below `top`, divided by the container's volume between `floor` and `top` (both m, in
// the frame of the scene). A grain that reaches through the plane z = top counts by its part below it: a cap
// of height h of a sphere of radius r has the volume pi h^2 (3 r - h) / 3. NaN if there is no container, or
// if `top` is not above `floor`.
double solid_fraction(const Container& container, const Grains& grains, double floor, double top);

// How the contacts between grains are oriented.
//
// The fabric tensor F = <n n^T> over the unit normals n of contacts: Oda (1982, Soils Found. 22(4), 96),
// Rothenburg & Bathurst (1989, Geotechnique 39, 601). Its trace is 1; F = I / 3 when no direction is
// preferred.
class Fabric {
  public:
    void add(const Vec3& normal) {
        sum_ += normal * normal.transpose();
        contacts_ += 1;
    }
    double contacts() const { return contacts_; }
    // All NaN without contacts.
    Eigen::Matrix3d tensor() const { return sum_ / contacts_; }
    // Largest minus smallest eigenvalue of F: 0 without a preferred direction, 1 when all normals are
    // parallel.
    double anisotropy() const;
    // F_zz, the mean square of the cosine between a normal and the vertical: 1/3 without a preferred
    // direction, 1 when all normals are vertical.
    double vertical() const { return tensor()(2, 2); }

  private:
    Eigen::Matrix3d sum_ = Eigen::Matrix3d::Zero();
    double contacts_ = 0;
};

// Index of the intruder: the only grain of the species with the largest mean diameter. Empty if there is only
// one species, or if this species does not have exactly one grain.
std::optional<std::size_t> find_intruder(const Scene& scene, const Grains& grains);

// Height of the intruder's top divided by the height of the bed's surface around it, both above the floor. It
// is 1 when the intruder comes to the surface. The surface is that of the other grains (surface.hpp) in a
// square around the intruder which reaches two of their mean diameters beyond it. NaN without other grains
// there.
double intruder_height(const Scene& scene, const Grains& grains, std::size_t intruder, double floor);

}  // namespace grainreel
