// Tests of grains glued to walls: where they are, how a grain bounces off them, and what they leave
// unchanged.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "engine/measure/columns.hpp"
#include "engine/measure/energy.hpp"
#include "engine/measure/walls/wall_faces.hpp"
#include "engine/run/simulation/simulated_bed.hpp"
#include "engine/scene/scene_file.hpp"
#include "engine/start/restart.hpp"
#include "engine/state/container_faces.hpp"
#include "engine/step/surroundings.hpp"
#include "tests/physics/world.hpp"
#include "tests/support/small_scene.hpp"
#include "tests/support/temporary_folder.hpp"

namespace grainreel {
namespace {

const std::string kWedge = test::SmallScene()
                               .beads(90, "small", "2.8 mm to 3.2 mm")
                               .beads(6, "big", "4.5 mm to 5.5 mm")
                               .contacts("0.7", "0.4")
                               .wedge("20 deg", "20 mm", "18 mm", "16 mm", "40 mm")
                               .more(
                                   "wall_grains = { species = \"big\", faces = [\"left_slant\", "
                                   "\"right_slant\", \"floor\", \"front\"] }\n")
                               .shaken("40 Hz", "4")
                               .lasts("0.05 s")
                               .more("[start]\nsettle_limit = \"0.02 s\"\n")
                               .text();

Scene scene_of(std::vector<std::string> sets = {}) {
    return read_scene_text(kWedge, "rough.toml", with_tested_precision(std::move(sets)), measurable_in);
}

// Returns a scene with the same grains in a cylinder.
std::string in_a_cylinder() {
    std::string text = kWedge;
    const std::size_t from = text.find("shape"), to = text.find("[drive]");
    return text.replace(from, to - from, R"(shape = "cylinder"
diameter = "36 mm"
height = "40 mm"
wall_grains = { species = "big", faces = ["wall", "floor"] }
outlet = { diameter = "10 mm" }
)");
}

// Distance from the opening: a slot is as long as the container is deep, and a hole is round.
double from_opening(const Scene& scene, const Vec3& at) {
    const Outlet& outlet = *scene.container.outlet;
    const bool slot = outlet.shape == Outlet::Shape::slot;
    return (slot ? std::abs(at.y()) : std::hypot(at.x(), at.y())) - outlet.half_width;
}

TEST(RoughWalls, GluedGrainsStandInTheirFacesAndInsideTheContainer) {
    for (const Scene& scene : {scene_of(), scene_of({"container.outlet={width=\"6 mm\"}"}),
                               read_scene_text(in_a_cylinder(), "rough.toml", with_tested_precision({}))}) {
        const std::vector<Face> faces = faces_of(scene);
        const GluedGrains glued = glue_grains(scene, faces);
        std::vector<int> on(faces.size());
        for (std::size_t g = 0; g < glued.size(); ++g) {
            const Vec3 at = glued.centre(g, faces, {});
            const auto own = static_cast<std::size_t>(glued.face[g]);
            ++on[own];
            EXPECT_NEAR(distance_to(faces[own], Vec3::Zero(), at).distance, 0, 1e-15) << faces[own].name;
            for (const Face& face : faces)
                EXPECT_GT(distance_to(face, Vec3::Zero(), at).distance, -1e-15) << face.name;
            EXPECT_GE(glued.place[g].radius, 2.25e-3);
            EXPECT_LE(glued.place[g].radius, 2.75e-3);
            if (scene.container.outlet && faces[own].name == "floor") {
                EXPECT_GE(from_opening(scene, at), glued.place[g].radius - 1e-15);
            }
        }
        const std::vector<std::string>& rough = scene.container.wall_grains->faces;
        for (std::size_t f = 0; f < faces.size(); ++f) {
            const bool asked = std::find(rough.begin(), rough.end(), faces[f].name) != rough.end();
            EXPECT_EQ(on[f] > 0, asked) << faces[f].name;
        }
    }
}

// In a triangular lattice each grain has the area sqrt(3) / 2 times the spacing squared.
TEST(RoughWalls, SpacingSaysHowManyThereAre) {
    for (const double spacing : {0.0008, 0.0015, 0.004}) {
        const Scene scene = scene_of({fmt::format("container.wall_grains.spacing={}", spacing),
                                      "container.wall_grains.faces=[\"right_slant\"]"});
        const double area = 0.016 * 0.02 / std::cos(std::numbers::pi / 9);
        const double expected = area / (std::sqrt(0.75) * spacing * spacing);
        EXPECT_NEAR(static_cast<double>(glue_grains(scene, faces_of(scene)).size()), expected,
                    0.2 * expected);
    }
}

TEST(RoughWalls, FollowTheSeed) {
    const auto places = [](const std::vector<std::string>& sets) {
        const Scene scene = scene_of(sets);
        return glue_grains(scene, faces_of(scene)).place;
    };
    const auto same = [](const LargeArray<Place>& a, const LargeArray<Place>& b) {
        return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](const Place& one, const Place& two) {
            return one.position == two.position && one.radius == two.radius;
        });
    };
    EXPECT_TRUE(same(places({}), places({})));
    EXPECT_FALSE(same(places({}), places({"run.seed=2"})));
    // A face has the same glued grains whatever other faces have some.
    const auto alone = places({"container.wall_grains.faces=[\"floor\"]"}), all = places({});
    EXPECT_TRUE(same(alone, LargeArray<Place>(all.begin(), all.begin() + std::ssize(alone))));
}

// A world of one free grain and one that is glued to a plane far below.
HandMadeBed beside_glued(const PairPlan& pair, double step, const Vec3& from, const Vec3& velocity,
                         NormalForce normal = NormalForce::walton_braun,
                         TangentialLaw tangential = TangentialLaw::incremental_slip) {
    HandMadeBed w = make_world(pair, step, normal, tangential);
    w.plan.glued = w.plan.wall;
    Face far_below = floor_face();
    far_below.point.z() = -1;
    w.around.faces = {far_below};
    w.around.glued.place.push_back({Vec3(0, 0, 1), 1.5 * kRadius});
    w.around.glued.face.push_back(0);
    w.grains.add(0, 0, from, kRadius, kDensity);
    w.start();
    w.grains.motion[0].velocity = velocity;
    w.loop->restart();
    return w;
}

// A head-on impact on a body that cannot move has v' = -e v after (pi / 2) (1 + e) sqrt(m / K1), with the
// whole mass of the grain.
TEST(RoughWalls, AGrainReboundsWithTheRestitutionOfThePair) {
    const double e = 0.6, speed = 0.3, natural = std::sqrt(sphere_mass() / kStiffness);
    const Vec3 along = Vec3(2, -1, 2) / 3;
    HandMadeBed w =
        beside_glued(walton_braun_pair(e, 0.3), natural / 400, 2.5 * kRadius * along, -speed * along);
    const double takes = std::numbers::pi / 2 * (1 + e) * natural;
    w.run(static_cast<std::int64_t>(0.98 * takes / w.plan.clock.step));
    int touching = 0;
    w.loop->visit_contacts(w.step, [&](const ContactView& c) {
        ++touching;
        EXPECT_EQ(c.second, -1) << "counts as the face";
        EXPECT_EQ(c.glued, 0);
        EXPECT_LT((c.normal + along).norm(), 1e-6);
    });
    EXPECT_EQ(touching, 1);
    w.run(static_cast<std::int64_t>(0.1 * takes / w.plan.clock.step));
    EXPECT_LT((w.velocity(0) - e * speed * along).norm(), of_rounding(1e-3, 2e-3) * speed);
    EXPECT_LT(w.spin(0).norm(), of_rounding(1e-6, 1e-4) * speed / kRadius);
    w.run(
        static_cast<std::int64_t>(2 * natural / w.plan.clock.step));  // until the residual overlap has ended
    w.loop->visit_contacts(w.step, [&](const ContactView&) { ADD_FAILURE() << "they have parted"; });
}

// An oblique impact is the same as one on a second grain that is so heavy that it stays in its place.
TEST(RoughWalls, AGrainBouncesAsOffAGrainOfInfiniteMass) {
    const double step = 0.02 * std::sqrt(sphere_mass() / kStiffness);
    const Vec3 from(0.8 * kRadius, -0.5 * kRadius, 2.4 * kRadius), velocity(-0.2, 0.35, -0.5);
    for (const LeverArms arms : {LeverArms::contact_plane, LeverArms::radius})
        for (const auto& [normal, tangential] :
             {std::pair{NormalForce::walton_braun, TangentialLaw::incremental_slip},
              {NormalForce::spring_dashpot, TangentialLaw::linear_spring},
              {NormalForce::hertz, TangentialLaw::mindlin}}) {
            PairPlan pair = walton_braun_pair(0.8, 0.4);
            pair.normal_damping = pair.tangential_damping = 500;
            pair.hertz_damping = 0.1, pair.modulus = 1e7, pair.tangential_ratio = 0.9;
            pair.rolling_friction = 0.05, pair.model.rolls = true;
            HandMadeBed glued = beside_glued(pair, step, from, velocity, normal, tangential);
            glued.plan.arms = arms;
            glued.start();
            HandMadeBed heavy = make_world(pair, step, normal, tangential);
            heavy.plan.arms = arms;
            heavy.grains.add(0, 0, from, kRadius, kDensity);
            heavy.grains.add(1, 0, Vec3(0, 0, 0), 1.5 * kRadius, 1e14 * kDensity);
            heavy.grains.motion[0].velocity = velocity;
            heavy.start();
            glued.grains.motion[0].spin = heavy.grains.motion[heavy.index_of(0)].spin = Vec3(30, -40, 20);
            glued.run(2000), heavy.run(2000);
            EXPECT_GT((glued.velocity(0) - velocity).norm(), 0.3) << "they have met";
            const double accuracy = of_rounding(1e-9, 1e-4);
            EXPECT_LT((glued.velocity(0) - heavy.velocity(0)).norm(), accuracy);
            EXPECT_LT((glued.position(0) - heavy.position(0)).norm(), kRadius * accuracy);
            EXPECT_LT((glued.spin(0) - heavy.spin(0)).norm(), accuracy / kRadius);
        }
}

// A wall that comes with speed V throws a grain at rest away with (1 + e) V, and the wall's work is the
// grain's energy.
TEST(RoughWalls, MoveAndWorkAsTheirWallDoes) {
    const double speed = 0.3, step = 0.01 * std::sqrt(sphere_mass() / kStiffness);
    HandMadeBed w =
        make_world(walton_braun_pair(1, 0), step, NormalForce::spring_dashpot, TangentialLaw::none);
    w.plan.glued = w.plan.wall;
    Face far_below = floor_face();
    far_below.point.z() = -1;
    far_below.body.velocity = Vec3(0, 0, speed);
    w.around.motion = DriveMotion(Drive{}, w.plan.clock);
    w.around.faces = {far_below};
    w.around.glued.place.push_back({Vec3(0, 0, 1), 1.5 * kRadius});
    w.around.glued.face.push_back(0);
    w.grains.add(0, 0, Vec3(0, 0, 2.6 * kRadius), kRadius, kDensity);
    w.start();
    w.run(static_cast<std::int64_t>(2 * kRadius / speed / step));
    EXPECT_NEAR(w.velocity(0).z(), 2 * speed, of_rounding(1e-3, 1e-3) * speed);
    EXPECT_NEAR(w.grains.wall_work[0], 0.5 * sphere_mass() * w.velocity(0).squaredNorm(),
                1e-3 * sphere_mass() * speed * speed);
}

// In a depth that repeats, a glued grain is met from both ends.
TEST(RoughWalls, AreMetAcrossThePeriod) {
    HandMadeBed w = beside_glued(walton_braun_pair(1, 0), 1e-6, Vec3(0, 0, 1), Vec3::Zero());
    w.around.period = 10 * kRadius;
    w.around.glued.place[0].position.x() = 4.5 * kRadius;
    w.grains.place[0].position = Vec3(-3.5 * kRadius, 0, 0);
    w.start();
    w.run(1);
    double overlap = 0;
    w.loop->visit_contacts(w.step, [&](const ContactView& c) { overlap = c.overlap; });
    EXPECT_NEAR(overlap, 0.5 * kRadius, 1e-3 * kRadius);
}

// However the bed is packed, no grain overlaps a glued one.
TEST(RoughWalls, NothingIsPackedIntoThem) {
    for (const char* method : {"layers", "rain"}) {
        const Scene scene = scene_of({fmt::format("start.method={}", method), "start.settle_limit=0.2 s"});
        const Plan plan = make_plan(scene);
        SimulatedBed run(scene, plan, 1);
        run.pack();
        const State frame = run.frame();
        ASSERT_EQ(frame.size(), 96u) << "glued grains do not count";
        const std::vector<Face> faces = faces_of(scene);
        const GluedGrains glued = glue_grains(scene, faces);
        int near = 0;
        for (std::size_t i = 0; i < frame.size(); ++i)
            for (std::size_t g = 0; g < glued.size(); ++g) {
                const double reach = frame.radius[i] + glued.place[g].radius,
                             distance = (frame.position[i] - glued.centre(g, faces, {})).norm();
                EXPECT_GT(distance, reach - 0.1 * frame.radius[i]);
                near += distance < 1.02 * reach;
            }
        EXPECT_GT(near, 20) << "the bed lies on them";
    }
}

TEST(RoughWalls, TheSameBitsAtAnyNumberOfThreadsAndThroughACheckpoint) {
    const test::TemporaryFolder here;
    const Scene scene = scene_of({"output.instruments=[\"walls\"]", "run.duration=0.02 s"});
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
        for (const char* column : {"left_slant_force_z_N", "floor_force_z_N", "front_moment_y_N.m"})
            EXPECT_EQ(whole.measure(column), first.measure(column)) << threads << column;
        EXPECT_EQ(whole.contacts(), first.contacts()) << threads;
        const Scene next = continued(scene, here / "a.grs");
        SimulatedBed taken_up(next, plan, threads);
        taken_up.pack();
        taken_up.advance(plan.steps);
        EXPECT_EQ(taken_up.state_hash(), first.state_hash()) << threads;
    }
}

// Only weight and walls, with their glued grains, change the momentum of the grains.
TEST(RoughWalls, TheirForcesAreThoseOfTheirFace) {
    const Scene scene = scene_of({"output.instruments=[\"walls\"]", "species.small.count=60"});
    const Plan plan = make_plan(scene);
    SimulatedBed run(scene, plan, 1);
    run.pack();
    double mass = 0;
    const auto momentum = [&] {
        Vec3 sum(0, 0, 0);
        const State frame = run.frame();
        mass = 0;
        for (std::size_t i = 0; i < frame.size(); ++i) {
            const double m = 2500 * 4.0 / 3 * std::numbers::pi * std::pow(frame.radius[i], 3);
            mass += m, sum += m * frame.velocity[i];
        }
        return sum;
    };
    const Vec3 before = momentum();
    Vec3 impulse(0, 0, 0);
    double at_slants = 0;
    for (int row = 1; row <= 16; ++row) {  // two periods
        const std::int64_t from = run.step();
        run.advance(std::llround(row * plan.measures_every));
        const double time = static_cast<double>(run.step() - from) * plan.clock.step;
        const Measures m = run.measures();
        for (const std::string& face : face_names(scene)) {
            impulse +=
                time * Vec3(m.at(face + "_force_x_N"), m.at(face + "_force_y_N"), m.at(face + "_force_z_N"));
            if (face == "left_slant") at_slants += std::abs(m.at(face + "_force_y_N"));
        }
    }
    const double time = plan.clock.time(run.step());
    const Vec3 expected = time * mass * scene.gravity - (momentum() - before);
    EXPECT_LT((impulse - expected).norm(), 1e-9 * mass * 9.81 * time);
    EXPECT_GT(at_slants, 0);
}

// The friction that a contact's force is reported with is that of the two grains, and not that of the wall.
TEST(RoughWalls, ContactsHaveTheFrictionOfTheGluedGrains) {
    const Scene scene = scene_of({"contact.wall.friction=0.05", "drive.g_level=1.5"});
    const Plan plan = make_plan(scene);
    SimulatedBed run(scene, plan, 1);
    run.pack();
    run.advance(plan.steps / 2);
    int beyond_the_walls = 0;
    for (const DetailedContact& contact : run.contact_forces()) {
        const double tangential = contact.tangential.norm();
        EXPECT_LE(tangential, (1 + 1e-5) * contact.friction * contact.normal_force);
        if (contact.second < 0 && tangential > 0.06 * contact.normal_force) ++beyond_the_walls;
    }
    EXPECT_GT(beyond_the_walls, 0);
}

// The energy balances term by term under the drive, in steps that are short against the integrator's own
// error. A grain often touches several glued grains of one face, each of which has an account of its own.
TEST(RoughWalls, EnergyBalances) {
    const Scene scene = scene_of({"run.steps_per_contact=60", "drive.direction=[0.3, 1, 0.5]"});
    HandMadeBed w;
    w.plan = make_plan(scene);
    w.around = make_surroundings(scene, w.plan);
    for (int i = 0; i < 16; ++i)
        w.grains.add(i, 0,
                     Vec3(3.3e-3 * (i % 3) - 4e-3, 3.3e-3 * (i / 3 % 3) - 3e-3, 0.006 + 3.3e-3 * (i / 9)),
                     1.5e-3, 2500);
    w.start();
    EnergyBalance balance(w.around, w.grains, *w.loop, w.step, w.plan.clock.step);
    double worst = 0;
    std::size_t touched = 0;
    while (w.step < w.plan.steps) {
        w.run(1);
        balance.note(w.step);
        worst = std::max(worst, std::abs(balance.residual()));
        if (w.step % 100 == 0)
            w.loop->visit_contacts(w.step, [&](const ContactView& c) { touched += c.glued >= 0; });
    }
    EXPECT_GT(touched, 20u) << "contacts seen";
    EXPECT_LT(worst, of_rounding(2e-3, 1e-2) * balance.terms().lost());
}

// Few grains lie in a thin layer, between the glued grains, so that they start small and light.
const std::string kFewInACylinder = test::SmallScene()
                                        .beads(6, "grains", "4 mm", "500")
                                        .cylinder("48 mm", "80 mm")
                                        .more("wall_grains = { species = \"grains\", faces = [\"floor\"] }\n")
                                        .more("[drive]\nfrequency = \"200 Hz\"\namplitude = \"0.7 mm\"\n")
                                        .more("[start]\nsettle_limit = \"1 ms\"\n")
                                        .lasts("0.02 s")
                                        .more("accuracy = \"draft\"\n")
                                        .text();

// Packs so many grains and looks at the health of the first step. Each grain must lie in the cylinder, and
// overlap no other body by more than a hundredth of its radius.
void expect_to_start(int grains, int seed, const char* face, const char* gravity) {
    const std::vector<std::string> sets{
        fmt::format("species.grains.count={}", grains), fmt::format("run.seed={}", seed),
        fmt::format("container.wall_grains.faces=[\"{}\"]", face), fmt::format("gravity={}", gravity)};
    const Scene scene =
        read_scene_text(kFewInACylinder, "few.toml", with_tested_precision(sets), measurable_in);
    const std::string what = fmt::format("{} grains, seed {}, {}, {} m/s2", grains, seed, face, gravity);
    SimulatedBed run(scene, make_plan(scene), 1);
    run.pack();
    const State frame = run.frame();
    for (std::size_t i = 0; i < frame.size(); ++i) {
        const Vec3& at = frame.position[i];
        EXPECT_LE(std::hypot(at.x(), at.y()), 0.024 - 0.99 * frame.radius[i]) << what;
        EXPECT_GE(at.z(), 0.99 * frame.radius[i]) << what;
        EXPECT_LE(at.z(), 0.08) << what;
    }
    for (const DetailedContact& contact : run.contact_forces())
        EXPECT_LT(contact.overlap, 1e-2 * contact.smaller_radius) << what;
    EXPECT_NO_THROW(run.advance(1)) << what;
}

TEST(RoughWalls, AFewGrainsStartBetweenGluedOnes) {
    for (int seed = 1; seed <= 60; ++seed)
        for (const char* face : {"floor", "wall"})
            expect_to_start(1 + seed % 12, seed, face, seed % 2 == 0 ? "0" : "9.81");
}

TEST(RoughWalls, AnyFewGrainsStartBetweenGluedOnesLong) {
    for (int seed = 1; seed <= 60; ++seed)
        for (int grains = 1; grains <= 12; ++grains)
            for (const char* face : {"floor", "wall"})
                for (const char* gravity : {"0", "9.81"}) expect_to_start(grains, seed, face, gravity);
}

}  // namespace
}  // namespace grainreel
