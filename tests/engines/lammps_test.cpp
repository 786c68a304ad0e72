// Decks as LAMMPS runs them, against closed forms. Skipped where there is no `lmp` (./test --peers installs
// it).
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "engine/run/simulation/simulated_bed.hpp"
#include "engine/state/drive_motion.hpp"
#include "tests/engines/handed.hpp"
#include "tests/support/small_scene.hpp"
#include "tests/support/temporary_folder.hpp"

namespace grainreel {
namespace {

struct ScriptRun {
    CarriedScene carried;
    std::map<std::int64_t, State> dump;
    int status = 0;
    std::string words;  // of the engine
};

// Hands a scene over and runs it by the script that lies in the folder.
ScriptRun run_on_lammps(const std::string& text) {
    const test::TemporaryFolder folder;
    ScriptRun run;
    run.carried = test::hand_over(text, {}, folder.path());
    run.status = std::system(("sh " + (folder / "run.sh").string() + " 2> /dev/null").c_str());
    run.words = test::text_of(folder / "out.lammps");
    run.dump = test::frames_of(PeerEngine::lammps, folder.path());
    return run;
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
    NEEDS_ENGINE(PeerEngine::lammps);
    const ScriptRun run =
        run_on_lammps(one_ball("[0, 0, 0.05]",
                               "[drive]\nfrequency = \"50 Hz\"\namplitude = \"2 mm\"\ndirection = [0, "
                               "1, 2]\nramp = 0\nphase = 0.2\n",
                               "4 ms"));
    ASSERT_EQ(run.status, 0) << run.words;
    ASSERT_EQ(run.carried.frame, ReferenceFrame::container);
    const DriveMotion walls(run.carried.scene.drive, run.carried.plan.clock);
    ASSERT_GE(run.dump.size(), 10u);
    for (const auto& [step, grains] : run.dump) {
        const DrivePose pose = walls.at(step);
        const double t = pose.time;
        const Vec3 lab = grains.position.at(0) + pose.offset;
        EXPECT_NEAR((lab - Vec3(0, 0, 0.05 - 9.81 * t * t / 2)).norm(), 0, 1e-7) << t;
    }
}

// A plane that comes with speed U against a ball at rest leaves it with (1 + e) U.
TEST(OnLammps, AMovingPlaneKicksABall) {
    NEEDS_ENGINE(PeerEngine::lammps);
    const ScriptRun run = run_on_lammps(
        "gravity = 0\n" + one_ball("[0, 0, 0.05]",
                                   "[[wall]]\nname = \"piston\"\npoint = [0.004, 0, 0]\nnormal = [-1, 0, 0]\n"
                                   "velocity = [-0.3, 0, 0]\n",
                                   "8 ms", "duration = \"8 ms\"\nstep = 1e-7\n"));
    ASSERT_EQ(run.status, 0) << run.words;
    EXPECT_NEAR(run.dump.rbegin()->second.velocity.at(0).x() / -(1.6 * 0.3), 1, 1e-4);
}

// A plane that slides under a ball drags it with mu g until it rolls; then it goes with 2/7 of the plane's
// speed.
TEST(OnLammps, ASlidingPlaneDragsABall) {
    NEEDS_ENGINE(PeerEngine::lammps);
    const double radius = 0.0025, mass = 4.0 / 3 * 3.14159265358979 * radius * radius * radius * 2500;
    const double height = 0.01 + radius - mass * 9.81 / 20000;  // at rest on it
    const ScriptRun run = run_on_lammps(one_ball(
        fmt::format("[0, 0, {}]", height),
        "[[wall]]\nname = \"belt\"\npoint = [0, 0, 0.01]\nnormal = [0, 0, 1]\nvelocity = [0.2, 0, 0]\n",
        "2 ms"));
    ASSERT_EQ(run.status, 0) << run.words;
    const std::int64_t ms = std::llround(1e-3 / run.carried.step);
    const auto speed = [&](std::int64_t time) {
        return run.dump.lower_bound(time * ms)->second.velocity.at(0).x();
    };
    const auto when = [&](std::int64_t time) {
        return static_cast<double>(run.dump.lower_bound(time * ms)->first) * run.carried.step;
    };
    EXPECT_NEAR((speed(8) - speed(2)) / (when(8) - when(2)) / (0.5 * 9.81), 1, 1e-4);
    EXPECT_NEAR(speed(38) / 0.2, 2.0 / 7, 1e-3);
}

// A hundred grains in every container that is carried: none is lost, none sinks into a wall.
std::string bed(const std::string& container, const std::string& more = "") {
    return test::SmallScene()
               .beads(100, "ball", "3.8 mm to 4.2 mm")
               .more("[contact]\nlaw = \"spring-dashpot\"\nstiffness = 3000\nrestitution = 0.7\n")
               .more("[container]\n")
               .text() +
           container + "[run]\nduration = \"0.1 s\"\n[output]\ntrajectory_interval = \"20 ms\"\n" + more;
}

void expect_sound(const std::string& text, std::size_t grains = 100) {
    const ScriptRun run = run_on_lammps(text);
    ASSERT_EQ(run.status, 0) << run.words;
    ASSERT_EQ(run.dump.size(), run.carried.dumps.size());
    const auto& last = run.dump.rbegin()->second;
    EXPECT_EQ(last.size(), grains);
    // Overlaps stay far below the radius.
    const DriveMotion walls(run.carried.scene.drive, run.carried.plan.clock);
    DrivePose pose = walls.at(run.dump.rbegin()->first);
    if (run.carried.frame == ReferenceFrame::container) pose = DrivePose();
    for (std::size_t i = 0; i < last.size(); ++i)
        for (const Face& face : run.carried.faces)
            EXPECT_GT(distance_at(face, pose, last.position[i]).distance, 0.0019 * 0.9)
                << last.id[i] << " " << face.name;
}

const std::string shaken = "[drive]\nfrequency = \"30 Hz\"\ng_level = 2\n";

TEST(OnLammps, BedsStayInTheirContainers) {
    NEEDS_ENGINE(PeerEngine::lammps);
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
    NEEDS_ENGINE(PeerEngine::lammps);
    const ScriptRun run =
        run_on_lammps(bed("shape = \"box\"\nwidth = \"30 mm\"\ndepth = \"20 mm\"\nheight = \"80 mm\"\n"
                          "outlet = { width = \"14 mm\", opens = \"20 ms\", exit_depth = \"20 mm\" }\n"));
    ASSERT_EQ(run.status, 0) << run.words;
    EXPECT_EQ(run.dump.begin()->second.size(), 100u);
    SimulatedBed ours(run.carried.scene, run.carried.plan, 1);
    ours.pack();
    ours.advance(run.carried.last);
    const auto left = static_cast<double>(run.dump.rbegin()->second.size());
    EXPECT_LT(ours.grains(), 90u);
    EXPECT_NEAR(left, static_cast<double>(ours.grains()), 8);
}

}  // namespace
}  // namespace grainreel
