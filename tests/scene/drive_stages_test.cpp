// Tests of [[drive.stage]]: what is read and written, what the plan makes of it, and what is refused.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <numbers>

#include "engine/base/error.hpp"
#include "engine/plan/plan.hpp"
#include "engine/plan/resolved_scene.hpp"
#include "engine/scene/drive_schedule.hpp"
#include "render/scene/filmed_scene.hpp"
#include "tests/scene/scene_text.hpp"
#include "tests/support/tells.hpp"

namespace grainreel {
namespace {

using Kind = DriveStage::Kind;
using test::tells;
using testing::HasSubstr;

std::string staged(const std::string& stages) {
    return wedge_text + stages;
}

// The drive begins with 20 Hz and Gamma 3; gravity is 10 m/s2.
const std::string four_stages = R"([[drive.stage]]
from = "0.5 s"
frequency = "40 Hz"
[[drive.stage]]
from = "1 s"
kind = "rest"
[[drive.stage]]
from = "1.2 s"
kind = "taps"
interval = "0.1 s"
amplitude = "2 mm"
[[drive.stage]]
from = "1.55 s"
frequency = "10 Hz"
g_level = 5
over = 4
)";

double level(double amplitude, double frequency) {
    return amplitude * std::pow(2 * std::numbers::pi * frequency, 2) / 10;
}

TEST(DriveStageKeys, TakeWhatIsNotSaidFromTheStageBefore) {
    const Drive drive = read_text(staged(four_stages)).drive;
    ASSERT_EQ(drive.stages.size(), 4u);
    EXPECT_EQ(drive.stages[0].over, 3);
    EXPECT_NEAR(level(drive.stages[0].amplitude, 40), 3, 1e-12);
    EXPECT_EQ(drive.stages[1].kind, Kind::rest);
    EXPECT_EQ(drive.stages[1].amplitude, 0);
    EXPECT_EQ(drive.stages[2].frequency, 40);  // the frequency of the last stage that was not at rest
    EXPECT_EQ(drive.stages[2].amplitude, 0.002);
    EXPECT_NEAR(level(drive.stages[3].amplitude, 10), 5, 1e-12);
    EXPECT_EQ(drive.highest_frequency(), 40);
    EXPECT_EQ(drive.largest_amplitude(), drive.stages[3].amplitude);
    EXPECT_NEAR(drive.strongest_g_level(10), level(0.002, 40), 1e-9);
}

TEST(DriveStageKeys, AResolvedSceneReadsBackAsItWas) {
    const FilmedScene scene = read_text(staged(four_stages));
    const Plan plan = make_plan(scene);
    const FilmedScene back = read_filmed_scene_text(resolved_scene(scene, plan), "scene.toml");
    EXPECT_EQ(back.drive, scene.drive);
    EXPECT_EQ(back.output, scene.output);  // the rhythm by periods is kept
    EXPECT_EQ(make_plan(back).clock.step, plan.clock.step);
    EXPECT_EQ(make_plan(back).steps, plan.steps);
}

// Each stage begins with the first whole period at its time or later, and changes over whole periods.
TEST(DriveSchedule, BeginsWithWholePeriods) {
    const DriveSchedule schedule(read_text(staged(four_stages)).drive);
    EXPECT_DOUBLE_EQ(schedule.begins(1), 0.5);
    EXPECT_DOUBLE_EQ(schedule.settled(1), 0.5 + 2 * 3 / (20.0 + 40));
    EXPECT_DOUBLE_EQ(schedule.begins(2), 1);
    EXPECT_DOUBLE_EQ(schedule.settled(2), 1 + 3 / 40.0);
    EXPECT_DOUBLE_EQ(schedule.begins(3), 1.2);
    EXPECT_DOUBLE_EQ(schedule.begins(4), 1.6);  // after the fourth tap
    EXPECT_DOUBLE_EQ(schedule.settled(4), 1.6 + 4 / 10.0);
    EXPECT_DOUBLE_EQ(schedule.times().cycles(1.6), 10 + 3 + 16 + 3 + 5 + 4);
}

TEST(DriveSchedule, TellsWhatIsOn) {
    const DriveSchedule schedule(read_text(staged(four_stages)).drive);
    const auto at = [&](double time) { return schedule.now(schedule.times().cycles(time)); };
    EXPECT_EQ(at(0.4).frequency, 20);
    EXPECT_TRUE(at(0.55).changing);
    EXPECT_NEAR(at(0.55).frequency, 30, 1e-9);  // half of the change: s(1/2) = 1/2
    EXPECT_NEAR(level(at(0.55).amplitude, 30), 3, 1e-9);
    EXPECT_EQ(at(0.7).frequency, 40);
    EXPECT_EQ(at(1.1).kind, Kind::rest);
    EXPECT_EQ(at(1.1).amplitude, 0);
    EXPECT_EQ(at(1.3).kind, Kind::taps);
    EXPECT_EQ(at(1.3).interval, 0.1);
}

TEST(DriveStagesPlan, FollowsTheStrongestStage) {
    const auto planned = [](const std::string& stages, const Assignments& sets = {}) {
        return make_plan(read_text(staged(stages), sets));
    };
    const Plan weak = planned(""), strong = planned("", {"drive.g_level=12", "drive.frequency=40 Hz"});
    const Plan changing =
        planned("[[drive.stage]]\nfrom = \"1 s\"\nfrequency = \"40 Hz\"\ng_level = 12\nover = 20\n");
    EXPECT_GT(changing.grain[0].loading_stiffness, 1.5 * weak.grain[0].loading_stiffness);
    EXPECT_NEAR(changing.grain[0].loading_stiffness, strong.grain[0].loading_stiffness,
                1e-6 * strong.grain[0].loading_stiffness);
    EXPECT_LT(changing.clock.step, weak.clock.step);
}

TEST(DriveStagesPlan, PeriodsOfAllStagesAreWholeStepsWherePossible) {
    const Plan plan = make_plan(read_text(staged(four_stages)));
    for (const PeriodStretch& stretch : plan.clock.changes.stretches()) {
        if (stretch.changes()) continue;
        EXPECT_EQ(stretch.period, std::round(stretch.period));
    }
    EXPECT_EQ(plan.clock.phase(plan.clock.step_at(25.25)), 0.25);
    EXPECT_EQ(plan.trajectory_periods, 1);
    EXPECT_EQ(make_plan(read_text(wedge_text)).trajectory_periods, 0);
}

TEST(DriveStagesPlan, WarnsOfAHarshChange) {
    const auto warnings = [](const char* over) {
        const std::string stage =
            std::string("[[drive.stage]]\nfrom = \"0.5 s\"\nfrequency = \"200 Hz\"\nover = ");
        return make_plan(read_text(staged(stage + over + "\n"))).warnings;
    };
    EXPECT_THAT(warnings("3"), testing::Contains(tells({"this stage", "shakes", "up to"})));
    EXPECT_THAT(warnings("40"), testing::Not(testing::Contains(HasSubstr("the change to this stage"))));
}

struct Mistake {
    const char* stages;
    const char* message;
};

TEST(DriveStageMessages, WordForWord) {
    const Mistake mistakes[] = {
        {"[[drive.stage]]\nfrom = 1\n[[drive.stage]]\nfrom = 0.8\n",
         "test.toml:31:1: 'from' is 0.8 s, not later than the stage before it, 1 s; stages follow each other "
         "in "
         "time"},
        {"[[drive.stage]]\nfrom = 2\n",
         "test.toml:29:1: 'from' is 2 s, but the run ends at 2 s; bring it forward or lengthen run.duration"},
        {"[[drive.stage]]\nfrom = 0.1\n",
         "test.toml:29:1: 'from' is 0.1 s, but until 0.15 s the drive still grows (drive.ramp); begin later, "
         "or at "
         "0 in place of that drive"},
        {"[[drive.stage]]\nfrom = 1\nover = 30\ng_level = 1\n",
         "test.toml:30:1: 'over' is 30 periods, until 2.5 s, but the run ends at 2 s; change in fewer, or "
         "make "
         "the stage longer"},
        {"[[drive.stage]]\nfrom = 1\nover = 10\ng_level = 1\n[[drive.stage]]\nfrom = 1.4\n",
         "test.toml:30:1: 'over' is 10 periods, until 1.5 s, but the next stage begins at 1.4 s; change in "
         "fewer, "
         "or make the stage longer"},
        {"[[drive.stage]]\nfrom = 1\ng_level = 2\namplitude = 0.001\n",
         "test.toml:30:1: 'g_level' is of no use here: 'amplitude' is given; remove it"},
        {"[[drive.stage]]\nfrom = 1\nkind = \"rest\"\nfrequency = 30\n",
         "test.toml:31:1: 'frequency' is of no use here: at rest nothing oscillates; "
         "remove it"},
        {"[[drive.stage]]\nfrom = 1\nkind = \"taps\"\n",
         "test.toml:28:1: [[drive.stage]] lacks 'interval'; write for example interval = \"10 s\""},
        {"[[drive.stage]]\nfrom = 1\nkind = \"taps\"\ninterval = 0.01\n",
         "test.toml:31:1: 'interval' is 0.01 s, but a tap of 20 Hz lasts 0.05 s; lengthen it "
         "or "
         "raise the frequency"},
        {"[[drive.stage]]\nfrom = 1.84\nkind = \"taps\"\ninterval = 0.1\n",
         "test.toml:31:1: 'interval' has no time for a tap: the first would begin at 2 s, and the run ends "
         "at 2 "
         "s; make the stage longer"},
        {"[[drive.stage]]\nfrom = 1\ninterval = 0.01\n",
         "test.toml:30:1: 'interval' is of no use here: only taps have an interval; remove "
         "it"},
    };
    for (const auto& [stages, message] : mistakes) {
        try {
            make_plan(read_text(staged(stages)));
            ADD_FAILURE() << "accepted: " << stages;
        } catch (const UserError& error) {
            EXPECT_STREQ(error.what(), message);
        }
    }
}

// Without a ramp the container begins in its place, where the sine may be anywhere: z = a (sin(w t + p) - sin
// p).
TEST(DrivePeaks, WithoutARampTheContainerMayGoTwiceItsAmplitude) {
    Drive drive = read_text(wedge_text).drive;
    drive.ramp = 0;
    drive.phase = 0.75;  // turns; sin p = -1
    EXPECT_NEAR(drive_peaks(drive).offset, 2 * drive.amplitude, 1e-15);
    drive.phase = 0.5;
    EXPECT_NEAR(drive_peaks(drive).offset, drive.amplitude, 1e-15);
    drive.phase = 0.75, drive.ramp = 2;
    EXPECT_NEAR(drive_peaks(drive).offset, drive.amplitude, 1e-15);
}

}  // namespace
}  // namespace grainreel
