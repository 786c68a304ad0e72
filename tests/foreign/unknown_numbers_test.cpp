// Tests that a velocity or spin that is no number stays unknown, in every format that is read and written,
// and that a place, a radius or an id that is none is refused.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "engine/base/error.hpp"
#include "engine/files/foreign/foreign_archive.hpp"
#include "engine/files/frames/open_frames.hpp"
#include "engine/files/frames/state_writer.hpp"
#include "engine/files/trajectory/trajectory.hpp"
#include "engine/run/import/import_run.hpp"
#include "tests/foreign/dumps/dump_files.hpp"
#include "tests/support/tells.hpp"
#include "tests/support/temporary_folder.hpp"

namespace grainreel {
namespace {

namespace fs = std::filesystem;
using test::tells;
using test::TemporaryFolder;
using test::text_of;
using test::write_text;
using testing::HasSubstr;

// Three grains, whose second one has these words.
struct Words {
    std::string id = "2", x = "0.3", radius = "0.05", vz = "0.25", wx = "1";
    std::vector<std::vector<std::string>> rows() const {
        return {{"1", "0.1", "0.5", "0.5", "0.05", "0", "0", "0.5", "1", "0", "0"},
                {id, x, "0.5", "0.5", radius, "0", "0", vz, wx, "0", "0"},
                {"3", "0.5", "0.5", "0.5", "0.05", "0", "0", "0.75", "1", "0", "0"}};
    }
};

std::string csv_of(const Words& words) {
    std::string text = "time,id,x,y,z,radius,vx,vy,vz,wx,wy,wz\n";
    for (const auto& row : words.rows()) text += fmt::format("0,{}\n", fmt::join(row, ","));
    return text;
}

std::string xyz_of(const Words& words) {
    std::string text = "3\nProperties=id:I:1:pos:R:3:radius:R:1:velo:R:3:omega:R:3 Time=0\n";
    for (const auto& row : words.rows()) text += fmt::format("{}\n", fmt::join(row, " "));
    return text;
}

std::string dump_of(const Words& words) {
    std::string rows;
    for (const auto& row : words.rows()) rows += fmt::format("{}\n", fmt::join(row, " "));
    return "ITEM: TIME\n0\n" + frame_text("0", "3", "id x y z radius vx vy vz omegax omegay omegaz", rows);
}

// The numbers of some columns, row by row.
std::string block(const Words& words, std::vector<std::size_t> columns) {
    std::string text;
    for (const auto& row : words.rows())
        for (const std::size_t column : columns) text += row[column] + " ";
    return text + "\n";
}

std::string vtk_of(const Words& words) {
    return "# vtk DataFile Version 3.0\nx\nASCII\nDATASET POLYDATA\nPOINTS 3 double\n" +
           block(words, {1, 2, 3}) + "POINT_DATA 3\nSCALARS id double 1\nLOOKUP_TABLE default\n" +
           block(words, {0}) + "SCALARS radius double 1\nLOOKUP_TABLE default\n" + block(words, {4}) +
           "VECTORS v double\n" + block(words, {5, 6, 7}) + "VECTORS omega double\n" +
           block(words, {8, 9, 10});
}

std::string vtp_of(const Words& words) {
    const auto array = [&](const char* name, int components, std::vector<std::size_t> columns) {
        return fmt::format(
            "<DataArray type=\"Float64\" Name=\"{}\" NumberOfComponents=\"{}\" format=\"ascii\">{}"
            "</DataArray>\n",
            name, components, block(words, std::move(columns)));
    };
    return "<?xml version=\"1.0\"?>\n<VTKFile type=\"PolyData\" version=\"0.1\" byte_order=\"LittleEndian\">"
           "<PolyData><Piece NumberOfPoints=\"3\"><PointData>\n" +
           array("id", 1, {0}) + array("radius", 1, {4}) + array("velocity", 3, {5, 6, 7}) +
           array("omega", 3, {8, 9, 10}) + "</PointData><Points>\n" + array("Points", 3, {1, 2, 3}) +
           "</Points></Piece></PolyData></VTKFile>\n";
}

struct Format {
    const char* file;
    std::string (*text)(const Words&);
};
void PrintTo(const Format& format, std::ostream* out) {
    *out << format.file;
}

class UnknownNumbers : public testing::TestWithParam<Format> {
  protected:
    fs::path written(const Words& words) const {
        write_text(folder_ / GetParam().file, GetParam().text(words));
        return folder_ / GetParam().file;
    }
    const TemporaryFolder folder_;
};

TEST_P(UnknownNumbers, StayUnknownInVelocitiesAndSpins) {
    for (const char* word : {"nan", "-nan", "inf", "-inf", "1e400", "1e30", "-nan(ind)", "1.#QNAN"}) {
        Words velocity, spin;
        velocity.vz = spin.wx = word;
        const ForeignArchive moving(written(velocity), {});
        State state = moving.grains(0);
        EXPECT_TRUE(std::isnan(state.velocity[1].z())) << word;
        EXPECT_EQ(state.velocity[1].x(), 0) << word;
        EXPECT_EQ(state.velocity[0].z(), 0.5);
        EXPECT_EQ(state.velocity[2].z(), 0.75);
        EXPECT_THAT(moving.news_of_frames(),
                    testing::ElementsAre(tells({"1 velocity is no number", "grain 2"})));
        const ForeignArchive turning(written(spin), {});
        state = turning.grains(0);
        EXPECT_EQ(state.spin[0].x(), 1);
        EXPECT_TRUE(std::isnan(state.spin[1].x())) << word;
        EXPECT_THAT(turning.news_of_frames(), testing::ElementsAre(HasSubstr("1 spin is no number")));
    }
    const ForeignArchive whole(written({}), {});
    EXPECT_EQ(whole.grains(0).velocity[1].z(), 0.25);
    EXPECT_THAT(whole.news_of_frames(), testing::IsEmpty());
}

TEST_P(UnknownNumbers, AreRefusedInPlacesRadiiAndIds) {
    for (const char* word : {"nan", "inf", "1e400"})
        for (std::string Words::*const member : {&Words::id, &Words::x, &Words::radius}) {
            Words words;
            words.*member = word;
            EXPECT_THROW(ForeignArchive(written(words), {}).grains(0), UserError) << word;
        }
    for (const char* place : {"1e30", "-3e6"}) {
        Words words;
        words.x = place;
        EXPECT_THROW(ForeignArchive(written(words), {}).grains(0), UserError) << place;
    }
}

TEST_P(UnknownNumbers, ANumberOfFortranIsTaken) {
    Words words;
    words.vz = "2.5d-1";
    EXPECT_EQ(ForeignArchive(written(words), {}).grains(0).velocity[1].z(), 0.25);
}

TEST_P(UnknownNumbers, ComeBackUnknownFromEveryExport) {
    Words words;
    words.vz = "nan";
    const ForeignArchive archive(written(words), {});
    for (const auto& [format, file] : {std::pair("csv", "o.csv"),
                                       {"xyz", "o.xyz"},
                                       {"lammps-dump", "o.dump"},
                                       {"vtk", "o-vtk"},
                                       {"gsd", "o.gsd"},
                                       {"netcdf", "o.nc"}}) {
        if (std::string(format) == "netcdf" && !archive.world().time_known) continue;
        const Exported made =
            export_frames(archive, format, folder_ / file, {}, true, [](double) { return true; });
        EXPECT_THAT(made.news, testing::Contains(HasSubstr("1 velocity is no number"))) << format;
        const bool in_folder = std::string(format) == "vtk";
        const State state =
            open_frames(in_folder ? folder_ / file / "grains.pvd" : folder_ / file)->grains(0);
        ASSERT_EQ(state.size(), 3u) << format;
        EXPECT_TRUE(std::isnan(state.velocity[1].z())) << format;
        EXPECT_EQ(state.velocity[0].z(), 0.5) << format;
    }
    for (const char* format : {"lammps-data", "grain-table"})
        EXPECT_THROW(export_frames(archive, format, folder_ / "start", {}, true, [](double) { return true; }),
                     UserError)
            << format;
}

TEST_P(UnknownNumbers, AreUnknownInAnImportedRun) {
    Words words;
    words.vz = "nan";
    ImportRequest request;
    request.from = written(words);
    request.folder = folder_ / "run";
    const Imported made = import_run(request);
    EXPECT_THAT(made.news, testing::Contains(HasSubstr("1 velocity is no number")));
    const TrajectoryReader trajectory(folder_ / "run/trajectory.nc");
    const State state = trajectory.read(0);
    EXPECT_TRUE(std::isnan(state.velocity[1].z()));
    EXPECT_EQ(state.velocity[2].z(), 0.75);
    EXPECT_TRUE(trajectory.info().velocities);
    EXPECT_TRUE(trajectory.info().spins);
}

INSTANTIATE_TEST_SUITE_P(Formats, UnknownNumbers,
                         testing::Values(Format{"a.csv", csv_of}, Format{"a.xyz", xyz_of},
                                         Format{"a.dump", dump_of}, Format{"a.vtk", vtk_of},
                                         Format{"a.vtp", vtp_of}),
                         [](const auto& of) { return std::string(of.param.file).substr(2); });

// An empty cell is a missing number; "NA" is one of R.
TEST(UnknownCells, AreMissingNumbersOfATable) {
    const TemporaryFolder folder;
    for (const char* word : {"", "NA", "null"}) {
        Words words;
        words.vz = word;
        write_text(folder / "a.csv", csv_of(words));
        EXPECT_TRUE(std::isnan(ForeignArchive(folder / "a.csv", {}).grains(0).velocity[1].z())) << word;
    }
}

// A slip among types that are numbers makes a species, and is told. Words alone are names of species.
TEST(UnknownCells, AWordAmongTypesThatAreNumbersIsTold) {
    const TemporaryFolder folder;
    const auto news_of = [&](const std::string& one, const std::string& other,
                             const ReadingOptions& options) {
        write_text(folder / "a.csv",
                   "id,type,x,y,z,radius\n1," + one + ",0,0,0,0.1\n2," + other + ",1,0,0,0.1\n");
        std::string all;
        for (const std::string& line : ForeignArchive(folder / "a.csv", options).news()) all += line + "\n";
        return all;
    };
    ReadingOptions named;
    named.species["1x"] = "big";
    EXPECT_THAT(news_of("1", "1x", {}), tells({"a.csv", "types are numbers", "\"1x\"", "--species"}));
    for (const std::string& quiet :
         {news_of("1", "2.5", {}), news_of("glass", "1x", {}), news_of("1", "1x", named)})
        EXPECT_EQ(quiet.find("types are numbers"), std::string::npos) << quiet;
}

// A type that --species names and no grain has may come later, so it is told; a word among numbers is a slip.
TEST(UnknownCells, ATypeThatNoGrainHasIsTold) {
    const TemporaryFolder folder;
    const auto news_of = [&](const std::string& types, const ReadingOptions& options) {
        write_text(folder / "a.csv", "id,type,x,y,z,radius\n1," + types + ",0,0,0,0.1\n");
        std::string all;
        for (const std::string& line : ForeignArchive(folder / "a.csv", options).news()) all += line + "\n";
        return all;
    };
    ReadingOptions later, slip;
    later.species = {{"1", "small"}, {"3", "big"}};
    slip.species = {{"sand", "1"}};
    EXPECT_THAT(news_of("1", later), tells({"--species", "type 3", "no grain", "a.csv", "type is"}));
    EXPECT_THAT(news_of("glass", slip), tells({"--species", "sand", "no grain", "a.csv", "glass"}));
    EXPECT_EQ(news_of("3", {}).find("no grain"), std::string::npos);
    EXPECT_THAT([&] { news_of("1", slip); },
                testing::ThrowsMessage<UserError>(tells({"--species", "sand", "no grain", "a.csv"})));
}

TEST(UnknownCells, AWordInAColumnOfNumbersIsRefusedWithItsRow) {
    const TemporaryFolder folder;
    for (const auto& [member, name] : {std::pair(&Words::id, "id"),
                                       {&Words::x, "x"},
                                       {&Words::radius, "radius"},
                                       {&Words::vz, "vz"},
                                       {&Words::wx, "wx"}}) {
        Words words;
        words.*member = "abc";
        write_text(folder / "a.csv", csv_of(words));
        try {
            ForeignArchive(folder / "a.csv", {}).grains(0);
            ADD_FAILURE() << name << " was taken";
        } catch (const UserError& mistake) {
            EXPECT_THAT(mistake.what(), tells({"a.csv:3: ", name, "\"abc\""}));
        }
    }
}

// What a file has no column for is not written as 0.
TEST(UnknownColumns, AreNoColumnsOfExports) {
    const TemporaryFolder folder;
    write_text(folder / "a.csv", "time,id,x,y,z,radius,vx,vy,vz\n0,1,0,0,0,0.1,0,0,1\n");
    const ForeignArchive archive(folder / "a.csv", {});
    const auto text = [&](const char* format, const char* file) {
        export_frames(archive, format, folder / file, {}, true, [](double) { return true; });
        return text_of(folder / file);
    };
    EXPECT_THAT(text("csv", "o.csv"), testing::AllOf(HasSubstr(",vz\n"), testing::Not(HasSubstr("wx"))));
    EXPECT_THAT(text("xyz", "o.xyz"), testing::AllOf(HasSubstr("velo"), testing::Not(HasSubstr("omega"))));
    EXPECT_THAT(text("lammps-dump", "o.dump"), testing::Not(HasSubstr("omega")));
    text("netcdf", "o.nc");
    const std::unique_ptr<StateArchive> trajectory = open_frames(folder / "o.nc");
    EXPECT_TRUE(trajectory->supply().velocities);
    EXPECT_FALSE(trajectory->supply().spins);
}

constexpr const char* kMasses =
    "time,id,x,y,z,radius,mass,vx,vy,vz\n0,1,0,0,0,0.1,5,0,0,1\n0,2,1,0,0,0.1,7,0,0,1\n0,3,2,0,0,0.05,0.5,0,"
    "0,1\n";

TEST(MassesOfGrains, StayTheirOwnInExportsAndImports) {
    const TemporaryFolder folder;
    write_text(folder / "a.csv", kMasses);
    const ForeignArchive archive(folder / "a.csv", {});
    EXPECT_THAT(archive.grains(0).mass, testing::ElementsAre(5, 7, 0.5));
    for (const auto& [format, file] : {std::pair("csv", "o.csv"),
                                       {"xyz", "o.xyz"},
                                       {"lammps-dump", "o.dump"},
                                       {"vtk", "o-vtk"},
                                       {"gsd", "o.gsd"},
                                       {"netcdf", "o.nc"}}) {
        export_frames(archive, format, folder / file, {}, true, [](double) { return true; });
        const bool in_folder = std::string(format) == "vtk";
        EXPECT_THAT(open_frames(in_folder ? folder / file / "grains.pvd" : folder / file)->grains(0).mass,
                    testing::ElementsAre(5, 7, 0.5))
            << format;
    }
    ImportRequest request;
    request.from = folder / "a.csv";
    request.folder = folder / "run";
    import_run(request);
    EXPECT_THAT(TrajectoryReader(folder / "run/trajectory.nc").read(0).mass, testing::ElementsAre(5, 7, 0.5));
}

TEST(MassesOfGrains, AreThoseOfTheSpeciesWhereTheFileSaysNone) {
    const TemporaryFolder folder;
    std::string text = kMasses;
    text.replace(text.find(",7,"), 3, ",0,");
    write_text(folder / "a.csv", text);
    const ForeignArchive archive(folder / "a.csv", {});
    const double sphere = 4.0 / 3 * M_PI * 1e-3;
    const double density = (5 / sphere + 0.5 / (sphere / 8)) / 2;
    EXPECT_NEAR(archive.grains(0).mass[1], density * sphere, 1e-9);
    EXPECT_THAT(archive.news_of_frames(), testing::ElementsAre(tells({"1 mass", "density of the species"})));
    ReadingOptions options;
    options.density = 1000;
    EXPECT_THAT(ForeignArchive(folder / "a.csv", options).grains(0).mass, testing::IsEmpty());
}

// A run whose grains all have the density of their species needs no masses. They may differ only later.
TEST(MassesOfGrains, AreKeptFromTheFrameOnInWhichTheyDiffer) {
    const TemporaryFolder folder;
    const double sphere = 1000 * 4.0 / 3 * M_PI * 1e-3;
    const auto text = [&](double last) {
        return fmt::format("time,id,x,y,z,radius,mass\n0,1,0,0,0,0.1,{0}\n1,1,0,0,0,0.1,{1}\n", sphere, last);
    };
    ImportRequest request;
    request.from = folder / "a.csv";
    write_text(folder / "a.csv", text(sphere));
    request.folder = folder / "alike";
    import_run(request);
    EXPECT_FALSE(TrajectoryReader(folder / "alike/trajectory.nc").info().masses);
    write_text(folder / "a.csv", text(2 * sphere));
    request.folder = folder / "heavier";
    import_run(request);
    const TrajectoryReader trajectory(folder / "heavier/trajectory.nc");
    ASSERT_TRUE(trajectory.info().masses);
    EXPECT_NEAR(trajectory.read(0).mass[0], sphere, 1e-12);
    EXPECT_NEAR(trajectory.read(1).mass[0], 2 * sphere, 1e-12);
}

std::string one_frame(const std::string& names, const std::string& rows, int count,
                      const std::string& flags = "pp pp ff") {
    return fmt::format(
        "ITEM: TIME\n0\nITEM: TIMESTEP\n0\nITEM: NUMBER OF ATOMS\n{}\nITEM: BOX BOUNDS {}\n0 1\n0 "
        "1\n0 1\nITEM: ATOMS {}\n{}",
        count, flags, names, rows);
}

TEST(UnwrappedPlaces, AreMovedIntoThePeriodicBoxWithAWord) {
    const TemporaryFolder folder;
    write_text(folder / "a.dump", one_frame("id xu yu zu radius", "1 2.25 -0.25 1.5 0.1\n", 1));
    const ForeignArchive archive(folder / "a.dump", {});
    EXPECT_LT((archive.grains(0).position[0] - Vec3(0.25, 0.75, 1.5)).norm(), 1e-12);
    EXPECT_THAT(archive.news(),
                testing::Contains(tells({"outside of its periodic box", "--columns x=xu,y=yu "})));
    ReadingOptions options;
    options.columns = {{"x", "xu"}, {"y", "yu"}, {"z", "zu"}};
    const ForeignArchive as_written(folder / "a.dump", options);
    EXPECT_EQ(as_written.grains(0).position[0], Vec3(2.25, -0.25, 1.5));
    EXPECT_THAT(as_written.news(), testing::Not(testing::Contains(HasSubstr("periodic"))));
}

TEST(ShapesOfGrains, AreToldWhereTheyAreNoSpheres) {
    const TemporaryFolder folder;
    const auto news = [&](const char* names, const char* row) {
        write_text(folder / "a.dump", one_frame(std::string("id x y z ") + names, row, 1));
        std::string all;
        for (const std::string& line : ForeignArchive(folder / "a.dump", {}).news()) all += line + "\n";
        return all;
    };
    EXPECT_THAT(news("shapex shapey shapez", "1 0 0 0 0.1 0.2 0.3\n"),
                tells({"no spheres", "shapex, shapey, shapez"}));
    EXPECT_THAT(news("radius blockiness1 blockiness2", "1 0 0 0 0.1 2 8\n"),
                tells({"no spheres", "blockiness2", "radius"}));
    EXPECT_EQ(news("shapex shapey shapez blockiness1", "1 0 0 0 0.1 0.1 0.1 2\n"), "");
    EXPECT_THAT(news("shapex shapey shapez quatw quati quatj quatk", "1 0 0 0 0.4 0.1 0.1 1 0 0 0\n"),
                tells({"no spheres", "ellipsoids", "same volume"}));
}

// LAMMPS' columns hold whole lengths, LIGGGHTS' half lengths; both with the real part of the quaternion
// first.
TEST(ShapesOfGrains, AreReadWhereTheirAxesAreKnown) {
    const TemporaryFolder folder;
    const auto read = [&](const char* names, const char* row, const ReadingOptions& options = {}) {
        write_text(folder / "a.dump", one_frame(std::string("id x y z ") + names, row, 1));
        return ForeignArchive(folder / "a.dump", options).grains(0);
    };
    const State lammps =
        read("shapex shapey shapez quatw quati quatj quatk", "1 0 0 0 0.4 0.2 0.1 0.6 0 0.8 0\n");
    ASSERT_EQ(lammps.shape.size(), 1u);
    EXPECT_EQ(lammps.shape[0].half, Vec3(0.2, 0.1, 0.05));
    EXPECT_EQ(lammps.orientation[0].coeffs(), Quaternion(0.6, 0, 0.8, 0).coeffs());
    EXPECT_NEAR(lammps.radius[0], 0.1, 1e-12);  // (0.2 x 0.1 x 0.05)^(1/3)
    const char* of_liggghts = "radius shapex shapey shapez quat1 quat2 quat3 quat4 blockiness1 blockiness2";
    const State liggghts = read(of_liggghts, "1 0 0 0 0.5 0.4 0.2 0.1 0.6 0 0.8 0 8 2\n");
    EXPECT_EQ(liggghts.shape[0].half, Vec3(0.4, 0.2, 0.1));
    EXPECT_EQ(liggghts.shape[0].along, 8);
    EXPECT_EQ(liggghts.shape[0].around, 2);
    ReadingOptions options;
    options.radius = 0.3;
    const State spheres = read(of_liggghts, "1 0 0 0 0.5 0.4 0.2 0.1 0.6 0 0.8 0 8 2\n", options);
    EXPECT_TRUE(spheres.shape.empty());
    EXPECT_EQ(spheres.radius[0], 0.3);
    for (const char* absurd :
         {"1 0 0 0 0.5 0 0.2 0.1 1 0 0 0 8 2\n", "1 0 0 0 0.5 0.4 0.2 0.1 1 0 0 0 1 2\n",
          "1 0 0 0 0.5 nan 0.2 0.1 1 0 0 0 8 2\n", "1 0 0 0 0.5 1e9 0.2 0.1 1 0 0 0 8 2\n"})
        EXPECT_THROW(read(of_liggghts, absurd), UserError) << absurd;
}

TEST(AbsurdPlaces, OfWallsAreRefused) {
    RawWall wall;
    wall.mesh.vertices = {Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 2e7, 0)};
    wall.mesh.triangles = {{0, 1, 2}};
    std::vector<std::string> news;
    EXPECT_EQ(follow_walls({{0, {}, {wall}}}, 0.001, "w.vtk", news).size(), 1u);
    EXPECT_THROW(follow_walls({{0, {}, {wall}}}, 1, "w.vtk", news), UserError);
}

TEST(AbsurdClocks, AreRefused) {
    const TemporaryFolder folder;
    for (const char* clock : {"step\n9100000000000000000", "step\n9000000000000000", "time\n1e12"}) {
        const std::string name(clock, std::string_view(clock).find('\n'));
        write_text(folder / "a.csv", fmt::format("{},id,x,y,z,radius\n{},1,0,0,0,1\n", name,
                                                 std::string(clock).substr(name.size() + 1)));
        EXPECT_THROW(ForeignArchive(folder / "a.csv", {}), UserError) << clock;
    }
}

}  // namespace
}  // namespace grainreel
