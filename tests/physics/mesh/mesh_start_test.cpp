// Tests of beds that begin in a vessel of triangles, or in a box that the scene gives.
#include <gmock/gmock.h>

#include <algorithm>

#include "engine/plan/resolved_scene.hpp"
#include "engine/run/simulation/simulated_bed.hpp"
#include "engine/start/layers.hpp"
#include "engine/state/container_faces.hpp"
#include "engine/step/surroundings.hpp"
#include "tests/physics/mesh/mesh_files.hpp"
#include "tests/support/small_scene.hpp"

namespace grainreel {
namespace {

using std::numbers::pi;
using testing::HasSubstr;

const std::string kBeads = test::SmallScene()
                               .beads(300, "beads", "2 mm", "2.5 g/cm3")
                               .contacts("0.6", "0.4")
                               .lasts("0.05 s")
                               .more("threads = 1\n")
                               .text();

const char* const kVessel = R"([container]
shape = "mesh"
mesh = "vessel"
[[mesh]]
name = "vessel"
file = "vessel.stl"
)";

class MeshStart : public MeshFiles {};

double volume_of_beads(const Scene& scene) {
    return static_cast<double>(scene.species[0].count) * pi / 6 * std::pow(scene.species[0].diameter.mean, 3);
}

// A cone has V = pi R^2 z^3 / (3 h^2), and a third of the room that the grains take is solid. If a cone is
// filled to z, the mean height is 3/4 z and its deviation is sqrt(3/80) z.
TEST_F(MeshStart, LayersFillAConeToTheHeightOfTheirVolume) {
    constexpr double radius = 0.03, height = 0.06;
    write("vessel.stl", cone(radius, height, 180));
    const Scene scene = read(std::string(kBeads) + kVessel);
    const double top = std::cbrt(3 * volume_of_beads(scene) * 3 * height * height / (pi * radius * radius));
    const Grains grains = place_in_layers(scene);
    ASSERT_EQ(grains.size(), 300U);
    double mean = 0, highest = 0;
    for (const Place& p : grains.place) {
        const Vec3& x = p.position;
        EXPECT_LT(std::hypot(x.x(), x.y()), x.z() * radius / height);
        mean += x.z() / 300, highest = std::max(highest, x.z());
    }
    EXPECT_LE(highest, 1.02 * top);
    EXPECT_GT(highest, 0.95 * top);
    EXPECT_NEAR(mean, 0.75 * top, 4 * std::sqrt(3.0 / 80 / 300) * top + 0.02 * top);
    // The plan's bed has a solid fraction of 0.6.
    EXPECT_NEAR(make_plan(scene).bed_height, std::cbrt(1 / 1.8) * top, 0.01 * top);
}

TEST_F(MeshStart, ABedInABoxOfTrianglesPacksAsInABoxOfPlanes) {
    write("vessel.stl", box_of_triangles(Vec3(-0.01, -0.01, 0), Vec3(0.01, 0.01, 0.04)));
    for (const char* method : {"layers", "rain"}) {
        const std::string set = std::string("start.method=") + method;
        const Scene mesh = read(std::string(kBeads) + kVessel, {set});
        const Scene planes = read(std::string(kBeads) + R"([container]
shape = "box"
width = "20 mm"
depth = "20 mm"
height = "40 mm"
)",
                                  {set});
        double centre[2], solid[2];
        for (const bool of_mesh : {true, false}) {
            const Scene& scene = of_mesh ? mesh : planes;
            SimulatedBed run(scene, make_plan(scene), 1);
            const PackingResult packed = run.pack();
            EXPECT_TRUE(packed.settled) << method;
            centre[of_mesh] = run.measure("centre_z_m");
            solid[of_mesh] = packed.solid_fraction;
            for (const Vec3& x : run.frame().position) {
                EXPECT_LT(std::max(std::abs(x.x()), std::abs(x.y())), 0.0091) << method;
                EXPECT_GT(x.z(), 0.0009) << method;
            }
        }
        EXPECT_NEAR(centre[true], centre[false], 0.03 * centre[false]) << method;
        EXPECT_NEAR(solid[true], solid[false], 0.03) << method;
    }
}

// A vessel need not stand in the middle, nor on z = 0.
TEST_F(MeshStart, AVesselElsewhereIsFilledThere) {
    const Vec3 low(0.05, -0.03, -0.02), high(0.08, -0.01, 0.03);
    write("vessel.stl", box_of_triangles(low, high, true));
    const Scene scene = read(std::string(kBeads) + kVessel);
    EXPECT_NEAR(scene.container.base(), low.z(), 1e-4);
    const double deep = volume_of_beads(scene) / 0.6 / (0.03 * 0.02);
    EXPECT_NEAR(make_plan(scene).bed_height, deep, 0.02 * deep);
    SimulatedBed run(scene, make_plan(scene), 1);
    EXPECT_TRUE(run.pack().settled);
    for (const Vec3& x : run.frame().position) {
        EXPECT_TRUE(((x - low).array() > 0.0009).all());
        EXPECT_TRUE((x.x() < high.x() - 0.0009) && (x.y() < high.y() - 0.0009));
    }
}

TEST_F(MeshStart, ARegionIsFilledWithoutAContainer) {
    write("plate.stl", box_of_triangles(Vec3(-0.1, -0.1, -0.01), Vec3(0.1, 0.1, 0)));
    const Scene scene = read(std::string(kBeads) + R"([container]
shape = "none"
[start]
region = { low = [-0.01, -0.02, 0.005], high = [0.03, 0.02, 0.035] }
[[mesh]]
name = "plate"
file = "plate.stl"
)");
    const Grains grains = place_in_layers(scene);
    const double top = 0.005 + volume_of_beads(scene) * 3 / (0.04 * 0.04);
    double highest = 0;
    for (const Place& p : grains.place) {
        EXPECT_TRUE(p.position.x() > -0.01 && p.position.x() < 0.03 && std::abs(p.position.y()) < 0.02);
        EXPECT_GT(p.position.z(), 0.005);
        highest = std::max(highest, p.position.z());
    }
    EXPECT_NEAR(highest, top, 0.02 * top);
    SimulatedBed run(scene, make_plan(scene), 1);
    run.pack();
    for (const Vec3& x : run.frame().position) EXPECT_GT(x.z(), 0.0009);
    EXPECT_LT(run.measure("centre_z_m"), 0.006);  // a heap on the plate
}

// Nothing turns before the run, though the turn begins at once: a grain lies as in a vessel that stands
// still. (Otherwise the floor would drag it along at 63 mm/s.)
TEST_F(MeshStart, WallsStandStillWhileABedSettles) {
    write("vessel.stl", box_of_triangles(Vec3(-0.01, -0.01, 0), Vec3(0.01, 0.01, 0.02)));
    const std::string still = std::string(kBeads) + kVessel,
                      turn = "turn = { axis = [1, 0, 0], through = [0, 0, 0.01], rate = \"-60 rpm\" }\n";
    Vec3 place[2];
    for (const bool turns : {false, true}) {
        const Scene scene =
            read(turns ? still + turn : still, {"species.0.count=1", "contact.stiffness=1e4"});
        SimulatedBed run(scene, make_plan(scene), 1);
        EXPECT_TRUE(run.pack().settled);
        place[turns] = run.frame().position[0];
        EXPECT_EQ(run.frame().bodies.back().rotation.coeffs(), Quaternion::Identity().coeffs());
    }
    // Faster walls make the plan expect faster impacts, so the two do not pack step by step alike.
    EXPECT_LT((place[true] - place[false]).norm(), 1e-4);
}

// ---- going on from files ----

TEST_F(MeshStart, ARestingBedStaysAtRestUnderTheSameLaw) {
    std::filesystem::create_directory(here / "meshes");  // a run keeps its meshes there
    write("meshes/vessel.stl", box_of_triangles(Vec3(-0.01, -0.01, 0), Vec3(0.01, 0.01, 0.04)));
    std::string text = std::string(kBeads) + kVessel;
    text.replace(text.find("vessel.stl"), 10, "meshes/vessel.stl");
    const Scene scene = read(text);
    SimulatedBed first(scene, make_plan(scene), 1);
    first.pack();
    first.save_checkpoint(here / "checkpoint.grs");
    const Scene next = read(text, {"start.method=file", "start.file=" + (here / "checkpoint.grs").string()});
    const Plan plan = make_plan(next);
    EXPECT_TRUE(plan.start.keeps_histories);
    EXPECT_FALSE(plan.start.relaxes);
    EXPECT_EQ(plan.mesh[0].stiffness_reason, "the start file");
    SimulatedBed run(next, plan, 1);
    run.pack();
    const double before = run.measure("centre_z_m");
    EXPECT_NEAR(before, first.measure("centre_z_m"), 1e-9);
    run.advance(plan.steps);
    EXPECT_NEAR(run.measure("centre_z_m"), before, 1e-5);
    EXPECT_LT(run.measure("kinetic_J"), 1e-9);
}

TEST_F(MeshStart, ACheckpointGoesOnBitByBit) {
    write("vessel.stl", box_of_triangles(Vec3(-0.01, -0.01, 0), Vec3(0.01, 0.01, 0.04)));
    const Scene scene = read(std::string(kBeads) + kVessel +
                             "turn = { axis = [1, 0, 0], through = [0, 0, 0.02], rate = \"60 rpm\" }\n");
    const Plan plan = make_plan(scene);
    SimulatedBed whole(scene, plan, 1), half(scene, plan, 1);
    whole.pack(), half.pack();
    whole.advance(600), half.advance(300);
    half.save_checkpoint(here / "checkpoint.grs");
    SimulatedBed rest = SimulatedBed::at_checkpoint(scene, plan, here / "checkpoint.grs", 2);
    rest.advance(600);
    EXPECT_EQ(rest.state_hash(), whole.state_hash());
}

// ---- the plan ----

TEST_F(MeshStart, MeshesHaveTheContactsThatTheSceneSays) {
    write("vessel.stl", box_of_triangles(Vec3(-0.01, -0.01, 0), Vec3(0.01, 0.01, 0.04)));
    const std::string text = std::string(kBeads) + kVessel + R"([[contact.pair]]
between = ["beads", "vessel"]
friction = 0.1
restitution = 0.3
stiffness = "1e4 N/m"
)";
    const Scene scene = read(text);
    const Plan plan = make_plan(scene);
    ASSERT_EQ(plan.mesh.size(), 1U);
    EXPECT_EQ(plan.at_mesh(0, 0).friction, 0.1);
    EXPECT_EQ(plan.at_mesh(0, 0).restitution, 0.3);
    EXPECT_EQ(plan.at_mesh(0, 0).loading_stiffness, 1e4);
    EXPECT_EQ(plan.wall[0].friction, 0.4);
    EXPECT_FALSE(plan.moving_walls);
    const Scene filled = with_choices(read(std::string(kBeads) + kVessel), plan);
    EXPECT_EQ(*filled.contact.mesh[0].stiffness, 1e4);
    EXPECT_EQ(face_names(scene), std::vector<std::string>{"vessel"});
}

// The wall's own speed counts in v*: 2.2 times the speed of the rim, 30 rpm x 22.4 mm here.
TEST_F(MeshStart, FastWallsMakeTheContactsStiff) {
    write("vessel.stl", box_of_triangles(Vec3(-0.01, -0.01, 0), Vec3(0.01, 0.01, 0.04)));
    const std::string text = std::string(kBeads) + kVessel;
    const auto turning = [&](const std::string& rate) {
        return make_plan(
            read(text + "turn = { axis = [1, 0, 0], through = [0, 0, 0.02], rate = \"" + rate + "\" }\n"));
    };
    const double rim = std::hypot(0.01, 0.02), still = make_plan(read(text)).impact_speed;
    EXPECT_EQ(turning("30 rpm").impact_speed, still);
    const Plan fast = turning("600 rpm");
    EXPECT_NEAR(fast.wall_speed, 20 * pi * rim, 1e-12);
    EXPECT_NEAR(fast.impact_speed, 2.2 * 20 * pi * rim, 1e-9);
    EXPECT_TRUE(fast.moving_walls);
    // t_c ~ 1 / v* where impacts determine the stiffness.
    EXPECT_NEAR(turning("1200 rpm").clock.step / fast.clock.step, 0.5, 0.01);
}

TEST_F(MeshStart, ExitsAreRegionsOfTheSurroundings) {
    write("vessel.stl", cone(0.03, 0.06, 36));
    const std::string text = std::string(kBeads) + kVessel;
    const auto leaves = [](const Surroundings& around, const Vec3& at) {
        return std::any_of(around.exits.begin(), around.exits.end(),
                           [&](const Exit& exit) { return exit.holds(at); });
    };
    const Scene below = read(text + "[[exit]]\nlow = [-1, -1, -1]\nhigh = [1, 1, -0.1]\n");
    const Scene around = read(text + "[[exit]]\nlow = [-1, -1, -1]\nhigh = [1, 1, 1]\noutside = true\n");
    const Surroundings one = make_surroundings(below, make_plan(below)),
                       other = make_surroundings(around, make_plan(around));
    EXPECT_TRUE(make_plan(below).traffic);
    EXPECT_TRUE(leaves(one, Vec3(0.5, 0, -0.2)));
    EXPECT_FALSE(leaves(one, Vec3(0.5, 0, -0.05)));
    EXPECT_FALSE(leaves(one, Vec3(1.5, 0, -0.2)));
    EXPECT_FALSE(leaves(other, Vec3(0.5, -0.5, 0.9)));
    for (int axis = 0; axis < 3; ++axis)
        for (const double side : {-1.0, 1.0}) EXPECT_TRUE(leaves(other, 1.01 * side * Vec3::Unit(axis)));
}

// The gap below the plate is lower than a large grain. Growth would not push such a grain out.
TEST_F(MeshStart, LayersLeaveOutGapsThatAreTooNarrow) {
    write("plate.stl", box_of_triangles(Vec3(-0.002, -0.012, 0.004), Vec3(0.002, 0.012, 0.02)));
    for (const int seed : {1, 2, 3, 4}) {
        Scene scene = read(test::SmallScene()
                               .beads(10, "small", "3 mm", "2.5 g/cm3")
                               .beads(8, "big", "6 mm", "2.5 g/cm3")
                               .contacts("0.6", "0.4")
                               .lasts("0.01 s")
                               .more("threads = 1\n")
                               .text() +
                           R"([container]
shape = "box"
width = "36 mm"
depth = "30 mm"
height = "60 mm"
[[mesh]]
name = "plate"
file = "plate.stl"
)");
        scene.run.seed = static_cast<std::uint64_t>(seed);
        const Grains grains = place_in_layers(scene);
        for (std::size_t i = 0; i < grains.size(); ++i) {
            const Vec3& at = grains.place[i].position;
            const bool below = std::abs(at.x()) < 0.002 && std::abs(at.y()) < 0.012 && at.z() < 0.004;
            EXPECT_FALSE(grains.species[i] == 1 && below) << seed << " " << at.transpose();
        }
        SimulatedBed run(scene, make_plan(scene), 1);
        EXPECT_NO_THROW(run.pack()) << seed;
    }
}

}  // namespace
}  // namespace grainreel
