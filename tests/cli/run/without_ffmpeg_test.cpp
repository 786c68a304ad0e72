// Tests of a machine without FFmpeg, whose libraries are opened when a film is made: an empty file stands in
// place of each.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

extern "C" {
#include <libavcodec/avcodec.h>
#include <libavfilter/version.h>
#include <libavformat/avformat.h>
#include <libswscale/swscale.h>
}

#include <fmt/format.h>
#include <fstream>
#include <nlohmann/json.hpp>

#include "tests/cli/program.hpp"
#include "tests/support/small_scene.hpp"
#include "tests/support/temporary_folder.hpp"

namespace grainreel {
namespace {

namespace fs = std::filesystem;
using namespace test;
using testing::HasSubstr, testing::Not;

struct Library {
    const char* name;
    int major;
};

const std::vector<Library> of_every_film = {{"avutil", LIBAVUTIL_VERSION_MAJOR},
                                            {"avcodec", LIBAVCODEC_VERSION_MAJOR},
                                            {"avformat", LIBAVFORMAT_VERSION_MAJOR},
                                            {"swscale", LIBSWSCALE_VERSION_MAJOR}};

class WithoutFfmpeg : public testing::Test {
  protected:
    fs::path hide(const Library& library) {
        fs::create_directory(here / "hidden");
        fs::path file = here / "hidden" / fmt::format("lib{}.so.{}", library.name, library.major);
        std::ofstream{file};
        return file;
    }

    void hide_all() {
        for (const Library& library : of_every_film) hide(library);
    }

    Ended run(const std::vector<std::string>& words) {
        return run_program(words, {here.path(), {"LD_LIBRARY_PATH=" + (here / "hidden").string()}});
    }

    nlohmann::json libraries_of(const char* folder) {
        return nlohmann::json::parse(text_of(here / folder / "run.json"))["program"]["libraries"];
    }

    static std::string missing(const Library& library, const fs::path& file) {
        return fmt::format(
            "film: FFmpeg's lib{0} cannot be opened ({2}: file too short); on Debian: apt-get install "
            "lib{0}{1}",
            library.name, library.major, file.string());
    }

    TemporaryFolder here;
    fs::path scene = write_small_scene(here.path());
};

// With this variable the loader lists what it would load, and does not start the program.
TEST_F(WithoutFfmpeg, TheProgramStartsWithoutItsLibraries) {
    const Ended listed = run_program({"--version"}, {here.path(), {"LD_TRACE_LOADED_OBJECTS=1"}});
    EXPECT_THAT(listed.out, HasSubstr("libnetcdf.so"));
    for (const char* of_ffmpeg : {"libav", "libsw", "libx264"})
        EXPECT_THAT(listed.out, Not(HasSubstr(of_ffmpeg)));
}

TEST_F(WithoutFfmpeg, AFilmIsRefusedInOneLineBeforeTheRun) {
    for (const Library& library : of_every_film) {
        const fs::path file = hide(library);
        const Ended ended = run({"movie", scene.string(), "--out", library.name});
        EXPECT_EQ(ended.status, 1);
        EXPECT_THAT(ended.err, HasSubstr("error: " + missing(library, file) + "\n"));
        EXPECT_FALSE(fs::exists(here / library.name / "trajectory.nc"));
        fs::remove(file);
    }
}

TEST_F(WithoutFfmpeg, AGifNeedsTheLibraryOfFilters) {
    const Library filters{"avfilter", LIBAVFILTER_VERSION_MAJOR};
    const fs::path file = hide(filters);
    EXPECT_EQ(run({"movie", scene.string(), "--out", "mp4", "--no-report"}).status, 0);
    const Ended ended = run({"movie", scene.string(), "--format", "gif", "--out", "gif", "--no-report"});
    EXPECT_EQ(ended.status, 1);
    EXPECT_THAT(ended.err, HasSubstr(missing(filters, file)));
}

TEST_F(WithoutFfmpeg, AllElseWorks) {
    hide_all();
    EXPECT_EQ(run({"--version"}).status, 0);
    const Ended ran = run({"movie", scene.string(), "--no-film", "--out", "plain"});
    EXPECT_EQ(ran.status, 0) << ran.err;
    EXPECT_TRUE(fs::exists(here / "plain/report.html"));
    EXPECT_FALSE(libraries_of("plain").contains("libavcodec"));
    EXPECT_EQ(run({"inspect", "plain"}).status, 0);
    const Ended drawn = run({"render", "plain", "--at", "0.01s", "--out", "still.png"});
    EXPECT_EQ(drawn.status, 0) << drawn.err;
    const Ended pictures =
        run({"movie", scene.string(), "--no-film", "--frames", "--no-report", "--out", "pictures"});
    EXPECT_EQ(pictures.status, 0) << pictures.err;
    EXPECT_TRUE(fs::exists(here / "pictures/frames/000001.png"));
}

TEST_F(WithoutFfmpeg, DoctorNamesWhatIsMissing) {
    hide_all();
    const Ended ended = run({"doctor"});
    EXPECT_EQ(ended.status, 1);
    EXPECT_THAT(ended.out, HasSubstr("MISSING  FFmpeg"));
    EXPECT_THAT(ended.out, HasSubstr("apt-get install libavutil"));
    EXPECT_THAT(ended.out, HasSubstr("Films cannot be made here"));
}

std::string version_text(unsigned version) {
    return fmt::format("{}.{}.{}", AV_VERSION_MAJOR(version), AV_VERSION_MINOR(version),
                       AV_VERSION_MICRO(version));
}

TEST_F(WithoutFfmpeg, RunJsonAndDoctorTellTheVersionsThatAreOpened) {
    ASSERT_EQ(run({"movie", scene.string(), "--out", "film"}).status, 0);
    const nlohmann::json libraries = libraries_of("film");
    EXPECT_EQ(libraries["FFmpeg"], av_version_info());
    EXPECT_EQ(libraries["libavcodec"], version_text(avcodec_version()));
    EXPECT_EQ(libraries["libavformat"], version_text(avformat_version()));
    EXPECT_EQ(libraries["libswscale"], version_text(swscale_version()));
    EXPECT_THAT(run({"doctor"}).out, HasSubstr(fmt::format("{} (libavformat {}, ", av_version_info(),
                                                           version_text(avformat_version()))));
}

}  // namespace
}  // namespace grainreel
