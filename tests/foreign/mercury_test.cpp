// Tests of the readers of MercuryDPM's files: .data, .fstat and .restart.
#include <fmt/format.h>
#include <cmath>

#include "tests/foreign/small_files.hpp"
#include "tests/support/tells.hpp"

namespace grainreel {

RawFormat mercury_data_format();
RawFormat mercury_contacts_format();
RawFormat mercury_restart_format();

namespace {

using namespace small_files;
using test::tells;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::StartsWith;

const std::string data_3d =
    "0 0 -1 -1 0 1 1 5 \n"
    "2 0.5 -1 -1 0 1 2 5 \n"
    "0.1 0.2 0.3 1 2 3 0.5 0 0 0 7 8 9 1\n"
    "0.4 0.5 0.6 4 5 6 0.25 0 0 0 -7 -8 -9 2\n"
    "1 1 -1 -1 0 1 1 5 \n"
    "0.1 0.2 0.3 1 2 3 0.5 0 0 0 7 8 9 1\n";

TEST(MercuryData, FramesHaveCountTimeAndBox) {
    EXPECT_TRUE(takes(mercury_data_format(), data_3d));
    EXPECT_THAT(counts(mercury_data_format(), data_3d), ElementsAre(0, 2, 1));
    const RawFrame frame = frame_of(mercury_data_format(), data_3d, 1);
    EXPECT_EQ(frame.time, 0.5);
    ASSERT_TRUE(frame.box.has_value());
    EXPECT_EQ(frame.box->origin, Vec3(-1, -1, 0));
    EXPECT_EQ(frame.box->edges[1], Vec3(0, 3, 0));
    EXPECT_THAT(names(frame.grains), ElementsAre("x", "y", "z", "vx", "vy", "vz", "radius", "alpha", "beta",
                                                 "gamma", "wx", "wy", "wz", "info"));
    EXPECT_THAT(column(frame.grains, "radius"), ElementsAre(0.5, 0.25));
    EXPECT_THAT(column(frame.grains, "wy"), ElementsAre(8, -8));
}

TEST(MercuryData, TwoDimensionsHaveEightColumns) {
    const std::string data = "1 0 -1 0 1 2 \n0.1 0.2 3 4 0.5 -0 6 7\n";
    ASSERT_TRUE(takes(mercury_data_format(), data));
    const RawTable grains = frame_of(mercury_data_format(), data).grains;
    EXPECT_THAT(names(grains), ElementsAre("x", "y", "vx", "vy", "radius", "gamma", "wz", "info"));
    const RawFrame frame = frame_of(mercury_data_format(), data);
    ASSERT_TRUE(frame.box.has_value());
    EXPECT_EQ(frame.box->edges[0], Vec3(2, 0, 0));
    EXPECT_EQ(frame.box->edges[1], Vec3(0, 2, 0));
    const OneFile file(data);
    EXPECT_EQ(mercury_data_format().open(file.path())->facts().dimensions, 2);
}

TEST(MercuryData, DamageIsToldWithItsLine) {
    EXPECT_THAT(counts(mercury_data_format(), data_3d + "2 1.5 0 0 0 1 1 1\n0.1 0.2"), ElementsAre(0, 2, 1));
    EXPECT_THAT(news_of(mercury_data_format(), data_3d + "2 1.5 0 0 0 1 1 1\n0.1 0.2"),
                testing::AllOf(HasSubstr("last frame"), HasSubstr("left out")));
    EXPECT_THAT(
        complaint_of(mercury_data_format(), "1000000000 0 0 0 0 1 1 1\n1 2 3 0 0 0 1 0 0 0 0 0 0 0\n"),
        tells({"no frame", "whole"}));
    EXPECT_THAT(complaint_of(mercury_data_format(), "1 0 0 0 0 1 1 1\n1 nan 3 0 0 0 1 0 0 0 0 0 0 0\n"),
                StartsWith("grains:2: the grain has no place: its y is \"nan\""));
    EXPECT_THAT(
        complaint_of(mercury_data_format(), "1 0 0 0 0 1 1 1\n1 2 3 0 0 0 1 0 0 0 0 0 0 0\n1 2 3 0\n"),
        StartsWith("grains:3: the line of a frame must stand here"));
    EXPECT_THAT(
        complaint_of(mercury_data_format(), "2 0 0 0 0 1 1 1\n1 2 3 0 0 0 1 0 0 0 0 0 0 0\n1 2 3 0\n"),
        StartsWith("grains:3: row 2 of 2 has 4 numbers in place of 14"));
    EXPECT_THAT(complaint_of(mercury_data_format(),
                             "1 0 0 0 0 1 1 1\n1 2 3 0 0 0 1 0 0 0 0 0 0 0\n1 0 0 0 1 1\n1 2 0 0 1 0 0 0\n"),
                StartsWith("grains:3: this frame has 2 dimensions"));
}

TEST(MercuryData, GrowsByWholeFrames) {
    const OneFile file(data_3d);
    const std::unique_ptr<RawFile> opened = mercury_data_format().open(file.path());
    file.append("1 2 0 0 0 1 1 1\n0.1 0.2 0.3 1 2 3 0.5 0 0 0 7 8 9");
    EXPECT_FALSE(opened->grow());
    file.append(" 1\n0 3 0 0 0 1 1 1\n");
    EXPECT_TRUE(opened->grow());
    ASSERT_EQ(opened->moments().size(), 5u);
    EXPECT_EQ(opened->moments()[4].time, 3);
}

// A contact of i and j at x with the force f.
std::string contact(int i, int j, double x, double f) {
    return fmt::format("0.5 {} {} {} 0 0 0.01 0 {} 0 1 0 0 0 0 0\n", i, j, x, f);
}
const std::string no_contacts = "# 0 1\n# 0 0 0 1 1 2\n# 0.1 0.1 0 0 0 0\n";
const std::string some_contacts = "# 0.5 1\n# 0 0 0 1 1 2\n# 0.1 0.1 0 0 0 0\n" + contact(3, 5, 1, 10) +
                                  contact(5, 3, 1, 10) + contact(2, -1, 2, 20) + contact(4, 3, 3, 30);

TEST(MercuryContacts, APairIsGivenOnceAndAWallIsNegative) {
    EXPECT_TRUE(takes(mercury_contacts_format(), no_contacts + some_contacts));
    EXPECT_THAT(counts(mercury_contacts_format(), no_contacts + some_contacts), ElementsAre(0, 0));
    const RawFrame frame = frame_of(mercury_contacts_format(), no_contacts + some_contacts, 1);
    EXPECT_EQ(frame.time, 0.5);
    EXPECT_EQ(frame.contacts.rows, 3u);
    EXPECT_THAT(column(frame.contacts, "id1"), ElementsAre(3, 2, 4));
    EXPECT_THAT(column(frame.contacts, "id2"), ElementsAre(5, -1, 3));
    EXPECT_THAT(column(frame.contacts, "Fn"), ElementsAre(10, 20, 30));
    EXPECT_EQ(frame.grains.rows, 0u);
    EXPECT_EQ(frame_of(mercury_contacts_format(), no_contacts + some_contacts).contacts.rows, 0u);
}

TEST(MercuryContacts, DamageIsToldWithItsLine) {
    EXPECT_THAT(news_of(mercury_contacts_format(), some_contacts + "# 1 1\n# 0 0 0"), HasSubstr("left out"));
    EXPECT_THAT(news_of(mercury_contacts_format(), no_contacts + some_contacts + "0.5 1 2 3"),
                HasSubstr("left out"));
    EXPECT_THAT(complaint_of(mercury_contacts_format(), no_contacts + "0 1 2 3\n"),
                StartsWith("grains:4: a contact has 4 numbers in place of 16"));
    EXPECT_THAT(complaint_of(mercury_contacts_format(), no_contacts + "# 1 1\n0 1 2\n# 3\n"),
                StartsWith("grains:6: "));
}

// A restart file in the form of MercuryDPM 1.0, with the parts that a reader looks at.
std::string restart(const std::string& walls, int count_of_walls, int grains = 1) {
    return fmt::format(
               "MercuryDPM 1.0 name test\n"
               "xMin 0 xMax 1 yMin 0 yMax 2 zMin 0 zMax 3\n"
               "timeStep 0.001 time 0.5 ntimeSteps 500 timeMax 1\n"
               "systemDimensions 3 particleDimensions 3 gravity 0 0 -9.8 backgroundDrag 0\n"
               "Species 2\n"
               "LinearViscoelasticSpecies id 0 density 8 stiffness 1\n"
               "LinearViscoelasticSpecies id 1 density 4 stiffness 1\n"
               "LinearViscoelasticMixedSpecies idA 1 idB 0 stiffness 1\n"
               "Walls {}\n{}"
               "Boundaries 1\n"
               "PeriodicBoundary id 1 normal 0 1 0 scaleFactor 1 distanceLeft 0 distanceRight 2 shift 0 2 0\n"
               "Particles {}\n",
               count_of_walls, walls, grains) +
           "BaseParticle id 7 indSpecies 1 position 0.1 0.2 0.3 orientation 1 0 0 0 velocity 1 2 3 "
           "angularVelocity 4 "
           "5 6 force 0 0 0 torque 0 0 0 radius 0.5 invMass 2 timeStamp 0\n"
           "Interactions 0\n";
}

TEST(MercuryRestart, HasGrainsBoxGravityAndDensities) {
    const std::string text = restart("", 0);
    ASSERT_TRUE(takes(mercury_restart_format(), text));
    const OneFile file(text);
    const std::unique_ptr<RawFile> opened = mercury_restart_format().open(file.path());
    EXPECT_EQ(opened->facts().gravity, Vec3(0, 0, -9.8));
    const RawFrame frame = opened->read(0);
    EXPECT_EQ(frame.time, 0.5);
    EXPECT_EQ(frame.step, 500);
    EXPECT_THAT(frame.box->periodic, ElementsAre(false, true, false));
    EXPECT_EQ(frame.box->edges[2], Vec3(0, 0, 3));
    EXPECT_THAT(column(frame.grains, "id"), ElementsAre(7));
    EXPECT_THAT(column(frame.grains, "z"), ElementsAre(0.3));
    EXPECT_THAT(column(frame.grains, "vy"), ElementsAre(2));
    EXPECT_THAT(column(frame.grains, "wz"), ElementsAre(6));
    EXPECT_THAT(column(frame.grains, "density"), ElementsAre(4));
}

// The area of a wall times its normal.
Vec3 area_of(const TriangleMesh& mesh) {
    Vec3 area(0, 0, 0);
    for (const auto& [a, b, c] : mesh.triangles) {
        const auto at = [&](std::int32_t i) { return mesh.vertices[static_cast<std::size_t>(i)]; };
        area += 0.5 * (at(b) - at(a)).cross(at(c) - at(a));
    }
    return area;
}

TEST(MercuryRestart, InfiniteWallsAreCutToTheBoxAndLookInwards) {
    // Half a turn about y turns x into -x: the wall is at x = 0, and its normal points out of the bed.
    const RawFrame frame = frame_of(
        mercury_restart_format(),
        restart(
            "InfiniteWall id 0 indSpecies 0 position 0 0 0 orientation 0 0 1 0 velocity 0 0 0 force 1 2 3\n"
            "InfiniteWall id 1 indSpecies 0 position 1 1 1 orientation 1 0 0 0 velocity 0 0 0\n"
            "InfiniteWall id 2 normal 0 0 1 position 4\n",
            3));
    ASSERT_EQ(frame.walls.size(), 3u);
    EXPECT_TRUE(area_of(frame.walls[0].mesh).isApprox(Vec3(6, 0, 0)));  // 2 by 3
    EXPECT_TRUE(area_of(frame.walls[1].mesh).isApprox(Vec3(-6, 0, 0)));
    EXPECT_TRUE(area_of(frame.walls[2].mesh).isApprox(Vec3(0, 0, -2)));  // above the box, 1 by 2
    for (const Vec3& corner : frame.walls[1].mesh.vertices) EXPECT_DOUBLE_EQ(corner.x(), 1);
    for (const Vec3& corner : frame.walls[2].mesh.vertices) EXPECT_NEAR(corner.z(), 4, 1e-8);
}

TEST(MercuryRestart, AnObliqueWallEndsAtTheFaces) {
    // The plane goes through the edges x = 0, z = 0 and x = 1, z = 3.
    const RawFrame frame =
        frame_of(mercury_restart_format(), restart("InfiniteWall normal 3 0 -1 position 0\n", 1));
    ASSERT_EQ(frame.walls.size(), 1u);
    EXPECT_NEAR(area_of(frame.walls[0].mesh).norm(), std::sqrt(1 + 9.0) * 2, 1e-6);
}

TEST(MercuryRestart, WallsThatCannotBeDrawnAreTold) {
    const std::string text = restart("IntersectionOfWalls id 0 numIntersectionOfWalls 2 normal 1 0 0\n", 1);
    EXPECT_THAT(news_of(mercury_restart_format(), text), tells({"1 wall", "IntersectionOfWalls"}));
}

TEST(MercuryRestart, VersionThreeHasPlainNumbers) {
    const RawFrame frame =
        frame_of(mercury_restart_format(),
                 "restart_version 3\n"
                 "name chute\n"
                 "xmin 0 xmax 1 ymin 0 ymax 2 zmin 0 zmax 3\n"
                 "dt 1e-05 t 0.25 tmax 1\n"
                 "dim 3 gravity 4 0 -8\n"
                 "Species 1\n"
                 "k 38 disp 7 kt 1 dispt 1 mu 0.5 rho 2400 dim_particle 3\n"
                 "Walls 0\n"
                 "Boundaries 1\n"
                 "PeriodicBoundary normal 1 0 0 position_left 0 position_right 1 shift 1 0 0\n"
                 "Particles 2\n"
                 "TSP BP 1 2 3 4 5 6 0.5 7 8 9 10 11 12 0 0 0 0\n"
                 "TSP BP 2 2 3 4 5 6 0.25 7 8 9 10 11 12 13 14 0 1 1 2 3 0 0 0 0 0 0 1 -1 0.1\n");
    EXPECT_EQ(frame.time, 0.25);
    EXPECT_THAT(frame.box->periodic, ElementsAre(true, false, false));
    EXPECT_THAT(column(frame.grains, "x"), ElementsAre(1, 2));
    EXPECT_THAT(column(frame.grains, "radius"), ElementsAre(0.5, 0.25));
    EXPECT_THAT(column(frame.grains, "gamma"), ElementsAre(9, 9));
    EXPECT_THAT(column(frame.grains, "invMass"), ElementsAre(0, 13));
    EXPECT_THAT(column(frame.grains, "density"), ElementsAre(2400, 2400));
}

TEST(MercuryRestart, ACutFileIsRefused) {
    EXPECT_THAT(complaint_of(mercury_restart_format(), restart("", 0, 1000000000)), StartsWith("grains:"));
    EXPECT_THAT(complaint_of(mercury_restart_format(), "MercuryDPM 1.0 name a\nxMin 0 xMax 1\n"),
                HasSubstr("ends before its Particles"));
    const std::string grain = "BaseParticle position 1 2 3 radius 1\n";
    EXPECT_THAT(complaint_of(mercury_restart_format(),
                             "MercuryDPM 1.0\nParticles 1\n" + grain + grain + "Interactions 0\n"),
                testing::AllOf(StartsWith("grains:4: "), HasSubstr("behind the 1 that")));
    EXPECT_THAT(
        complaint_of(mercury_restart_format(), "MercuryDPM 1.0\nParticles 2\nBaseParticle position 1 2 3\n"),
        HasSubstr("ends 1 grains too early"));
}

}  // namespace
}  // namespace grainreel
