// A touching pair that turns as one body: geometry and law together see no slip.
#include <gtest/gtest.h>

#include "engine/laws/law_kernel.hpp"
#include "engine/step/contact_geometry.hpp"
#include "engine/step/histories.hpp"
#include "tests/physics/world.hpp"

namespace grainreel {
namespace {

// Two unequal spheres led by hand, and their contact's history.
class LedPair {
  public:
    explicit LedPair(TangentialLaw tangential)
        : kernel_(law_kernel({NormalForce::walton_braun, tangential, false})),
          parameters_(kernel_.parameters({walton_braun_pair(0.9, 0.5)})) {
        history_.shape(kernel_.history_size, kernel_.number_size);
        history_.resize(1);
        grains_.add(0, 0, Vec3(0, 0, 0), kRadius, kDensity);
        grains_.add(1, 0, Vec3(1.59 * kRadius, 0, 0), 0.6 * kRadius, kDensity);
    }

    // Where they are at the step's end, and how they move in the middle of it; the tangential force on the
    // second.
    Vec3 step(const Quaternion& pose, const Vec3& rate, const Vec3& slip, double step) {
        const Quaternion middle(Eigen::AngleAxisd(-0.5 * step * rate.norm(), rate.normalized()) * pose);
        const Vec3 apart(1.59 * kRadius, 0, 0);
        grains_.place[1].position = pose * apart;
        grains_.motion[1].velocity = rate.cross(middle * apart) - slip;
        grains_.motion[0].spin = grains_.motion[1].spin = rate;
        const GeometryInput in{&grains_, first_, second_, 1, Wants::spin, LeverArms::contact_plane,
                               step,     step,   nullptr};
        touch_pairs(in, 0, touch_);
        kernel_.step({1, &touch_, kind_, &parameters_, step, 0.5, kernel_.history_size, nullptr},
                     history_.of_block(0), force_);
        return {force_.tangential[0][0], force_.tangential[1][0], force_.tangential[2][0]};
    }

  private:
    const LawKernel& kernel_;
    const LawParameters parameters_;
    Histories history_;
    Grains grains_;
    TouchChunk touch_;
    ForceChunk force_;
    std::int32_t first_[kBlock] = {}, second_[kBlock] = {1}, kind_[kBlock] = {};
};

// By how much of itself the force is off that turns with the pair, after 0.01 s and nearly half a turn.
double carried_wrong(TangentialLaw law, double step) {
    LedPair pair(law);
    const Vec3 rate = 300 * Vec3(0.3, -0.5, 0.8).normalized();
    const Vec3 start = pair.step(Quaternion::Identity(), Vec3(1e-9, 0, 0), Vec3(0, 0.2, 0.1), 1e-6);
    EXPECT_GT(start.norm(), 1e-3);
    Quaternion pose = Quaternion::Identity();
    Vec3 force = Vec3::Zero();
    for (int n = 1; n * step < 0.01; ++n) {
        pose = Eigen::AngleAxisd(rate.norm() * step * n, rate.normalized());
        force = pair.step(pose, rate, Vec3::Zero(), step);
    }
    return (force - pose * start).norm() / start.norm();
}

// Nothing slips, so the force turns with the pair and keeps its size: to second order in the step, with the
// normal of the middle of the step beside the velocities of the middle. With that of its end it is first
// order.
TEST(RigidPair, CarriesItsForceAroundUnchanged) {
    for (const TangentialLaw law : {TangentialLaw::incremental_slip, TangentialLaw::linear_spring}) {
        const double error = carried_wrong(law, 1e-6);
        EXPECT_LT(error, 1e-3);
        EXPECT_NEAR(carried_wrong(law, 2e-6) / error, 4, 0.4);
    }
}

}  // namespace
}  // namespace grainreel
