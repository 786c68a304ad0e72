// Tests of films and pictures of files of other programs.
#include <chrono>
#include <cmath>
#include <fstream>
#include <thread>

#include <gmock/gmock.h>

#include <nlohmann/json.hpp>

#include "engine/files/frames/open_frames.hpp"
#include "engine/run/import/import_ranges.hpp"
#include "engine/state/pose.hpp"
#include "tests/cli/film_length.hpp"
#include "tests/cli/foreign/foreign_bed.hpp"
#include "tests/support/small_scene.hpp"
#include "tests/support/tells.hpp"

namespace grainreel {
namespace {

namespace fs = std::filesystem;
using namespace test;
using testing::HasSubstr;
using testing::Not;

class ForeignFilm : public ForeignBed {};

// The chunk with that name in a PNG; empty if there is none.
std::string chunk_of(const std::string& png, const std::string& name) {
    const auto number = [&](std::size_t at) {
        std::size_t value = 0;
        for (std::size_t i = 0; i < 4; ++i) value = value << 8 | static_cast<unsigned char>(png.at(at + i));
        return value;
    };
    for (std::size_t at = 8; at + 12 <= png.size(); at += 12 + number(at))
        if (png.compare(at + 4, 4, name) == 0) return png.substr(at + 8, number(at));
    return "";
}

TEST_F(ForeignFilm, HasThePicturesOfTheFramesOfTheFile) {
    const Ended ended =
        timed({"render", "bed.dump", "--walls", "paddle_*.stl", "--size", "160x120", "--frames"});
    ASSERT_EQ(ended.status, 0) << ended.err;
    EXPECT_EQ(ended.out, "./bed.dump-render\n");
    EXPECT_EQ(decoded_pictures(here / "bed.dump-render/movie.mp4"), kForeignFrames);
    EXPECT_EQ(std::distance(fs::directory_iterator(here / "bed.dump-render/frames"), {}), kForeignFrames);
    EXPECT_THAT(ended.err, tells({"no density", "energies", "left out", "--density"}));
    EXPECT_THAT(ended.err, Not(HasSubstr("says no times")));
}

TEST_F(ForeignFilm, AStillForPrintTellsItsPixelsAnInch) {
    ASSERT_EQ(timed({"render", "bed.dump", "--at", "0.02", "--size", "160x120", "--dpi", "254", "--out",
                     "print.png"})
                  .status,
              0);
    // 254 pixels an inch are 10,000 a metre; the last byte says that the unit is the metre.
    EXPECT_EQ(chunk_of(text_of(here / "print.png"), "pHYs"), std::string("\0\0\x27\x10\0\0\x27\x10\x01", 9));
    ASSERT_EQ(
        timed({"render", "bed.dump", "--at", "0.02", "--size", "160x120", "--out", "screen.png"}).status, 0);
    EXPECT_EQ(chunk_of(text_of(here / "screen.png"), "pHYs"), "");
}

// Two panels are as wide as a journal's column: 85 mm at 300 pixels an inch.
TEST_F(ForeignFilm, AComparisonAtAMomentIsForPrintToo) {
    const Ended ended = timed({"compare", "bed.dump", "bed.dump", "--at", "0.02", "--size", "320x180",
                               "--captions", "one|other", "--width-mm", "85", "--out", "both"});
    ASSERT_EQ(ended.status, 0) << ended.err;
    const std::string png = text_of(here / "both/still-0.020s.png");
    EXPECT_EQ(chunk_of(png, "pHYs"), std::string("\0\0\x2e\x23\0\0\x2e\x23\x01", 9));  // 11811 a metre
    const auto width = static_cast<std::uint32_t>(static_cast<unsigned char>(png.at(18)) << 8 |
                                                  static_cast<unsigned char>(png.at(19)));
    EXPECT_EQ(width, static_cast<std::uint32_t>(std::lround(85 / 25.4 * 300)));
    const Ended film = timed({"compare", "bed.dump", "bed.dump", "--dpi", "300", "--out", "film"});
    EXPECT_EQ(film.status, 2);
    EXPECT_THAT(film.err, tells({"--dpi", "one picture", "add --at"}));
}

// All grains rise at 0.1 m/s.
TEST_F(ForeignFilm, ColoursHaveTheirRangeFromTheFrames) {
    ASSERT_EQ(imported().status, 0);
    const auto range = [&](const char* quantity) {
        return imported_range(import(), quantity).value_or(std::array<double, 2>{0, 0});
    };
    EXPECT_EQ(range("start-height")[0], 0.005);
    EXPECT_EQ(range("start-height")[1], 0.015);
    for (const double most :
         {range("speed")[1], range("vertical-velocity")[1], -range("vertical-velocity")[0]}) {
        EXPECT_GE(most, 0.1);
        EXPECT_LE(most, 0.1 * 1.1);  // a class of sizes, and two digits
    }
    EXPECT_EQ(range("spin")[1], 0);
    EXPECT_EQ(range("contact-force")[1], 0);
    for (const char* by : {"speed", "vertical-velocity", "start-height", "kinetic-energy"}) {
        const Ended ended =
            imported({"--set", std::string("film.colour.by=") + by, "--out", std::string(by) + ".png"});
        EXPECT_EQ(ended.status, 0) << by << ' ' << ended.err;
    }
    const Ended none = imported({"--set", "film.colour.by=spin", "--out", "spin.png"});
    EXPECT_EQ(none.status, 2);
    EXPECT_THAT(none.err, HasSubstr("say nothing of \"spin\""));
}

TEST_F(ForeignFilm, AWallIsWhereItsFilesHaveIt) {
    ASSERT_EQ(imported({"--walls", "paddle_*.stl"}).status, 0);
    const auto frames = open_frames(import() / "trajectory.nc");
    ASSERT_EQ(frames->moments().size(), 4u);
    for (int k = 0; k < kForeignFrames; ++k) {
        const State frame = frames->grains(static_cast<std::size_t>(k));
        const Quaternion turn(Eigen::AngleAxisd(k * kPaddleTurn, Vec3::UnitZ()));
        // The files have nine digits for lengths up to 0.03 m.
        EXPECT_NEAR(frame.body(kFirstPlaneBody).rotation.angularDistance(turn), 0, 1e-6) << k;
        const Vec3 corner(0.03, 0.004, -0.01);
        EXPECT_NEAR((frame.body(kFirstPlaneBody).moved(corner) - turn * corner).norm(), 0, 1e-8) << k;
        EXPECT_EQ(frame.size(), static_cast<std::size_t>(kForeignGrains));
        EXPECT_EQ(frame.id.front(), 1);
        EXPECT_EQ(frame.radius.back(), 0.004);
        EXPECT_NEAR(frame.position.back().z(), 0.005 + 0.001 * k, 1e-12);
    }
}

// The container of a scene shakes by 1 mm at 25 Hz; the four frames lie a quarter of a period apart.
TEST_F(ForeignFilm, AContainerOfOursMovesByItsDrive) {
    write_text(here / "box.toml",
               SmallScene()
                   .beads(1, "any", "6 mm", "2.5 g/cm3")
                   .box("60 mm", "60 mm", "60 mm")
                   .more("[drive]\nfrequency = \"25 Hz\"\namplitude = \"1 mm\"\nramp = 0\n")
                   .lasts("1 s")
                   .text());
    const Ended ended = timed({"render", "bed.dump", "--container", "box.toml", "--at", "0.01", "--size",
                               "160x120", "--out", "shaken.png"});
    ASSERT_EQ(ended.status, 0) << ended.err;
    const auto frames = open_frames(import() / "trajectory.nc");
    ASSERT_EQ(frames->moments().size(), 4u);
    for (std::size_t k = 0; k < 4; ++k) {
        const State frame = frames->grains(k);
        const double phase = 2 * std::numbers::pi * 25 * 0.01 * static_cast<double>(k);
        EXPECT_NEAR(frame.container().place.z(), 0.001 * std::sin(phase), 1e-9) << k;
        EXPECT_NEAR(frame.position.back().z(), 0.005 + 0.001 * static_cast<double>(k), 1e-12) << k;
    }
}

// The bed is denser than the beds that a scene packs: a cube of eight grains that touch, 52 %, with one grain
// inside.
TEST_F(ForeignFilm, ABedMayBeCloserThanAScenePacksIt) {
    std::string text =
        "ITEM: TIMESTEP\n0\nITEM: NUMBER OF ATOMS\n9\nITEM: BOX BOUNDS pp pp pp\n0 0.02\n0 0.02\n0 0.02\n"
        "ITEM: ATOMS id type x y z radius\n";
    for (int i = 0; i < 8; ++i)
        text += fmt::format("{} 1 {} {} {} 0.005\n", i + 1, 0.005 + 0.01 * (i % 2),
                            0.005 + 0.01 * (i / 2 % 2), 0.005 + 0.01 * (i / 4));
    write_old_text(here / "close.dump", text + "9 1 0.01 0.01 0.01 0.0049\n");
    const Ended ended = program({"inspect", "close.dump", "--where", "radius > 1 mm", "--csv"});
    EXPECT_EQ(ended.status, 0) << ended.err;
}

TEST_F(ForeignFilm, AWallThatIsCalledLikeAFaceIsShown) {
    std::string text = foreign_paddle(0);
    for (std::size_t at = text.find("paddle"); at != std::string::npos; at = text.find("paddle"))
        text.replace(at, 6, "floor");
    write_old_text(here / "ground.stl", text);
    const Ended ended = imported({"--walls", "ground.stl"});
    EXPECT_EQ(ended.status, 0) << ended.err;
    EXPECT_THAT(text_of(import() / "scene.toml"), HasSubstr("floor of the files"));
}

// The test writes a frame each time another one was reported.
TEST_F(ForeignFilm, FollowsAFileThatGrows) {
    const fs::path file = here / "growing.dump";
    write_text(file, foreign_frame(0) + foreign_frame(1));
    std::thread writer([&] {
        for (int k = 2; k < 5; ++k) {
            std::this_thread::sleep_for(std::chrono::milliseconds(400));
            std::string text = foreign_frame(k);
            if (k == 4) text.replace(text.rfind("0.1"), 3, "nan");
            std::ofstream out(file, std::ios::app | std::ios::binary);
            out << text.substr(0, text.size() / 2) << std::flush;
            std::this_thread::sleep_for(std::chrono::milliseconds(200));
            out << text.substr(text.size() / 2);
        }
    });
    const Ended ended = timed({"render", "growing.dump", "--follow", "--idle", "6s", "--size", "160x120"});
    writer.join();
    EXPECT_EQ(ended.status, 0) << ended.err;
    EXPECT_EQ(decoded_pictures(here / "growing.dump-render/movie.mp4"), 5) << ended.err;
    EXPECT_THAT(ended.err,
                tells({"1 velocity is", "no number", "growing.dump"}));  // of a frame that came later
}

TEST_F(ForeignFilm, FollowingEndsWhereTheFileIsCutShort) {
    write_text(here / "cut.dump", foreign_dump(3));
    Program follower({"render", "cut.dump", "--follow", "--idle", "30", "--size", "160x120", "--time-step",
                      "1e-5", "--frames"},
                     setting());
    ASSERT_TRUE(wait_until(follower, [&] { return fs::exists(here / "cut.dump-render/frames/000002.png"); }));
    write_text(here / "cut.dump", foreign_dump(1));
    const Ended ended = follower.wait();
    EXPECT_EQ(ended.status, 1);
    EXPECT_THAT(ended.err, HasSubstr("truncated or replaced"));
}

TEST_F(ForeignFilm, RefusesToFollowARunOfOurs) {
    ASSERT_EQ(imported().status, 0);
    fs::rename(import(), here / "ours");
    const Ended ended = program({"render", "ours", "--follow"});
    EXPECT_EQ(ended.status, 2);
    EXPECT_THAT(ended.err, tells({"--follow", "other programs"}));
}

}  // namespace
}  // namespace grainreel
