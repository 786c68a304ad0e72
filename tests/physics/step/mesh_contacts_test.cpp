// Tests of balls on meshes: they move as on planes and cylinders of the same shape.
#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "engine/base/error.hpp"
#include "tests/physics/step/mesh_world.hpp"

namespace grainreel {
namespace {

constexpr double kGravity = 9.81;  // m/s2

PairPlan rubbing_pair() {
    PairPlan pair = walton_braun_pair(0.9, 0.4);
    pair.rolling_friction = 0;
    return pair;
}

// A ball that slides and then rolls.
HandMadeBed ball_on(const std::function<void(HandMadeBed&)>& ground) {
    HandMadeBed w = make_world(rubbing_pair(), 2e-6);
    ground(w);
    w.around.gravity = {0, 0, -kGravity};
    const double sink = sphere_mass() * kGravity / kStiffness;
    w.grains.add(0, 0, Vec3(-0.021, -0.013, kRadius - sink), kRadius, kDensity);
    w.grains.motion[0].velocity = {0.4, 0.23, 0};
    w.start();
    return w;
}

TEST(MeshContacts, ABallRollsOnTrianglesAsOnAPlane) {
    HandMadeBed plane = ball_on([](HandMadeBed& w) { w.around.faces = {floor_face()}; });
    plane.run(60000);
    const Vec3 v = plane.velocity(0);
    ASSERT_GT(v.norm(), 0.2);
    for (const int n : {1, 20, 80}) {
        HandMadeBed mesh = ball_on([&](HandMadeBed& w) { add_mesh(w, "floor", square_mesh(0.1, n)); });
        double highest = 0;
        for (int k = 0; k < 600; ++k) {
            mesh.run(100);
            highest = std::max(highest, std::abs(mesh.position(0).z() - kRadius));
        }
        EXPECT_LT(highest, 2e-6) << n;
        EXPECT_LT((mesh.velocity(0) - v).norm(), 1e-6 * v.norm()) << n;
        EXPECT_LT((mesh.position(0) - plane.position(0)).norm(), of_rounding(1e-9, 1e-6)) << n;
        EXPECT_LT((mesh.spin(0) - plane.spin(0)).norm(), 1e-6 * plane.spin(0).norm()) << n;
    }
}

// A ball falls on a face, over an edge and over a vertex.
TEST(MeshContacts, ABallReturnsAlikeFromFacesEdgesAndVertices) {
    const auto rebound = [](const Vec3& above) {
        HandMadeBed w = make_world(walton_braun_pair(0.8, 0.3), 1e-6);
        add_mesh(w, "floor", square_mesh(0.1, 10));
        w.grains.add(0, 0, above + Vec3(0, 0, 1.001 * kRadius), kRadius, kDensity);
        w.grains.motion[0].velocity = {0.01, 0.02, -0.5};
        w.start();
        w.run(1500);
        return Vec3(w.velocity(0));
    };
    const Vec3 face = rebound(Vec3(0.0012, 0.0031, 0));
    EXPECT_NEAR(face.z(), 0.8 * 0.5, 0.01);
    for (const Vec3& at : {Vec3(0.01, 0.003, 0), Vec3(0.01, 0.02, 0), Vec3(0.005, 0.005, 0)})
        EXPECT_LT((rebound(at) - face).norm(), of_rounding(1e-9, 1e-6)) << at.transpose();
}

TEST(MeshContacts, ConesOf10AndOf50TrianglesAreAlikeAtTheTip) {
    const auto rebound = [](int sides) {
        HandMadeBed w = make_world(walton_braun_pair(0.8, 0.3), 1e-6);
        add_mesh(w, "cone", cone_mesh(0.02, 0.03, sides));
        w.grains.add(0, 0, Vec3(0.0002, 0.0001, 1.001 * kRadius), kRadius, kDensity);
        w.grains.motion[0].velocity = {0, 0, -0.5};
        w.start();
        w.run(1500);
        return std::pair(Vec3(w.velocity(0)), Vec3(w.spin(0)));
    };
    const auto few = rebound(10), many = rebound(50);
    EXPECT_GT(few.first.z(), 0.3);
    EXPECT_LT((few.first - many.first).norm(), 1e-9);
    EXPECT_LT((few.second - many.second).norm(), 1e-6 * few.second.norm());
}

Container wedge() {
    Container c;
    c.shape = Container::Shape::wedge;
    c.half_width = 0.02;
    c.half_angle = 0.4;
    c.slant_height = 0.02;
    c.depth = 0.02;
    c.height = 0.04;
    return c;
}

// Each face as two large triangles about its middle.
TriangleMesh mesh_of(const std::vector<Face>& faces, double size) {
    TriangleMesh mesh;
    for (const Face& face : faces) {
        const Vec3 u = face.normal.unitOrthogonal(), v = face.normal.cross(u);
        add_sheet(
            1, 1, [&](double a, double b) { return face.point + size * ((a - 0.5) * u + (b - 0.5) * v); },
            mesh);
    }
    return mesh;
}

// Compares forces over a few steps, at places anywhere in the wedge and at any velocity and spin.
TEST(MeshContacts, TheWedgeOfTrianglesPushesAsThatOfPlanes) {
    std::mt19937_64 random(3);
    std::uniform_real_distribution<double> one(-1, 1);
    const std::vector<Face> faces = container_faces(wedge(), Drive{});
    const double scale = kStiffness * 1e-5;  // N
    int touched = 0;
    for (int state = 0; state < 1000; ++state) {
        Vec3 at(0.009 * one(random), 0.018 * one(random), 0.02 + 0.0185 * one(random));
        const Vec3 velocity(one(random), one(random), one(random));
        const Vec3 spin = 100 * Vec3(one(random), one(random), one(random));
        // Moves the ball to the walls that are near.
        for (const Face& face : faces) {
            const double distance = distance_to(face, Vec3::Zero(), at).distance;
            if (distance < 1.3 * kRadius) at += (kRadius - 1e-5 - distance) * face.normal;
        }
        // Deep in one wall, a ball does not feel the part of another that lies behind it, but endless planes
        // know of no behind.
        if (std::any_of(faces.begin(), faces.end(), [&](const Face& face) {
                return distance_to(face, Vec3::Zero(), at).distance < 0.95 * kRadius;
            }))
            continue;
        const auto pushed = [&](bool triangles) {
            HandMadeBed w = make_world(walton_braun_pair(0.9, 0.4), 1e-6);
            if (triangles)
                for (const Face& face : faces) add_mesh(w, face.name, mesh_of({face}, 1));
            else
                w.around.faces = faces;
            w.grains.add(0, 0, at, kRadius, kDensity);
            w.grains.motion[0].velocity = velocity;
            w.grains.motion[0].spin = spin;
            w.start();
            w.run(8);
            return w.grains.load[0];
        };
        const Load planes = pushed(false), mesh = pushed(true);
        touched += planes.force.norm() > 0;
        EXPECT_LT((planes.force - mesh.force).norm(),
                  of_rounding(1e-9, 1e-5) * (scale + planes.force.norm()));
        EXPECT_LT((planes.torque - mesh.torque).norm(),
                  of_rounding(1e-9, 1e-5) * (scale * kRadius + planes.torque.norm()));
    }
    EXPECT_GT(touched, 300);
}

// A ball lies in a corner of one mesh, whose sides meet in edges.
TEST(MeshContacts, ABoxOfTrianglesHoldsABallInItsCornerAsPlanesDo) {
    const auto pushed = [](bool triangles) {
        HandMadeBed w = make_world(walton_braun_pair(0.9, 0.4), 1e-6);
        Container box;
        box.shape = Container::Shape::box;
        box.half_width = box.depth = 0.02;
        box.height = 0.04;
        if (triangles)
            add_mesh(w, "box", box_mesh(Vec3(-0.01, -0.02, 0), Vec3(0.01, 0.02, 0.04), 7));
        else
            w.around.faces = container_faces(box, Drive{});
        const double in = kRadius - 1e-5;
        w.grains.add(0, 0, Vec3(-0.01 + in, 0.02 - in, in), kRadius, kDensity);
        w.grains.motion[0].velocity = {-0.1, 0.2, -0.1};
        w.grains.motion[0].spin = {20, -10, 30};
        w.start();
        w.run(20);
        return w.grains.load[0];
    };
    const Load planes = pushed(false), mesh = pushed(true);
    EXPECT_LT((planes.force - mesh.force).norm(), of_rounding(1e-9, 1e-5) * planes.force.norm());
    EXPECT_LT((planes.torque - mesh.torque).norm(), of_rounding(1e-9, 1e-5) * planes.torque.norm());
}

// A ball that meets two ridges at once has two contacts, each of which has the mesh's number and a triangle.
TEST(MeshContacts, AreShownWithTheirMeshAndTriangle) {
    HandMadeBed w = make_world(rubbing_pair(), 1e-6);
    w.around.faces = {floor_face()};
    add_mesh(w, "far", square_mesh(0.01, 1)).body.velocity = Vec3(0, 0, 0);
    w.around.meshes.clear(), w.plan.mesh.clear();
    TriangleMesh far = square_mesh(0.01, 1);
    for (Vec3& vertex : far.vertices) vertex.z() -= 1;
    add_mesh(w, "far", far);
    add_mesh(w, "groove", groove_mesh(0.05, 0.8, 0.8, 3));
    w.grains.add(0, 0, Vec3(0.001, 0, (kRadius - 1e-5) / std::cos(0.8)), kRadius, kDensity);
    w.start();
    int seen = 0;
    w.loop->visit_contacts(0, [&](const ContactView& c) {
        ++seen;
        EXPECT_EQ(c.second, -3);
        EXPECT_GE(c.triangle, 0);
        EXPECT_LT(c.triangle, 36);
        EXPECT_NEAR(c.overlap, 1e-5, 1e-14);
        EXPECT_NEAR(c.point.x(), 0.001, 1e-12);
        EXPECT_NEAR(std::abs(c.point.y()), (kRadius - 1e-5) * std::sin(0.8), 1e-12);
    });
    EXPECT_EQ(seen, 2);
}

// With mu = 0 and e = 1 nothing is lost on faces, seams and edges and in corners.
TEST(MeshContacts, AnElasticGasKeepsItsEnergyInAClosedMesh) {
    const auto energies = [](bool triangles) {
        PairPlan pair = walton_braun_pair(1, 0);
        HandMadeBed w = make_world(pair, 2e-6, NormalForce::spring_dashpot, TangentialLaw::none);
        if (triangles) {
            add_mesh(w, "box", box_mesh(Vec3(-0.01, -0.01, 0), Vec3(0.01, 0.01, 0.02), 3));
        } else {
            Container box;
            box.shape = Container::Shape::box;
            box.half_width = 0.01;
            box.depth = box.height = 0.02;
            w.around.faces = container_faces(box, Drive{});
        }
        std::mt19937_64 random(4);
        std::normal_distribution<double> speed(0, 0.3);
        for (int i = 0; i < 27; ++i) {
            const int layer = i / 9;
            w.grains.add(i, 0, 0.0055 * Vec3(i % 3 - 1, i / 3 % 3 - 1, layer - 1) + Vec3(0, 0, 0.01), kRadius,
                         kDensity);
            w.grains.motion.back().velocity = Vec3(speed(random), speed(random), speed(random));
        }
        w.start();
        const double before = w.energy();
        w.run(100000);
        return std::abs(w.energy() - before) / before;
    };
    const double box = energies(false), mesh = energies(true);
    std::printf("[ measured ] energy changes by %.1e in a box of planes, %.1e in one of triangles\n", box,
                mesh);
    EXPECT_LT(mesh, 2 * box + 1e-5);
}

TEST(MeshContacts, AGrainThatCrossesASheetEndsTheRunWithItsName) {
    for (const int threads : {1, 2}) {
        HandMadeBed w = make_world(walton_braun_pair(0.9, 0.4), 1e-5);
        w.team = std::make_unique<Team>(threads);
        add_mesh(w, "vane", square_mesh(0.05, 3));
        for (int i = 0; i < 20; ++i) {
            const int row = i / 10;
            w.grains.add(i, 0, Vec3(-0.02 + 0.004 * (i % 10), 0.01 * row, 2 * kRadius), kRadius,
                         i == 7 ? 1e7 : kDensity);
            w.grains.motion.back().velocity = {0, 0, i == 7 ? -5.0 : 0.0};
        }
        w.start();
        try {
            w.run(400);
            FAIL() << "it went through";
        } catch (const RunError& e) {
            const std::string text = e.what();
            EXPECT_NE(text.find("grain 7 "), std::string::npos) << text;
            EXPECT_NE(text.find("went through the mesh vane"), std::string::npos) << text;
        }
    }
}

// The torque of a contact is that of its force at the contact's point, on planes, on meshes and between
// grains of two sizes. So who reads points and forces finds the torque.
TEST(ContactPoints, AreWhereTheTorquesAct) {
    PairPlan pair = walton_braun_pair(0.9, 0.4);
    pair.rolling_friction = 0.1;
    HandMadeBed w = make_world(pair, 1e-6);
    w.plan.grain[0].model.rolls = w.plan.wall[0].model.rolls = true;
    w.around.faces = {floor_face()};
    TriangleMesh side = square_mesh(0.05, 1);
    for (Vec3& v : side.vertices) v = Vec3(v.x(), 0.01, v.y());
    add_mesh(w, "side", side);
    const double in = 0.98 * kRadius, small = 0.5 * kRadius;
    w.grains.add(0, 0, Vec3(0, 0.01 - in, in), kRadius, kDensity);
    w.grains.add(1, 0, Vec3(in + small, 0.01 - in, in), small, kDensity);
    w.grains.motion[0].velocity = {0.1, -0.02, 0.03};
    w.grains.motion[0].spin = {30, -20, 10};
    w.start();
    w.run(3);
    int seen = 0;
    w.loop->visit_contacts(w.step, [&](const ContactView& c) {
        ++seen;
        const Place& first = w.grains.place[static_cast<std::size_t>(c.first)];
        const Vec3 on_first = -(c.normal_force * c.normal + c.tangential);
        EXPECT_GT(c.tangential.norm(), 0) << seen;
        EXPECT_LT(((c.point - first.position).cross(on_first) - c.rolling - c.torque_on_first).norm(),
                  of_rounding(1e-12, 1e-5) * c.torque_on_first.norm())
            << c.second;
        EXPECT_NEAR(c.second == -1 ? c.point.z() : 0, 0, 1e-15);
        EXPECT_NEAR(c.second == -2 ? c.point.y() : 0.01, 0.01, 1e-15);
        if (c.second < 0) return;
        const Vec3 arm = c.point - w.grains.place[static_cast<std::size_t>(c.second)].position;
        EXPECT_LT((arm.cross(-on_first) + c.rolling - c.torque_on_second).norm(),
                  of_rounding(1e-12, 1e-5) * c.torque_on_second.norm());
    });
    EXPECT_EQ(seen, 3);
}

// The moment on a wall is that on the grain with the opposite sign, taken about the wall's point.
TEST(ContactPoints, APlaneHasTheMomentOfAMesh) {
    const auto sums_of = [](bool triangles) {
        PairPlan pair = walton_braun_pair(0.9, 0.4);
        pair.rolling_friction = 0.1;
        HandMadeBed w = make_world(pair, 1e-6);
        w.plan.grain[0].model.rolls = w.plan.wall[0].model.rolls = true;
        if (triangles)
            add_mesh(w, "floor", square_mesh(0.05, 3));
        else
            w.around.faces = {floor_face()};
        w.grains.add(0, 0, Vec3(0.003, 0.001, 0.98 * kRadius), kRadius, kDensity);
        w.grains.motion[0].velocity = {0.1, -0.02, 0};
        w.grains.motion[0].spin = {30, -20, 10};
        w.start();
        WallScale scale;
        scale.force = 0x1p-40, scale.length = 0x1p-20;
        w.loop->tally_walls(scale, 0);
        w.run(20);
        const FaceSums sums = w.loop->wall_sums().faces[0];
        std::array<double, 3> moment;
        for (std::size_t a = 0; a < 3; ++a) moment[a] = static_cast<double>(sums.moment[a]) * 0x1p-60;
        return moment;
    };
    const auto plane = sums_of(false), mesh = sums_of(true);
    for (std::size_t a = 0; a < 3; ++a) {
        EXPECT_GT(std::abs(mesh[a]), 1e-6) << a;
        EXPECT_NEAR(plane[a], mesh[a], of_rounding(1e-9, 1e-5) * std::abs(mesh[a])) << a;
    }
}

}  // namespace
}  // namespace grainreel
