// Tests of a touching pair that turns as one body: geometry and law together see no slip.
#include <gtest/gtest.h>

#include <algorithm>

#include "engine/laws/law_kernel.hpp"
#include "engine/step/geometry/contact_geometry.hpp"
#include "engine/step/lists/histories.hpp"
#include "tests/physics/world.hpp"

namespace grainreel {
namespace {

// Two unequal spheres that are moved by hand, and the history of their contact.
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

    // pose: where they are at the step's end; rate, slip: how they move in the middle of it. Returns the
    // tangential force on the second sphere.
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

// The relative error of the force that turns with the pair, after 0.01 s and nearly half a turn.
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

// Nothing slips, so the force turns with the pair and keeps its size. The error is of second order in the
// step if the normal of the middle of the step is used with the velocities of the middle. With the normal of
// the end it is of first order.
TEST(RigidPair, CarriesItsForceAroundUnchanged) {
    for (const TangentialLaw law : {TangentialLaw::incremental_slip, TangentialLaw::linear_spring}) {
        const double error = carried_wrong(law, 1e-6);
        EXPECT_LT(error, 1e-3);
        EXPECT_NEAR(carried_wrong(law, 2e-6) / error, 4, 0.4);
    }
}

// Two grains fly past each other from one force to the next. From their places and velocities, geometry finds
// a turn that takes the old normal to the new one, up to the third power of the angle. (tan(t) / 2 in place
// of tan(t / 2) is off by t^3 / 4, and neglecting the change of the distance is off by twice the square of
// v_n step / d.)
TEST(RigidPair, TurnTakesTheOldNormalToTheNew) {
    const Vec3 before(1.5e-3, -0.4e-3, 0.9e-3), velocity(0.7, 1.1, -0.6);
    std::int32_t first[kBlock] = {}, second[kBlock] = {};
    std::fill_n(second, kBlock, 1);
    TouchChunk touch;
    for (const double step : {1e-5, 1e-4}) {
        Grains grains;
        grains.add(0, 0, Vec3(0, 0, 0), 1e-3, kDensity);
        grains.add(1, 0, before + step * velocity, 1e-3, kDensity);
        grains.motion[1].velocity = velocity;
        touch_pairs({&grains, first, second, 1, Wants::spin, LeverArms::contact_plane, step, step, nullptr},
                    0, touch);
        const Vec3 now = grains.place[1].position.normalized();
        const double angle = std::acos(before.normalized().dot(now));
        const double nearer = std::abs(velocity.dot(now)) * step / grains.place[1].position.norm();
        const Vec3 turn(touch.turn[0][0], touch.turn[1][0], touch.turn[2][0]);
        const Quaternion rotation = Quaternion(1, turn.x(), turn.y(), turn.z()).normalized();
        EXPECT_LT((rotation * before.normalized() - now).norm(),
                  angle * (angle * angle / 3 + nearer * nearer));
    }
}

// The same holds along a round wall; at a plane wall there is only the twist.
TEST(RigidPair, TurnsAlongARoundWall) {
    const Vec3 before(8e-3, -5.9e-3, 1e-3), velocity(-0.4, -0.9, 0.7), spin(10, -20, 30);
    constexpr double step = 1e-4;
    std::vector<Face> faces(2);
    faces[0].kind = Face::Kind::cylinder;
    faces[0].radius = 10.5e-3;
    faces[1].normal = Vec3(-1, 0, 0);
    faces[1].point = Vec3(8.5e-3, 0, 0);
    WallState walls;
    walls.set(faces, DrivePose(), DrivePose(), step);
    Grains grains;
    grains.add(0, 0, before + step * velocity, 1e-3, kDensity);
    grains.motion[0].velocity = velocity;
    grains.motion[0].spin = spin;
    std::int32_t grain[kBlock] = {}, face[kBlock] = {0, 1};
    TouchChunk touch;
    touch_walls({&grains, grain, face, 2, Wants::spin, LeverArms::contact_plane, step, step, nullptr}, walls,
                touch);
    ASSERT_EQ(touch.touching & 3, 3u);
    const auto turn_of = [&](int c) { return Vec3(touch.turn[0][c], touch.turn[1][c], touch.turn[2][c]); };
    const auto outwards = [](const Vec3& x) { return Vec3(x.x(), x.y(), 0).normalized(); };
    const Vec3 was = outwards(before), is = outwards(grains.place[0].position);
    const Vec3 turn = turn_of(0);
    const Quaternion rotation = Quaternion(1, turn.x(), turn.y(), turn.z()).normalized();
    EXPECT_GT((was - is).norm(), 5e-3);
    EXPECT_LT((rotation * was - is).norm(), 2e-6);
    EXPECT_NEAR(turn.dot(is), 0.25 * step * spin.dot(is), 1e-12);
    EXPECT_LT((turn_of(1) - 0.25 * step * spin.x() * Vec3(1, 0, 0)).norm(), 1e-15);
}

}  // namespace
}  // namespace grainreel
