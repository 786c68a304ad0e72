// Tests of what `inspect` believes in a run's folder: nothing that is damaged or of another run goes into an
// answer without a message.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "engine/start/restart.hpp"
#include "tests/cli/program.hpp"
#include "tests/support/small_scene.hpp"
#include "tests/support/tells.hpp"
#include "tests/support/temporary_folder.hpp"

namespace grainreel {
namespace {

namespace fs = std::filesystem;
using namespace test;
using testing::AllOf;
using testing::HasSubstr;
using testing::Not;
using Words = std::vector<std::string>;

class Belief : public testing::Test {
  protected:
    Belief() { write_small_scene(here.path()); }

    Ended run(const Words& words) const { return run_program(words, {.folder = here.path()}); }
    void make(const char* folder, const Words& more = {}, const char* duration = "0.1 s") const {
        Words words = {"movie",      "fifty.toml", "--no-film", "--no-report",
                       "--duration", duration,     "--threads", "1",
                       "--out",      folder,       "--set",     "output.contacts=true"};
        words.insert(words.end(), more.begin(), more.end());
        const Ended ended = run(words);
        ASSERT_EQ(ended.status, 0) << ended.err;
    }
    Ended ask(const Words& question) const {
        Words words = {"inspect", "run"};
        words.insert(words.end(), question.begin(), question.end());
        return run(words);
    }
    void cut(const char* file, double share) const {
        const fs::path path = here / "run" / file;
        fs::resize_file(path, static_cast<std::uintmax_t>(share * static_cast<double>(fs::file_size(path))));
    }

    TemporaryFolder here;
};

TEST_F(Belief, ACheckpointOfAnotherSeedOrSceneIsPassedOver) {
    make("run");
    make("seed", {"--seed", "7"});
    make("drive", {"--set", "drive.g_level=2.5"});
    const Words question = {"--at", "0.0443 s", "--grain", "7", "--json"};
    const Ended before = ask(question);
    ASSERT_EQ(before.status, 0) << before.err;
    const fs::path first = here / "run/checkpoints/000000000000.grs";
    ASSERT_TRUE(fs::exists(first));
    for (const char* other : {"seed", "drive"}) {
        // This checkpoint is nearer to the moment than the run's own.
        const fs::path foreign = here / "run/checkpoints" / fs::path("000000000001.grs");
        fs::copy(here / other / "checkpoints/000000000000.grs", foreign);
        const Ended renamed = ask(question);
        EXPECT_EQ(renamed.out, before.out);
        EXPECT_THAT(renamed.err, tells({"000000000001.grs", "another moment", "step 0"}));
        fs::remove(foreign);
        // If the foreign checkpoint is the only one, nothing can be restored, and the run cannot continue.
        fs::rename(here / "run/checkpoints", here / "ring");
        fs::rename(here / "run/checkpoint.grs", here / "last.grs");
        fs::create_directory(here / "run/checkpoints");
        fs::copy(here / other / "checkpoints/000000000000.grs", first);
        const Ended alone = ask(question);
        EXPECT_EQ(alone.status, 2) << alone.out;
        EXPECT_THAT(alone.err, tells({"000000000000.grs", "another run", "'"}));
        EXPECT_EQ(run({"resume", "run", "--for", "0.1 s"}).status, 2) << "as resume refuses it";
        fs::remove_all(here / "run/checkpoints");
        fs::rename(here / "ring", here / "run/checkpoints");
        fs::rename(here / "last.grs", here / "run/checkpoint.grs");
    }
    // The checkpoint is put in place of the run's last one, which says how far the run has come.
    make("longer", {"--seed", "7"}, "0.15 s");
    const Ended last_before = ask({"--json"});
    fs::rename(here / "run/checkpoint.grs", here / "last.grs");
    fs::copy(here / "longer/checkpoint.grs", here / "run/checkpoint.grs");
    const Ended last = ask({"--json"});
    EXPECT_THAT(last.err, tells({"run/checkpoint.grs", "another run", "'run.seed' is 7 there"}));
    EXPECT_EQ(nlohmann::json::parse(last.out)["moment"]["step"],
              nlohmann::json::parse(last_before.out)["moment"]["step"]);
}

TEST_F(Belief, ADamagedLastCheckpointDoesNotSayHowFarTheRunCame) {
    make("run");
    const std::int64_t last = nlohmann::json::parse(ask({"--json"}).out)["moment"]["step"];
    fs::path file = here / "run/checkpoint.grs";
    std::string bytes = text_of(file);
    std::uint64_t scene_length = 0;
    const std::size_t at_length = 8 + 8;  // name with version, checksum
    std::memcpy(&scene_length, bytes.data() + at_length, sizeof scene_length);
    bytes[at_length + 8 + scene_length + 4] ^= 1;  // the step in the file becomes larger by 2^32
    fs::remove(file);                              // the file is a hard link to one of the ring
    write_text(file, bytes);
    ASSERT_GT(label_of_checkpoint(file)->step, std::int64_t{1} << 32);
    const Ended ended =
        run_program({"inspect", "run", "--json"}, {.folder = here.path(), .seconds_limit = 60});
    ASSERT_EQ(ended.status, 0) << ended.err;
    EXPECT_THAT(ended.err, HasSubstr("checkpoint.grs: is damaged"));
    EXPECT_LE(nlohmann::json::parse(ended.out)["moment"]["step"].get<std::int64_t>(), last);
}

// A change made by --accept is told apart from a value that another run had.
TEST_F(Belief, ACheckpointFromBeforeAnAcceptedChangeIsOfTheRun) {
    make("run", {"--seed", "3"});
    make("strange", {"--seed", "3", "--set", "contact.friction=0.3"});
    const Words question = {"--at", "0.0443 s", "--grain", "7", "--json"};
    const Ended before = ask(question);
    ASSERT_EQ(
        run({"resume", "run", "--for", "0.05 s", "--no-report", "--accept", "contact.friction=0.2"}).status,
        0);
    const Ended after = ask(question);
    EXPECT_EQ(after.out, before.out) << after.err;
    EXPECT_EQ(after.err, "");
    ASSERT_EQ(run({"resume", "run", "--for", "0.05 s", "--no-report"}).status, 0) << "which writes run.json";
    EXPECT_EQ(ask(question).out, before.out);
    // Which other checkpoints there are depends on the speed of the machine.
    fs::remove_all(here / "run/checkpoints");
    fs::create_directory(here / "run/checkpoints");
    fs::copy(here / "strange/checkpoints/000000000000.grs", here / "run/checkpoints/000000000000.grs");
    const Ended strange = ask(question);
    EXPECT_EQ(strange.status, 2);
    EXPECT_THAT(strange.err, tells({"friction' is 0.3 there", "0.2", "scene.toml"}));
}

TEST_F(Belief, ContactsThatWereCutOffAreBroughtBack) {
    make("run", {"--set", "output.trajectory_interval=20 ms"});
    const Words question = {"--at", "0.1 s", "--where", "contacts > 0", "--json"};
    const Ended before = ask(question);
    ASSERT_EQ(before.status, 0) << before.err;
    const auto matching = [](const Ended& ended) {
        return nlohmann::json::parse(ended.out)["tables"]["count"]["rows"];
    };
    ASSERT_THAT(before.out, Not(HasSubstr("brought back")));
    const std::string whole = text_of(here / "run/contacts.nc");
    const auto expect_brought_back = [&](const char* why) {
        const Ended ended = ask(question);
        ASSERT_EQ(ended.status, 0) << why << ended.err;
        EXPECT_EQ(matching(ended), matching(before)) << why;
        EXPECT_THAT(ended.out, HasSubstr("brought back")) << why;
        EXPECT_THAT(ended.err, HasSubstr("warning: run/contacts.nc: ")) << why;
    };
    cut("contacts.nc", 0.6);
    expect_brought_back("cut off");
    EXPECT_EQ(ask({"--at", "0.1 s", "--where", "contacts > 0", "--no-replay"}).status, 2);
    write_text(here / "run/contacts.nc", "");
    expect_brought_back("empty");
    std::string damaged = whole;
    damaged[damaged.size() - 20] ^= 4;  // damages a number of the last row
    write_text(here / "run/contacts.nc", damaged);
    const Ended ended = ask(question);
    EXPECT_EQ(matching(ended), matching(before)) << ended.err;
    EXPECT_THAT(ended.out, HasSubstr("brought back"));
}

TEST_F(Belief, ADamagedFrameIsBroughtBackAndSaidSo) {
    make("run", {"--set", "output.trajectory_interval=20 ms"});
    const Words question = {"--at", "0.1 s", "--where", "height > 5 mm", "--json"};
    const Ended before = ask(question);
    const std::string whole = text_of(here / "run/trajectory.nc");
    std::string damaged = whole;
    damaged[damaged.size() - 600] ^= 8;  // damages the last frame's grains
    write_text(here / "run/trajectory.nc", damaged);
    const Ended ended = ask(question);
    ASSERT_EQ(ended.status, 0) << ended.err;
    EXPECT_THAT(ended.err, tells({"warning: run/trajectory.nc", "frame 5", "damaged"}));
    // Restored velocities are not rounded, as those that were kept are.
    EXPECT_EQ(nlohmann::json::parse(ended.out)["tables"]["count"],
              nlohmann::json::parse(before.out)["tables"]["count"]);
    cut("trajectory.nc", 0.99);
    EXPECT_THAT(ask(question).err, tells({"warning: run/trajectory.nc", "frame 5", "not whole"}));
}

// The other run differs only in the seed, so its film has pictures at the same moments.
TEST_F(Belief, FilmMomentsOfAnotherRunAreNotUsed) {
    for (const char* folder : {"run", "other"}) {
        const Ended ended =
            run({"movie", "fifty.toml", "--no-report", "--duration", "0.1 s", "--size", "320x180", "--out",
                 folder, "--seed", folder == std::string("run") ? "1" : "7", "--set",
                 "output.film_moments=true"});
        ASSERT_EQ(ended.status, 0) << ended.err;
    }
    ASSERT_EQ(ask({"--frame", "3"}).status, 0);
    fs::copy_file(here / "other/film_moments.nc", here / "run/film_moments.nc",
                  fs::copy_options::overwrite_existing);
    const Ended asked = ask({"--frame", "3"});
    EXPECT_EQ(asked.status, 2) << asked.out;
    EXPECT_THAT(asked.err, AllOf(HasSubstr("run/film_moments.nc: "), HasSubstr("they are of two runs")));
    const Ended drawn = run({"render", "run", "--at", "0.03", "--out", "still.png"});
    EXPECT_EQ(drawn.status, 0) << drawn.err;
    EXPECT_THAT(drawn.err, tells({"two runs", "not used"}));
}

// Both runs start from a table of grains. A checkpoint does not say from which, so these seem to be the
// run's own.
TEST_F(Belief, AReplayToOtherGrainsThanWereKeptIsRefused) {
    make("first");
    make("second", {"--seed", "7"});
    write_text(here / "started.toml",
               std::string(small_scene_text) + "[start]\nmethod = \"file\"\nfile = \"grains.csv\"\n");
    for (const char* folder : {"first", "second"}) {
        fs::copy_file(here / folder / "final.csv", here / "grains.csv", fs::copy_options::overwrite_existing);
        const std::string out = folder == std::string("first") ? "run" : "other";
        const Ended ended = run({"movie", "started.toml", "--no-film", "--no-report", "--duration", "0.1 s",
                                 "--set", "output.trajectory_interval=20 ms", "--out", out});
        ASSERT_EQ(ended.status, 0) << ended.err;
    }
    const Words question = {"--at", "0.0731 s", "--grain", "7"};
    ASSERT_EQ(ask(question).status, 0);
    fs::remove_all(here / "run/checkpoints");
    fs::remove(here / "run/checkpoint.grs");
    fs::copy(here / "other/checkpoints", here / "run/checkpoints");
    for (const auto& entry : fs::directory_iterator(here / "run/checkpoints"))
        if (entry.path().filename() != "000000000000.grs") fs::remove(entry.path());
    const Ended ended = ask(question);
    EXPECT_EQ(ended.status, 2) << ended.out;
    EXPECT_THAT(ended.err, tells({"other grains", "trajectory.nc"}));
}

// A kept moment of a run with grains glued to its floor is restored as it was.
TEST_F(Belief, AFrameBesideGluedGrainsComesBackAsItWas) {
    make("run",
         {"--set", "output.trajectory_interval=20 ms", "--set", "container.wall_grains={faces=[\"floor\"]}"});
    const auto grains = [&](bool back) {
        Words question = {"--at", "0.1 s", "--where", "id >= 0", "--limit", "50", "--json"};
        if (!back) question.push_back("--no-replay");
        const Ended ended = ask(question);
        EXPECT_EQ(ended.status, 0) << ended.err;
        EXPECT_EQ(ended.out.find("brought back") != std::string::npos, back);
        return nlohmann::json::parse(ended.out)["tables"]["grains"]["rows"];
    };
    const auto kept = grains(false);
    ASSERT_EQ(kept.size(), 50u);
    for (const char* file : {"contacts.nc", "checkpoint.grs"}) fs::remove(here / "run" / file);
    for (const auto& entry : fs::directory_iterator(here / "run/checkpoints"))
        if (entry.path().filename() != "000000000000.grs") fs::remove_all(entry.path());
    std::string damaged = text_of(here / "run/trajectory.nc");
    damaged[damaged.size() - 600] ^= 8;  // damages the last frame's grains
    write_text(here / "run/trajectory.nc", damaged);
    const auto back = grains(true);
    ASSERT_EQ(back.size(), kept.size());
    for (std::size_t i = 0; i < kept.size(); ++i)
        for (int column : {2, 3, 4})  // m; values that were kept are rounded
            EXPECT_NEAR(back[i][column].get<double>(), kept[i][column].get<double>(), 1e-8) << i;
}

// A table does not say where it ends; the run.json beside it does.
TEST_F(Belief, AFinalTableThatWasCutAtARowsEndIsRefused) {
    make("run");
    const std::string whole = text_of(here / "run/final.csv");
    EXPECT_EQ(nlohmann::json::parse(text_of(here / "run/run.json"))["written"]["final_csv"]["grains"], 50);
    EXPECT_EQ(std::count(whole.begin(), whole.end(), '\n'), 51);
    const auto rows = [&](int count) {
        std::size_t end = 0;
        for (int k = 0; k <= count; ++k) end = whole.find('\n', end) + 1;
        return whole.substr(0, end);
    };
    write_text(here / "go_on.toml",
               std::string(small_scene_text)
                       .replace(std::string(small_scene_text).find("count = 10"), 10, "count = 4") +
                   "[start]\nmethod = \"file\"\nfile = \"run/final.csv\"\n");
    const auto expect_refused = [&](const std::string& text, const char* why) {
        write_text(here / "run/final.csv", text);
        for (const Words& words : {Words{"inspect", "run/final.csv"}, Words{"check", "go_on.toml"}}) {
            const Ended ended = run(words);
            EXPECT_EQ(ended.status, 2) << words[0] << ended.out;
            EXPECT_THAT(ended.err, HasSubstr(why));
        }
    };
    expect_refused(rows(44), "run/final.csv: was cut off: it has 44 of the 50 grains that its run wrote");
    std::string changed = whole;
    const std::size_t digit = changed.find("0.0", 300) + 3;
    changed[digit] = changed[digit] == '9' ? '8' : '9';
    expect_refused(changed, "run/final.csv: is not what its run wrote");
    // A table under another name may be whatever its owner made of it.
    write_text(here / "run/mine.csv", rows(44));
    EXPECT_EQ(run({"inspect", "run/mine.csv"}).status, 0);
    // Without a run.json, the scene beside the table gives the number of grains.
    fs::rename(here / "run/run.json", here / "run.json");
    write_text(here / "run/final.csv", rows(44));
    const Ended alone = run({"inspect", "run/final.csv"});
    EXPECT_EQ(alone.status, 2);
    EXPECT_THAT(alone.err, tells({"44 grains", "scene.toml", "50"}));
    write_text(here / "run/final.csv", whole);
    EXPECT_EQ(run({"inspect", "run/final.csv"}).status, 0);
    fs::rename(here / "run.json", here / "run/run.json");
    ASSERT_EQ(run({"resume", "run", "--for", "0.05 s", "--no-report"}).status, 0);
    EXPECT_EQ(run({"inspect", "run/final.csv"}).status, 0) << "a longer run has marked its table anew";
}

// A trajectory alone, under another name, has the same grains. What only the run knew is missing.
TEST_F(Belief, ATrajectoryAloneAnswersAsItsRunDoes) {
    make("run", {"--set", "output.trajectory_interval=20 ms"});
    fs::copy(here / "run/trajectory.nc", here / "moments");
    const auto grain = [&](const char* record) {
        const Ended ended =
            run({"inspect", record, "--at", "0.06 s", "--no-replay", "--grain", "7", "--json"});
        EXPECT_EQ(ended.status, 0) << ended.err;
        constexpr int z = 4;  // column
        return nlohmann::json::parse(ended.out)["tables"]["grain"]["rows"][0][z].get<double>();
    };
    EXPECT_EQ(grain("moments"), grain("run"));
    EXPECT_EQ(run({"inspect", "moments", "--at", "0.05 s"}).status, 2)
        << "which would have to be brought back";
}

}  // namespace
}  // namespace grainreel
