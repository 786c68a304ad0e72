// Decks as LAMMPS runs them, against closed forms. Skipped where there is no `lmp` (./test --peers installs
// it).
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "tests/engines/peer_run.hpp"

namespace grainreel {
namespace {

#define NEEDS_LAMMPS() \
    if (!test::has_lammps()) GTEST_SKIP() << "lmp is not installed"

// Lanes along y: two of A, A and B, two of B, A and B each against the back wall.
std::string impacts(const std::string& law) {
    return law + R"(
[[species]]
name = "A"
diameter = "2 mm"
density = 2500
[[species]]
name = "B"
diameter = "6 mm"
density = 2500
[container]
shape = "box"
width = "80 mm"
depth = "60 mm"
height = "40 mm"
[start]
method = "grains"
[[grain]]
species = "A"
position = [-0.0011, -0.03, 0.02]
velocity = [0.25, 0, 0]
[[grain]]
species = "A"
position = [0.0011, -0.03, 0.02]
velocity = [-0.25, 0, 0]
[[grain]]
species = "A"
position = [-0.0022, -0.015, 0.02]
velocity = [0.5, 0, 0]
[[grain]]
species = "B"
position = [0.0020, -0.015, 0.02]
[[grain]]
species = "B"
position = [-0.0031, 0, 0.02]
velocity = [0.25, 0, 0]
[[grain]]
species = "B"
position = [0.0031, 0, 0.02]
velocity = [-0.25, 0, 0]
[[grain]]
species = "A"
position = [-0.0288, 0.015, 0.02]
velocity = [-0.5, 0, 0]
[[grain]]
species = "B"
position = [-0.0268, 0.03, 0.02]
velocity = [-0.5, 0, 0]
[run]
duration = "6 ms"
step = 4e-7
[output]
trajectory_interval = "6 ms"
)";
}

// Of AA, AB, BB, A-wall and B-wall. All impacts are at 0.5 m/s.
std::vector<double> restitutions(const test::PeerRun& run) {
    const auto& after = run.dump.rbegin()->second;
    const auto speed = [&](std::int64_t id) { return after.at(id).velocity.x(); };
    return {(speed(2) - speed(1)) / 0.5, (speed(4) - speed(3)) / 0.5, (speed(6) - speed(5)) / 0.5,
            speed(7) / 0.5, speed(8) / 0.5};
}

constexpr const char* pairs = R"(
[contact.wall]
restitution = 0.6
[[contact.pair]]
between = ["A", "A"]
restitution = 0.9
[[contact.pair]]
between = ["A", "B"]
restitution = 0.8
[[contact.pair]]
between = ["B", "B"]
restitution = 0.7
[[contact.pair]]
between = ["B", "wall"]
restitution = 0.5
)";

void expect_restitutions(const std::string& contact) {
    const test::PeerRun run =
        test::run_on_lammps(impacts("gravity = 0\n[contact]\nfriction = 0.3\n" + contact + pairs));
    ASSERT_EQ(run.status, 0) << run.words;
    const std::vector<double> found = restitutions(run), wanted = {0.9, 0.8, 0.7, 0.6, 0.5};
    for (std::size_t i = 0; i < wanted.size(); ++i)
        EXPECT_NEAR(found[i], wanted[i], 0.003) << i << " " << contact;
}

TEST(OnLammps, ImpactsHaveTheirRestitution) {
    NEEDS_LAMMPS();
    expect_restitutions("law = \"spring-dashpot\"\nstiffness = 10000\n");
    expect_restitutions("law = \"spring-dashpot\"\nstiffness = 10000\nattraction = true\n");
}

TEST(OnLammps, ImpactsOfHertzHaveTheirRestitution) {
    NEEDS_LAMMPS();
    expect_restitutions("law = \"hertz\"\nmodulus = 2e7\nattraction = true\n");
    expect_restitutions("law = \"hertz\"\nmodulus = 2e7\n");
}

// One ball. Gravity 9.81 m/s2.
std::string one_ball(const std::string& place, const std::string& more, const std::string& output,
                     const std::string& run = "duration = \"40 ms\"\nstep = 1e-6\n") {
    return R"(
[[species]]
name = "ball"
diameter = "5 mm"
density = 2500
[contact]
law = "spring-dashpot"
restitution = 0.6
friction = 0.5
stiffness = 20000
[container]
shape = "box"
width = "80 mm"
depth = "80 mm"
height = "100 mm"
[start]
method = "grains"
[[grain]]
position = )" +
           place + "\n" + more + "[run]\n" + run + "[output]\ntrajectory_interval = \"" + output + "\"\n";
}

// It touches nothing, so in the lab it falls freely: z = z0 - g t^2 / 2.
TEST(OnLammps, AFreeGrainFallsFreelyInTheFrameOfItsContainer) {
    NEEDS_LAMMPS();
    const test::PeerRun run =
        test::run_on_lammps(one_ball("[0, 0, 0.05]",
                                     "[drive]\nfrequency = \"50 Hz\"\namplitude = \"2 mm\"\ndirection = [0, "
                                     "1, 2]\nramp = 0\nphase = 0.2\n",
                                     "4 ms"));
    ASSERT_EQ(run.status, 0) << run.words;
    ASSERT_EQ(run.carried.frame, RunFrame::container);
    const WallMotion walls(run.carried.scene.drive, run.carried.plan.clock);
    ASSERT_GE(run.dump.size(), 10u);
    for (const auto& [step, grains] : run.dump) {
        const Pose pose = walls.at(step);
        const double t = pose.time;
        const Vec3 lab = grains.at(1).position + pose.offset;
        EXPECT_NEAR((lab - Vec3(0, 0, 0.05 - 9.81 * t * t / 2)).norm(), 0, 1e-7) << t;
    }
}

// A plane that comes with speed U against a ball at rest leaves it with (1 + e) U.
TEST(OnLammps, AMovingPlaneKicksABall) {
    NEEDS_LAMMPS();
    const test::PeerRun run = test::run_on_lammps(
        "gravity = 0\n" + one_ball("[0, 0, 0.05]",
                                   "[[wall]]\nname = \"piston\"\npoint = [0.004, 0, 0]\nnormal = [-1, 0, 0]\n"
                                   "velocity = [-0.3, 0, 0]\n",
                                   "8 ms", "duration = \"8 ms\"\nstep = 1e-7\n"));
    ASSERT_EQ(run.status, 0) << run.words;
    EXPECT_NEAR(run.dump.rbegin()->second.at(1).velocity.x() / -(1.6 * 0.3), 1, 1e-4);
}

// A plane that slides under a ball drags it with mu g until it rolls; then it goes with 2/7 of the plane's
// speed.
TEST(OnLammps, ASlidingPlaneDragsABall) {
    NEEDS_LAMMPS();
    const double radius = 0.0025, mass = 4.0 / 3 * 3.14159265358979 * radius * radius * radius * 2500;
    const double height = 0.01 + radius - mass * 9.81 / 20000;  // at rest on it
    const test::PeerRun run = test::run_on_lammps(one_ball(
        fmt::format("[0, 0, {}]", height),
        "[[wall]]\nname = \"belt\"\npoint = [0, 0, 0.01]\nnormal = [0, 0, 1]\nvelocity = [0.2, 0, 0]\n",
        "2 ms"));
    ASSERT_EQ(run.status, 0) << run.words;
    const std::int64_t ms = std::llround(1e-3 / run.carried.step);
    const auto speed = [&](std::int64_t time) {
        return run.dump.lower_bound(time * ms)->second.at(1).velocity.x();
    };
    const auto when = [&](std::int64_t time) {
        return static_cast<double>(run.dump.lower_bound(time * ms)->first) * run.carried.step;
    };
    EXPECT_NEAR((speed(8) - speed(2)) / (when(8) - when(2)) / (0.5 * 9.81), 1, 1e-4);
    EXPECT_NEAR(speed(38) / 0.2, 2.0 / 7, 1e-3);
}

// A hundred grains in every container that is carried: none is lost, none sinks into a wall.
std::string bed(const std::string& container, const std::string& more = "") {
    return R"(
[[species]]
name = "ball"
count = 100
diameter = { min = "3.8 mm", max = "4.2 mm" }
density = 2500
[contact]
law = "spring-dashpot"
stiffness = 3000
restitution = 0.7
[container]
)" + container +
           "[run]\nduration = \"0.1 s\"\n[output]\ntrajectory_interval = \"20 ms\"\n" + more;
}

void expect_sound(const std::string& text, std::size_t grains = 100) {
    const test::PeerRun run = test::run_on_lammps(text);
    ASSERT_EQ(run.status, 0) << run.words;
    ASSERT_EQ(run.dump.size(), run.carried.dumps.size());
    const auto& last = run.dump.rbegin()->second;
    EXPECT_EQ(last.size(), grains);
    // Overlaps stay far below the radius.
    const WallMotion walls(run.carried.scene.drive, run.carried.plan.clock);
    Pose pose = walls.at(run.dump.rbegin()->first);
    if (run.carried.frame == RunFrame::container) pose = Pose();
    for (const auto& [id, grain] : last)
        for (const Face& face : run.carried.faces)
            EXPECT_GT(distance_at(face, pose, grain.position).distance, 0.0019 * 0.9)
                << id << " " << face.name;
}

const std::string shaken = "[drive]\nfrequency = \"30 Hz\"\ng_level = 2\n";

TEST(OnLammps, BedsStayInTheirContainers) {
    NEEDS_LAMMPS();
    expect_sound(
        bed("shape = \"wedge\"\nhalf_angle = \"25 deg\"\nslant_height = \"15 mm\"\nhalf_width = \"20 "
            "mm\"\ndepth = \"20 mm\"\nheight = \"80 mm\"\n",
            shaken));
    expect_sound(bed(
        "shape = \"box\"\nwidth = \"30 mm\"\ndepth = \"20 mm\"\nheight = \"80 mm\"\nperiodic_depth = true\n",
        shaken));
    expect_sound(bed("shape = \"box\"\nwidth = \"30 mm\"\ndepth = \"20 mm\"\nheight = \"80 mm\"\n",
                     shaken + "moves = \"floor\"\n"));
    expect_sound(bed("shape = \"cylinder\"\ndiameter = \"30 mm\"\nheight = \"80 mm\"\n", shaken));
    expect_sound(bed(
        "shape = \"cylinder\"\ndiameter = \"30 mm\"\nheight = \"80 mm\"\nturn = { axis = [0, 0, 1], rate = "
        "\"30 rpm\" }\n"));
    expect_sound(bed(
        "shape = \"box\"\nwidth = \"30 mm\"\ndepth = \"20 mm\"\nheight = \"80 mm\"\nwall_grains = { faces = "
        "[\"floor\"] }\n",
        shaken));
}

// Both runs begin with the same grains in the same places; all but those on the floor beside the slot leave.
TEST(OnLammps, AnOutletOpensAndLetsAsManyGrainsOutAsOurs) {
    NEEDS_LAMMPS();
    const test::PeerRun run = test::run_on_lammps(
        bed("shape = \"box\"\nwidth = \"30 mm\"\ndepth = \"20 mm\"\nheight = \"80 mm\"\n"
            "outlet = { width = \"14 mm\", opens = \"20 ms\", exit_depth = \"20 mm\" }\n"));
    ASSERT_EQ(run.status, 0) << run.words;
    EXPECT_EQ(run.dump.begin()->second.size(), 100u);
    Simulation ours(run.carried.scene, run.carried.plan, 1);
    ours.pack();
    ours.advance(run.carried.last);
    const auto left = static_cast<double>(run.dump.rbegin()->second.size());
    EXPECT_LT(ours.grains(), 90u);
    EXPECT_NEAR(left, static_cast<double>(ours.grains()), 8);
}

}  // namespace
}  // namespace grainreel
