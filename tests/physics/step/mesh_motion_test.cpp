// Tests of meshes and faces that turn: what they do to a ball, and the same bits on any number of threads and
// through a checkpoint.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include <random>
#include <sstream>

#include "engine/base/binary.hpp"
#include "tests/physics/step/mesh_world.hpp"

namespace grainreel {
namespace {

constexpr double kGravity = 9.81;  // m/s2

Face turning_floor(const BodyTurn& turn) {
    Face face = floor_face();
    face.body.turn = turn;
    face.reach = 0.1;
    return face;
}

// A ball that rolls without slip on a turning plate goes round in circles at 2/7 of the plate's rate: m a =
// T, I w' = -r z x T and no slip give v' = 2/7 W x v (Weltner 1979, Am. J. Phys. 47, 984).
class TurningPlate : public testing::TestWithParam<bool> {};

TEST_P(TurningPlate, LeadsARollingBallRoundATwoSeventhsOfItsRate) {
    const double rate = 8;  // rad/s
    const Vec3 through(0.003, -0.002, 0);
    HandMadeBed w = make_world(walton_braun_pair(0.9, 0.8), 2e-6);
    const BodyTurn turn = turn_about(Vec3(0, 0, 1), rate, through);
    if (GetParam())
        add_mesh(w, "plate", square_mesh(0.2, 13)).body.turn = turn;
    else
        w.around.faces = {turning_floor(turn)}, start_clock(w);
    w.around.gravity = {0, 0, -kGravity};
    const double sink = sphere_mass() * kGravity / kStiffness;
    const Vec3 at(0.02, 0.01, kRadius - sink), velocity(0.05, 0.02, 0);
    w.grains.add(0, 0, at, kRadius, kDensity);
    w.grains.motion[0].velocity = velocity;
    // Velocity of the ball's lowest point: v + w x (-d z) is the plate's velocity.
    const Vec3 slip = rate * Vec3(0, 0, 1).cross(at - through) - velocity;
    w.grains.motion[0].spin = Vec3(-slip.y(), slip.x(), 0) / at.z() * -1;
    w.start();
    for (int k = 1; k <= 10; ++k) {
        w.run(25000);
        const double angle = 2.0 / 7 * rate * 25000 * k * w.plan.clock.step;
        const Vec3 expected = Eigen::AngleAxisd(angle, Vec3::UnitZ()) * velocity;
        EXPECT_LT((w.velocity(0) - expected).norm(), 2e-3 * velocity.norm()) << k;
        EXPECT_NEAR(w.position(0).z(), at.z(), 1e-7);
    }
}

INSTANTIATE_TEST_SUITE_P(, TurningPlate, testing::Values(true, false),
                         [](const auto& of) { return std::string(of.param ? "OfTriangles" : "OfAFace"); });

// A ball in a drum that gravity presses to the wall, across the drum's axis.
struct InDrum {
    Vec3 position, velocity, spin;
    double work;    // J, of the drum
    double moment;  // N m, mean, about its axis
};
InDrum in_drum(int facets, std::int64_t steps, double friction = 0.5, double rolling = 0) {
    PairPlan pair = walton_braun_pair(0.6, friction);
    pair.rolling_friction = rolling;
    pair.model.rolls = rolling > 0;
    HandMadeBed w = make_world(pair, 2e-6);
    const double radius = 0.02;
    const BodyTurn turn = turn_about(Vec3(0, 0, 1), 5);
    if (facets > 0) {
        add_mesh(w, "drum", tube_mesh(radius, 0.02, facets, 3)).body.turn = turn;
    } else {
        Face wall;
        wall.kind = Face::Kind::cylinder;
        wall.name = "drum";
        wall.radius = radius;
        wall.body.turn = turn;
        w.around.faces = {wall};
        start_clock(w);
    }
    w.around.gravity = {0, -kGravity, 0};
    w.grains.add(0, 0, Vec3(0, -radius + kRadius, 0.0011), kRadius, kDensity);
    w.start();
    WallScale scale;
    scale.force = 0x1p-50;
    scale.length = 0x1p-10;
    w.loop->tally_walls(scale, 0);
    w.run(steps);
    const WallSums sums = w.loop->wall_sums();
    const double moment = static_cast<double>(sums.faces[0].moment[2]) * scale.force * scale.length;
    return {w.position(0), w.velocity(0), w.spin(0), w.grains.wall_work[0],
            moment / static_cast<double>(steps)};
}

// At first it slips, and the wall drags it with mu m g. In the end it rolls at the bottom, or swings about
// it.
TEST(TurningDrum, SpinsABallUp) {
    for (const int facets : {0, 360}) {
        const InDrum end = in_drum(facets, 500000);
        // Without slip the ball's surface moves with the wall.
        const Vec3 k = Vec3(end.position.x(), end.position.y(), 0).normalized();
        const Vec3 wall = 5 * Vec3(0, 0, 1).cross(0.02 * k);
        const Vec3 slip = end.velocity + end.spin.cross(kRadius * k) - wall;
        EXPECT_LT(slip.norm(), 0.01 * wall.norm()) << facets;
    }
}

TEST(TurningDrum, Of360FacetsTakesTheTorqueOfTheRoundOne) {
    // One facet passes below the ball, so its slope adds nothing to the mean. The ball slips during this
    // time.
    const std::int64_t steps = std::llround(2 * std::numbers::pi / 360 / 5 / 2e-6);
    const double time = 2e-6 * static_cast<double>(steps);
    const InDrum round = in_drum(0, steps), facets = in_drum(360, steps);
    EXPECT_NEAR(round.moment, -0.5 * sphere_mass() * kGravity * 0.02, 0.05 * std::abs(round.moment));
    EXPECT_NEAR(facets.moment, round.moment, 0.01 * std::abs(round.moment));
    // The drum's work is its moment times its angle.
    EXPECT_NEAR(facets.work, -5 * facets.moment * time, 1e-3 * std::abs(facets.work));
    EXPECT_NEAR(round.work, -5 * round.moment * time, 1e-3 * std::abs(round.work));
    EXPECT_NEAR(facets.work, round.work, 0.01 * round.work);
}

TEST(TurningDrum, WithoutFrictionNeedsNoPower) {
    const InDrum round = in_drum(0, 20000, 0), facets = in_drum(360, 20000, 0);
    const double of_friction = std::abs(in_drum(0, 20000).moment);
    EXPECT_LT(std::abs(round.moment), 1e-9 * of_friction);
    EXPECT_LT(std::abs(facets.moment), 0.02 * of_friction);  // a polygon has higher and lower places
}

TEST(TurningDrum, DoesTheWorkOfRollingResistanceToo) {
    const InDrum round = in_drum(0, 20000, 0.5, 0.3), facets = in_drum(360, 20000, 0.5, 0.3);
    EXPECT_NEAR(facets.work, -5 * facets.moment * 20000 * 2e-6, 1e-3 * std::abs(facets.work));
    EXPECT_NEAR(facets.work, round.work, 0.01 * round.work);
}

// The angular momentum L of a ball about the origin, a point of the floor, changes by the torque of its
// weight and by the opposite of the moment on the floor: dL/dt = x cross m g - M. The ball rolls and is
// slowed down by its resistance to rolling alone.
class FloorAtRest : public testing::TestWithParam<bool> {};

TEST_P(FloorAtRest, TakesTheTorqueOfRollingResistance) {
    PairPlan pair = walton_braun_pair(0.6, 0.5);
    pair.rolling_friction = 0.2;
    pair.model.rolls = true;
    HandMadeBed w = make_world(pair, 2e-6);
    if (GetParam())
        add_mesh(w, "floor", square_mesh(0.2, 13));
    else
        w.around.faces = {floor_face()}, start_clock(w);
    w.around.gravity = {0, 0, -kGravity};
    w.grains.add(0, 0, Vec3(0.001, 0.002, kRadius - sphere_mass() * kGravity / kStiffness), kRadius,
                 kDensity);
    w.grains.motion[0].velocity = Vec3(0.1, 0.05, 0);
    w.grains.motion[0].spin = Vec3(-0.05, 0.1, 0) / kRadius;
    w.start();
    const auto angular_momentum = [&] {
        return Vec3(sphere_mass() *
                    (w.position(0).cross(w.velocity(0)) + 0.4 * kRadius * kRadius * w.spin(0)));
    };
    WallScale scale;
    scale.force = 0x1p-50;
    scale.length = 0x1p-10;
    w.loop->tally_walls(scale, 0);
    const Vec3 before = angular_momentum(), weight(0, 0, -sphere_mass() * kGravity);
    const int steps = 20000;
    Vec3 of_weight(0, 0, 0);
    for (int k = 0; k < steps; ++k) {
        const Vec3 from = w.position(0);
        w.run(1);
        of_weight += w.plan.clock.step * (0.5 * (from + w.position(0))).cross(weight);
    }
    const WallSums sums = w.loop->wall_sums();
    Vec3 moment;
    for (int a = 0; a < 3; ++a)
        moment[a] = static_cast<double>(sums.faces[0].moment[static_cast<std::size_t>(a)]) * scale.force *
                    scale.length * w.plan.clock.step;
    const Vec3 expected = of_weight - (angular_momentum() - before);
    const double couple = 0.2 * kRadius * sphere_mass() * kGravity * steps * w.plan.clock.step;
    EXPECT_LT((moment - expected).norm(), 0.01 * couple);
    EXPECT_LT(w.velocity(0).norm(), 0.9 * Vec3(0.1, 0.05, 0).norm()) << "nothing resists";
}

INSTANTIATE_TEST_SUITE_P(, FloorAtRest, testing::Values(true, false),
                         [](const auto& of) { return std::string(of.param ? "OfTriangles" : "OfAFace"); });

// Ball and wall turn as one body about an axis far away: nothing slips, and the stored force stays.
TEST(TurningMesh, CarriesABallThatTurnsWithIt) {
    const double rate = 30;
    for (const bool triangles : {true, false}) {
        HandMadeBed w = make_world(walton_braun_pair(1, 0.8), 1e-6);
        const BodyTurn turn = turn_about(Vec3(1, 2, 2) / 3, rate, Vec3(0.02, 0.01, 0.01));
        if (triangles)
            add_mesh(w, "plate", square_mesh(0.03, 5)).body.turn = turn;
        else
            w.around.faces = {turning_floor(turn)}, start_clock(w);
        const Vec3 at(0.0013, 0.0007, kRadius - 1e-6);
        w.grains.add(0, 0, at, kRadius, 1e9);  // so heavy that forces do not matter
        w.grains.motion[0].spin = rate * turn.axis;
        w.grains.motion[0].velocity = rate * turn.axis.cross(at - turn.through);
        w.start();
        // The centre would fly straight on, so it is sent in each step to where the turn takes it.
        const auto place = [&](int k) {
            return Vec3(turn.through + Eigen::AngleAxisd(rate * k * 1e-6, turn.axis) * (at - turn.through));
        };
        double largest = 0;
        for (int k = 0; k < 2000; ++k) {
            w.grains.place[0].position = place(k);
            w.grains.motion[0].velocity = (place(k + 1) - place(k)) / 1e-6;
            w.run(1);
            w.loop->visit_contacts(w.step, [&](const ContactView& c) {
                largest = std::max(largest, c.tangential.norm() / c.normal_force);
            });
        }
        // None of the 1.3 mm of arc is felt as slip.
        EXPECT_LT(largest, of_rounding(1e-4, 1e-2)) << triangles;
    }
}

// A box of 20 mm by 40 mm by 40 mm that turns, of planes or of triangles, with one ball in it.
HandMadeBed in_turning_box(bool triangles, const BodyTurn& turn, const PairPlan& pair) {
    HandMadeBed w = make_world(pair, 1e-6);
    Container box;
    box.shape = Container::Shape::box;
    box.half_width = box.depth = 0.02;
    box.height = 0.04;
    if (triangles) {
        add_mesh(w, "box", box_mesh(Vec3(-0.01, -0.02, 0), Vec3(0.01, 0.02, 0.04), 7)).body.turn = turn;
        return w;
    }
    w.around.faces = container_faces(box, Drive{});
    for (Face& face : w.around.faces) {
        face.body.turn = turn;
        face.reach = 0.1;
    }
    start_clock(w);
    return w;
}

// Balls lie beside a side, an edge or a corner, at any velocity and spin, in a box that turns about any axis.
TEST(TurningBox, OfTrianglesPushesAsThatOfPlanes) {
    std::mt19937_64 random(5);
    std::uniform_real_distribution<double> one(-1, 1);
    const double in = kRadius - 1e-5, scale = kStiffness * 1e-5;
    int touched = 0;
    for (int state = 0; state < 300; ++state) {
        Vec3 at(0.006 * one(random), 0.016 * one(random), 0.02 + 0.016 * one(random));
        const int walls = 1 + state % 3;
        if (walls > 0) at.x() = 0.01 - in;
        if (walls > 1) at.y() = in - 0.02;
        if (walls > 2) at.z() = in;
        const Vec3 velocity(one(random), one(random), one(random));
        const Vec3 spin = 100 * Vec3(one(random), one(random), one(random));
        const Vec3 axis = Vec3(one(random), one(random), one(random)).normalized();
        const BodyTurn turn =
            turn_about(axis, 40 * one(random), 0.02 * Vec3(one(random), one(random), one(random)));
        const auto pushed = [&](bool triangles) {
            HandMadeBed w = in_turning_box(triangles, turn, walton_braun_pair(0.9, 0.4));
            w.grains.add(0, 0, at, kRadius, kDensity);
            w.grains.motion[0].velocity = velocity;
            w.grains.motion[0].spin = spin;
            w.start();
            w.run(8);
            return w.grains.load[0];
        };
        const Load planes = pushed(false), mesh = pushed(true);
        touched += planes.force.norm() > 0 && planes.torque.norm() > 0;
        EXPECT_LT((planes.force - mesh.force).norm(), of_rounding(1e-9, 1e-5) * (scale + planes.force.norm()))
            << state;
        EXPECT_LT((planes.torque - mesh.torque).norm(),
                  of_rounding(1e-9, 1e-5) * (scale * kRadius + planes.torque.norm()))
            << state;
    }
    EXPECT_GT(touched, 200);
}

// A side turns into a ball that is too heavy to move. The force is k times the overlap with the turned plane,
// along its turned normal.
TEST(TurningBox, PressesAsTheTurnedPlaneDoes) {
    const BodyTurn turn = turn_about(Vec3(2, -1, 2) / 3, 20, Vec3(-0.004, 0.007, 0.011));
    const Vec3 normal(-1, 0, 0), on_side(0.01, 0, 0), at(0.01 - kRadius + 1e-6, 0.002, 0.03);
    for (const bool triangles : {false, true}) {
        HandMadeBed w = in_turning_box(triangles, turn, walton_braun_pair(0.9, 0));
        w.grains.add(0, 0, at, kRadius, 1e18);
        w.start();
        double last = 0;
        for (int k = 1; k <= 40; ++k) {
            w.run(50);
            const Eigen::Matrix3d turned =
                Eigen::AngleAxisd(turn.rate * w.plan.clock.step * 50 * k, turn.axis).toRotationMatrix();
            const Vec3 n = turned * normal, there = turn.through + turned * (on_side - turn.through);
            const double overlap = kRadius - n.dot(at - there);
            ASSERT_GT(overlap, last);  // it is being loaded all the time
            last = overlap;
            EXPECT_LT((w.grains.load[0].force - kStiffness * overlap * n).norm(),
                      of_rounding(1e-9, 1e-4) * kStiffness * overlap)
                << triangles << " " << k;
        }
    }
}

// A bed in a closed box with a vane that turns and a tube that is shaken.
HandMadeBed bed(int threads) {
    PairPlan pair = walton_braun_pair(0.4, 0.5);
    pair.rolling_friction = 0.1;
    pair.model.rolls = true;
    HandMadeBed w = make_world(pair, 5e-6);
    w.team = std::make_unique<Team>(threads);
    add_mesh(w, "box", box_mesh(Vec3(-0.016, -0.016, 0), Vec3(0.016, 0.016, 0.05), 9));
    TriangleMesh vane;
    add_sheet(
        4, 3, [](double u, double v) { return Vec3(0.026 * (u - 0.5), 0, 0.005 + 0.02 * v); }, vane);
    add_mesh(w, "vane", vane).body.turn = turn_about(Vec3(0, 0, 1), 20);
    TriangleMesh tube = tube_mesh(0.004, 0.01, 24, 2);
    for (Vec3& vertex : tube.vertices) vertex += Vec3(0.011, 0.011, 0.035);
    add_mesh(w, "tube", tube).body.velocity = Vec3(0, 0, -0.05);
    w.around.gravity = {0.5, 0, -60};
    std::mt19937_64 random(5);
    std::uniform_real_distribution<double> some(-1, 1);
    int id = 0;
    for (int z = 0; z < 9; ++z)
        for (int x = 0; x < 6; ++x)
            for (int y = 0; y < 6; ++y) {
                const Vec3 at =
                    0.0045 * Vec3(x - 2.5, y - 2.5, z + 0.8) + 0.0002 * Vec3(some(random), some(random), 0);
                if (std::abs(at.y()) < 0.0025 && at.z() < 0.028) continue;
                if (at.z() > 0.026 && at.x() > 0.003 && at.y() > 0.003) continue;
                w.grains.add(id++, 0, at, kRadius * (1 + 0.05 * some(random)), kDensity);
                w.grains.motion.back().velocity = 0.2 * Vec3(some(random), some(random), some(random));
            }
    w.around.skin = 0.3 * kRadius;
    w.start();
    return w;
}

std::string state_of(const HandMadeBed& w) {
    std::ostringstream out;
    w.loop->save(out);
    for (std::size_t i = 0; i < w.grains.size(); ++i) {
        write_value(out, w.grains.id[i]);
        write_value(out, w.grains.place[i].position);
        write_value(out, w.grains.motion[i].velocity);
        write_value(out, w.grains.motion[i].spin);
        write_value(out, w.grains.load[i].force);
        write_value(out, w.grains.wall_work[i]);
    }
    return out.str();
}

std::string seen_in(const HandMadeBed& w) {
    std::ostringstream out;
    w.loop->visit_contacts(w.step, [&](const ContactView& c) {
        write_value(out, c.first), write_value(out, c.second), write_value(out, c.triangle);
        write_value(out, c.normal_force), write_value(out, c.tangential), write_value(out, c.point);
    });
    return out.str();
}

TEST(MeshSameBits, OnOneTwoAndThreeThreads) {
    std::vector<std::string> states, seen;
    for (const int threads : {1, 2, 3}) {
        HandMadeBed w = bed(threads);
        for (int k = 0; k < 40; ++k) w.run(150);
        states.push_back(state_of(w));
        seen.push_back(seen_in(w));
        int at_meshes[3] = {0, 0, 0};
        w.loop->visit_contacts(w.step, [&](const ContactView& c) {
            if (c.second < 0) ++at_meshes[-1 - c.second];
        });
        EXPECT_GT(at_meshes[0], 20);
        EXPECT_GT(at_meshes[1], 2);
        EXPECT_GT(w.loop->rebuilds(), 2);
    }
    EXPECT_EQ(states[0], states[1]);
    EXPECT_EQ(states[0], states[2]);
    EXPECT_EQ(seen[0], seen[1]);
    EXPECT_EQ(seen[0], seen[2]);
}

// The run is saved during contacts, and read by another number of threads.
TEST(MeshSameBits, ThroughACheckpoint) {
    for (const std::int64_t at : {1500, 2777, 4001}) {
        HandMadeBed whole = bed(1);
        whole.run(at);
        std::ostringstream saved;
        whole.loop->save(saved);
        const std::string before = seen_in(whole);
        for (const int threads : {1, 2, 3}) {
            HandMadeBed w = bed(1);
            w.grains = whole.grains;
            w.step = at;
            w.team = std::make_unique<Team>(threads);
            w.loop = std::make_unique<StepLoop>(w.plan, w.around, w.grains, *w.team);
            const std::string text = saved.str();
            Bytes in(text);
            w.loop->load(in, at);
            ASSERT_FALSE(in.failed());
            EXPECT_EQ(seen_in(w), before);
            w.run(1300);
            HandMadeBed on = bed(1);
            on.run(at), on.run(1300);
            EXPECT_EQ(state_of(w), state_of(on)) << at << " " << threads;
        }
    }
}

// A checkpoint that was tampered with is refused, and nothing is read beyond its end.
TEST(MeshSameBits, AForgedTriangleIsRefused) {
    HandMadeBed w = bed(1);
    w.run(2000);
    std::ostringstream saved;
    w.loop->save(saved);
    const std::string good = saved.str();
    std::mt19937_64 random(6);
    int refused = 0;
    for (int k = 0; k < 200; ++k) {
        std::string text = good;
        const std::size_t at = random() % (text.size() - 8);
        for (std::size_t b = 0; b < 8; ++b) text[at + b] = static_cast<char>(random());
        Bytes in(text);
        HandMadeBed other = bed(1);
        other.grains = w.grains;
        other.loop = std::make_unique<StepLoop>(other.plan, other.around, other.grains, *other.team);
        other.loop->load(in, w.step);
        refused += in.failed();
        if (!in.failed()) (void)seen_in(other);
    }
    EXPECT_GT(refused, 20);
}

// Grains that leave take their contacts with meshes along; the others keep theirs.
TEST(MeshSameBits, WhenGrainsLeaveAndCome) {
    std::vector<std::string> states;
    for (const int threads : {1, 2, 3}) {
        HandMadeBed w = bed(threads);
        w.run(3000);
        w.loop->remove({5, 17, 40, 41, 90}, w.step);
        w.run(1);
        ComingGrain grain;
        grain.radius = kRadius;
        grain.density = kDensity;
        grain.position = {-0.01, -0.01, 0.046};
        w.loop->insert({grain});
        w.step += 0;
        w.run(1500);
        states.push_back(state_of(w));
    }
    EXPECT_EQ(states[0], states[1]);
    EXPECT_EQ(states[0], states[2]);
}

}  // namespace
}  // namespace grainreel
