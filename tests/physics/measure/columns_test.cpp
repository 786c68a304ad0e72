// Tests of columns that are computed anew for each row, on states with simple numbers.
#include <gtest/gtest.h>

#include <numbers>

#include "engine/scene/scene_file.hpp"
#include "tests/physics/measure/bed_by_hand.hpp"
#include "tests/support/small_scene.hpp"

namespace grainreel {
namespace {

using test::BedByHand;

TEST(EnergyColumns, GravityMayPointAnyWay) {
    BedByHand bed;
    bed.gravity = {3, 0, -10};
    bed.add(0, {2, 7, 5}, 0.5, 6 / std::numbers::pi);  // 1 kg
    EXPECT_NEAR(bed.look(0, "gravitational_J"), 10 * 5 - 3 * 2, 1e-12);
}

ContactView touch(std::int32_t second, const Vec3& normal, double force) {
    ContactView contact{};
    contact.second = second;
    contact.glued = -1;
    contact.normal = normal;
    contact.overlap = 0.01;
    contact.smaller_radius = 1;
    contact.normal_force = force;
    return contact;
}

// Contacts with walls do not count, nor do grains that touch without a force, nor contacts in the row before.
TEST(FabricColumns, AreOfPairsThatPushEachOtherNow) {
    BedByHand bed;
    Vec3 pair = Vec3::UnitY();
    bed.contacts = [&](const auto& see) {
        see(touch(1, pair, 5));
        see(touch(-1, {0, 0, -1}, 5));
        see(touch(2, {1, 0, 0}, 0));
    };
    bed.add(0, {0, 0, 1}, 0.5);
    EXPECT_NEAR(bed.look(0, "fabric_vertical"), 0, 1e-12);
    EXPECT_NEAR(bed.look(0, "fabric_anisotropy"), 1, 1e-12);
    pair = Vec3::UnitZ();
    EXPECT_NEAR(bed.look(125, "fabric_vertical"), 1, 1e-12);
}

TEST(FloorPosition, IsTheWayAlongTheDrivesDirection) {
    BedByHand bed;
    bed.scene.drive.direction = {0, 0.6, -0.8};
    for (const double way : {0.02, -0.03}) {
        bed.pose.offset = way * bed.scene.drive.direction;
        EXPECT_NEAR(bed.look(0, "floor_position_m"), way, 1e-15);
    }
}

// The drive has 20 Hz at 2 g, from 0.1 s on 45 Hz at 4 g, rest from 0.4 s on, and from 0.6 s on taps of 1 /
// 30 s at 5 g.
TEST(DriveColumns, AreThoseOfTheStageThatIsOn) {
    BedByHand bed;
    bed.scene = read_scene_text(std::string(test::small_scene_text) +
                                    "[[drive.stage]]\nfrom = \"0.1 s\"\nfrequency = \"45 Hz\"\ng_level = 4\n"
                                    "[[drive.stage]]\nfrom = \"0.4 s\"\nkind = \"rest\"\n"
                                    "[[drive.stage]]\nfrom = \"0.6 s\"\nkind = \"taps\"\n"
                                    "frequency = \"30 Hz\"\ng_level = 5\ninterval = \"50 ms\"\n",
                                "stages.toml", {"run.duration=1 s", "drive.ramp=0"});
    bed.plan = make_plan(bed.scene);
    bed.gravity = bed.scene.gravity;
    bed.add(0, {0, 0, 0.01}, 0.002);
    const auto at = [&](double time, const char* column) {
        return bed.look(std::llround(time / bed.plan.clock.step), column);
    };
    EXPECT_NEAR(at(0.05, "drive_frequency_Hz"), 20, 1e-9);
    EXPECT_NEAR(at(0.05, "drive_g_level"), 2, 1e-9);
    EXPECT_NEAR(at(0.35, "drive_frequency_Hz"), 45, 1e-9);
    EXPECT_NEAR(at(0.35, "drive_g_level"), 4, 1e-9);
    EXPECT_EQ(at(0.55, "drive_frequency_Hz"), 0);
    EXPECT_EQ(at(0.55, "drive_g_level"), 0);
    EXPECT_NEAR(at(0.9, "drive_frequency_Hz"), 30, 1e-9);
    EXPECT_NEAR(at(0.9, "drive_g_level"), 5, 1e-9);
}

// While the drive grows over four periods, it has the share s(u) = 10 u^3 - 15 u^4 + 6 u^5.
TEST(DriveColumns, GrowWithTheDrive) {
    BedByHand bed;
    bed.scene = read_scene_text(std::string(test::small_scene_text), "ramp.toml",
                                {"run.duration=1 s", "drive.ramp=4", "drive.g_level=3"});
    bed.plan = make_plan(bed.scene);
    bed.gravity = bed.scene.gravity;
    bed.add(0, {0, 0, 0.01}, 0.002);
    const auto at = [&](double periods) {
        return bed.look(std::llround(periods * static_cast<double>(bed.plan.clock.steps_per_period)),
                        "drive_g_level");
    };
    EXPECT_EQ(at(0), 0);
    EXPECT_NEAR(at(1), 3 * (10.0 / 64 - 15.0 / 256 + 6.0 / 1024), 1e-9);
    EXPECT_NEAR(at(2), 1.5, 1e-9);
    EXPECT_NEAR(at(4), 3, 1e-9);
}

// A light grain is at 1 in one period and at 3 in the next one, and a heavy grain rests.
struct TwoHeights : BedByHand {
    TwoHeights(double light, double heavy) {
        add(0, {0, 0, 1}, 0.5, light);
        add(0, {0, 2, 1}, 0.5, heavy);
    }
    void run(int periods) {
        for (int n = 0; n <= 8 * periods; ++n) {
            grains.place[0].position.z() = n / 8 % 2 ? 3 : 1;
            n == 0 ? start() : gather(125 * n);
        }
    }
};

TEST(BedPeriodsColumns, GoByTheCentreOfMass) {
    TwoHeights bed(1, 99);  // the centre moves by 2 / 100, less than a tenth of a grain
    bed.run(20);
    EXPECT_NEAR(bed.look(20000, "period_difference_m"), 0.02, 1e-12);
    EXPECT_EQ(bed.look(20000, "bed_periods"), 1);
}

// 99 grains of 1 and one of 101 have the mean 2; the mean of the species is 51. The centre moves by 1.
TEST(BedPeriodsColumns, AreMeasuredByTheMeanGrain) {
    TwoHeights bed(1, 1);
    bed.scene.species[0].count = 99;
    bed.scene.species[1].count = 1;
    bed.scene.species[1].diameter.mean = 101;
    bed.run(20);
    EXPECT_EQ(bed.look(20000, "bed_periods"), 2);
}

TEST(BedPeriodsColumns, AreZeroWithoutADrive) {
    TwoHeights bed(1, 1);
    bed.plan.clock.steps_per_period = 0;
    bed.start();
    EXPECT_EQ(bed.look(0, "bed_periods"), 0);
}

}  // namespace
}  // namespace grainreel
