#include "engine/measure/bed/fabric.hpp"

#include <Eigen/Eigenvalues>

#include "engine/measure/no_value.hpp"

namespace grainreel {

double Fabric::anisotropy() const {
    if (contacts_ == 0) return kNoValue;
    Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver;
    solver.compute(tensor(), Eigen::EigenvaluesOnly);
    const Vec3 rising = solver.eigenvalues();
    return rising[2] - rising[0];
}

}  // namespace grainreel
