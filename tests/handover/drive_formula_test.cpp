// The drive as other engines are told it, against the motion of our own walls.
#include <gtest/gtest.h>

#include <cctype>
#include <limits>
#include <numbers>

#include "engine/handover/carry.hpp"
#include "engine/handover/drive_formula.hpp"
#include "engine/plan/damping.hpp"
#include "engine/plan/plan.hpp"
#include "engine/scene/scene_file.hpp"
#include "engine/state/drive_motion.hpp"
#include "tests/handover/peer_expression.hpp"
#include "tests/support/small_scene.hpp"

namespace grainreel {
namespace {

const std::string scene_text = test::SmallScene()
                                   .beads(1, "ball")
                                   .more("[contact]\nstiffness = 20000\n")
                                   .box("40 mm", "40 mm", "60 mm")
                                   .lasts("1.2 s")
                                   .more("[drive]\nfrequency = \"20 Hz\"\namplitude = \"1 mm\"\n")
                                   .more("direction = [1, 0, 2]\n")
                                   .text();

struct Motion {
    double shift, speed, ride;
};

Motion at(const DriveFormula& formula, double time) {
    test::PeerExpression::Values values{{"t", time}};
    for (const PeerVariable& one : formula.variables) {
        EXPECT_LT(one.expression.size(), 1000u);
        values[one.name] = test::PeerExpression::value(one.expression, values);
    }
    return {values.at("shift"), values.at("speed"), values.at("ride")};
}

void expect_our_motion(const std::string& more) {
    const Scene scene = read_scene_text(scene_text + more, "drive.toml");
    const Plan plan = make_plan(scene);
    const DriveMotion walls(scene.drive, plan.clock);
    const DriveFormula formula = drive_formula(scene.drive);
    const double omega = 2 * std::numbers::pi * 60;  // no stage is faster
    double farthest = 0;
    for (std::int64_t step = 0; step < plan.steps; step += plan.steps / 997) {
        const double time = plan.clock.time(step), dt = 1e-6;
        const Motion now = at(formula, time);
        const DrivePose pose = walls.at(step);
        farthest = std::max(farthest, std::abs(now.shift));
        // The stretches of ours begin at whole steps, so they may come a part of a step later.
        const double late = 1e-9 + 1e-6 * 0.002;
        ASSERT_NEAR((pose.offset - now.shift * scene.drive.direction).norm(), 0, late) << time << more;
        ASSERT_NEAR((pose.velocity - now.speed * scene.drive.direction).norm(), 0, late * omega)
            << time << more;
        if (time < dt) continue;
        const Motion before = at(formula, time - dt), after = at(formula, time + dt);
        ASSERT_NEAR(now.speed, (after.shift - before.shift) / (2 * dt), 2e-5) << time << more;
        ASSERT_NEAR(-now.ride, (after.speed - before.speed) / (2 * dt), 3e-2) << time << more;
    }
    EXPECT_GT(farthest, 0.5e-3);
}

TEST(DriveFormula, IsOurMotionWithARamp) {
    expect_our_motion("ramp = 4\nphase = 0.3\n");
}

TEST(DriveFormula, IsOurMotionWithoutARamp) {
    expect_our_motion("ramp = 0\nphase = 0.125\n");
}

TEST(DriveFormula, IsOurMotionInStages) {
    expect_our_motion(R"(ramp = 3
[[drive.stage]]
from = "0.3 s"
frequency = "35 Hz"
amplitude = "0.4 mm"
over = 4
[[drive.stage]]
from = "0.6 s"
kind = "taps"
frequency = "50 Hz"
amplitude = "0.3 mm"
interval = "60 ms"
[[drive.stage]]
from = "0.9 s"
kind = "rest"
)");
}

TEST(DriveFormula, OfNoDriveIsEmpty) {
    EXPECT_TRUE(drive_formula(Drive()).empty());
}

TEST(TurnFormula, IsOurTurn) {
    BodyTurn turn;
    turn.rate = -3;
    turn.from = 0.1;
    turn.until = 0.9;
    for (const double over : {0.0, 0.2}) {
        turn.over = over;
        const TurnFormula formula = turn_formula(turn);
        for (double time = 0.005; time < 1.3; time += 0.01) {
            const test::PeerExpression::Values values{{"t", time}};
            EXPECT_NEAR(test::PeerExpression::value(formula.angle, values), turn.angle_at(time), 1e-12)
                << time;
            EXPECT_NEAR(test::PeerExpression::value(formula.rate, values), turn.rate_at(time), 1e-12) << time;
        }
    }
}

TEST(PackingThere, ShiftsTheTime) {
    const PeerVariable time = time_variable(500);
    const auto value = [&](double step) {
        return test::PeerExpression::value(time.expression, {{"step", step}, {"dt", 1e-3}});
    };
    EXPECT_EQ(value(200), 0);
    EXPECT_EQ(value(500), 0);
    EXPECT_NEAR(value(800), 0.3, 1e-15);
}

// The polynomial is the manual's; sqrt(5) beta is the damping of Hertz' dashpot that pulls (Antypov &
// Elliott).
TEST(Dashpot, IsToldToTsuji) {
    for (const double e : {0.3, 0.5, 0.7, 0.9, 0.98}) {
        const double wanted = hertz_damping(e, true);
        const auto told = tsuji_restitution(wanted);
        ASSERT_TRUE(told);
        EXPECT_NEAR(tsuji_damping(*told), wanted, 1e-12);
    }
    EXPECT_NEAR(tsuji_damping(0), 1.2728, 1e-15);
    EXPECT_FALSE(tsuji_restitution(20));
}

}  // namespace
}  // namespace grainreel
