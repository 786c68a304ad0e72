// Tests of boxes of dumps, straight and tilted, against the formulas of LAMMPS' page Howto_triclinic.
#include <gmock/gmock.h>

#include "engine/files/foreign/dumps/dump_parts.hpp"
#include "tests/foreign/dumps/dump_files.hpp"
#include "tests/support/tells.hpp"

namespace grainreel {
namespace {

using test::tells;

WorldCell box_of(const std::string& flags, const std::vector<std::string>& lines) {
    BoxReader reader(flags);
    for (const std::string& line : lines) EXPECT_EQ(reader.take(line), "");
    EXPECT_EQ(reader.finish(false), "");
    return reader.box().value_or(WorldCell{});
}

void expect_vector(const Vec3& is, const Vec3& should) {
    EXPECT_LT((is - should).norm(), 1e-14) << is.transpose() << " of " << should.transpose();
}

TEST(DumpBox, StraightWithFlagsAndWithout) {
    const WorldCell cell = box_of("pp ff mm", {"-1 2", "0 3", "1e-1 6.1"});
    expect_vector(cell.origin, {-1, 0, 0.1});
    expect_vector(cell.edges[0], {3, 0, 0});
    expect_vector(cell.edges[1], {0, 3, 0});
    expect_vector(cell.edges[2], {0, 0, 6});
    EXPECT_EQ(cell.periodic, (std::array{true, false, false}));
    EXPECT_EQ(box_of("", {"0 1", "0 1", "0 1"}).periodic, (std::array{false, false, false}));
}

// The bounds are those of the box around the tilted one: xlo_bound = xlo + min(0, xy, xz, xy + xz), and so
// on.
TEST(DumpBox, TiltedForAllSigns) {
    const Vec3 low(-1, 2, 3), high(4, 8, 9);
    for (const double xy : {-1.5, 0.0, 1.0})
        for (const double xz : {-0.5, 0.0, 2.0})
            for (const double yz : {-0.75, 0.0, 0.25}) {
                const auto row = [](double a, double b, double c) {
                    return std::to_string(a) + " " + std::to_string(b) + " " + std::to_string(c);
                };
                const WorldCell cell = box_of(
                    "xy xz yz pp pp ff", {row(low.x() + std::min({0.0, xy, xz, xy + xz}),
                                              high.x() + std::max({0.0, xy, xz, xy + xz}), xy),
                                          row(low.y() + std::min(0.0, yz), high.y() + std::max(0.0, yz), xz),
                                          row(low.z(), high.z(), yz)});
                expect_vector(cell.origin, low);
                expect_vector(cell.edges[0], {high.x() - low.x(), 0, 0});
                expect_vector(cell.edges[1], {xy, high.y() - low.y(), 0});
                expect_vector(cell.edges[2], {xz, yz, high.z() - low.z()});
                EXPECT_EQ(cell.periodic, (std::array{true, true, false}));
            }
}

TEST(DumpBox, GeneralAndUnnamedTilts) {
    const WorldCell general =
        box_of("abc origin pp pp ff", {"0.02 0 0 -0.01", "0.004 0.02 0 0.5", "0 0.001 0.03 0.25"});
    expect_vector(general.origin, {-0.01, 0.5, 0.25});
    expect_vector(general.edges[1], {0.004, 0.02, 0});
    expect_vector(general.edges[2], {0, 0.001, 0.03});
    const WorldCell unnamed = box_of("pp pp pp", {"0 3 1", "0 2 0", "0 2 0"});
    expect_vector(unnamed.edges[0], {2, 0, 0});
    expect_vector(unnamed.edges[1], {1, 2, 0});
}

TEST(DumpBox, WhatIsNoBoxIsRefusedWithItsLine) {
    const test::TemporaryFolder folder;
    const auto complaint = [&](const std::string& bounds, const std::string& count = "1") {
        return text_complaint(folder, "ITEM: TIMESTEP\n0\nITEM: NUMBER OF ATOMS\n" + count +
                                          "\nITEM: BOX BOUNDS pp pp pp\n" + bounds + "ITEM: ATOMS id x\n" +
                                          (count == "1" ? "1 0\n" : ""));
    };
    EXPECT_THAT(complaint("DUMMY\n0 1\n0 1\n"), tells({":6: ", "number", "expected", "\"DUMMY\""}));
    EXPECT_THAT(complaint("0 1\n0 nan\n0 1\n"), tells({":7: ", "number", "expected", "\"nan\""}));
    EXPECT_THAT(complaint("0 1\n0 1\n0\n"), tells({":8: ", "1 numbers", "of 2"}));
    EXPECT_THAT(complaint("0 1\n1 0\n0 1\n"), tells({":8: ", "ends before", "along y"}));
    EXPECT_EQ(complaint("0 1\n1 0\n0 1\n", "0"), "no complaint");  // a box shrunk around no grain
}

}  // namespace
}  // namespace grainreel
