// How the bed is built: its solid fraction, the directions of its contacts (Fabric), and the height of a
// single large grain in it. Plain formulas without the step loop.
#pragma once

#include <cstddef>
#include <optional>

#include "engine/base/vector.hpp"
#include "engine/scene/scene.hpp"
#include "engine/state/grains.hpp"

namespace grainreel {

// Volume of the grains below `top` over the container's volume between `floor` and `top`; both m, in the
// room. A grain that reaches through the plane z = top counts by its part below: a cap of height h of a
// sphere of radius r has the volume pi h^2 (3 r - h) / 3. NaN in empty space, and where top is not above
// floor.
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
    // Largest less smallest eigenvalue of F: 0 without a preferred direction, 1 when all normals are
    // parallel.
    double anisotropy() const;
    // F_zz, the mean square of the cosine between a normal and the vertical: 1/3 without a preferred
    // direction, 1 when all normals are vertical.
    double vertical() const { return tensor()(2, 2); }

  private:
    Eigen::Matrix3d sum_ = Eigen::Matrix3d::Zero();
    double contacts_ = 0;
};

// Index of the one grain of the species of the largest mean diameter; none where there is one species only,
// or that species has not just one grain.
std::optional<std::size_t> find_intruder(const Scene& scene, const Grains& grains);

// Height of the intruder's top over that of the bed's surface around it, both above the floor: 1 when it
// comes to the surface. The surface is that of the other grains (surface.hpp) in a square around the intruder
// which reaches two of their mean diameters beyond it. NaN without other grains there.
double intruder_height(const Scene& scene, const Grains& grains, std::size_t intruder, double floor);

}  // namespace grainreel
