// Tests of whole beds: packing, neighbours, work and energy, and the same bits on any number of threads.
#include <gtest/gtest.h>

#include <filesystem>
#include <set>
#include <utility>

#include "engine/base/error.hpp"
#include "engine/base/random.hpp"
#include "engine/run/simulation/simulated_bed.hpp"
#include "engine/scene/free_space.hpp"
#include "engine/scene/scene_file.hpp"
#include "engine/start/layers.hpp"
#include "engine/start/radius_growth.hpp"
#include "engine/start/restart.hpp"
#include "engine/start/settle.hpp"
#include "engine/step/grid/neighbours.hpp"
#include "tests/physics/world.hpp"
#include "tests/support/small_scene.hpp"
#include "tests/support/temporary_folder.hpp"

namespace grainreel {
namespace {

const std::string kWedge = test::SmallScene("title = \"test\"\n")
                               .beads(260, "small", "4 mm to 5 mm")
                               .beads(20, "big", "9 mm")
                               .contacts("0.8", "0.4")
                               .wedge("25 deg", "40 mm", "35 mm", "30 mm", "90 mm")
                               .shaken("20 Hz", "3")
                               .lasts("1 s")
                               .text();

// Most tests need a crowd in motion and not one at rest, so settling is cut short unless a test asks for
// more.
Scene scene_of(std::vector<std::string> sets = {}) {
    sets.insert(sets.begin(), "start.settle_limit=\"0.05 s\"");
    return read_scene_text(kWedge, "test.toml", with_tested_precision(sets));
}

const std::string kPeriodic = "container.periodic_depth=true", kDeeper = "container.depth=\"40 mm\"";
const std::string kFullSettling = "start.settle_limit=\"5 s\"";

SimulatedBed packed(const Scene& scene, const Plan& plan, int threads) {
    SimulatedBed simulation(scene, plan, threads);
    simulation.pack();
    return simulation;
}

// Continues from a checkpoint of the same scene.
SimulatedBed gone_on(const Scene& scene, const Plan& plan, const std::filesystem::path& file, int threads) {
    return packed(continued(scene, file), plan, threads);
}

TEST(Layers, PutBigGrainsBelowSmallOnesInsideTheContainer) {
    const Scene scene = scene_of();
    const Grains grains = place_in_layers(scene);
    ASSERT_EQ(grains.size(), 280u);
    const auto faces = container_faces(scene.container, scene.drive);
    double highest_big = 0, lowest_small = 1;
    for (std::size_t i = 0; i < grains.size(); ++i) {
        for (const Face& face : faces) {
            EXPECT_GT(distance_to(face, Vec3::Zero(), grains.place[i].position).distance, 0) << face.name;
        }
        const double z = grains.place[i].position.z();
        if (grains.species[i] == 1)
            highest_big = std::max(highest_big, z);
        else
            lowest_small = std::min(lowest_small, z);
    }
    EXPECT_LE(highest_big, lowest_small);
}

// The room in a box that planes cut is what formulas give, and layers fill it from below.
TEST(FreeSpace, IsWhatPlanesLeaveOfTheContainer) {
    Scene scene = scene_of();
    scene.container.shape = Container::Shape::box;
    const Container& box = scene.container;
    const double base = 2 * box.half_width * box.depth;
    EXPECT_EQ(FreeSpace(scene).volume(), box.volume());
    ScenePlane plane;
    plane.point = Vec3(0, 0, 0.02);
    scene.walls = {plane};
    EXPECT_NEAR(FreeSpace(scene).volume(), base * (box.height - 0.02), 1e-3 * box.volume());
    EXPECT_NEAR(FreeSpace(scene).height_of_share(0.5), 0.5 * (0.02 + box.height), 1e-3 * box.height);
    // The plane goes through the middle of the floor at 45 degrees and cuts off half the base's width times
    // itself, halved.
    plane.point = Vec3(0, 0, 0);
    plane.normal = Vec3(0, 1, 1).normalized();
    scene.walls = {plane};
    EXPECT_NEAR(FreeSpace(scene).volume(), box.volume() - 0.5 * box.half_width * box.half_width * box.depth,
                1e-3 * box.volume());
}

// Beds would differ between compilers if the order were left open.
TEST(Layers, PlacesAreDrawnInOneOrderOnEveryCompiler) {
    Random one(5, Stream::centres), other(5, Stream::centres);
    const Vec3 drawn = one.in_cube(2);
    for (int axis = 2; axis >= 0; --axis) EXPECT_EQ(drawn[axis], other.between(-2, 2)) << axis;
    // Each draw of a centre takes z, then y, then x. A draw outside the wedge is thrown away.
    const Scene scene = scene_of();
    const Vec3 first = place_in_layers(scene).place[0].position;
    const FreeSpace space(scene);
    const Vec3 &low = space.low(), &high = space.high();
    Random centres(scene.run.seed, Stream::centres);
    int draws = 0;
    for (bool found = false; !found; ++draws) {
        ASSERT_LT(draws, 100) << "no draw gives the first grain's place";
        centres.uniform();
        const double y = centres.between(low.y(), high.y()), x = centres.between(low.x(), high.x());
        found = first.y() == y && first.x() == x;
    }
}

TEST(Layers, StartInFrontOfTheScenesOwnPlanes) {
    Scene scene = scene_of();
    ScenePlane plane;
    plane.point = Vec3(0, 0, 0.03);
    plane.normal = Vec3(0.1, 0.5, 1).normalized();
    scene.walls = {plane};
    const Grains grains = place_in_layers(scene);
    ASSERT_EQ(grains.size(), 280u);
    for (std::size_t i = 0; i < grains.size(); ++i)
        EXPECT_GT(plane.normal.dot(grains.place[i].position - plane.point), 0);
}

TEST(RadiusGrowth, EndsWithoutOverlapInsideTheAskedRange) {
    for (const auto& sets : {std::vector<std::string>{}, {kPeriodic, kDeeper}}) {
        const Scene scene = scene_of(sets);
        const Plan plan = make_plan(scene);
        Surroundings around;
        around.faces = container_faces(scene.container, scene.drive);
        around.period = period_of_depth(scene.container);
        around.skin = 0.0005;
        Grains grains = place_in_layers(scene);
        Team team(1);
        const GrowthReport report =
            grow_radii(scene, plan, around, grains, team, [](double, std::int64_t) { return true; });
        EXPECT_TRUE(report.finished);
        for (std::size_t i = 0; i < grains.size(); ++i) {
            const SizeSpread& spread = scene.species[grains.species[i]].diameter;
            EXPECT_GE(2 * grains.place[i].radius, spread.smallest * (1 - 1e-12));
            EXPECT_LE(2 * grains.place[i].radius, spread.largest * (1 + 1e-12));
            for (std::size_t j = 0; j < i; ++j) {
                Vec3 apart = grains.place[i].position - grains.place[j].position;
                apart.x() = nearest_image(apart.x(), around.period);
                EXPECT_GE(apart.norm(), grains.place[i].radius + grains.place[j].radius);
            }
            for (const Face& face : around.faces) {
                EXPECT_GE(distance_to(face, Vec3::Zero(), grains.place[i].position).distance,
                          grains.place[i].radius);
            }
        }
    }
}

TEST(Settling, BringsTheBedToRestOnTheFloor) {
    const Scene scene = scene_of({kFullSettling});
    const Plan plan = make_plan(scene);
    SimulatedBed simulation(scene, plan, 1);
    const PackingResult result = simulation.pack();
    EXPECT_TRUE(result.settled);
    EXPECT_EQ(simulation.step(), 0);
    // The walls carry the weight: the vertical force between grains and walls is the bed's weight.
    double weight = 0, carried = 0;
    const State frame = simulation.frame();
    for (std::size_t i = 0; i < frame.size(); ++i) weight += sphere_mass(frame.radius[i]) * 9.81;
    const auto faces = container_faces(scene.container, scene.drive);
    for (const auto& c : simulation.contacts()) {
        if (c.second >= 0) continue;
        carried += c.normal * faces[-1 - c.second].normal.z() - c.tangential.z();
    }
    EXPECT_NEAR(carried, weight, 0.01 * weight);
}

using Bodies = std::set<std::pair<std::int32_t, std::int32_t>>;  // ids, or -1 - face for the second

Bodies reported_contacts(const SimulatedBed& simulation) {
    Bodies bodies;
    for (const auto& c : simulation.contacts())
        bodies.insert({c.second >= 0 ? std::max(c.first, c.second) : c.first,
                       c.second >= 0 ? std::min(c.first, c.second) : c.second});
    return bodies;
}

// The bodies that overlap and that spring and dashpot push apart.
Bodies pushed_bodies(const Scene& scene, const Plan& plan, const State& f) {
    const double period = period_of_depth(scene.container);
    const std::vector<Face> faces = container_faces(scene.container, scene.drive);
    const auto push = [](const PairPlan& pair, double overlap, double closing_speed, double effective_mass) {
        return overlap > 0 && pair.loading_stiffness * overlap +
                                      pair.damping_rate(effective_mass) * effective_mass * closing_speed >
                                  0;
    };
    const auto mass = [&](std::size_t i) { return sphere_mass(f.radius[i]); };
    Bodies bodies;
    for (std::size_t i = 0; i < f.size(); ++i) {
        for (std::size_t j = 0; j < i; ++j) {
            Vec3 apart = f.position[i] - f.position[j];
            apart.x() = nearest_image(apart.x(), period);
            const double closing = apart.normalized().dot(f.velocity[j] - f.velocity[i]);
            if (push(plan.grain[f.species[i] * scene.species.size() + f.species[j]],
                     f.radius[i] + f.radius[j] - apart.norm(), closing,
                     mass(i) * mass(j) / (mass(i) + mass(j))))
                bodies.insert({f.id[i], f.id[j]});
        }
        for (std::size_t k = 0; k < faces.size(); ++k) {
            const FaceDistance at = distance_to(faces[k], f.container().place, f.position[i]);
            const double closing = at.normal.dot(f.container().velocity - f.velocity[i]);
            if (push(plan.wall[f.species[i]], f.radius[i] - at.distance, closing, mass(i)))
                bodies.insert({f.id[i], -1 - static_cast<std::int32_t>(k)});
        }
    }
    return bodies;
}

TEST(Contacts, AreThoseOfASearchOverAllPairs) {
    for (const auto& place : {std::vector<std::string>{}, {kPeriodic, kDeeper}}) {
        std::vector<std::string> sets{"contact.law=spring-dashpot", "contact.restitution=0.3"};
        sets.insert(sets.end(), place.begin(), place.end());
        const Scene scene = scene_of(sets);
        const Plan plan = make_plan(scene);
        SimulatedBed simulation = packed(scene, plan, 2);
        simulation.advance(100);  // the floor has begun to push
        const Bodies reported = reported_contacts(simulation);
        EXPECT_GT(reported.size(), 50u);
        EXPECT_TRUE(
            std::any_of(reported.begin(), reported.end(), [](const auto& c) { return c.second < 0; }));
        EXPECT_EQ(reported, pushed_bodies(scene, plan, simulation.frame()));
    }
}

TEST(StepLoop, TouchesExactlyThePairsAllPairsSearchFinds) {
    for (const double period : {0.0, 0.02}) {
        HandMadeBed w = make_world(walton_braun_pair(0.9, 0.3), 1e-5);
        w.around.period = period;
        w.around.skin = 0.0006;
        std::srand(3);
        const auto random = [](double half) { return half * (2.0 * std::rand() / RAND_MAX - 1); };
        for (int k = 0; k < 400; ++k) {
            const double r = k % 10 == 0 ? 0.002 : 0.0007;
            w.grains.add(k, 0, Vec3(random(0.01), random(0.012), random(0.006)), r, kDensity);
        }
        w.start();
        std::size_t expected = 0, found = 0;
        for (std::size_t i = 0; i < w.grains.size(); ++i) {
            for (std::size_t j = 0; j < i; ++j) {
                Vec3 apart = w.grains.place[i].position - w.grains.place[j].position;
                apart.x() = nearest_image(apart.x(), period);
                expected += apart.norm() < w.grains.place[i].radius + w.grains.place[j].radius;
            }
        }
        w.loop->visit_contacts(0, [&](const ContactView&) { ++found; });
        ASSERT_GT(expected, 100u);
        EXPECT_EQ(found, expected) << "period " << period;
    }
}

TEST(Determinism, PacksTheSameBedOnAnyNumberOfThreads) {
    const Scene scene = scene_of({"start.settle_limit=\"0.01 s\""});
    const Plan plan = make_plan(scene);
    EXPECT_EQ(packed(scene, plan, 3).state_hash(), packed(scene, plan, 1).state_hash());
}

TEST(Determinism, SameBitsOnAnyNumberOfThreads) {
    const test::TemporaryFolder folder;
    for (const char* law : {"walton-braun", "spring-dashpot"}) {
        const Scene scene = scene_of({std::string("contact.law=\"") + law + "\""});
        const Plan plan = make_plan(scene);
        const auto packing = folder / "packed.grs";
        packed(scene, plan, 1).save_checkpoint(packing);
        std::uint64_t first = 0;
        std::vector<SavedContact> contacts;
        std::pair<double, double> energies;
        for (const int threads : {1, 2, 3}) {
            SimulatedBed simulation = gone_on(scene, plan, packing, threads);
            simulation.advance(plan.clock.steps_per_period);
            if (threads == 1) first = simulation.state_hash(), contacts = simulation.contacts();
            EXPECT_EQ(simulation.state_hash(), first) << law << " on " << threads << " threads";
            ASSERT_GT(contacts.size(), 100u);
            EXPECT_EQ(simulation.contacts(), contacts) << law << " on " << threads << " threads";
            const std::pair now(simulation.measure("elastic_J"), simulation.measure("lost_J"));
            if (threads == 1) energies = now;
            EXPECT_EQ(now, energies) << law << " on " << threads << " threads";
        }
    }
}

TEST(Determinism, SeedsDiffer) {
    const Scene one = scene_of(), two = scene_of({"run.seed=2"});
    EXPECT_NE(place_in_layers(one).place[0].position, place_in_layers(two).place[0].position);
}

TEST(Checkpoint, GoesOnBitByBit) {
    const test::TemporaryFolder folder;
    for (const char* law : {"walton-braun", "spring-dashpot"}) {
        const Scene scene = scene_of({std::string("contact.law=\"") + law + "\""});
        const Plan plan = make_plan(scene);
        SimulatedBed whole = packed(scene, plan, 1);
        whole.advance(1234);
        const auto file = folder / "go-on.grs";
        whole.save_checkpoint(file);
        whole.advance(4321);
        SimulatedBed second = gone_on(scene, plan, file, 2);
        EXPECT_EQ(second.step(), 1234);
        second.advance(4321);
        EXPECT_EQ(second.state_hash(), whole.state_hash()) << law;
        EXPECT_EQ(second.measure("lost_J"), whole.measure("lost_J"));
    }
}

TEST(Checkpoint, RefusesAnotherPlanAndADamagedFile) {
    const test::TemporaryFolder folder;
    const Scene scene = scene_of();
    SimulatedBed simulation = packed(scene, make_plan(scene), 1);
    const auto file = folder / "refuse.grs";
    simulation.save_checkpoint(file);
    const auto message = [&](const Scene& s) {
        try {
            gone_on(s, make_plan(s), file, 1);
        } catch (const UserError& e) {
            return std::string(e.what());
        }
        return std::string("accepted");
    };
    EXPECT_EQ(message(scene), "accepted");
    EXPECT_NE(message(scene_of({"contact.friction=0.1"}))
                  .find("friction' of [\"small\", \"small\"] is 0.1, but it was 0.4"),
              std::string::npos);
    std::filesystem::resize_file(file, std::filesystem::file_size(file) - 8);
    EXPECT_NE(message(scene).find("is damaged"), std::string::npos);
}

// Perfectly elastic grains without friction lose nothing, so their energy is what the walls put in.
TEST(Energy, WallWorkIsWhatElasticGrainsGain) {
    const Scene scene = scene_of({"contact.restitution=1", "contact.friction=0", "run.steps_per_contact=12",
                                  "start.settle_damping=20"});
    const Plan plan = make_plan(scene);
    SimulatedBed simulation = packed(scene, plan, 1);
    simulation.advance(3 * plan.clock.steps_per_period);
    const double work = simulation.measure("wall_work_J");
    ASSERT_GT(std::abs(work), 1e-4);
    EXPECT_LT(std::abs(simulation.measure("lost_J")), 0.01 * std::abs(work));
}

// In a container at rest the sum of kinetic, gravity and recoverable elastic energy never rises beyond the
// error of the step.
TEST(Energy, NeverRisesInAStillContainer) {
    const Scene scene = scene_of();
    const Plan plan = make_plan(scene);
    HandMadeBed w;
    w.plan = plan;
    w.around.faces = container_faces(scene.container, Drive{});
    w.around.gravity = scene.gravity;
    w.around.skin = 0.0005;
    w.grains = place_in_layers(scene);
    grow_radii(scene, plan, w.around, w.grains, *w.team, [](double, std::int64_t) { return true; });
    w.start();
    const double fall = w.energy();
    double lowest = fall, worst = 0;
    for (int k = 0; k < 300; ++k) {
        w.run(50);
        worst = std::max(worst, w.energy() - lowest);
        lowest = std::min(lowest, w.energy());
    }
    ASSERT_LT(lowest, 0.8 * fall) << "the bed should have fallen";
    EXPECT_LT(worst, 1e-3 * (fall - lowest));
}

TEST(Health, StopsARunWhoseStepIsTooLong) {
    const Scene scene = scene_of();
    const Plan good = make_plan(scene);
    Plan plan = good;
    plan.clock.step *= 12;
    plan.clock.steps_per_period = 0;
    plan.settle_steps_limit = 0;
    SimulatedBed simulation(scene, plan, 1);
    try {
        simulation.pack();
        simulation.advance(100000);
        FAIL() << "the run went on";
    } catch (const RunError& error) {
        EXPECT_NE(std::string(error.what()).find("step "), std::string::npos) << error.what();
        EXPECT_NE(std::string(error.what()).find("run.step"), std::string::npos) << error.what();
    }
}

}  // namespace
}  // namespace grainreel
