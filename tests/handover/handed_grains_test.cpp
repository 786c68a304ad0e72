// The dump that comes back begins with the grains that were handed over, and these stay what they are.
#include "engine/handover/handed_grains.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "engine/base/error.hpp"
#include "tests/support/tells.hpp"
#include "tests/support/temporary_folder.hpp"

namespace grainreel::test {
namespace {

constexpr const char* data_text =
    "handed over by grainreel; units si\n\n2 atoms\n2 atom types\n\n0 1 xlo xhi\n0 1 ylo yhi\n0 1 zlo zhi\n\n"
    "Atoms\n\n1 1 0.004 2500 0.1 0.2 0.3\n2 2 0.006 2500 0.9 0.2 0.4\n\n"
    "Velocities\n\n1 0.5 0 0 0 0 7\n2 0 0 -0.123456789123 0 0 0\n";

State first_frame() {
    State frame;
    frame.id = {1, 2, 9};  // 9 was fed
    frame.species = {0, 1, 0};
    frame.radius = {0.002, 0.003, 0.001};
    frame.position = {Vec3(0.1, 0.2, 0.3), Vec3(0.9, 0.2, 0.4), Vec3(0, 0, 0)};
    frame.velocity = {Vec3(0.5, 0, 0), Vec3(0, 0, -0.123456789), Vec3(1, 1, 1)};
    frame.spin = {Vec3(0, 0, 7), Vec3(0, 0, 0), Vec3(0, 0, 0)};
    return frame;
}

class HandedGrainsTest : public testing::Test {
  protected:
    std::string said(const State& first, double period = 0) const {
        try {
            HandedGrains(folder_.write("grains.data", data_text), "lammps.dump").check_first(first, period);
        } catch (const UserError& wrong) {
            return wrong.what();
        }
        return "";
    }
    TemporaryFolder folder_;
};

TEST_F(HandedGrainsTest, AreInTheFirstFrame) {
    EXPECT_EQ(said(first_frame()), "");
    State other = first_frame();
    other.position[1].x() = -0.1;
    EXPECT_EQ(said(other, 1.0), "") << "a period away";
    EXPECT_THAT(said(other), tells({"lammps.dump", "step 0", "atom 2", "-0.1", "0.9", "grains.data"}));
    other = first_frame();
    other.spin[0].z() = 1.8e19;
    EXPECT_THAT(said(other), tells({"atom 1", "spin", "1.8e+19"}));
    other = first_frame();
    other.velocity[1].z() = 0;
    EXPECT_THAT(said(other), tells({"atom 2", "velocity"}));
    other.step = 500;  // after the packing of the other engine, grains are elsewhere
    other.position[0].z() = 0.1;
    EXPECT_EQ(said(other), "");
    other.radius[1] = 0.0031;
    EXPECT_THAT(said(other), tells({"step 500", "atom 2", "radius", "0.0031", "0.003"}));
    other = first_frame();
    other.species[0] = 1;
    EXPECT_THAT(said(other), tells({"atom 1", "type 2", "type 1"}));
}

TEST_F(HandedGrainsTest, AreNotComparedWithoutTheirFile) {
    State other = first_frame();
    other.radius[0] = 1;
    HandedGrains(folder_ / "nothing", "x.dump").check_first(other, 0);
}

TEST_F(HandedGrainsTest, DamageIsToldWithItsLine) {
    const auto file = folder_.write("d.data", "Atoms\n\n1 1 0.004 2500 0.1 x 0.3\n");
    try {
        HandedGrains(file, "x.dump");
        FAIL();
    } catch (const UserError& wrong) {
        EXPECT_THAT(wrong.what(), tells({"d.data:3", "row"}));
    }
}

TEST(GrainsOfADump, KeepTypeAndRadius) {
    State before = first_frame(), now = first_frame();
    now.step = 10;
    now.position[0].z() = 0.2;
    check_unchanged(before, now, "x.dump");
    now.radius[1] *= 0.8;
    EXPECT_THROW(check_unchanged(before, now, "x.dump"), RunError);
    now = first_frame();
    now.species[2] = 1;
    try {
        check_unchanged(before, now, "x.dump");
        FAIL();
    } catch (const RunError& wrong) {
        EXPECT_THAT(wrong.what(), tells({"x.dump", "grain 9", "type 2", "type 1"}));
    }
    // A grain that has come since is no other.
    before.id[2] = 8;
    check_unchanged(before, now, "x.dump");
}

}  // namespace
}  // namespace grainreel::test
