// Tests of runs that are resumed: longer ones, and runs that cannot be resumed, which stay as they were.
#include <gmock/gmock.h>
#include <signal.h>

#include <functional>

#include "tests/cli/run/resumed_folder.hpp"
#include "tests/support/tells.hpp"

namespace grainreel {
namespace {

using namespace test;
using testing::HasSubstr;

// The feed still gives grains, so there are more of them at each end.
TEST_F(ResumedFolder, OneThatIsStillFedIsMadeLongerTwice) {
    movie("whole", {"--frames", "--duration", "0.16 s"});
    movie("run", {"--frames"});
    const Ended first = run({"resume", "run", "--until", "0.13s", "--threads", "2"});
    ASSERT_EQ(first.status, 0) << first.err;
    const Ended second = run({"resume", "run", "--until", "0.16s", "--threads", "1"});
    ASSERT_EQ(second.status, 0) << second.err;
    expect_same_run("whole", "run");
    EXPECT_EQ(run({"report", "run"}).status, 0);
    EXPECT_EQ(run({"render", "run", "--at", "0.15 s", "--out", "still.png"}).status, 0);
    EXPECT_EQ(run({"inspect", "run", "--at", "0.15 s"}).status, 0);
}

// The film has to begin anew, so everything is cut; then the disk is full.
TEST_F(ResumedFolder, OneThatFailsIsPutBack) {
    movie("run", {"--frames"});
    fs::resize_file(here / "run/film_moments.nc", 0);
    const auto before = files_of("run");
    const Ended ended = run({"resume", "run", "--for", "0.05 s"}, 12'000);
    EXPECT_EQ(ended.status, 1) << ended.err;
    EXPECT_THAT(ended.err, tells({"run: ", "as it was before"}));
    expect_same_folder("run", before);
}

TEST_F(ResumedFolder, OneThatIsStoppedBeforeItsFormerEndIsPutBack) {
    movie("run", {"--frames"});
    fs::resize_file(here / "run/film_moments.nc", 0);
    const auto before = files_of("run");
    Program program({"resume", "run", "--for", "0.05 s"}, {.folder = here.path()});
    ASSERT_TRUE(wait_until(program, [&] { return fs::exists(here / "run" / kFormerRun); }));
    program.send(SIGINT);
    EXPECT_EQ(program.wait().status, 130);
    expect_same_folder("run", before);
}

TEST_F(ResumedFolder, OneThatIsKilledIsPutBackByTheNext) {
    movie("whole", {"--frames", "--duration", "0.13 s"});
    movie("run", {"--frames"});
    fs::resize_file(here / "run/film_moments.nc", 0);
    Program program({"resume", "run", "--for", "0.03 s"}, {.folder = here.path()});
    ASSERT_TRUE(wait_until(program, [&] { return fs::exists(here / "run" / kFormerRun); }));
    program.send(SIGKILL);
    program.wait();
    ASSERT_TRUE(fs::exists(here / "run" / kFormerRun));
    const Ended ended = run({"resume", "run", "--for", "0.03 s"});
    ASSERT_EQ(ended.status, 0) << ended.err;
    EXPECT_THAT(ended.err, HasSubstr("run is as it was before"));
    expect_same_run("whole", "run");
}

// All files are checked before the first one is cut.
TEST_F(ResumedFolder, AFileWithWhichItCannotGoOnIsNamedAndNothingChanges) {
    movie("whole");
    const auto refused = [&](const char* file, const std::function<void(const fs::path&)>& damage) {
        copy("whole", "run");
        damage(here / "run" / file);
        const auto before = files_of("run");
        const Ended ended = run({"resume", "run", "--for", "0.05 s"});
        EXPECT_EQ(ended.status, 2) << file << ' ' << ended.err;
        EXPECT_THAT(ended.err, HasSubstr(file));
        expect_same_folder("run", before);
    };
    const auto emptied = [](const fs::path& file) { fs::resize_file(file, 0); };
    for (const char* file : {"trajectory.nc", "contacts.nc", "fields.nc", "measures.csv", "outflow.csv"})
        refused(file, emptied);
    refused("outflow.csv", [](const fs::path& file) { write_text(file, "x" + text_of(file)); });
    refused("checkpoint.grs", [](const fs::path& file) {
        fs::remove(file);
        fs::create_directory(file);
    });
}

TEST_F(ResumedFolder, ARowThatWasTakenOutOfTheOutflowIsMissed) {
    std::string text = busy_scene_text;
    // Without fields, also of walls, the run continues from its end.
    text.erase(text.find("[output.fields]"), text.find("[film]") - text.find("[output.fields]"));
    text.replace(text.find("[\"walls\", \"outflow\"]"), 20, "[\"outflow\"]");
    write_text(here / "busy.toml", text);
    movie("run", {"--no-film"});
    std::string rows = text_of(here / "run/outflow.csv");
    const std::size_t row = rows.find('\n') + 1;
    ASSERT_LT(row, rows.size());
    rows.erase(row, rows.find('\n', row) + 1 - row);
    write_text(here / "run/outflow.csv", rows);
    const auto before = files_of("run");
    const Ended ended = run({"resume", "run", "--for", "0.05 s"});
    EXPECT_EQ(ended.status, 2) << ended.err;
    EXPECT_THAT(ended.err, HasSubstr("run/outflow.csv: has "));
    expect_same_folder("run", before);
}

// The frames kept for its film are lost, so all of the film is drawn again.
TEST_F(ResumedFolder, WithoutTheMomentsOfItsFilmItBeginsAnew) {
    movie("whole", {"--frames", "--duration", "0.13 s"});
    movie("short", {"--frames"});
    for (const std::uintmax_t bytes : {0, 3000}) {
        copy("short", "run");
        fs::resize_file(here / "run/film_moments.nc", bytes);
        const Ended ended = run({"resume", "run", "--for", "0.03 s"});
        ASSERT_EQ(ended.status, 0) << ended.err;
        expect_same_run("whole", "run");
    }
}

// Otherwise records in the middle would be missing at the end.
TEST_F(ResumedFolder, CutContactsAndFieldsAreWrittenAgain) {
    movie("whole", {"--frames", "--duration", "0.13 s"});
    movie("run", {"--frames"});
    for (const char* file : {"contacts.nc", "fields.nc"})
        fs::resize_file(here / "run" / file, fs::file_size(here / "run" / file) * 9 / 10);
    const Ended ended = run({"resume", "run", "--for", "0.03 s"});
    ASSERT_EQ(ended.status, 0) << ended.err;
    expect_same_run("whole", "run");
}

// There is no room for the first text of run.json, and no old text to write it over.
TEST_F(ResumedFolder, AFullDiskWithoutARecordIsAFailure) {
    movie("run", {"--no-film"});
    fs::remove(here / "run/run.json");
    const auto before = files_of("run");
    const Ended ended = run({"resume", "run", "--for", "0.05 s"}, 700);
    EXPECT_EQ(ended.status, 1) << ended.err;
    EXPECT_THAT(ended.err, HasSubstr("File too large"));
    expect_same_folder("run", before);
}

// The comments are those of the plan for the same scene in one go, with the reasons of its choices.
TEST_F(ResumedFolder, ItsSceneKeepsItsComments) {
    movie("run", {"--no-film"});
    const std::string before = text_of(here / "run/scene.toml");
    ASSERT_THAT(before, HasSubstr("# chosen for: "));
    ASSERT_EQ(run({"resume", "run", "--until", "0.13 s"}).status, 0);
    std::string wanted = before;
    const std::string then = "\nduration = 0.1\n";
    wanted.replace(wanted.find(then), then.size(), "\nduration = 0.13\n");
    EXPECT_EQ(text_of(here / "run/scene.toml"), wanted);
}

TEST_F(ResumedFolder, AMissingPageIsMade) {
    const Words words = {"movie", "busy.toml", "--out", "run"};
    Program program(words, {.folder = here.path()});
    ASSERT_TRUE(wait_until(program, [&] {
        return text_of(here / "run/run.json").find("\"missing\": [\n    \"page\"") != std::string::npos;
    }));
    program.send(SIGSTOP);
    EXPECT_EQ(record("run")["status"], "running");
    EXPECT_EQ(record("run")["exit_status"], nullptr);
    program.send(SIGKILL);
    program.wait();
    std::error_code none;
    fs::remove(here / "run/report.html", none);  // in case the page was made quickly
    const auto film = fs::last_write_time(here / "run/movie.mp4");
    const Ended ended = run({"resume", "run"});
    EXPECT_EQ(ended.status, 0) << ended.err;
    EXPECT_EQ(ended.out, "run\n");
    EXPECT_THAT(ended.err, tells({"run: ", "only its page"}));
    EXPECT_EQ(text_of(here / "run/report.html").find("class=\"ended\""), std::string::npos);
    EXPECT_EQ(fs::last_write_time(here / "run/movie.mp4"), film);
    EXPECT_EQ(record("run")["status"], "complete");
    EXPECT_EQ(record("run")["exit_status"], 0);
    EXPECT_EQ(record("run")["written"]["page"], "report.html");
    EXPECT_TRUE(record("run")["missing"].empty());
    const Ended over = run({"resume", "run"});
    EXPECT_EQ(over.status, 2);
    EXPECT_THAT(over.err, HasSubstr("come to 0.1 s already"));
    // Versions before left the run like this.
    fs::remove(here / "run/report.html");
    EXPECT_EQ(run({"resume", "run"}).status, 0);
    EXPECT_TRUE(fs::exists(here / "run/report.html"));
}

}  // namespace
}  // namespace grainreel
