// Tests of a scene that was handed over and is drawn while its job runs, or after the job has died. The dump
// is written by the test: a ball that falls freely.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <cstdlib>
#include <fstream>

#include <fmt/format.h>
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
using testing::HasSubstr;
using testing::Not;

using Words = std::vector<std::string>;

// 21 pictures, one each 100 steps.
const std::string falling =
    SmallScene("title = \"A ball\"\n")
        .beads(0, "ball")
        .more("[contact]\nlaw = \"spring-dashpot\"\nfriction_law = \"linear-spring\"\n")
        .more("stiffness = 1000\nrestitution = 0.7\n")
        .box("20 mm", "20 mm", "400 mm")
        .more("[start]\nmethod = \"grains\"\n[[grain]]\nposition = [0, 0, 0.3]\n")
        .lasts("0.2 s")
        .more("step = 1e-4\n[film]\nsize = \"160x120\"\nrate = 25\n")
        .more("[[film.segment]]\nplayback = 0.25\n")
        .text();

constexpr int kPictures = 21, kStepsAPicture = 100;

class FollowedJob : public testing::Test {
  protected:
    void SetUp() override {
        write_text(here / "ball.toml", falling);
        const Ended ended = program({"handover", "ball.toml", "--to", "lammps", "--out", "job"});
        ASSERT_EQ(ended.status, 0) << ended.err;
    }

    Ended program(const Words& words) { return run_program(words, {here.path(), {}}); }
    Words follow(const std::string& idle) const {
        return {"render", "job", "--follow", "--idle", idle, "--out", "film"};
    }
    Words follow_with_frames() const {
        return {"render", "job", "--follow", "--idle", "300", "--out", "film", "--frames"};
    }

    // Adds moments to the dump; a place of NaN leaves the ball out.
    void add(int from, int count, double lift = 0, bool lost = false) {
        std::ofstream dump(here / "job/lammps.dump", std::ios::app);
        for (int k = from; k < from + count; ++k) {
            const double time = k * kStepsAPicture * 1e-4, speed = -9.81 * time;
            dump << fmt::format(
                "ITEM: TIMESTEP\n{}\nITEM: NUMBER OF ATOMS\n{}\nITEM: BOX BOUNDS ff ff ff\n-1 1\n-1 1\n-1 1\n"
                "ITEM: ATOMS id type radius x y z vx vy vz omegax omegay omegaz \n",
                k * kStepsAPicture, lost ? 0 : 1);
            if (!lost)
                dump << fmt::format("1 1 0.002 0 0 {:.9g} 0 0 {:.9g} 0 0 0\n",
                                    0.3 - 0.5 * 9.81 * time * time + lift, speed);
        }
    }
    void job_ends(int status, const std::string& words = "", const std::string& job = "node 1 1 start") {
        if (!words.empty()) write_text(here / "job/out.lammps", words);
        write_text(here / "job/job.status", fmt::format("{}\njob {}\n", status, job));
    }
    void job_begins(const std::string& job) {
        write_text(here / "job/job.status", "running\njob " + job + "\n");
    }
    // As run.sh --continue does: the frames from `from` on are cut off and come again.
    void job_goes_on_from(int from, const std::string& job) {
        fs::remove(here / "job/job.status");
        std::string text = text_of(here / "job/lammps.dump");
        const std::string frame = fmt::format("ITEM: TIMESTEP\n{}\n", from * kStepsAPicture);
        fs::resize_file(here / "job/lammps.dump", text.find(frame));
        job_begins(job);
    }
    // Number of pictures that are encoded so far.
    bool film_grows(Program& following, std::uintmax_t beyond) {
        return wait_until(following, [&] {
            std::error_code missing;
            std::uintmax_t size = 0;
            for (const auto& one : fs::recursive_directory_iterator(here / "film", missing))
                if (one.path().filename().string().starts_with("0000")) ++size;
            return size > beyond;
        });
    }
    int drawn() { return decoded_pictures(here / "film/movie.mp4"); }
    std::string status_of_film() { return nlohmann::json::parse(text_of(here / "film/run.json"))["status"]; }

    TemporaryFolder here;
};

// The pictures are there while the dump still lacks later ones, and in the end they are those of a film that
// is drawn afterwards.
TEST_F(FollowedJob, IsDrawnBesideTheJob) {
    Program following(follow_with_frames(), {here.path(), {}});
    add(0, 8);
    ASSERT_TRUE(film_grows(following, 7)) << following.wait().err;  // eight pictures, numbered from 0
    add(8, 5);
    ASSERT_TRUE(film_grows(following, 12)) << following.wait().err;
    add(13, kPictures - 13);
    const Ended ended = following.wait();  // by the last moment, long before --idle
    EXPECT_EQ(ended.status, 0) << ended.err;
    EXPECT_EQ(drawn(), kPictures);
    EXPECT_EQ(status_of_film(), "complete");
    EXPECT_FALSE(fs::exists(here / "job/.following-1"));

    const Ended again =
        program({"render", "job", "--frames", "--out", "again", "--set", "film.camera.reach=0.31"});
    EXPECT_EQ(again.status, 0) << again.err;
    EXPECT_EQ(decoded_pictures(here / "again/movie.mp4"), kPictures);
}

TEST_F(FollowedJob, EndsWithTheJobThatEndsEarlyInGoodOrder) {
    job_begins("node 1 1 start");
    Program following(follow_with_frames(), {here.path(), {}});
    add(0, 6);
    ASSERT_TRUE(film_grows(following, 5)) << following.wait().err;
    job_ends(0);
    const Ended ended = following.wait();
    EXPECT_EQ(ended.status, 0) << ended.err;
    EXPECT_THAT(ended.err, tells({"LAMMPS", "0.05 s of 0.2 s"}));
    EXPECT_EQ(drawn(), 6);
}

TEST_F(FollowedJob, SaysWhyTheJobDied) {
    job_begins("node 1 1 start");
    Program following(follow_with_frames(), {here.path(), {}});
    add(0, 6);
    ASSERT_TRUE(film_grows(following, 5)) << following.wait().err;
    job_ends(1, "LAMMPS (29 Sep 2021)\nERROR: Lost atoms: original 1 current 0 (../thermo.cpp:438)\n");
    const Ended ended = following.wait();
    EXPECT_EQ(ended.status, 1) << ended.err;
    EXPECT_THAT(ended.err, tells({"LAMMPS ended", "in.lammps", "Lost atoms"}));
    EXPECT_THAT(ended.err, HasSubstr("0.05 s of 0.2 s"));
    EXPECT_EQ(drawn(), 6);
    EXPECT_EQ(status_of_film(), "failed");
}

// The status is of a job that was killed. The film waits for the one that goes on, which cuts the dump.
TEST_F(FollowedJob, WaitsForAJobThatGoesOn) {
    for (const bool named : {true, false}) {
        fs::remove_all(here / "film");
        fs::remove(here / "job/lammps.dump");
        fs::remove(here / "job/trajectory.nc");
        add(0, 8);
        job_ends(143, "", "node 1 1 start");
        if (!named) write_text(here / "job/job.status", "143\n");  // of a run.sh that names no job
        Program following(follow_with_frames(), {here.path(), {}});
        ASSERT_TRUE(film_grows(following, 7)) << following.wait().err;
        job_goes_on_from(5, "node 2 2 continue");
        add(5, 5);
        ASSERT_TRUE(film_grows(following, 9)) << following.wait().err;
        add(10, kPictures - 11);
        job_ends(0, "", "node 2 2 continue");
        const Ended ended = following.wait();
        EXPECT_EQ(ended.status, 0) << ended.err;
        EXPECT_THAT(ended.err, tells({"job: ", "ended before", "none goes on"}));
        EXPECT_THAT(ended.err, HasSubstr("0.19 s of 0.2 s"));
        EXPECT_EQ(drawn(), kPictures - 1);
    }
}

TEST_F(FollowedJob, AJobThatBeginsAgainFromTheStartEndsTheFilm) {
    add(0, 8);
    job_ends(143, "", "node 1 1 start");
    Program following(follow_with_frames(), {here.path(), {}});
    ASSERT_TRUE(film_grows(following, 7)) << following.wait().err;
    job_begins("node 2 2 start");
    const Ended ended = following.wait();
    EXPECT_EQ(ended.status, 1) << ended.err;
    EXPECT_THAT(ended.err, tells({"new job", "from the start"}));
    EXPECT_EQ(drawn(), 8);
}

TEST_F(FollowedJob, EndsWhereNothingNewComes) {
    add(0, 6);
    const Ended ended = program(follow("1"));
    EXPECT_EQ(ended.status, 0) << ended.err;
    EXPECT_THAT(ended.err, tells({"nothing new", "1 s"}));
    EXPECT_EQ(drawn(), 6);
}

TEST_F(FollowedJob, IsWholeAfterCtrlC) {
    Program following(follow_with_frames(), {here.path(), {}});
    add(0, 8);
    ASSERT_TRUE(film_grows(following, 7)) << following.wait().err;
    following.send(SIGINT);
    const Ended ended = following.wait();
    EXPECT_EQ(ended.status, 130) << ended.err;
    EXPECT_EQ(drawn(), 8);
    EXPECT_FALSE(fs::exists(here / "job/.following-1"));
}

TEST_F(FollowedJob, AGrainThatIsLostEndsTheFilmWithItsStep) {
    add(0, 6);
    add(6, 1, 0, true);
    const Ended ended = program(follow("300"));
    EXPECT_EQ(ended.status, 1) << ended.err;
    EXPECT_THAT(ended.err, tells({"step 600", "grain 0", "missing"}));
    EXPECT_EQ(drawn(), 6);
}

TEST_F(FollowedJob, ThatHasNotBegunIsWaitedFor) {
    const Ended ended = program(follow("1"));
    EXPECT_EQ(ended.status, 2) << ended.err;
    EXPECT_THAT(ended.err, HasSubstr("job/lammps.dump: is not there"));
    EXPECT_FALSE(fs::exists(here / "film"));
}

// 0.1 m in 10 ms: m g h = 82 µJ come from nowhere, while 5 % of its motion and a radius allow 1.7 µJ.
TEST_F(FollowedJob, EnergyFromNowhereIsAnErrorAsInOurRuns) {
    add(0, 6);
    add(6, 1, 0.1);
    const Ended ended = program({"render", "job", "--out", "film"});
    EXPECT_EQ(ended.status, 0) << ended.err;
    EXPECT_THAT(ended.err, tells({"step 600 (0.06 s)", "gained"}));
    EXPECT_THAT(ended.err, HasSubstr("grain 0 (ball)"));
    EXPECT_EQ(drawn(), 6);
}

TEST_F(FollowedJob, IsInspectedBeforeItWasDrawn) {
    add(0, kPictures);
    const Ended ended = program({"inspect", "job", "--at", "0.1s", "--grain", "0", "--json"});
    ASSERT_EQ(ended.status, 0) << ended.err;
    EXPECT_THAT(ended.out, HasSubstr("\"ball\""));
    EXPECT_THAT(ended.out, HasSubstr("0.25095"));  // m, 0.3 - g (0.1 s)^2 / 2
}

// No advice to run the scene with another output: a dump has grains alone.
TEST_F(FollowedJob, IsNotAskedForWhatNoDumpHas) {
    add(0, kPictures);
    const std::vector<std::pair<Words, std::string>> cases = {
        {{"render", "job", "--set", "film.force_chains=true"},
         "job: another engine computes the run, and its dumps "},
        {{"render", "job", "--follow", "--set", "film.force_chains=true"}, "its dumps have no contacts"},
        {{"render", "job", "--set", "film.rotation=true"}, "its dumps have no orientations"},
        {{"render", "job", "--set", "film.wall_forces=true"}, "forces on walls are not measured there"},
        {{"compare", "job", "job", "--set", "film.force_chains=true"}, "its dumps have no contacts"},
        {{"inspect", "job", "--wall", "floor"},
         "--wall: job: forces on walls and overlaps are known of runs of our"},
        {{"inspect", "job", "--largest-overlap"}, "known of runs of our own engine alone"},
        {{"inspect", "job", "--where", "contacts > 2"}, "its dumps have no contacts"},
        {{"inspect", "job", "--where", "force > 2 N"}, "known of runs of our own engine alone"},
        {{"movie", "ball.toml", "--engine", "lammps", "--set", "film.force_chains=true"},
         "--engine lammps: another "}};
    for (const auto& [words, part] : cases) {
        const Ended ended = program(words);
        EXPECT_EQ(ended.status, 2) << testing::PrintToString(words) << ended.err;
        EXPECT_THAT(ended.err, HasSubstr(part)) << testing::PrintToString(words);
        EXPECT_THAT(ended.err, Not(HasSubstr("output."))) << testing::PrintToString(words);
        EXPECT_THAT(ended.err, Not(HasSubstr("--no-replay"))) << testing::PrintToString(words);
    }
    const Ended between = program({"inspect", "job", "--at", "0.0512s", "--where", "z > 0 m"});
    EXPECT_EQ(between.status, 0) << between.err;
    EXPECT_THAT(between.out, tells({"0.0512 s", "not kept", "nearest kept moment"}));
}

TEST_F(FollowedJob, IsExportedBeforeItWasDrawn) {
    add(0, 6);
    const Ended ended = program({"export", "job", "--to", "xyz", "--out", "job.xyz"});
    EXPECT_EQ(ended.status, 0) << ended.err;
    EXPECT_THAT(ended.err, HasSubstr("6 frames"));
}

TEST_F(FollowedJob, OneThatDiedBeforeItsFirstMomentSaysWhy) {
    job_ends(1, "LAMMPS (29 Sep 2021)\nERROR: Unknown command: nonsense (../input.cpp:274)\n");
    for (const Words& words : {follow("300"), Words{"render", "job"}, Words{"inspect", "job"}}) {
        const Ended ended = program(words);
        EXPECT_EQ(ended.status, 1) << words.front() << ended.err;
        EXPECT_THAT(ended.err, HasSubstr("LAMMPS ended: "));
        EXPECT_THAT(ended.err, HasSubstr("Unknown command: nonsense"));
        EXPECT_THAT(ended.err, testing::Not(HasSubstr("has not run yet")));
    }
    EXPECT_FALSE(fs::exists(here / "film"));
}

// A user who draws a second time may not have read the first message, so the reason is said each time.
TEST_F(FollowedJob, EachVerbSaysWhyTheRunIsShort) {
    add(0, 6);
    job_ends(143);
    for (const Words& words : {Words{"render", "job", "--out", "first"},
                               {"render", "job", "--out", "second"},
                               {"inspect", "job"}}) {
        const Ended ended = program(words);
        EXPECT_EQ(ended.status, 0) << ended.err;
        EXPECT_THAT(ended.err, tells({"LAMMPS", "signal", "Ctrl-C", "0.05 s of"}));
    }
}

// Nobody waits for a pipe that has the name of a file of the job.
TEST_F(FollowedJob, APipeInTheFolderIsNotWaitedFor) {
    add(0, 6);
    for (const char* file : {"job/job.status", "job/out.lammps", "job/log.lammps"})
        ASSERT_EQ(::mkfifo((here / file).c_str(), 0600), 0);
    EXPECT_EQ(program({"inspect", "job"}).status, 0);
}

// Commands that are printed can be pasted, whatever the folder is called.
TEST_F(FollowedJob, PrintedCommandsAreQuoted) {
    const Ended written = program({"handover", "ball.toml", "--to", "lammps", "--out", "my job"});
    EXPECT_EQ(written.status, 0);
    EXPECT_THAT(written.err, tells({"run it", "sh 'my job/run.sh'", "cd 'my job'"}));
    EXPECT_THAT(written.err, tells({"draw it", "render 'my job'"}));
    EXPECT_THAT(program({"resume", "my job"}).err, tells_only({"my job", "sh 'my job/run.sh' --continue"}));
    EXPECT_THAT(program({"render", "my job"}).err, tells_only({"my job", "sh 'my job/run.sh'"}));
}

// A job that goes on keeps the log that told why the one before ended, also where it cannot go on.
TEST_F(FollowedJob, AJobThatGoesOnKeepsTheLogOfTheOneBefore) {
    fs::create_directory(here / "bin");
    write_text(here / "bin/mpirun", "#!/bin/sh\necho run > log.lammps\necho said\nexit 0\n");
    fs::permissions(here / "bin/mpirun", fs::perms::owner_all);
    const auto run = [&](const std::string& how) {
        const std::string command =
            fmt::format("cd '{}' && PATH=\"$PWD/bin:$PATH\" ENGINE=true sh job/run.sh {} 2> said",
                        here.path().string(), how);
        return WEXITSTATUS(std::system(command.c_str()));
    };
    write_text(here / "job/log.lammps", "why\n");
    EXPECT_EQ(run("--continue"), 2);  // there is no restart file
    EXPECT_EQ(text_of(here / "job/log.lammps"), "why\n");
    add(0, 3);
    write_text(here / "job/lammps.restart.100", "");
    write_text(here / "job/out.lammps", "what\n");
    EXPECT_EQ(run("--continue"), 0) << text_of(here / "said");
    EXPECT_EQ(run("--continue"), 0) << text_of(here / "said");
    EXPECT_EQ(text_of(here / "job/log.lammps.1"), "why\n");
    EXPECT_EQ(text_of(here / "job/out.lammps.1"), "what\n");
    EXPECT_EQ(text_of(here / "job/log.lammps.2"), "run\n");
    EXPECT_EQ(run(""), 0);
    EXPECT_FALSE(fs::exists(here / "job/log.lammps.1")) << "a job from the start begins with nothing";
}

// A stand-in for mpirun, whose banner comes after the engine's error.
TEST_F(FollowedJob, TheEnginesErrorIsTheLastThatRunShSays) {
    fs::create_directory(here / "bin");
    write_text(here / "bin/mpirun",
               "#!/bin/sh\ncp job.status during.status\n"
               "printf 'units si\\npair_style nonsense 3\\nERROR: Unrecognized (force.cpp:278)\\n' | tee "
               "log.lammps\n"
               "printf -- '-----\\nmpirun detected that one or more processes exited\\n-----\\n'\nexit 1\n");
    fs::permissions(here / "bin/mpirun", fs::perms::owner_all);
    write_text(here / "job/in.lammps", "units si  # metres\n\npair_style   nonsense\t3\n");
    const std::string command = fmt::format(
        "cd '{}' && PATH=\"$PWD/bin:$PATH\" ENGINE=true sh job/run.sh 2> said", here.path().string());
    EXPECT_EQ(WEXITSTATUS(std::system(command.c_str())), 1);
    EXPECT_THAT(text_of(here / "said"),
                tells_only({"run.sh", "LAMMPS ended", "in.lammps:3", "pair_style nonsense 3", "out.lammps"}));
    EXPECT_THAT(text_of(here / "job/during.status"),
                testing::MatchesRegex("running\njob .* [0-9]+ [0-9]+ start\n"));
    EXPECT_THAT(text_of(here / "job/job.status"), testing::MatchesRegex("1\njob .* [0-9]+ [0-9]+ start\n"));
    const std::string running = text_of(here / "job/during.status"), ended = text_of(here / "job/job.status");
    EXPECT_EQ(running.substr(running.find('\n')), ended.substr(ended.find('\n'))) << "both name the same job";
}

// Packing may take minutes, so that nothing is packed for a folder that cannot be had.
TEST_F(FollowedJob, ATakenFolderIsRefusedBeforeAnythingElse) {
    fs::create_directory(here / "taken");
    write_text(here / "taken/mine", "precious");
    std::string packed = falling;
    packed.replace(packed.find("diameter"), 0, "count = 50\n");
    packed.erase(packed.find("[start]"), packed.find("[run]") - packed.find("[start]"));
    write_text(here / "packed.toml", packed);
    const Words hand_over = {"handover", "packed.toml", "--to", "lammps", "--progress", "json", "--out"};
    const auto handed_to = [&](const std::string& folder) {
        Words words = hand_over;
        words.push_back(folder);
        return program(words);
    };
    EXPECT_THAT(handed_to("free").err, HasSubstr("settling"));
    const Ended ended = handed_to("taken");
    EXPECT_EQ(ended.status, 2) << ended.err;
    EXPECT_THAT(ended.err, HasSubstr("--out taken: exists already"));
    EXPECT_THAT(ended.err, Not(HasSubstr("settling")));
    // A dump that is damaged would be refused too, once it is read.
    write_text(here / "job/lammps.dump", "nonsense\n");
    for (const Words& words :
         {Words{"export", "job", "--to", "csv", "--out", "taken"}, Words{"render", "job", "--out", "taken"},
          Words{"render", "job", "--follow", "--out", "taken"},
          Words{"render", "job", "--at", "0", "--out", "taken"},
          Words{"compare", "job", "job", "--out", "taken"}, Words{"report", "job", "--out", "taken"}}) {
        const Ended refused = program(words);
        EXPECT_EQ(refused.status, 2) << testing::PrintToString(words) << refused.err;
        EXPECT_THAT(refused.err, HasSubstr("--out taken: ")) << testing::PrintToString(words);
    }
    EXPECT_EQ(text_of(here / "taken/mine"), "precious");
}

TEST_F(FollowedJob, IsToldToRunFirst) {
    for (const char* verb : {"inspect", "render"}) {
        const Ended ended = program({verb, "job"});
        EXPECT_EQ(ended.status, 2) << ended.err;
        EXPECT_THAT(ended.err, tells({"LAMMPS", "not run yet", "sh job/run.sh"}));
    }
}

}  // namespace
}  // namespace grainreel
