// Tests that what a user means as one wall is one contact, however it is put together, and that nothing is
// felt through a wall. The closed forms are those of one plane.
#include <gtest/gtest.h>

#include <functional>
#include <utility>
#include <vector>

#include "engine/plan/damping.hpp"
#include "tests/physics/step/mesh_world.hpp"

namespace grainreel {
namespace {

constexpr double kRestitution = 0.6, kGravity = 9.81;  // m/s2

PairPlan springy_pair(double friction = 0) {
    PairPlan pair = walton_braun_pair(1, friction);
    pair.restitution = kRestitution;
    pair.normal_damping = 2 * std::sqrt(kStiffness / sphere_mass()) * linear_damping(kRestitution, true);
    pair.attraction = true;
    return pair;
}

HandMadeBed springy_world(double friction = 0) {
    HandMadeBed w = make_world(springy_pair(friction), 2e-7, NormalForce::spring_dashpot,
                               friction > 0 ? TangentialLaw::linear_spring : TangentialLaw::none);
    if (friction > 0) w.plan.wall[0].tangential_damping = w.plan.grain[0].tangential_damping = 0;
    return w;
}

// A rectangle at the height z, facing up.
TriangleMesh rectangle(double x0, double x1, double y0, double y1, double z = 0, int n = 1) {
    TriangleMesh mesh;
    add_sheet(
        n, n, [&](double u, double v) { return Vec3(x0 + u * (x1 - x0), y0 + v * (y1 - y0), z); }, mesh);
    return mesh;
}

// Both in one file; vertices that coincide are joined, others are not.
TriangleMesh both(TriangleMesh one, const TriangleMesh& other) {
    const auto first = static_cast<std::int32_t>(one.vertices.size());
    one.vertices.insert(one.vertices.end(), other.vertices.begin(), other.vertices.end());
    for (const TriangleMesh::Triangle& t : other.triangles)
        one.triangles.push_back({t[0] + first, t[1] + first, t[2] + first});
    return one;
}

// A wall of many pieces, all of which lie in z = 0 as seen from above.
struct Ground {
    std::string name;
    std::function<void(HandMadeBed&)> add;
};

constexpr double kWide = 0.05;  // m

std::vector<Ground> grounds() {
    const auto left = [](double z = 0) { return rectangle(-kWide, 0, -kWide, kWide, z); };
    const auto right = [](double z = 0, int n = 1) { return rectangle(0, kWide, -kWide, kWide, z, n); };
    const auto whole = [](double z = 0) { return rectangle(-kWide, kWide, -kWide, kWide, z); };
    TriangleMesh rib;  // stands under a sheet
    add_sheet(
        1, 1, [](double u, double v) { return Vec3(0.0005, (v - 0.5) * kWide, -1e-6 - 0.01 * u); }, rib);
    return {
        {"flush meshes", [=](HandMadeBed& w) { add_mesh(w, "a", left()), add_mesh(w, "b", right()); }},
        {"seam without common vertices",
         [=](HandMadeBed& w) { add_mesh(w, "a", both(left(), right(0, 7))); }},
        {"narrow gap",
         [=](HandMadeBed& w) {
             add_mesh(w, "a",
                      both(rectangle(-kWide, -1e-5, -kWide, kWide), rectangle(1e-5, kWide, -kWide, kWide)));
         }},
        {"gap between meshes",
         [=](HandMadeBed& w) {
             add_mesh(w, "a", rectangle(-kWide, -1e-5, -kWide, kWide));
             add_mesh(w, "b", rectangle(1e-5, kWide, -kWide, kWide));
         }},
        {"strip in a floor",
         [=](HandMadeBed& w) {
             w.around.faces = {floor_face()};
             add_mesh(w, "strip", rectangle(-0.001, 0.003, -kWide, kWide));
         }},
        {"floor that a mesh ends",
         [=](HandMadeBed& w) {
             w.around.faces = {floor_face()};
             add_mesh(w, "half", right());
         }},
        {"mesh on mesh", [=](HandMadeBed& w) { add_mesh(w, "a", whole()), add_mesh(w, "b", whole()); }},
        {"mesh under mesh",
         [=](HandMadeBed& w) { add_mesh(w, "a", whole()), add_mesh(w, "b", whole(-3e-6)); }},
        {"mesh over a floor",
         [=](HandMadeBed& w) {
             Face low = floor_face();
             low.point.z() = -3e-6;
             w.around.faces = {low};
             add_mesh(w, "a", whole());
         }},
        {"floor over a mesh",
         [=](HandMadeBed& w) {
             w.around.faces = {floor_face()};
             add_mesh(w, "a", whole(-3e-6));
         }},
        {"thin closed plate",
         [=](HandMadeBed& w) {
             add_mesh(w, "a", box_mesh(Vec3(-kWide, -kWide, -3e-6), Vec3(kWide, kWide, 0), 1));
         }},
        {"two plates on each other",
         [=](HandMadeBed& w) {
             add_mesh(w, "a", box_mesh(Vec3(-kWide, -kWide, -3e-6), Vec3(kWide, kWide, 0), 2));
             add_mesh(w, "b", box_mesh(Vec3(-kWide, -kWide, -6e-6), Vec3(kWide, kWide, -3e-6), 1));
         }},
        {"rib under a sheet", [=](HandMadeBed& w) { add_mesh(w, "a", both(whole(), rib)); }},
        {"rib of another mesh", [=](HandMadeBed& w) { add_mesh(w, "a", whole()), add_mesh(w, "b", rib); }},
    };
}

// The speed after a fall onto the ground, as a share of that before.
double rebound(const Ground& ground, double x, double speed) {
    HandMadeBed w = springy_world();
    ground.add(w);
    w.grains.add(0, 0, Vec3(x, 0.0013, kRadius + 1e-6), kRadius, kDensity);
    w.grains.motion[0].velocity = Vec3(0, 0, -speed);
    w.start();
    w.run(1500);
    EXPECT_GT(w.position(0).z(), kRadius) << ground.name;
    EXPECT_LT(w.velocity(0).head<2>().norm(), 1e-3 * speed) << ground.name << " " << x;
    return w.velocity(0).z() / speed;
}

// At 4 m/s the ball sinks in by 6 % of its radius.
TEST(Screens, ABallReturnsFromPiecesAsFromOnePlane) {
    for (const Ground& ground : grounds())
        for (const double x : {-0.004, -1e-5, 0.0, 1e-5, 1e-4, 0.0004})
            for (const double speed : {0.5, 4.0})
                EXPECT_NEAR(rebound(ground, x, speed), kRestitution, 1e-3)
                    << ground.name << " " << x << " " << speed;
}

int contacts_of(HandMadeBed& w, std::int32_t id) {
    int seen = 0;
    w.loop->visit_contacts(w.step, [&](const ContactView& c) {
        seen += w.grains.id[static_cast<std::size_t>(c.first)] == id ||
                (c.second >= 0 && w.grains.id[static_cast<std::size_t>(c.second)] == id);
    });
    return seen;
}

// A ball that slides and then rolls goes on over the seams with its friction.
TEST(Screens, ABallRollsOverPiecesAsOverOnePlane) {
    const auto end_of = [](const Ground& ground) {
        HandMadeBed w = make_world(walton_braun_pair(0.9, 0.4), 2e-6);
        ground.add(w);
        w.around.gravity = {0, 0, -kGravity};
        const double sink = sphere_mass() * kGravity / kStiffness;
        w.grains.add(0, 0, Vec3(-0.008, 0.0013, kRadius - sink), kRadius, kDensity);
        w.grains.motion[0].velocity = {0.3, 0.02, 0};
        w.start();
        for (int k = 0; k < 30; ++k) {
            w.run(1000);
            EXPECT_EQ(contacts_of(w, 0), 1) << ground.name << " at " << w.position(0).x();
        }
        return std::pair(Vec3(w.velocity(0)), Vec3(w.spin(0)));
    };
    const auto plane = end_of({"plane", [](HandMadeBed& w) { w.around.faces = {floor_face()}; }});
    EXPECT_LT(plane.first.x(), 0.25);
    for (const Ground& ground : grounds()) {
        if (ground.name.find("gap") != std::string::npos) continue;  // it sinks in by a hair
        const auto pieces = end_of(ground);
        EXPECT_LT((pieces.first - plane.first).norm(), 1e-4 * plane.first.norm()) << ground.name;
        EXPECT_LT((pieces.second - plane.second).norm(), 1e-4 * plane.second.norm()) << ground.name;
    }
}

// A ball on a slope is held by friction alone. If it lost its history on the seam, it would slip there.
TEST(Screens, AHistoryGoesOnOnAFlushWall) {
    for (const Ground& ground : grounds()) {
        if (ground.name.find("gap") != std::string::npos) continue;
        HandMadeBed w = make_world(walton_braun_pair(0.9, 0.4), 2e-6);
        ground.add(w);
        const double sink = sphere_mass() * kGravity / kStiffness;
        w.grains.add(0, 0, Vec3(-1e-4, 0.0013, kRadius - sink), kRadius, kDensity);
        w.around.gravity = {0, 0, -kGravity};
        w.grains.motion[0].velocity = {0.1, 0, 0};
        w.grains.motion[0].spin = {0, 0.1 / (kRadius - sink), 0};  // it rolls
        w.start();
        w.run(1000);
        EXPECT_GT(w.position(0).x(), 9e-5) << ground.name;
        EXPECT_NEAR(w.velocity(0).x(), 0.1, 1e-6) << ground.name;
        EXPECT_NEAR(w.grains.load[0].force.z(), sphere_mass() * kGravity, 1e-3 * sphere_mass() * kGravity)
            << ground.name;
    }
}

TEST(Screens, BallsOnBothSidesOfASheetDoNotFeelEachOther) {
    for (const double aside : {0.0, 0.0008}) {
        for (const double thick : {0.0, 3e-6}) {
            HandMadeBed w = springy_world(0.3);
            add_mesh(w, "sheet",
                     thick > 0 ? box_mesh(Vec3(-kWide, -kWide, -thick), Vec3(kWide, kWide, 0), 1)
                               : rectangle(-kWide, kWide, -kWide, kWide));
            w.grains.add(0, 0, Vec3(0.001, 0.002, kRadius + 1e-6), kRadius, kDensity);
            w.grains.add(1, 0, Vec3(0.001 + aside, 0.002, -thick - kRadius - 1e-6), kRadius, kDensity);
            w.grains.motion[0].velocity = Vec3(0, 0, -1);
            w.grains.motion[1].velocity = Vec3(0, 0, 1);
            w.start();
            w.run(150);
            EXPECT_EQ(contacts_of(w, 0), 1);
            EXPECT_EQ(contacts_of(w, 1), 1);
            w.run(1350);
            EXPECT_NEAR(w.velocity(0).z(), kRestitution, 1e-3) << aside << " " << thick;
            EXPECT_NEAR(w.velocity(1).z(), -kRestitution, 1e-3) << aside << " " << thick;
        }
    }
}

// Beside the sheet's rim the way is free.
TEST(Screens, BallsBesideARimTouchEachOther) {
    HandMadeBed w = springy_world();
    add_mesh(w, "sheet", rectangle(0, kWide, -kWide, kWide));
    const double high = kRadius - 2e-6;
    w.grains.add(0, 0, Vec3(-0.0001, 0, high), kRadius, kDensity);
    w.grains.add(1, 0, Vec3(-0.0001, 0, -high), kRadius, kDensity);
    w.start();
    EXPECT_EQ(contacts_of(w, 0), 1);  // the other ball; the rim is out of reach
    for (const std::int32_t id : {0, 1}) w.grains.place[w.index_of(id)].position.x() = 0.0001;
    w.loop->restart();
    EXPECT_EQ(contacts_of(w, 0), 1);  // the sheet
    EXPECT_EQ(contacts_of(w, 1), 1);
}

TEST(Screens, RealContactsOfTwoMeshesStay) {
    const double in = kRadius - 1e-5;
    {
        HandMadeBed w = springy_world();  // the corner of a floor and a wall
        add_mesh(w, "floor", rectangle(-kWide, kWide, -kWide, kWide));
        TriangleMesh wall = rectangle(-kWide, kWide, -kWide, kWide);
        for (Vec3& v : wall.vertices) v = Vec3(0, v.y(), v.x());
        add_mesh(w, "wall", wall);
        w.grains.add(0, 0, Vec3(in, 0, in), kRadius, kDensity);
        w.grains.add(1, 0, Vec3(in, 0.01, -in), kRadius, kDensity);
        w.start();
        EXPECT_EQ(contacts_of(w, 0), 2);
        EXPECT_EQ(contacts_of(w, 1), 2);
    }
    {
        HandMadeBed w = springy_world();  // between two plates, and between a plate and a face
        add_mesh(w, "low", rectangle(-kWide, 0, -kWide, kWide));
        add_mesh(w, "high", rectangle(-kWide, kWide, -kWide, kWide, 2 * in));
        Face floor = floor_face();
        floor.point.z() = -1e-6;
        w.around.faces = {floor};
        w.grains.add(0, 0, Vec3(-0.01, 0, in), kRadius, kDensity);
        w.grains.add(1, 0, Vec3(0.01, 0, in), kRadius, kDensity);
        w.start();
        EXPECT_EQ(contacts_of(w, 0), 2);
        EXPECT_EQ(contacts_of(w, 1), 2);
    }
    for (const double turn :
         {15.0, 12.0, 9.0}) {  // two sheets that meet in a groove: one wall below 10.5 degrees
        HandMadeBed w = springy_world();
        const double tilt = turn * std::numbers::pi / 360;
        TriangleMesh left, right;
        add_sheet(
            1, 1,
            [&](double u, double v) {
                return Vec3(0.1 * (v - 0.5), -u * 0.1 * std::cos(tilt), u * 0.1 * std::sin(tilt));
            },
            left);
        add_sheet(
            1, 1,
            [&](double u, double v) {
                return Vec3(0.1 * (v - 0.5), u * 0.1 * std::cos(tilt), u * 0.1 * std::sin(tilt));
            },
            right);
        add_mesh(w, "left", left), add_mesh(w, "right", right);
        w.grains.add(0, 0, Vec3(0, 0, in / std::cos(tilt)), kRadius, kDensity);
        w.start();
        EXPECT_EQ(contacts_of(w, 0), turn > 10.5 ? 2 : 1) << turn;
    }
}

// On a seam of two materials the nearer wall counts.
TEST(Screens, TheNearerOfTwoMaterialsCounts) {
    HandMadeBed w = springy_world(0.3);
    add_mesh(w, "a", rectangle(-kWide, 0, -kWide, kWide));
    add_mesh(w, "b", rectangle(0, kWide, -kWide, kWide));
    w.plan.mesh[1].friction = 0.1;
    w.grains.add(0, 0, Vec3(-1e-5, 0, kRadius - 1e-5), kRadius, kDensity);
    w.grains.add(1, 0, Vec3(1e-5, 0.01, kRadius - 1e-5), kRadius, kDensity);
    w.start();
    std::vector<std::pair<std::int32_t, std::int32_t>> seen;
    w.loop->visit_contacts(0, [&](const ContactView& c) {
        seen.emplace_back(w.grains.id[static_cast<std::size_t>(c.first)], c.second);
    });
    std::sort(seen.begin(), seen.end());
    const std::vector<std::pair<std::int32_t, std::int32_t>> wanted{{0, -1}, {1, -2}};
    EXPECT_EQ(seen, wanted);
}

// A bed on both sides of a sheet of several pieces has the same bits on any number of threads.
TEST(Screens, DoNotDependOnThreads) {
    const auto end_of = [](int threads) {
        HandMadeBed w = make_world(walton_braun_pair(0.8, 0.4), 2e-6);
        w.team = std::make_unique<Team>(threads);
        w.around.faces = {floor_face()};
        add_mesh(w, "strip", rectangle(-0.005, 0.003, -0.02, 0.02));
        add_mesh(w, "left", rectangle(-0.03, 0, -0.03, 0.03, 0.0075, 3));
        add_mesh(w, "right", rectangle(0, 0.03, -0.03, 0.03, 0.0075, 1));
        w.around.gravity = {0, 0, -kGravity};
        for (int i = 0; i < 80; ++i) {
            const int layer = i / 40;
            w.grains.add(i, 0,
                         Vec3(-0.0105 + 0.0043 * (i % 5) + 0.0001 * (i % 7), -0.016 + 0.0043 * (i / 5 % 8),
                              layer ? 0.0075 + kRadius + 1e-5 * (i % 3) : kRadius + 1e-5 * (i % 4)),
                         kRadius, kDensity);
            w.grains.motion.back().velocity = Vec3(0.1 * (i % 3 - 1), 0.1 * (i % 5 - 2), layer ? -0.2 : 1.5);
        }
        w.start();
        w.run(5000);
        std::vector<double> numbers;
        for (int i = 0; i < 80; ++i)
            for (int a = 0; a < 3; ++a)
                numbers.insert(numbers.end(), {w.position(i)[a], w.velocity(i)[a], w.spin(i)[a]});
        return numbers;
    };
    const std::vector<double> one = end_of(1);
    EXPECT_EQ(end_of(2), one);
    EXPECT_EQ(end_of(3), one);
}

}  // namespace
}  // namespace grainreel
