// Tests of a tray below an outlet, which catches what flows out.
#include <gtest/gtest.h>

#include <cmath>

#include "engine/measure/columns.hpp"
#include "engine/run/simulation/simulated_bed.hpp"
#include "engine/scene/bed.hpp"
#include "engine/scene/scene_file.hpp"
#include "engine/start/restart.hpp"
#include "engine/state/container_faces.hpp"
#include "engine/step/surroundings.hpp"
#include "tests/physics/world.hpp"
#include "tests/support/small_scene.hpp"
#include "tests/support/temporary_folder.hpp"

namespace grainreel {
namespace {

const std::string kHourglass =
    test::SmallScene()
        .beads(60, "sand", "3 mm to 4 mm")
        .contacts("0.6", "0.3")
        .more("[container]\nshape = \"wedge\"\nhalf_angle = \"40 deg\"\n")
        .more("floor_width = \"24 mm\"\nhalf_width = \"30 mm\"\ndepth = \"16 mm\"\n")
        .more("height = \"40 mm\"\noutlet = { width = \"24 mm\", opens = \"10 ms\" }\n")
        .more("tray = { depth = \"30 mm\", width = \"64 mm\" }\n")
        .lasts("0.3 s")
        .more("[start]\nsettle_limit = \"0.02 s\"\n")
        .text();

Scene scene_of(std::vector<std::string> sets = {}) {
    return read_scene_text(kHourglass, "hourglass.toml", with_tested_precision(std::move(sets)),
                           measurable_in);
}

const Face& named(const std::vector<Face>& faces, const std::string& name) {
    for (const Face& face : faces)
        if (face.name == name) return face;
    throw std::runtime_error(name);
}

// The walls end at the floor's lowest place: above it a grain meets only their edge.
TEST(Tray, HasAFloorWithoutEndAndWallsThatEndAbove) {
    for (const bool shaken : {false, true}) {
        const Scene scene =
            shaken ? scene_of({"drive={frequency=\"30 Hz\", amplitude=\"1 mm\"}"}) : scene_of();
        const double rim = shaken ? -0.002 : 0;
        const std::vector<Face> faces = tray_faces(scene);
        ASSERT_EQ(faces.size(), 5u);
        const auto at = [&](const char* name, const Vec3& centre) {
            return distance_to(named(faces, name), Vec3::Zero(), centre);
        };
        EXPECT_NEAR(at("tray floor", {0.1, 0.3, -0.028}).distance, 0.002, 1e-15);
        EXPECT_NEAR(at("tray left wall", {0, -0.029, -0.01}).distance, 0.003, 1e-15);
        const FaceDistance above = at("tray right wall", {0, 0.028, rim + 0.003});
        EXPECT_NEAR(above.distance, 0.005, 1e-15);
        EXPECT_LT((above.normal - Vec3(0, -0.8, 0.6)).norm(), 1e-12);
        EXPECT_NEAR(at("tray front", {0.005, 0.3, -0.02}).distance, 0.003, 1e-15);
        for (const Face& face : faces) EXPECT_EQ(face.velocity_at({{0, 0, 1}, {0, 0, 1}, 1}), Vec3(0, 0, 0));
    }
}

TEST(Tray, IsRoundBelowACylinder) {
    std::string text = kHourglass;
    const std::size_t from = text.find("shape"), to = text.find("[run]");
    text.replace(from, to - from, R"(shape = "cylinder"
diameter = "40 mm"
height = "40 mm"
outlet = { diameter = "18 mm" }
tray = {}
)");
    const Scene scene = read_scene_text(text, "round.toml");
    const std::vector<Face> faces = tray_faces(scene);
    ASSERT_EQ(faces.size(), 2u);
    const FaceDistance at =
        distance_to(named(faces, "tray wall"), Vec3::Zero(), {0.6 * 0.018, 0.8 * 0.018, -0.01});
    EXPECT_NEAR(at.distance, 0.002, 1e-15);
    EXPECT_LT((at.normal - Vec3(-0.6, -0.8, 0)).norm(), 1e-12);
    EXPECT_NEAR(distance_to(named(faces, "tray floor"), Vec3::Zero(), {0, 0, -0.04}).distance, 0, 1e-15);
}

// All grains stay in the run. Grains that have fallen into the tray count as outflow.
TEST(Tray, KeepsAllThatFlowsOut) {
    const Scene scene = scene_of({"output.instruments=[\"outflow\"]"});
    const Plan plan = make_plan(scene);
    EXPECT_FALSE(plan.traffic);
    SimulatedBed run(scene, plan, 1);
    run.pack();
    run.advance(plan.steps);
    EXPECT_EQ(run.traffic().left, 0);
    const State frame = run.frame();
    ASSERT_EQ(frame.size(), 60u);
    int below = 0;
    double mass = 0;
    for (std::size_t i = 0; i < frame.size(); ++i) {
        EXPECT_GT(frame.position[i].z(), -0.03 + 0.9 * frame.radius[i]);
        EXPECT_LT(std::abs(frame.position[i].y()), 0.032);
        if (frame.position[i].z() >= 0) continue;
        ++below;
        mass += 2500 * 4.0 / 3 * std::numbers::pi * std::pow(frame.radius[i], 3);
    }
    EXPECT_GT(below, 50);
    EXPECT_NEAR(run.measures().at("outflow_kg"), mass, 1e-9 * mass);
}

TEST(Tray, TheSameBitsAtAnyNumberOfThreadsAndThroughACheckpoint) {
    const test::TemporaryFolder here;
    const Scene scene = scene_of({"run.duration=0.12 s"});
    const Plan plan = make_plan(scene);
    SimulatedBed first(scene, plan, 1);
    first.pack();
    first.advance(plan.steps / 2);
    first.save_checkpoint(here / "a.grs");
    first.advance(plan.steps);
    for (const int threads : {2, 3}) {
        SimulatedBed whole(scene, plan, threads);
        whole.pack();
        whole.advance(plan.steps);
        EXPECT_EQ(whole.state_hash(), first.state_hash()) << threads;
        const Scene next = continued(scene, here / "a.grs");
        SimulatedBed taken_up(next, plan, threads);
        taken_up.pack();
        taken_up.advance(plan.steps);
        EXPECT_EQ(taken_up.state_hash(), first.state_hash()) << threads;
    }
}

}  // namespace
}  // namespace grainreel
