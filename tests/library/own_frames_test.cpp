// Frames that a program makes itself: writing them in every format, reading them again, drawing them.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include <grainreel/error.hpp>
#include <grainreel/files.hpp>
#include <grainreel/picture.hpp>

#include "tests/support/temporary_folder.hpp"

namespace gr = grainreel;

namespace {

gr::World one_species() {
    gr::World world;
    world.species = {"ball"};
    return world;
}

// A row of balls that do not touch.
gr::Frame row_of_balls(int count, double time) {
    gr::Frame frame;
    frame.time = time;
    for (int k = 0; k < count; ++k) frame.add({0.01 * k, 0, 0.02 + 0.001 * k}, 0.004);
    return frame;
}

// The message of the Error that the call throws; empty if it throws none.
template <class Call>
std::string complaint(const Call& call) {
    try {
        call();
    } catch (const gr::Error& error) {
        return error.what();
    }
    return "";
}

bool has(const std::string& text, const std::string& part) {
    return text.find(part) != std::string::npos;
}

const std::vector<std::string> kept_whole{"netcdf", "lammps-dump", "xyz", "csv", "vtk", "gsd"};

TEST(OwnFrames, ComeBackWithoutStepsInEveryFormat) {
    const grainreel::test::TemporaryFolder folder;
    for (const std::string& format : kept_whole) {
        gr::FrameWriter writer(folder / format, format, one_species());
        const std::vector<int> counts{5, 7, 3, 20};  // grains come and go
        for (int k = 0; k < 4; ++k) writer.write(row_of_balls(counts[static_cast<std::size_t>(k)], 0.1 * k));
        writer.close();
        const gr::FrameFile file(folder / format);
        ASSERT_EQ(file.size(), 4U) << format;
        for (std::size_t k = 0; k < 4; ++k) {
            const gr::Frame frame = file.frame(k);
            ASSERT_EQ(frame.size(), static_cast<std::size_t>(counts[k])) << format << " frame " << k;
            if (format != "gsd") {
                EXPECT_NEAR(frame.time, 0.1 * static_cast<double>(k), 1e-12) << format;
            }
            EXPECT_NEAR(frame.position.back().z, 0.02 + 0.001 * (counts[k] - 1), 1e-7) << format;
        }
        for (const std::string& line : file.news()) EXPECT_FALSE(has(line, "passed over")) << line;
    }
}

// Formats that have a place for masses keep that of each grain, and a frame says where it has none.
TEST(OwnFrames, KeepTheMassOfEachGrain) {
    const grainreel::test::TemporaryFolder folder;
    for (const std::string format : {"lammps-dump", "xyz", "csv", "vtk"}) {
        gr::FrameWriter writer(folder / format, format, one_species());
        gr::Frame frame = row_of_balls(3, 0);
        frame.mass = {1e-3, 2e-3, 4e-3};
        writer.write(frame);
        frame.time = 1;
        frame.mass[1] = 0;
        EXPECT_TRUE(has(complaint([&] { writer.write(frame); }), "grain 1 has a mass of 0 kg"));
        frame.mass = {1e-3, 2e-3};
        EXPECT_TRUE(has(complaint([&] { writer.write(frame); }), "3 ids and 2 entries of mass"));
        frame.mass.clear();
        EXPECT_TRUE(has(complaint([&] { writer.write(frame); }), "no masses, unlike the frames before"));
        writer.close();
        const std::vector<double> read = gr::FrameFile(folder / format).frame(0).mass;
        ASSERT_EQ(read.size(), 3U) << format;
        for (std::size_t k = 0; k < 3; ++k) EXPECT_NEAR(read[k] / (1e-3 * (1 << k)), 1, 1e-6) << format;
    }
    EXPECT_TRUE(row_of_balls(2, 0).mass.empty());
}

// The file has as many places as its largest frame has grains.
TEST(OwnFrames, MakeATrajectoryThatGrows) {
    const grainreel::test::TemporaryFolder folder;
    gr::FrameWriter writer(folder / "run.nc", "netcdf", one_species());
    for (int k = 0; k < 30; ++k) {
        gr::Frame frame = row_of_balls(k, 0.01 * k);  // none at first
        frame.orientation.resize(frame.size());
        for (gr::Rotation& one : frame.orientation) one = {std::cos(0.1 * k), std::sin(0.1 * k), 0, 0};
        writer.write(frame);
    }
    writer.close();
    const gr::FrameFile file(folder / "run.nc");
    ASSERT_EQ(file.size(), 30U);
    for (std::size_t k = 0; k < 30; ++k) {
        const gr::Frame frame = file.frame(k);
        ASSERT_EQ(frame.size(), k);
        EXPECT_EQ(frame.step, static_cast<std::int64_t>(k));
        ASSERT_EQ(frame.orientation.size(), k);
        if (k > 0) {
            EXPECT_NEAR(frame.orientation[k - 1].x, std::sin(0.1 * static_cast<double>(k)), 1e-6);
        }
    }
    EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder / ""),
                            std::filesystem::directory_iterator()),
              1);
    // 29 places: the last frame's grains, without an empty place.
    gr::FrameWriter exact(folder / "exact.nc", "netcdf", one_species());
    gr::Frame full = row_of_balls(29, 0);
    full.orientation.resize(29);
    for (int k = 0; k < 30; ++k) full.time = 0.01 * k, exact.write(full);
    exact.close();
    EXPECT_EQ(std::filesystem::file_size(folder / "run.nc"), std::filesystem::file_size(folder / "exact.nc"));
}

// In a dump of a region, a grain may come whose id lies between those of others.
TEST(OwnFrames, MayComeInAnyOrderOfIds) {
    const grainreel::test::TemporaryFolder folder;
    const std::vector<std::vector<std::int32_t>> ids{{1, 3}, {1, 2, 3}, {0, 4}, {2, 5, 6}};
    gr::FrameWriter writer(folder / "a.dump", "lammps-dump", one_species());
    for (std::size_t k = 0; k < ids.size(); ++k) {
        gr::Frame frame = row_of_balls(static_cast<int>(ids[k].size()), 0.1 * static_cast<double>(k));
        frame.id = ids[k];
        for (std::size_t i = 0; i < ids[k].size(); ++i) frame.position[i].x = ids[k][i];
        writer.write(frame);
    }
    writer.close();
    gr::FrameFile(folder / "a.dump").write(folder / "a.nc", "netcdf");
    const gr::FrameFile file(folder / "a.nc");
    ASSERT_EQ(file.size(), ids.size());
    for (std::size_t k = 0; k < ids.size(); ++k) {
        const gr::Frame frame = file.frame(k);
        ASSERT_EQ(frame.id, ids[k]) << "frame " << k;
        for (std::size_t i = 0; i < ids[k].size(); ++i) EXPECT_EQ(frame.position[i].x, ids[k][i]);
    }
}

TEST(OwnFrames, MustRise) {
    const grainreel::test::TemporaryFolder folder;
    gr::FrameWriter writer(folder / "a.xyz", "xyz", one_species());
    gr::Frame frame = row_of_balls(2, 1);
    frame.step = 10;
    writer.write(frame);
    EXPECT_TRUE(has(complaint([&] { writer.write(frame); }), "rising time"));
    frame.time = 2;
    EXPECT_TRUE(has(complaint([&] { writer.write(frame); }), "its step is 10, and that of the frame before"));
    frame.step = 0;
    EXPECT_TRUE(has(complaint([&] { writer.write(frame); }), "rising steps"));
    frame.step = 20;
    frame.time = NAN;
    EXPECT_TRUE(has(complaint([&] { writer.write(frame); }), "has no time"));
    frame.time = INFINITY;
    EXPECT_TRUE(has(complaint([&] { writer.write(frame); }), "its time is inf s"));
    frame.time = 2;
    frame.orientation.resize(2);
    EXPECT_TRUE(has(complaint([&] { writer.write(frame); }), "orientations, unlike the frames before"));
    frame.orientation.clear();
    writer.write(frame);
    writer.close();
    const gr::FrameFile file(folder / "a.xyz");
    ASSERT_EQ(file.size(), 2U);  // what was refused is not there
    EXPECT_EQ(file.frame(1).step, 20);
}

TEST(OwnFrames, MayHaveNoTimes) {
    const grainreel::test::TemporaryFolder folder;
    for (const std::string format : {"xyz", "lammps-dump", "vtk", "csv", "gsd"}) {
        gr::FrameWriter writer(folder / format, format, one_species());
        for (const int count : {2, 3}) writer.write(row_of_balls(count, NAN));
        EXPECT_TRUE(has(complaint([&] { writer.write(row_of_balls(2, 1)); }), "has a time")) << format;
        writer.close();
        const gr::FrameFile file(folder / format);
        ASSERT_EQ(file.size(), 2U) << format;
        EXPECT_TRUE(std::isnan(file.time(1)) && std::isnan(file.frame(1).time)) << format;
        EXPECT_EQ(file.frame(1).size(), 3U) << format;
        EXPECT_THROW(file.nearest(0), gr::Error) << format;
    }
    gr::FrameWriter writer(folder / "a.nc", "netcdf", one_species());
    EXPECT_TRUE(has(complaint([&] { writer.write(row_of_balls(2, NAN)); }), "has times"));
}

TEST(OwnFrames, LeaveNoFileIfAllAreRefused) {
    const grainreel::test::TemporaryFolder folder;
    for (const std::string& format : gr::written_formats()) {
        gr::Frame bad = row_of_balls(2, 0);
        bad.radius[1] = -1;
        {
            gr::FrameWriter writer(folder / format, format, one_species());
            const std::string wrong = complaint([&] { writer.write(bad); });
            EXPECT_TRUE(has(wrong, "frame 0: grain 1 has a radius of -1 m")) << wrong;
            EXPECT_TRUE(has(complaint([&] { writer.close(); }), "without a frame")) << format;
        }
        EXPECT_FALSE(std::filesystem::exists(folder / format)) << format;
    }
    std::ofstream(folder / "old") << "precious";
    EXPECT_THROW(gr::FrameWriter(folder / "old", "xyz", one_species()), gr::Error);
    EXPECT_EQ(std::filesystem::file_size(folder / "old"), 8U);
    EXPECT_THROW(gr::FrameWriter(folder / "no/new.nc", "netcdf", one_species()), gr::Error);
}

TEST(OwnFrames, MustFitTheirWorld) {
    const grainreel::test::TemporaryFolder folder;
    gr::World world = one_species();
    world.walls = {gr::Mesh::box("box", {-0.01, -0.01, 0}, {0.3, 0.01, 0.1})};
    gr::Frame frame = row_of_balls(9, 0);
    for (const std::size_t count : {0U, 1U, 2U, 3U, 4U}) {
        frame.bodies.resize(count);
        const bool wrong = count == 1 || count == 2;
        const std::string name = "bodies" + std::to_string(count);
        for (const std::string format : {"netcdf", "vtk"}) {
            gr::FrameWriter writer(folder / (name + format), format, world);
            const std::string words = complaint([&] { writer.write(frame); });
            EXPECT_EQ(has(words, "give none, or 3: container, floor and 1 walls"), wrong) << words;
        }
        EXPECT_EQ(complaint([&] { gr::Painter(world, frame, {"film.size=160x120"}); }) != "", wrong);
    }
    frame.bodies.clear();
    frame.species[7] = 3;
    gr::FrameWriter writer(folder / "a.xyz", "xyz", world);
    EXPECT_TRUE(has(complaint([&] { writer.write(frame); }),
                    "a.xyz: frame 0: grain 7 has the species 3; there is 1, counted from 0"));
    try {
        writer.write(frame);
    } catch (const gr::Error& error) {
        EXPECT_EQ(error.file(), (folder / "a.xyz").string());
    }
    const auto refused = [&](gr::World other) {
        return complaint([&] { gr::FrameWriter(folder / "b.xyz", "xyz", other); });
    };
    for (const double density : {-1.0, 0.0, HUGE_VAL}) {
        world.density = {density};
        EXPECT_TRUE(has(refused(world), "\"ball\" of a world has the density")) << density;
    }
    world.density = {NAN};
    EXPECT_EQ(refused(world), "");
    world.density.clear();
    world.species = {"a", "b", "a"};
    EXPECT_TRUE(has(refused(world), "two species with the name \"a\""));
}

TEST(FramesOfOneFile, AreReadAlone) {
    const grainreel::test::TemporaryFolder folder;
    for (const int number : {0, 10}) {
        gr::FrameWriter writer(folder / ("dump" + std::to_string(number)), "xyz", one_species());
        gr::Frame frame = row_of_balls(number + 1, number);
        frame.step = number;
        writer.write(frame);
        writer.close();
    }
    const gr::FrameFile alone(folder / "dump10");
    EXPECT_EQ(alone.size(), 1U);
    EXPECT_EQ(alone.frame(0).size(), 11U);
    gr::ReadOptions all;
    all.series = true;
    EXPECT_EQ(gr::FrameFile(folder / "dump10", all).size(), 2U);
    EXPECT_EQ(gr::FrameFile(folder / "dump*").size(), 2U);
}

// Files of a series that have the same step and the same grains: the later one counts, and this is said.
TEST(FramesOfOneFile, AreToldToComeTwice) {
    const grainreel::test::TemporaryFolder folder;
    for (const std::string ending : {"xyz", "dump"}) {
        for (const int number : {1, 2}) {
            gr::FrameWriter writer(folder / (ending + std::to_string(number)),
                                   ending == "dump" ? "lammps-dump" : "xyz", one_species());
            writer.write(row_of_balls(number, 0.1 * number));
            writer.close();
        }
        const gr::FrameFile file(folder / (ending + "*"));
        EXPECT_EQ(file.size(), 1U);
        EXPECT_TRUE(std::ranges::any_of(file.news(), [](const std::string& line) {
            return has(line, "again; the later file counts");
        })) << ending;
    }
}

// What a film can show is the same as what frames know. The range of colours comes from the first frame.
TEST(OwnPictures, AreColouredByWhatFramesKnow) {
    gr::World world = one_species();
    gr::Frame frame = row_of_balls(9, 0);
    frame.velocity[3] = {0, 0.5, 0};
    const auto picture = [&](const std::string& by, const std::string& range = "") {
        std::vector<std::string> settings{"film.size=160x120", "film.words=none", "film.colour.by=" + by};
        if (!range.empty()) settings.push_back("film.colour.range=" + range);
        return gr::Painter(world, frame, settings).draw(frame).rgba;
    };
    EXPECT_EQ(picture("start-height"), picture("start-height", R"(["0 mm", "28 mm"])"));
    EXPECT_NE(picture("start-height"), picture("start-height", R"(["0 mm", "20 mm"])"));
    // As fast as a grain that falls from 28 mm and has 0.5 m/s at first.
    char fall[64];
    std::snprintf(fall, sizeof(fall), "[0, %.17g]", std::sqrt(0.25 + 2 * 9.81 * 0.028));
    EXPECT_EQ(picture("speed"), picture("speed", fall));
    for (const std::string by : {"vertical-velocity", "spin", "kinetic-energy"})
        EXPECT_NO_THROW(picture(by)) << by;
    EXPECT_TRUE(has(complaint([&] { picture("coordination"); }), "knows no contacts"));
    EXPECT_TRUE(has(complaint([&] { picture("contact-force"); }), "knows no contacts"));
    for (const std::string by : {"displacement", "rise", R"("rise")"})
        EXPECT_TRUE(has(complaint([&] { picture(by); }), "knows no displacements")) << by;
    const gr::World& other = world;
    EXPECT_TRUE(
        has(complaint([&] { gr::Painter(other, frame, {"film.force_chains=true"}); }), "no contacts"));
    EXPECT_TRUE(has(complaint([&] { picture("start-height", "3"); }), R"(["0 mm", "5 mm"])"));
}

TEST(OwnPictures, RefuseWordsThatAreNotUtf8) {
    gr::World world = one_species();
    const gr::Frame frame = row_of_balls(2, 0);
    gr::Painter painter(world, frame, {"film.size=160x120"});
    testing::internal::CaptureStderr();
    EXPECT_TRUE(has(complaint([&] { painter.draw(frame, "\xff\xfe"); }), "the words of a picture: "));
    EXPECT_THROW(painter.draw(frame, std::string(1, '\0')), gr::Error);
    EXPECT_NO_THROW(painter.draw(frame, "höher"));
    world.title = "\xff";
    EXPECT_TRUE(has(complaint([&] { gr::Painter(world, frame); }), "the title of a world: "));
    EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
}

}  // namespace
