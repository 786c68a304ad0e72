// Tests of folders that come from somebody else, in which a link or a pipe has the name of a run's file.
#include <gmock/gmock.h>
#include <sys/stat.h>

#include "tests/cli/run/resumed_folder.hpp"

namespace grainreel {
namespace {

using namespace test;
using testing::HasSubstr;

using ForeignFolder = ResumedFolder;

TEST_F(ForeignFolder, NothingIsWrittenThroughALink) {
    movie("whole", {"--frames"});
    const std::string precious = "nobody may change this";
    for (const char* name : {"run.json",
                             ".run.json.part",
                             "scene.toml",
                             ".scene.toml.part",
                             "trajectory.nc",
                             "contacts.nc",
                             "fields.nc",
                             "measures.csv",
                             "outflow.csv",
                             "film_moments.nc",
                             "key_moments.nc",
                             "key_contacts.nc",
                             "final.csv",
                             ".final.csv.part",
                             "checkpoint.grs",
                             "log.txt",
                             "movie.mp4",
                             "movie.mp4.part",
                             "poster.png",
                             "checkpoint.grs.part",
                             ".lock",
                             "report.html",
                             "frames/000000.png",
                             "film_times.csv",
                             "poster.png.part",
                             "checkpoints/000000000000.grs.part",
                             ".report.html.part"}) {
        copy("whole", "run");
        // The file has the right bytes, so that nothing else is wrong.
        const fs::path file = here / "run" / name, target = here / "precious";
        const std::string bytes = fs::exists(file) ? text_of(file) : precious;
        write_text(target, bytes);
        fs::remove(file);
        fs::create_symlink(target, file);
        const Ended ended = run({"resume", "run", "--for", "0.02 s"});
        EXPECT_EQ(ended.status, 2) << name << ' ' << ended.err;
        EXPECT_THAT(ended.err, HasSubstr(std::string(name) + ": is a link"));
        EXPECT_EQ(text_of(target) == bytes, true) << name;
    }
    for (const char* name : {"frames", "checkpoints", "movie.work", ".before", ".before.part"}) {
        copy("whole", "run");
        fs::remove_all(here / "run" / name);
        fs::create_directory(here / "outside");
        fs::create_directory_symlink(here / "outside", here / "run" / name);
        EXPECT_EQ(run({"resume", "run", "--for", "0.02 s"}).status, 2) << name;
        EXPECT_TRUE(fs::is_empty(here / "outside")) << name;
    }
    // The folder itself may be a link, because the user named it.
    copy("whole", "run");
    fs::create_directory_symlink(here / "run", here / "named");
    EXPECT_EQ(run({"resume", "named", "--for", "0.02 s", "--no-film"}).status, 0);
}

TEST_F(ForeignFolder, ReportAndRenderWriteThroughNoLinkEither) {
    movie("run", {"--no-film"});
    write_text(here / "precious", "nobody may change this");
    for (const char* name : {"run/.report.html.part", "run/report.html", "still.png.part"}) {
        fs::remove(here / name);
        fs::create_symlink(here / "precious", here / name);
    }
    EXPECT_EQ(run({"report", "run"}).status, 0);
    EXPECT_EQ(run({"render", "run", "--at", "0.05 s", "--out", "still.png"}).status, 0);
    EXPECT_EQ(text_of(here / "precious"), "nobody may change this");
    EXPECT_TRUE(fs::is_regular_file(fs::symlink_status(here / "run/report.html")));
}

// Whatever the question is, no pipe is read, because that would never end.
TEST_F(ForeignFolder, NoPipeIsWaitedFor) {
    movie("whole", {"--frames"});
    const std::vector<Words> questions = {{"inspect", "run", "--at", "0.05 s"},
                                          {"report", "run"},
                                          {"compare", "run", "whole", "--out", "both"},
                                          {"resume", "run", "--for", "1 ms", "--no-film"}};
    std::size_t which = 0;
    for (const char* name :
         {"run.json", "scene.toml", "trajectory.nc", "contacts.nc", "fields.nc", "measures.csv",
          "outflow.csv", "film_moments.nc", "key_moments.nc", "key_contacts.nc", "checkpoint.grs",
          "movie.mp4", "poster.png", "film_times.csv", ".lock", "checkpoints/000000000000.grs"}) {
        // Two of the questions are asked for each file, in turn, so that all four are asked.
        for (int k = 0; k < 2; ++k, ++which) {
            const Words& words = questions[(which + which / 2) % questions.size()];
            copy("whole", "run");
            fs::remove_all(here / "both");
            fs::remove(here / "run" / name);
            ASSERT_EQ(::mkfifo((here / "run" / name).c_str(), 0600), 0);
            EXPECT_LE(run(words).status, 2) << words.front() << ' ' << name;  // and the program ends
        }
    }
    for (const char* file : {"run.grs", "run.csv"}) {
        ASSERT_EQ(::mkfifo((here / file).c_str(), 0600), 0);
        const Ended ended = run(
            {"check", "busy.toml", "--set", "start.method=file", "--set", std::string("start.file=") + file});
        EXPECT_EQ(ended.status, 2);
        EXPECT_THAT(ended.err, HasSubstr(file));
    }
}

}  // namespace
}  // namespace grainreel
