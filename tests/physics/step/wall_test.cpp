// Tests of walls: distances on all faces and in corners, and their motion.
#include <gtest/gtest.h>

#include "engine/state/body.hpp"
#include "engine/state/drive_motion.hpp"
#include "tests/physics/world.hpp"

namespace grainreel {
namespace {

Container wedge() {
    Container c;
    c.shape = Container::Shape::wedge;
    c.half_width = 0.05;
    c.half_angle = 0.4;
    c.slant_height = 0.06;
    c.depth = 0.03;
    c.height = 0.1;
    return c;
}

const Face& face_named(const std::vector<Face>& faces, const std::string& name) {
    for (const Face& f : faces) {
        if (f.name == name) return f;
    }
    throw std::runtime_error(name);
}

TEST(Wedge, DistancesAreTheSeedsFormulas) {
    const Container c = wedge();
    const auto faces = container_faces(c, Drive{});
    EXPECT_EQ(faces.size(), 8u);  // floor, two walls, two slants, front, back, lid
    for (const double y : {-0.03, -0.01, 0.02, 0.035}) {
        for (const double z : {0.005, 0.03, 0.08}) {
            const Vec3 x(0.004, y, z);
            const bool right = y > 0;
            const double wall = c.half_width - std::abs(y);
            const double slant =
                (c.half_width - std::abs(y) - (c.slant_height - z) * std::tan(c.half_angle)) *
                std::cos(c.half_angle);
            const auto at = [&](const std::string& name) {
                return distance_to(face_named(faces, name), Vec3::Zero(), x);
            };
            EXPECT_NEAR(at(right ? "right wall" : "left wall").distance, wall, 1e-15);
            const FaceDistance d = at(right ? "right slant" : "left slant");
            EXPECT_NEAR(d.distance, slant, 1e-15);
            EXPECT_NEAR(d.normal.y(), (right ? -1 : 1) * std::cos(c.half_angle), 1e-15);
            EXPECT_NEAR(d.normal.z(), std::sin(c.half_angle), 1e-15);
            EXPECT_NEAR(at("floor").distance, z, 1e-15);
            EXPECT_NEAR(at("lid").distance, c.height - z, 1e-15);
            EXPECT_NEAR(at("front").distance, c.depth / 2 - x.x(), 1e-15);
            EXPECT_NEAR(at("back").distance, c.depth / 2 + x.x(), 1e-15);
        }
    }
}

TEST(Wedge, MovesWithItsWalls) {
    const auto faces = container_faces(wedge(), Drive{});
    const Vec3 x(0, 0.01, 0.02), lift(0, 0, 0.003);
    for (const Face& face : faces) {
        EXPECT_NEAR(distance_to(face, lift, x + lift).distance, distance_to(face, Vec3::Zero(), x).distance,
                    1e-16);
    }
}

// Gravity presses a frictionless ball into the corner of slant and floor, and the ball leans on both.
TEST(Wedge, BallInACornerTouchesBothFaces) {
    const Container c = wedge();
    PairPlan pair = walton_braun_pair(0.9, 0);
    pair.unloading_stiffness = pair.loading_stiffness;
    pair.normal_damping = 1000;
    HandMadeBed w = make_world(pair, 1e-6, NormalForce::spring_dashpot, TangentialLaw::none);
    w.around.faces = container_faces(c, Drive{});
    const double lean = 0.2;
    w.around.gravity = 9.81 * Vec3(0, std::sin(lean), -std::cos(lean));
    // The centre has the distance r from the floor and from the right slant.
    const double y =
        c.half_width - (c.slant_height - kRadius) * std::tan(c.half_angle) - kRadius / std::cos(c.half_angle);
    w.grains.add(0, 0, Vec3(0, y, kRadius), kRadius, kDensity);
    w.start();
    w.run(50000);
    double floor = 0, slant = 0;
    w.loop->visit_contacts(w.step, [&](const ContactView& v) {
        (w.around.faces[-1 - v.second].name == "floor" ? floor : slant) = v.normal_force;
    });
    // The slant's normal is (0, -cos t, sin t). Balance: S cos t = m g sin lean; F + S sin t = m g cos lean.
    const double weight = sphere_mass() * 9.81;
    const double expected_slant = weight * std::sin(lean) / std::cos(c.half_angle);
    EXPECT_NEAR(slant, expected_slant, 1e-3 * weight);
    EXPECT_NEAR(floor, weight * std::cos(lean) - expected_slant * std::sin(c.half_angle), 1e-3 * weight);
}

TEST(Cylinder, DistanceIsRadial) {
    Container c;
    c.shape = Container::Shape::cylinder;
    c.half_width = 0.04;
    c.height = 0.1;
    const auto faces = container_faces(c, Drive{});
    const FaceDistance d =
        distance_to(face_named(faces, "wall"), Vec3(0.001, 0, 0), Vec3(0.004, 0.004, 0.05));
    EXPECT_NEAR(d.distance, 0.04 - 0.005, 1e-15);
    EXPECT_NEAR(d.normal.x(), -0.6, 1e-12);
    EXPECT_NEAR(d.normal.y(), -0.8, 1e-12);
}

// A ball that is pressed sideways against the wall leans on it with its weight, wherever around the axis it
// is.
TEST(Cylinder, HoldsABallByItsWeightOverStiffness) {
    PairPlan pair = walton_braun_pair(0.7, 0);
    pair.unloading_stiffness = pair.loading_stiffness;
    pair.normal_damping = 0.2 * 2 * std::sqrt(kStiffness / sphere_mass());
    HandMadeBed w = make_world(pair, 1e-6, NormalForce::spring_dashpot, TangentialLaw::none);
    Face wall;
    wall.kind = Face::Kind::cylinder;
    wall.point = Vec3(0.001, -0.002, 0);
    wall.radius = 0.01;
    w.around.faces = {wall};
    const Vec3 outwards = Vec3(3, -4, 0) / 5;
    w.around.gravity = 9.81 * outwards;
    w.grains.add(0, 0, wall.point + (wall.radius - 1.05 * kRadius) * outwards, kRadius, kDensity);
    w.start();
    w.run(300000);
    const double sink = sphere_mass() * 9.81 / kStiffness;
    const Vec3 rest = wall.point + (wall.radius - kRadius + sink) * outwards;
    // Along the wall gravity holds the ball softly: it moves by R for each radian that the normal is off.
    EXPECT_LT((w.position(0) - rest).norm(), of_rounding(1e-4 * sink, 1e-7 * wall.radius));
}

// A ball that rolls without slip on a plate shaken sideways follows it by 2/7: m a = T, I w' = -T r and a - r
// w' = a_plate give a = 2/7 a_plate. Only the plate's velocity acts on the ball.
TEST(Drive, DragsARollingBallByTwoSeventhsOfItsMotion) {
    Drive drive;
    drive.present = true;
    drive.frequency = 20;
    drive.amplitude = 0.0005;
    drive.direction = Vec3(1, 0, 0);
    HandMadeBed w = make_world(walton_braun_pair(0.9, 0.8), 1 / (drive.frequency * 20000));
    w.plan.clock.steps_per_period = 20000;
    w.around.faces = {floor_face()};
    w.around.faces[0].body.driven = true;
    w.around.motion = DriveMotion(drive, w.plan.clock);
    w.around.gravity = {0, 0, -9.81};
    const double sink = sphere_mass() * 9.81 / kStiffness;
    w.grains.add(0, 0, Vec3(0, 0, kRadius - sink), kRadius, kDensity);
    w.start();
    for (int quarter = 1; quarter <= 20; ++quarter) {
        w.run(5000);
        const double plate = w.around.motion.at(w.step).offset.x();
        EXPECT_NEAR(w.position(0).x(), 2.0 / 7 * plate, 0.01 * drive.amplitude) << quarter;
    }
}

TEST(Drive, FollowsItsSineAndItsVelocityIsItsDerivative) {
    Drive drive;
    drive.present = true;
    drive.frequency = 20;
    drive.amplitude = 0.002;
    drive.phase = 0.1;
    Clock clock;
    clock.steps_per_period = 8000;
    clock.step = 1 / (drive.frequency * 8000);
    clock.initial_phase = drive.phase;
    for (const double ramp : {3.0, 0.0}) {
        drive.ramp = ramp;
        const DriveMotion motion(drive, clock);
        EXPECT_EQ(motion.at(0).offset.z(), 0);
        EXPECT_EQ(motion.at(-5).velocity.z(), 0);
        const double speed = drive.speed();
        for (std::int64_t n = 10; n < 40000; n += 777) {
            const double slope =
                (motion.at(n + 1).offset.z() - motion.at(n - 1).offset.z()) / (2 * clock.step);
            EXPECT_NEAR(motion.at(n).velocity.z(), slope, 1e-6 * speed) << n;
        }
        const std::int64_t late = 5 * 8000 + 1000;
        const double phase = 2 * std::numbers::pi * (1000.0 / 8000 + drive.phase);
        const double start = ramp > 0 ? 0 : std::sin(2 * std::numbers::pi * drive.phase);
        EXPECT_NEAR(motion.at(late).offset.z(), drive.amplitude * (std::sin(phase) - start), 1e-15);
        // The phase is computed from a count and not by adding up: after a billion periods it is the same to
        // the bit.
        EXPECT_EQ(motion.at(late).offset.z(), motion.at(late + 8000 * std::int64_t{1000000000}).offset.z());
    }
    // The ramp is twice differentiable: no kick at its start.
    drive.ramp = 3;
    const double u = 80.0 / 8000 / drive.ramp;
    const double bound = (30 * u * u / (2 * std::numbers::pi * drive.ramp) + 10 * u * u * u) * drive.speed();
    EXPECT_LT(std::abs(DriveMotion(drive, clock).at(80).velocity.z()), bound);
}

// Places follow the formula of the drive for bodies that follow it, and v t for a plane's own velocity.
TEST(Bodies, AreWhereTheirFacesAre) {
    ScenePlane still, sliding, shaken;
    sliding.velocity = Vec3(0, 0.3, -0.1);
    shaken.moves = true;
    const std::vector<ScenePlane> planes{still, sliding, shaken};
    const DrivePose stroke{Vec3(0, 0, 0.002), Vec3(0, 0, -0.7), 0.25};
    for (const auto moves : {Drive::Moves::container, Drive::Moves::floor}) {
        Drive drive;
        drive.present = true;
        drive.moves = moves;
        const std::vector<Body> bodies = bodies_of(drive, planes);
        const std::vector<BodyPose> poses = poses_of(bodies, stroke);
        ASSERT_EQ(poses.size(), kFirstPlaneBody + 3u);
        for (std::size_t b = 0; b < bodies.size(); ++b)
            EXPECT_EQ(bodies[b].number, static_cast<std::int32_t>(b));
        const Vec3 none(0, 0, 0);
        const bool all = moves == Drive::Moves::container;
        EXPECT_EQ(poses[kContainerBody].place, all ? stroke.offset : none);
        EXPECT_EQ(poses[kContainerBody].velocity, all ? stroke.velocity : none);
        EXPECT_EQ(poses[kFloorBody].place, stroke.offset);
        EXPECT_EQ(poses[kFirstPlaneBody].place, none);
        EXPECT_EQ(poses[kFirstPlaneBody + 1].place, Vec3(0, 0.075, -0.025));
        EXPECT_EQ(poses[kFirstPlaneBody + 1].velocity, sliding.velocity);
        EXPECT_EQ(poses[kFirstPlaneBody + 2].place, stroke.offset);
        std::vector<Face> faces = container_faces(wedge(), drive);
        for (const Face& plane : free_faces(planes)) faces.push_back(plane);
        for (const Face& face : faces) {
            const BodyPose& body = poses[static_cast<std::size_t>(face.body.number)];
            EXPECT_EQ(face.displacement(stroke), body.place) << face.name;
            EXPECT_EQ(face.velocity_at(stroke), body.velocity) << face.name;
        }
        // A file of an earlier version has only the poses of container and floor.
        std::vector<BodyPose> earlier(poses.begin(), poses.begin() + kFirstPlaneBody);
        add_planes(planes, stroke.time, earlier);
        EXPECT_EQ(earlier, poses);
        add_planes(planes, stroke.time, earlier);
        EXPECT_EQ(earlier, poses) << "nothing is added twice";
    }
    std::vector<BodyPose> before(kFirstPlaneBody);
    add_planes(planes, -0.1, before);
    for (const BodyPose& pose : before)
        EXPECT_EQ(pose.place, Vec3(0, 0, 0)) << "nothing has gone anywhere yet";
}

TEST(Drive, MovesOnlyTheFloorWhenAsked) {
    Drive drive;
    drive.present = true;
    drive.moves = Drive::Moves::floor;
    for (const Face& f : container_faces(wedge(), drive))
        EXPECT_EQ(f.body.driven, f.name == "floor") << f.name;
}

}  // namespace
}  // namespace grainreel
