// Tests of the program's films in every format: their files, stdout, and an interrupt.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>

#include <cstdlib>
#include <nlohmann/json.hpp>

#include "tests/cli/film_length.hpp"
#include "tests/cli/program.hpp"
#include "tests/support/small_scene.hpp"
#include "tests/support/tells.hpp"
#include "tests/support/temporary_folder.hpp"

namespace grainreel {
namespace {

namespace fs = std::filesystem;
using namespace test;
using testing::EndsWith;
using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

class FilmFormats : public testing::Test {
  protected:
    Ended movie(const std::vector<std::string>& more) const {
        std::vector<std::string> words = {"movie", scene.string()};
        words.insert(words.end(), more.begin(), more.end());
        return run_program(words, {here.path(), {}});
    }
    nlohmann::json record() const { return nlohmann::json::parse(text_of(here / "run/run.json")); }
    int frames_written() const { return record()["written"]["film_frames"].get<int>(); }

    TemporaryFolder here;
    fs::path scene = write_small_scene(here.path());
};

struct Format {
    const char* name;
    const char* file;
    const char* encoder;
};

class EachFormat : public FilmFormats, public testing::WithParamInterface<Format> {
  protected:
    fs::path film() const { return here / "run" / GetParam().file; }
};

INSTANTIATE_TEST_SUITE_P(All, EachFormat,
                         testing::Values(Format{"mp4", "movie.mp4", "libx264"},
                                         Format{"webm", "movie.webm", "libvpx-vp9"},
                                         Format{"av1", "movie.mp4", "av1"}, Format{"gif", "movie.gif", "GIF"},
                                         Format{"ffv1", "movie.mkv", "FFV1"},
                                         Format{"y4m", "movie.y4m", "Y4M"}),
                         [](const auto& format) { return format.param.name; });

TEST_P(EachFormat, HasAllFramesAndIsNamedInTheRecord) {
    const Ended ended = movie({"--out", "run", "--format", GetParam().name});
    ASSERT_EQ(ended.status, 0) << ended.err;
    EXPECT_EQ(ended.out, "run\n");
    EXPECT_THAT(ended.err, HasSubstr(GetParam().file));
    EXPECT_THAT(ended.err, Not(HasSubstr("Svt[")));  // libraries print nothing
    EXPECT_GE(frames_written(), 13);                 // 0.2 s at half speed with 30 frames a second, or 33.3
    EXPECT_EQ(decoded_pictures(film()), frames_written());
    EXPECT_THAT(record()["encoder"].get<std::string>(), HasSubstr(GetParam().encoder));
    EXPECT_TRUE(fs::exists(here / "run/poster.png"));
    EXPECT_FALSE(fs::exists(here / "run/movie.work"));
}

TEST_P(EachFormat, AnInterruptLeavesAFilmThatPlays) {
    Program program(
        {"movie", scene.string(), "--duration", "3600 s", "--out", "run", "--format", GetParam().name},
        {here.path(), {}});
    ASSERT_TRUE(wait_until(program, [&] { return fs::exists(here / "run/poster.png"); }));
    ASSERT_TRUE(wait_until(program, [&] {
        return fs::exists(here / "run/checkpoint.grs") || text_of(here / "run/measures.csv").size() > 3000;
    }));
    program.send(SIGINT);
    const Ended ended = program.wait();
    EXPECT_EQ(ended.status, 130) << ended.err;
    EXPECT_GT(frames_written(), 0);
    EXPECT_EQ(decoded_pictures(film()), frames_written());
    EXPECT_FALSE(fs::exists(here / "run/movie.work"));
}

TEST_F(FilmFormats, APngFilmIsItsFrames) {
    const Ended ended = movie({"--out", "run", "--format", "png", "--transparent", "--sheet", "3x2"});
    ASSERT_EQ(ended.status, 0) << ended.err;
    const auto files = fs::directory_iterator(here / "run/frames");
    EXPECT_EQ(std::distance(begin(files), end(files)), frames_written());
    EXPECT_THAT(ended.err, HasSubstr("poster.png, sheet.png, frames/ (13 pictures)"));
    EXPECT_FALSE(fs::exists(here / "run/movie.mp4"));
    EXPECT_TRUE(fs::exists(here / "run/sheet.png"));
    EXPECT_EQ(text_of(here / "run/frames/000000.png")[25], 6);  // IHDR's colour type: RGB and alpha
}

TEST_F(FilmFormats, Y4mOnStdoutIsTheFilmAndNothingElse) {
    const Ended ended = movie({"--out", "-", "--format", "y4m"});
    ASSERT_EQ(ended.status, 0) << ended.err;
    const std::string head = ended.out.substr(0, ended.out.find('\n') + 1);
    EXPECT_THAT(head, StartsWith("YUV4MPEG2 W160 H120 F30:1 "));
    EXPECT_THAT(head, HasSubstr("C420mpeg2"));
    constexpr std::size_t frame = 6 + 160 * 120 * 3 / 2;  // "FRAME\n" and three planes
    EXPECT_EQ((ended.out.size() - head.size()) % frame, 0u);
    EXPECT_EQ((ended.out.size() - head.size()) / frame, 13u);
    EXPECT_THAT(ended.err, EndsWith("output/fifty\n"));
    EXPECT_TRUE(fs::exists(here / "output/fifty/measures.csv"));
    EXPECT_FALSE(fs::exists(here / "output/fifty/movie.y4m"));
}

TEST_F(FilmFormats, AReaderThatEndsIsAClearError) {
    const std::string command =
        "cd '" + here.path().string() +
        "' && bash -c '" GRAINREEL_BINARY
        " movie fifty.toml --duration 2s --out - --format y4m 2> err.txt | head -c 1000 > /dev/null; "
        "echo ${PIPESTATUS[0]} > status.txt'";
    ASSERT_EQ(std::system(command.c_str()), 0);
    EXPECT_EQ(text_of(here / "status.txt"), "1\n");
    EXPECT_THAT(text_of(here / "err.txt"), tells({"stdout", "cannot write", "Broken pipe", "after"}));
    EXPECT_THAT(text_of(here / "err.txt"), tells({"program", "reads it", "ended"}));
    EXPECT_TRUE(fs::exists(here / "output/fifty/final.csv"));
}

TEST_F(FilmFormats, StdoutTakesY4mAlone) {
    const Ended ended = movie({"--out", "-"});
    EXPECT_EQ(ended.status, 2);
    EXPECT_EQ(ended.err,
              "error: --out -: stdout takes a film in y4m alone; add --format y4m, or name a folder\n");
    EXPECT_FALSE(fs::exists(here / "output"));
}

TEST_F(FilmFormats, ACapThatIsNoFilmAtAllIsRefusedBeforeTheRun) {
    const Ended ended = movie({"--out", "run", "--max-size", "10 B"});
    EXPECT_EQ(ended.status, 2);
    EXPECT_THAT(ended.err, tells({"--max-size", "10 B", "13 frames", "160x120", "0.0003 bits"}));
    EXPECT_FALSE(fs::exists(here / "run"));
}

TEST_F(FilmFormats, CheckTellsFormatAndSize) {
    const Ended ended =
        run_program({"check", scene.string(), "--format", "webm", "--max-size", "2 MB"}, {here.path(), {}});
    EXPECT_EQ(ended.status, 0);
    EXPECT_THAT(ended.out, HasSubstr("film (VP9 in WebM) about"));
    EXPECT_THAT(ended.out, HasSubstr("2 MB at most"));
}

}  // namespace
}  // namespace grainreel
