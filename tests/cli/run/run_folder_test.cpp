// Tests of the folder of a run: its name, what --force replaces, and its lock.
#include "engine/files/run_folder.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include "engine/base/error.hpp"
#include "tests/support/tells.hpp"
#include "tests/support/temporary_folder.hpp"

namespace grainreel {
namespace {

namespace fs = std::filesystem;
using test::tells;
using test::tells_only;
using test::TemporaryFolder, test::text_of, test::write_text;
using testing::HasSubstr;

std::string message_of(const FolderRequest& request) {
    try {
        RunFolder folder(request);
    } catch (const UserError& error) {
        return error.what();
    }
    return "no error";
}

// Makes an earlier run in `path`, with a file by which it can be recognised.
void make_run(const fs::path& path) {
    fs::create_directory(path);
    write_text(path / "run.json", "{}");
    write_text(path / "movie.mp4", "the old film");
}

std::size_t entries(const fs::path& folder) {
    return static_cast<std::size_t>(std::distance(fs::directory_iterator(folder), fs::directory_iterator()));
}

TEST(RunFolder, TakesTheSceneNameThenTheNextFreeNumber) {
    const TemporaryFolder here;
    const fs::path base = here / "deep/output";
    EXPECT_EQ(RunFolder({"wedge", base, {}, false}).path(), base / "wedge");
    EXPECT_EQ(RunFolder({"wedge", base, {}, false}).path(), base / "wedge-2");
    write_text(base / "wedge-3", "a file in the way");
    EXPECT_EQ(RunFolder({"wedge", base, {}, false}).path(), base / "wedge-4");
    EXPECT_TRUE(fs::is_directory(base / "wedge-4"));
}

TEST(RunFolder, AnExistingOutIsAnErrorThatNamesForce) {
    const TemporaryFolder here;
    make_run(here / "run");
    const std::string path = (here / "run").string();
    EXPECT_EQ(message_of({"wedge", "output", here / "run", false}),
              "--out " + path +
                  ": exists already; choose another name, or --force to replace it when the new run "
                  "is complete");
    EXPECT_EQ(text_of(here / "run/movie.mp4"), "the old film");
    EXPECT_EQ(entries(here.path()), 1u);
}

TEST(RunFolder, ForceKeepsTheOldRunUntilTheNewOneIsComplete) {
    const TemporaryFolder here;
    make_run(here / "run");
    RunFolder folder({"wedge", "output", here.path() / "run/", true});
    EXPECT_EQ(folder.path(), here / "run");
    EXPECT_EQ(entries(here / "run"), 1u);  // the lock
    EXPECT_EQ(folder.previous(), here / ".run.old-1");
    EXPECT_EQ(text_of(folder.previous() / "movie.mp4"), "the old film");
    folder.remove_previous();
    EXPECT_FALSE(fs::exists(here / ".run.old-1"));
    EXPECT_TRUE(fs::exists(here / "run"));
}

// The folder has all files of a run with fields and an outlet.
TEST(RunFolder, ForceReplacesARunWithAllItsFiles) {
    const TemporaryFolder here;
    make_run(here / "run");
    for (const char* file : {"fields.nc", "outflow.csv", "contacts.nc", "still-0.500s.png"})
        write_text(here / "run" / file, "");
    EXPECT_EQ(RunFolder({"wedge", "output", here / "run", true}).previous(), here / ".run.old-1");
}

TEST(RunFolder, ForceNeverTouchesAnEarlierRunThatStillWaits) {
    const TemporaryFolder here;
    make_run(here / "run");
    make_run(here / ".run.old-1");
    RunFolder folder({"wedge", "output", here / "run", true});
    EXPECT_EQ(folder.previous(), here / ".run.old-2");
    folder.remove_previous();
    EXPECT_EQ(text_of(here / ".run.old-1/movie.mp4"), "the old film");
}

TEST(RunFolder, ForceLeavesAFolderAloneThatHoldsNoRun) {
    const TemporaryFolder here;
    fs::create_directory(here / "home");
    write_text(here / "home/thesis.tex", "years of work");
    EXPECT_THAT(message_of({"wedge", "output", here / "home", true}), HasSubstr("holds no run"));
    EXPECT_EQ(text_of(here / "home/thesis.tex"), "years of work");
}

TEST(RunFolder, ForceLeavesAFolderAloneThatHoldsOtherFilesToo) {
    const TemporaryFolder here;
    const fs::path run = here / "run";
    make_run(run);
    fs::create_directory(run / "frames");
    write_text(run / "frames/000000.png", "");
    const auto expect_refused = [&](const std::string& name) {
        EXPECT_EQ(
            message_of({"wedge", "output", run, true}),
            "--out " + run.string() + ": holds " + name +
                ", which is no file of a run, so --force leaves the folder alone; move that file away or "
                "choose another name");
        EXPECT_TRUE(fs::exists(run / name));
        EXPECT_EQ(text_of(run / "movie.mp4"), "the old film");
        EXPECT_EQ(entries(here.path()), 1u);
    };
    write_text(run / "frames/notes.png", "mine");
    expect_refused("frames/notes.png");
    write_text(run / "mine.txt", "mine");
    write_text(run / "zoo.txt", "mine");
    expect_refused("mine.txt");  // the first by name
    fs::create_directory(run / "film");
    expect_refused("film");
}

TEST(RunFolder, AFileThatCameToTheOldRunMeanwhileKeepsIt) {
    const TemporaryFolder here;
    make_run(here / "run");
    RunFolder folder({"wedge", "output", here / "run", true});
    write_text(folder.previous() / "mine.txt", "mine");
    folder.remove_previous();
    EXPECT_EQ(folder.previous(), here / ".run.old-1");
    EXPECT_EQ(text_of(here / ".run.old-1/mine.txt"), "mine");
}

TEST(RunFolder, AnEmptyFolderIsTakenOnceAndEmptyAgainWhenDiscarded) {
    const TemporaryFolder here;
    fs::create_directory(here / "mine");
    for (const bool force : {false, true}) {
        RunFolder folder({"wedge", "output", here / "mine", force});
        EXPECT_EQ(folder.path(), here / "mine");
        EXPECT_TRUE(folder.previous().empty());
        EXPECT_THAT(message_of({"wedge", "output", here / "mine", false}), HasSubstr("is in use by process"));
        write_text(folder.path() / "run.json", "begun");
        folder.discard();
        EXPECT_TRUE(fs::is_empty(here / "mine"));
    }
}

TEST(RunFolder, AFolderInUseIsRefusedAndItsHolderNamed) {
    const TemporaryFolder here;
    const fs::path run = here / "run";
    {
        const RunFolder folder({"wedge", "output", run, false, "grainreel movie wedge.toml"});
        write_text(run / "run.json", "{}");
        for (const bool force : {false, true}) {
            const std::string message = message_of({"wedge", "output", run, force});
            EXPECT_THAT(message, HasSubstr("--out " + run.string() + ": is in use by process " +
                                           std::to_string(::getpid()) + ", which began 2"));
            EXPECT_THAT(message, tells({"(grainreel movie wedge.toml)", "wait"}));
        }
        EXPECT_EQ(entries(here.path()), 1u);
        EXPECT_EQ(text_of(run / "run.json"), "{}");
    }
    EXPECT_EQ(entries(run), 1u);  // the lock went with its holder
    EXPECT_EQ(message_of({"wedge", "output", run, true}), "no error");
}

TEST(RunFolder, ARunThatIsBeingReplacedIsInUseToo) {
    const TemporaryFolder here;
    make_run(here / "run");
    const RunFolder folder({"wedge", "output", here / "run", true});
    EXPECT_THAT(message_of({"wedge", "output", here / "run", true}), HasSubstr("is in use"));
    EXPECT_THAT(message_of({"wedge", "output", here / ".run.old-1", true}), HasSubstr("is in use"));
}

// A killed run leaves the file, but nobody has its lock.
TEST(RunFolder, ALockFileThatWasLeftBehindMeansNothing) {
    const TemporaryFolder here;
    make_run(here / "run");
    write_text(here / "run/.lock", "1\nelsewhere\n2031-05-04T12:30:00Z\ngrainreel movie\n");
    EXPECT_EQ(message_of({"wedge", "output", here / "run", true}), "no error");
}

TEST(RunFolder, AComparisonWithAPanelInUseIsLeftAlone) {
    const TemporaryFolder here;
    make_run(here / "both");
    write_text(here / "both/run.json", R"({"panels": ["weak"]})");
    make_run(here / "both/weak");
    const RunFolder panel({"weak", "output", here / "both/weak", true});
    fs::remove_all(here / "both/.weak.old-1");
    EXPECT_THAT(message_of({"wedge", "output", here / "both", true}),
                HasSubstr("--out " + (here / "both/weak").string() + ": is in use"));
}

TEST(RunFolder, KnowsWhenItIsGone) {
    const TemporaryFolder here;
    RunFolder folder({"wedge", "output", here / "run", false});
    EXPECT_NO_THROW(folder.lock().check_there());
    fs::rename(here / "run", here / "elsewhere");
    EXPECT_THROW(folder.lock().check_there(), RunError);
    const RunFolder another({"wedge", "output", here / "run", false});  // a scene of the same name
    EXPECT_THROW(folder.lock().check_there(), RunError);
    EXPECT_NO_THROW(another.lock().check_there());
}

TEST(RunFolder, AnEmptyNameIsAUserError) {
    EXPECT_THAT(message_of({"wedge", "output", "", false}),
                tells_only({"--out", "name is empty", "leave out --out"}));
}

TEST(RunFolder, DiscardPutsTheOldRunBack) {
    const TemporaryFolder here;
    make_run(here / "run");
    RunFolder folder({"wedge", "output", here / "run", true});
    write_text(folder.path() / "log.txt", "begun");
    folder.discard();
    EXPECT_EQ(text_of(here / "run/movie.mp4"), "the old film");
    EXPECT_EQ(entries(here.path()), 1u);
}

TEST(RunFolder, AFolderThatCannotBeMadeIsAUserError) {
    const TemporaryFolder here;
    write_text(here / "file", "");
    const std::string path = (here / "file/run").string();
    EXPECT_EQ(message_of({"wedge", "output", here / "file/run", false}),
              path + ": the folder cannot be made: Not a directory; choose another with --out");
    EXPECT_THAT(message_of({"wedge", here / "file", {}, false}), HasSubstr("the folder cannot be made"));
}

}  // namespace
}  // namespace grainreel
