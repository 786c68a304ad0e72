// Tests of frames of other programs as an archive: meaning of columns, series, boxes, velocities from places,
// and walls that move.
#include "engine/files/foreign/foreign_archive.hpp"

#include <cmath>
#include <filesystem>
#include <fstream>
#include <numbers>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "engine/base/error.hpp"
#include "engine/files/frames/open_frames.hpp"
#include "engine/files/frames/state_writer.hpp"
#include "tests/support/tells.hpp"
#include "tests/support/temporary_folder.hpp"

namespace grainreel {
namespace {

namespace fs = std::filesystem;
using test::tells;
using test::TemporaryFolder;
using testing::HasSubstr;

void write(const fs::path& file, const std::string& text) {
    std::ofstream(file, std::ios::binary) << text;
}

// One frame of a dump in a box from 0 to 2 m.
std::string dump(int step, const std::string& columns, const std::vector<std::string>& rows,
                 const std::string& bounds = "0 2\n0 2\n0 2\n", const std::string& flags = "ff ff ff") {
    std::string text =
        fmt::format("ITEM: TIMESTEP\n{}\nITEM: NUMBER OF ATOMS\n{}\nITEM: BOX BOUNDS {}\n{}ITEM: ATOMS {}\n",
                    step, rows.size(), flags, bounds, columns);
    for (const std::string& row : rows) text += row + "\n";
    return text;
}

std::string message_of(const fs::path& file, const ReadingOptions& options = {}) {
    try {
        const ForeignArchive archive(file, options);
        for (std::size_t k = 0; k < archive.moments().size(); ++k) archive.grains(k);
    } catch (const UserError& mistake) {
        return mistake.what();
    }
    return "";
}

class Foreign : public testing::Test {
  protected:
    TemporaryFolder folder_;
    fs::path file(const std::string& name) const { return fs::path(folder_.path()) / name; }
};

TEST_F(Foreign, RowsComeByTheirIdsWhateverTheirOrder) {
    write(file("a.dump"), dump(0, "id type x y z radius", {"7 2 1 1 1 0.1", "3 1 0.5 0.5 0.5 0.2"}));
    const ForeignArchive archive(file("a.dump"), {});
    const State frame = archive.grains(0);
    EXPECT_THAT(frame.id, testing::ElementsAre(3, 7));
    EXPECT_THAT(frame.species, testing::ElementsAre(0, 1));
    EXPECT_EQ(frame.position[1], Vec3(1, 1, 1));
    EXPECT_THAT(frame.radius, testing::ElementsAre(0.2, 0.1));
    EXPECT_EQ(archive.world().species[1].name, "type 2");
}

TEST_F(Foreign, SharesOfATiltedBoxBecomePlaces) {
    // The edges are (2 0 0), (0.5 2 0), (0.25 0.1 2) from the origin: x = sx a + sy b + sz c. The bounds are
    // those of the box around it: x from 0 to 2 + 0.75, y from 0 to 2.1.
    write(file("t.dump"), dump(0, "id type xs ys zs radius", {"1 1 0.5 0.25 0.5 0.1"},
                               "0 2.75 0.5\n0 2.1 0.25\n0 2 0.1\n", "xy xz yz pp pp pp"));
    const ForeignArchive archive(file("t.dump"), {});
    const Vec3 wanted = 0.5 * Vec3(2, 0, 0) + 0.25 * Vec3(0.5, 2, 0) + 0.5 * Vec3(0.25, 0.1, 2);
    EXPECT_NEAR((archive.grains(0).position[0] - wanted).norm(), 0, 1e-14);
}

TEST_F(Foreign, ADiameterIsHalvedAndARadiusOfATypeIsTaken) {
    write(file("d.dump"), dump(0, "id type x y z diameter", {"1 1 1 1 1 0.3"}));
    EXPECT_EQ(ForeignArchive(file("d.dump"), {}).grains(0).radius[0], 0.15);
    write(file("r.dump"), dump(0, "id type x y z", {"1 1 1 1 1", "2 5 1 1 1.5"}));
    ReadingOptions options;
    options.radius_of_type = {{"1", 0.1}, {"5", 0.2}};
    EXPECT_THAT(ForeignArchive(file("r.dump"), options).grains(0).radius, testing::ElementsAre(0.1, 0.2));
    EXPECT_THAT(message_of(file("r.dump")), HasSubstr("--radius"));
    options.radius_of_type.erase("5");
    EXPECT_THAT(message_of(file("r.dump"), options), HasSubstr("5=2mm"));
}

TEST_F(Foreign, UnitsBecomeSi) {
    // In cgs units 1 cm = 0.01 m, 1 cm/s = 0.01 m/s, 1 g/cm3 = 1000 kg/m3 (LAMMPS manual, command units).
    write(file("c.dump"), dump(10, "id type x y z radius vx vy vz density", {"1 1 1 2 3 0.1 5 0 0 2.5"}));
    ReadingOptions options;
    options.units = "cgs";
    options.time_step = 1e-3;
    const ForeignArchive archive(file("c.dump"), options);
    const State frame = archive.grains(0);
    EXPECT_NEAR((frame.position[0] - Vec3(0.01, 0.02, 0.03)).norm(), 0, 1e-16);
    EXPECT_DOUBLE_EQ(frame.radius[0], 0.001);
    EXPECT_DOUBLE_EQ(frame.velocity[0].x(), 0.05);
    EXPECT_DOUBLE_EQ(archive.world().species[0].density, 2500);
    EXPECT_NEAR(frame.time, 0.01, 1e-15);
}

TEST_F(Foreign, UnitsOfMillimetresGramsAndSeconds) {
    write(file("m.dump"), dump(10, "id type x y z radius vx vy vz density", {"1 1 1 2 3 0.5 5 0 0 2.5e-3"}));
    ReadingOptions options;
    options.units = "mm";
    const ForeignArchive archive(file("m.dump"), options);
    const State frame = archive.grains(0);
    EXPECT_NEAR((frame.position[0] - Vec3(0.001, 0.002, 0.003)).norm(), 0, 1e-17);
    EXPECT_DOUBLE_EQ(frame.radius[0], 0.0005);
    EXPECT_DOUBLE_EQ(frame.velocity[0].x(), 0.005);
    EXPECT_NEAR(archive.world().species[0].density, 2500, 1e-9);
}

// What `render` made of files lies in a folder with tables that are no grains.
TEST_F(Foreign, AFolderOfAFilmIsRefused) {
    std::filesystem::create_directory(file("post-render"));
    write(file("post-render/run.json"), "{}");
    write(file("post-render/film_times.csv"), "frame,step,time_s\n0,1,2\n");
    EXPECT_THAT(message_of(file("post-render")), HasSubstr("a film alone"));
}

TEST_F(Foreign, ANumberedSeriesIsReadByItsNumbers) {
    for (const int step : {0, 500, 10000})
        write(file(fmt::format("s.{}.dump", step)),
              dump(step, "id type x y z radius", {fmt::format("1 1 1 1 {} 0.1", 1 + step * 1e-5)}));
    const ForeignArchive series(file("s.500.dump"), {});
    ASSERT_EQ(series.moments().size(), 3u);
    EXPECT_NEAR(series.grains(2).position[0].z(), 1.1, 1e-12);
    ReadingOptions alone;
    alone.one = true;
    const ForeignArchive one(file("s.500.dump"), alone);
    EXPECT_EQ(one.moments().size(), 1u);
    EXPECT_THAT(one.news().front(), HasSubstr("one of 3 numbered files"));
    const ForeignArchive pattern(file("s.*.dump"), {});
    EXPECT_EQ(pattern.moments().size(), 3u);
}

TEST_F(Foreign, FilesOfProcessesAreOneFrameAndALaterFrameOfAStepCounts) {
    write(file("p.0"), dump(0, "id type x y z radius", {"1 1 1 1 1 0.1"}));
    write(file("p.1"), dump(0, "id type x y z radius", {"2 1 1 1 1.5 0.1"}));
    EXPECT_THAT(ForeignArchive(file("p.0"), {}).grains(0).id, testing::ElementsAre(1, 2));
    write(file("twice.dump"), dump(0, "id type x y z radius", {"1 1 1 1 1 0.1"}) +
                                  dump(100, "id type x y z radius", {"1 1 1 1 1.1 0.1"}) +
                                  dump(100, "id type x y z radius", {"1 1 1 1 1.2 0.1"}));
    const ForeignArchive twice(file("twice.dump"), {});
    ASSERT_EQ(twice.moments().size(), 2u);
    EXPECT_EQ(twice.grains(1).position[0].z(), 1.2);
}

TEST_F(Foreign, VelocitiesComeFromPlacesWhereMomentsAreNear) {
    // A grain falls: central differences of z = -g t^2 / 2 are exact.
    std::string text;
    for (int k = 0; k < 5; ++k) {
        const double t = 1e-3 * k;
        text += dump(k, "id type x y z radius", {fmt::format("1 1 1 1 {} 0.1", 1 - 0.5 * 9.81 * t * t)});
    }
    write(file("v.dump"), text);
    ReadingOptions options;
    options.time_step = 1e-3;
    const ForeignArchive archive(file("v.dump"), options);
    EXPECT_TRUE(archive.derived_velocities());
    EXPECT_NEAR(archive.grains(2).velocity[0].z(), -9.81 * 2e-3, 1e-9);
    // Frames that are a second apart tell nothing about velocities.
    write(file("far.dump"), dump(0, "id type x y z radius", {"1 1 1 1 0.2 0.1"}) +
                                dump(1000, "id type x y z radius", {"1 1 1 1 1.9 0.1"}));
    const ForeignArchive far(file("far.dump"), options);
    EXPECT_FALSE(far.derived_velocities());
    EXPECT_FALSE(far.supply().velocities);
}

TEST_F(Foreign, WrongRowsAreRefusedWithWhatToDo) {
    write(file("two.dump"), dump(0, "id type x y z radius", {"1 1 1 1 1 0.1", "2 1 1 1 1 0"}));
    EXPECT_THAT(message_of(file("two.dump")), HasSubstr("--radius"));
    write(file("id.dump"), dump(0, "id type x y z radius", {"1.5 1 1 1 1 0.1"}));
    EXPECT_THAT(message_of(file("id.dump")), HasSubstr("whole number"));
    write(file("flat.dump"), dump(0, "id type x y radius", {"1 1 1 1 0.1"}));
    EXPECT_THAT(message_of(file("flat.dump")), HasSubstr("--columns z="));
    ReadingOptions options;
    options.columns = {{"radius", "c_rad"}};
    write(file("ok.dump"), dump(0, "id type x y z radius", {"1 1 1 1 1 0.1"}));
    EXPECT_THAT(message_of(file("ok.dump"), options), HasSubstr("id, type, x, y, z, radius"));
}

TEST(RigidMotion, ATurnAndAShiftAreFound) {
    const Quaternion turn(Eigen::AngleAxisd(0.7, Vec3(1, 2, 3).normalized()));
    const Vec3 shift(0.1, -0.2, 0.3);
    std::vector<Vec3> from{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, to;
    for (const Vec3& point : from) to.push_back(shift + turn * point);
    const RigidMotion motion = rigid_motion(from, to);
    EXPECT_LT(motion.residual, 1e-14);
    EXPECT_LT(motion.pose.rotation.angularDistance(turn), 1e-12);
    EXPECT_LT((motion.pose.place - shift).norm(), 1e-14);
    to[3] += Vec3(0.5, 0, 0);
    EXPECT_GT(rigid_motion(from, to).residual, 0.05);
}

TEST(ForeignWallMotion, PartsOfOneSolidMoveEachOnItsOwn) {
    const auto triangle = [](const Vec3& at) {
        TriangleMesh mesh;
        mesh.vertices = {at, at + Vec3(1, 0, 0), at + Vec3(0, 1, 0)};
        mesh.triangles = {{0, 1, 2}};
        return mesh;
    };
    const auto both = [&](double shift) {
        RawWall wall;
        wall.mesh = triangle(Vec3(0, 0, 0));
        const TriangleMesh other = triangle(Vec3(5, 0, shift));
        for (const Vec3& vertex : other.vertices) wall.mesh.vertices.push_back(vertex);
        wall.mesh.triangles.push_back({3, 4, 5});
        return wall;
    };
    std::vector<std::string> news;
    const std::vector<MovingWall> walls =
        follow_walls({{0, {}, {both(0)}}, {1, {}, {both(2)}}}, 0.5, "w.stl", news);
    ASSERT_EQ(walls.size(), 2u);
    EXPECT_FALSE(walls[0].moves);
    EXPECT_TRUE(walls[1].moves);
    EXPECT_NEAR((walls[1].poses[1].moved(Vec3(2.5, 0, 0)) - Vec3(2.5, 0, 1)).norm(), 0, 1e-12);
    EXPECT_TRUE(news.empty());
}

// What an exporter writes comes back. Places are exact if the format has doubles, and right to a float's last
// digit otherwise.
class RoundTrip : public Foreign,
                  public testing::WithParamInterface<std::tuple<const char*, const char*, double>> {};

TEST_P(RoundTrip, IdsTypesAndPlacesComeBack) {
    const auto [format, name, precision] = GetParam();
    write(file("o.dump"), dump(0, "id type x y z radius vx vy vz",
                               {"9 2 0.1 0.2 0.3 0.05 1 2 3", "4 1 1.123456789 0.3 1.7 0.07 0 0 -1"}) +
                              dump(100, "id type x y z radius vx vy vz",
                                   {"9 2 0.15 0.2 0.3 0.05 1 2 3", "4 1 1.1 0.3 1.6 0.07 0 0 -1"}));
    ReadingOptions options;
    options.time_step = 1e-4;
    const ForeignArchive first(file("o.dump"), options);
    export_frames(first, format, file(name), {}, false, [](double) { return true; });
    const fs::path back = std::string(format) == "vtk" ? file(name) / "grains.pvd" : file(name);
    const std::unique_ptr<StateArchive> again = open_frames(back);
    const std::size_t last = again->moments().size() - 1;
    const State is = again->grains(last), wanted = first.grains(1);
    EXPECT_EQ(is.id, wanted.id);
    EXPECT_EQ(is.species, wanted.species);
    for (std::size_t i = 0; i < wanted.size(); ++i) {
        EXPECT_LE((is.position[i] - wanted.position[i]).norm(), precision) << format;
        EXPECT_LE(std::abs(is.radius[i] - wanted.radius[i]), precision) << format;
        EXPECT_LE((is.velocity[i] - wanted.velocity[i]).norm(), 10 * precision) << format;
    }
}

INSTANTIATE_TEST_SUITE_P(Formats, RoundTrip,
                         testing::Values(std::tuple("lammps-dump", "a.dump", 1e-15),
                                         std::tuple("xyz", "a.xyz", 1e-15), std::tuple("csv", "a.csv", 1e-15),
                                         std::tuple("vtk", "a-vtk", 1e-15), std::tuple("gsd", "a.gsd", 2e-7)),
                         [](const auto& of) {
                             std::string text = std::get<0>(of.param);
                             std::erase(text, '-');
                             return text;
                         });

// One of a hundred frames has a grain of another type.
TEST(Archive, ATypeOfOneFrameAmongManyIsASpecies) {
    const TemporaryFolder folder;
    std::string text;
    for (int k = 0; k < 100; ++k)
        text += dump(k, "id type x y z radius", {fmt::format("1 {} 1 1 1 0.1", k == 51 ? 7 : 2)});
    write(folder / "a.dump", text);
    const ForeignArchive archive(folder / "a.dump", {});
    ASSERT_EQ(archive.world().species.size(), 2u);
    EXPECT_EQ(archive.grains(50).species[0], 0);
    EXPECT_EQ(archive.grains(51).species[0], 1);
    EXPECT_EQ(archive.world().species[1].name, "type 7");
}

std::string contacts_without_names() {
    return "ITEM: TIMESTEP\n0\nITEM: NUMBER OF ENTRIES\n1\nITEM: BOX BOUNDS pp pp pp\n0 2\n0 2\n0 2\nITEM: "
           "ENTRIES c_pl[1] c_pl[2] c_pl[3]\n1 2 0.5\n";
}

TEST(Archive, ContactsThatNoNameExplainsAreLeftOutWithAWord) {
    const TemporaryFolder folder;
    write(folder / "a.dump", dump(0, "id type x y z radius", {"1 1 1 1 1 0.1", "2 1 1.2 1 1 0.1"}));
    write(folder / "c.dump", contacts_without_names());
    ReadingOptions options;
    options.contacts = {(folder / "c.dump").string()};
    const ForeignArchive nameless(folder / "a.dump", options);
    EXPECT_FALSE(nameless.supply().contacts);
    EXPECT_THAT(nameless.news(), testing::Contains(HasSubstr("as in --columns id1=c_1[1],id2=c_1[2]")));
    options.columns = {{"id1", "c_pl[1]"}, {"id2", "c_pl[2]"}, {"force", "c_pl[3]"}};
    const ForeignArchive named(folder / "a.dump", options);
    ASSERT_TRUE(named.supply().contacts);
    ASSERT_EQ(named.touches(0)->size(), 1u);
    EXPECT_EQ(named.touches(0)->front().force, 0.5);
}

TEST(Archive, AFileOfContactsAloneSaysWhereItBelongs) {
    const TemporaryFolder folder;
    write(folder / "c.dump", contacts_without_names());
    EXPECT_THAT(ForeignArchive(folder / "c.dump", {}).news(),
                testing::Contains(tells({"contacts", "no grains", "file of the grains"})));
}

// Contacts in tables: matched by time; names as programs have them.
TEST(Archive, ContactsInATableBelongToTheGrainsOfTheirTime) {
    const TemporaryFolder folder;
    write(folder / "a.csv",
          "time,id,x,y,z,radius\n0,4,0,0,0,0.5\n0,9,1,0,0,0.5\n0.1,4,0,0,0,0.5\n0.1,9,1,0,0,0.5\n");
    write(folder / "pairs.csv", "time;step;id1;id2;fn\n0,1;700;4;9;2,5\n0,1;700;9;-1;0,5\n");
    ReadingOptions options;
    options.contacts = {(folder / "pairs.csv").string()};
    const ForeignArchive archive(folder / "a.csv", options);
    ASSERT_TRUE(archive.supply().contacts);
    EXPECT_FALSE(archive.has_contacts_of(0));
    const std::vector<Link> links = *archive.touches(1);
    ASSERT_EQ(links.size(), 2u);
    EXPECT_EQ(links[0].first, 4);
    EXPECT_EQ(links[0].second, 9);
    EXPECT_EQ(links[0].force, 2.5);
    EXPECT_EQ(links[1].second, -1);
    EXPECT_THAT(message_of(folder / "pairs.csv"), tells({"contacts", "no grains", "--contacts"}));
    // In a folder, grains and contacts are told apart.
    EXPECT_TRUE(ForeignArchive(folder.path(), {}).supply().contacts);
}

// DEM-Engine counts the rows of its grains from 0, and walls and meshes by their own numbers.
TEST(Archive, ContactsOfDemEngineCountFrom0) {
    const TemporaryFolder folder;
    write(folder / "grains.csv", "X,Y,Z,r,absv\n0,0,1,0.5,0\n0,0,0,0.5,0\n");
    write(folder / "pairs.csv",
          "contact_type,geoA,geoB,f_x,f_y,f_z,X,Y,Z\nSS,0,1,0,3,-4,0,0,-6\nSA,0,0,0,0,1.5,0,0,-10\nSM,1,2,0,"
          "0,1,0,0,1\n");
    ReadingOptions options;
    options.contacts = {(folder / "pairs.csv").string()};
    const ForeignArchive archive(folder / "grains.csv", options);
    const std::vector<Link> links = *archive.touches(0);
    ASSERT_EQ(links.size(), 3u);
    EXPECT_EQ(links[0].first, 1);
    EXPECT_EQ(links[0].second, 2);
    EXPECT_EQ(links[0].force, 5);
    EXPECT_EQ(links[1].first, 1);
    EXPECT_EQ(links[1].second, -1);
    EXPECT_EQ(links[2].second, -3);
}

TEST(Archive, VelocitiesHaveTheUnitOfTheirNames) {
    const TemporaryFolder folder;
    write(folder / "a.csv", "x [mm],y [mm],z [mm],radius [mm],vx [mm/s],vy [mm/s],vz\n1,2,3,4,5,6,7\n");
    const State frame = ForeignArchive(folder / "a.csv", {}).grains(0);
    EXPECT_NEAR(frame.velocity[0].x(), 0.005, 1e-15);
    EXPECT_NEAR(frame.velocity[0].z(), 7, 1e-12);
    EXPECT_NEAR(frame.radius[0], 0.004, 1e-15);
}

// Brackets may hold any unit of that dimension. One of another dimension is passed over, and told.
TEST(Archive, UnitsInNamesMeasureWhatTheColumnHolds) {
    const TemporaryFolder folder;
    write(folder / "a.csv",
          "x [inch],y [inch],z [inch],radius [µm],vx [km/h],vy [s],vz (plain)\n1,2,3,4,36,6,7\n");
    const ForeignArchive archive(folder / "a.csv", {});
    const State frame = archive.grains(0);
    EXPECT_NEAR(frame.position[0].x(), 0.0254, 1e-15);
    EXPECT_NEAR(frame.radius[0], 4e-6, 1e-18);
    EXPECT_NEAR(frame.velocity[0].x(), 10, 1e-12);
    EXPECT_NEAR(frame.velocity[0].y(), 6, 1e-12);
    EXPECT_NEAR(frame.velocity[0].z(), 7, 1e-12);
    EXPECT_THAT(archive.news(), testing::Contains(tells({"\"vy [s]\"", "not measure", "speed"})));
    EXPECT_THAT(archive.news(), testing::Not(testing::Contains(HasSubstr("vz"))));
}

// A restart has written the last frame again.
TEST(Archive, OfTwoFramesOfOneTimeTheLaterCounts) {
    const TemporaryFolder folder;
    const std::string row = " 0.2 0.3 1 2 3 0.5 0 0 0 7 8 9 1\n", box = " 0 0 0 1 1 1\n";
    write(folder / "a.data", "1 0" + box + "0.1" + row + "1 0.5" + box + "0.2" + row + "1 0.5" + box + "0.3" +
                                 row + "1 1" + box + "0.4" + row);
    const ForeignArchive archive(folder / "a.data", {});
    ASSERT_EQ(archive.moments().size(), 3u);
    EXPECT_EQ(archive.grains(1).position[0].x(), 0.3);
}

}  // namespace
}  // namespace grainreel
