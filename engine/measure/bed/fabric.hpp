// How the contacts between grains are oriented.
#pragma once

#include "engine/base/vector.hpp"

namespace grainreel {

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

}  // namespace grainreel
