// Tests of the verb `study` as its users meet it: it runs, stops, continues and gathers results.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <unistd.h>

#include <csignal>
#include <cstdlib>

#include "engine/files/measures_csv.hpp"
#include "render/app/study/study.hpp"
#include "tests/cli/verbs/study_verb.hpp"
#include "tests/support/tells.hpp"

namespace grainreel {
namespace {

using namespace test;
using testing::HasSubstr;
using testing::Not;

TEST_F(StudyVerb, RunsReducesAndCharts) {
    const Ended ended = run_program(words(write(four_members)), {});
    EXPECT_EQ(ended.status, 0) << ended.err;
    EXPECT_EQ(ended.out, out().string() + "\n");
    const auto rows = table();
    ASSERT_EQ(rows.size(), 5u);
    EXPECT_THAT(rows[0], testing::ElementsAre("drive.g_level", "run.seed", "state", "kinetic", "warnings",
                                              "error", "folder"));
    for (std::size_t i = 1; i < rows.size(); ++i) {
        EXPECT_EQ(rows[i][0], i <= 2 ? "2" : "3");
        EXPECT_EQ(rows[i][2], "complete");
        const fs::path member = out() / rows[i].back();
        EXPECT_EQ(record(member)["engine"]["seed"], std::stoi(rows[i][1]));
        EXPECT_EQ(record(member)["threads"]["engine"], 1);
        const auto measures = read_measures(member / "measures.csv");
        const auto at = std::find(measures->columns().begin(), measures->columns().end(), "kinetic_J");
        const auto column = static_cast<std::size_t>(at - measures->columns().begin());
        EXPECT_EQ(std::stod(rows[i][3]), mean_of_values(measures->values(column, 0, measures->rows())));
    }
    EXPECT_NE(rows[1][3], rows[2][3]) << "seeds";
    for (const char* file :
         {"charts/kinetic.csv", "charts/kinetic.svg", "charts/kinetic.png", "index.html", "study.toml"})
        EXPECT_TRUE(fs::exists(out() / file)) << file;
    const std::string page = text_of(out() / "index.html");
    EXPECT_THAT(page, HasSubstr("charts/kinetic.svg"));
    for (const std::size_t first : {1, 3})
        EXPECT_THAT(
            page, HasSubstr("src=\"posters/" + fs::path(rows[first].back()).filename().string() + ".png\""));
}

// A member's run is the same as that of `movie --set ...`; the hash of its end state shows it.
TEST_F(StudyVerb, AMemberIsWhatMovieMakes) {
    ASSERT_EQ(run_program(words(write(four_members), {"--no-posters"}), {}).status, 0);
    const Ended movie = run_program(
        {"movie", (folder_ / "fifty.toml").string(), "--no-film", "--out", (folder_ / "one").string(),
         "--duration", "0.1 s", "--set", "drive.g_level=3", "--seed", "2"},
        {});
    ASSERT_EQ(movie.status, 0) << movie.err;
    EXPECT_EQ(record(folder_ / "one")["engine"]["state_hash"],
              record(out() / table().back().back())["engine"]["state_hash"]);
}

TEST_F(StudyVerb, GoesOnWithWhatIsMissing) {
    const std::string study = write(four_members);
    ASSERT_EQ(run_program(words(study, {"--no-posters"}), {}).status, 0);
    const std::string before = text_of(out() / "study.csv");
    const auto all = members();
    ASSERT_EQ(all.size(), 4u);
    std::vector<fs::file_time_type> times;
    for (const fs::path& member : all) times.push_back(fs::last_write_time(member / "run.json"));
    fs::remove_all(all[1]);
    // A killed run leaves such a file.
    write_text(all[2] / "run.json", "{\"status\": \"run");
    ASSERT_EQ(run_program(words(study, {"--no-posters"}), {}).status, 0);
    EXPECT_EQ(text_of(out() / "study.csv"), before);
    EXPECT_EQ(fs::last_write_time(all[0] / "run.json"), times[0]);
    EXPECT_EQ(fs::last_write_time(all[3] / "run.json"), times[3]);
    EXPECT_NE(fs::last_write_time(all[1] / "run.json"), times[1]);
    EXPECT_NE(fs::last_write_time(all[2] / "run.json"), times[2]);
}

// A study that should be longer goes on with its members, and gets what a study that was longer at once gets.
TEST_F(StudyVerb, ALongerDurationGoesOnWithTheMembers) {
    const std::string longer = replaced(four_members, "run.duration=0.1 s", "run.duration=0.15 s");
    ASSERT_EQ(run_program(words(write(four_members), {"--no-posters"}), {}).status, 0);
    EXPECT_THAT(run_program(words(write(longer), {"--dry-run"}), {}).out, tells({"goes on", "4 members"}));
    const Ended ended = run_program(words(write(longer), {"--no-posters"}), {});
    ASSERT_EQ(ended.status, 0) << ended.err;
    EXPECT_THAT(ended.err, tells({"4 members go on"}));
    const std::string grown = text_of(out() / "study.csv");
    EXPECT_EQ(members().size(), 4u);
    for (const fs::path& member : members())
        EXPECT_THAT(record(member)["command"].get<std::string>(), HasSubstr("resume")) << "not begun anew";
    fs::remove_all(out());
    ASSERT_EQ(run_program(words(write(longer), {"--no-posters"}), {}).status, 0);
    EXPECT_EQ(text_of(out() / "study.csv"), grown);
}

TEST_F(StudyVerb, RunsOneVariantAlone) {
    const std::string study = write(
        replaced(replaced(four_members, "[[vary]]\nkey = \"drive.g_level\"\nvalues = [2, 3]\n",
                          "[[variant]]\nname = \"as it is\"\nset = []\n[[variant]]\nname = \"hard\"\nset = "
                          "[\"drive.g_level=3\"]\nseeds = [7]\n"),
                 "seeds = 2", "seeds = [1]"));
    const Ended ended = run_program(words(study, {"--no-posters", "--variant", "hard"}), {});
    ASSERT_EQ(ended.status, 0) << ended.err;
    const auto rows = table();
    ASSERT_EQ(rows.size(), 3u);
    EXPECT_EQ(rows[0][0], "variant");
    EXPECT_THAT(rows[1], testing::Contains("missing"));
    EXPECT_EQ(rows[2][0], "hard");
    EXPECT_EQ(rows[2][1], "7");
    EXPECT_EQ(rows[2][2], "complete");
    const Ended dry = run_program(words(study, {"--dry-run"}), {});
    EXPECT_THAT(dry.out, HasSubstr("variants     as it is, hard\n"));
    EXPECT_THAT(dry.out, tells({"2 settings", "1 of them", "to be run"}));
    ASSERT_EQ(run_program(words(study, {"--no-posters"}), {}).status, 0);
    EXPECT_EQ(table()[1][2], "complete");
    EXPECT_EQ(table()[2], rows[2]);
    const Ended unknown = run_program(words(study, {"--variant", "soft"}), {});
    EXPECT_EQ(unknown.status, 2);
    EXPECT_THAT(unknown.err, tells({"no such variant", "as it is, hard"}));
    EXPECT_EQ(run_program(words(write(four_members), {"--variant", "hard"}), {}).status, 2);
}

TEST_F(StudyVerb, StopsInGoodOrder) {
    const std::string study = write(with_long_runs());
    Program program(words(study, {"--jobs", "2", "--no-posters"}), {});
    const auto some_vibrate = [&] {
        if (!fs::exists(out() / "members")) return false;
        for (const fs::path& member : members())
            if (text_of(member / "measures.csv").size() > 2000) return true;
        return false;
    };
    ASSERT_TRUE(wait_until(program, some_vibrate));
    program.send(SIGINT);
    const Ended ended = program.wait();
    EXPECT_EQ(ended.status, 130) << ended.err;
    EXPECT_THAT(ended.err, HasSubstr("the same command goes on"));
    EXPECT_EQ(table().size(), 5u);
    for (const fs::path& member : members()) EXPECT_EQ(record(member)["status"], "interrupted");
    EXPECT_THAT(text_of(out() / "study.csv"), HasSubstr("incomplete"));
}

// When a study ends at once, none of its members goes on by itself.
TEST_F(StudyVerb, MembersEndWithAKilledStudy) {
    Program program(words(write(with_long_runs()), {"--jobs", "1", "--no-posters"}), {});
    ASSERT_TRUE(wait_until(program, [&] {
        return fs::exists(out() / "members") && !members().empty() &&
               fs::exists(members()[0] / "measures.csv");
    }));
    program.send(SIGKILL);
    program.wait();
    const fs::path member = members()[0];
    for (int i = 0; i < 100 && record(member)["status"] == "running"; ++i) usleep(100'000);
    EXPECT_EQ(record(member)["status"], "interrupted");
}

TEST_F(StudyVerb, AFailedMemberEndsNothing) {
    // The step of the second value is far too long for the contacts.
    const std::string study = write(
        replaced(replaced(four_members, "drive.g_level", "run.step"), "[2, 3]", "[\"1e-5 s\", \"1e-2 s\"]"));
    const Ended ended = run_program(words(study, {"--no-posters"}), {});
    EXPECT_EQ(ended.status, 1) << ended.err;
    const auto rows = table();
    ASSERT_EQ(rows.size(), 5u);
    EXPECT_EQ(rows[1][2], "complete");
    EXPECT_EQ(rows[3][2], "failed");
    EXPECT_FALSE(rows[3][5].empty()) << "the reason";
    EXPECT_THAT(ended.err, tells({"2 of 4 members", "complete", "2 failed"}));
    EXPECT_THAT(text_of(out() / "index.html"), HasSubstr("<h2>Failed</h2>"));
}

TEST_F(StudyVerb, CommandsRunElsewhereAndAreGathered) {
    const std::string study = write(replaced(four_members, "fifty.toml", "it's fifty.toml"));
    fs::rename(folder_ / "fifty.toml", folder_ / "it's fifty.toml");
    const Ended printed = run_program(words(study, {"--print-commands"}), {});
    ASSERT_EQ(printed.status, 0) << printed.err;
    EXPECT_EQ(std::count(printed.out.begin(), printed.out.end(), '\n'), 4);
    EXPECT_TRUE(members().empty());
    write_text(folder_ / "commands.txt", printed.out);
    // The members run the scene as it was when their commands were printed.
    write_text(folder_ / "it's fifty.toml", "no scene");
    ASSERT_EQ(std::system(("head -3 '" + (folder_ / "commands.txt").string() + "' | sh > /dev/null").c_str()),
              0);
    write_small_scene(folder_.path());
    fs::rename(folder_ / "fifty.toml", folder_ / "it's fifty.toml");
    const Ended gathered = run_program(words(study, {"--collect"}), {});
    EXPECT_EQ(gathered.status, 0) << gathered.err;
    EXPECT_THAT(gathered.err, tells({"3 of 4 members", "complete"}));
    EXPECT_EQ(table().back()[2], "missing");
    // Only the members that are still to be run are printed.
    const Ended rest = run_program(words(study, {"--print-commands"}), {});
    EXPECT_EQ(std::count(rest.out.begin(), rest.out.end(), '\n'), 1);
}

TEST_F(StudyVerb, DryRunTellsAndWritesNothing) {
    const Ended ended = run_program(words(write(four_members), {"--dry-run"}),
                                    {folder_.path(), {"XDG_CACHE_HOME=" + folder_.path().string()}});
    EXPECT_EQ(ended.status, 0) << ended.err;
    for (const char* words :
         {"4 = 2 settings x 2 seeds, 4 of them to be run", "cost ", "disk ", "drive.g_level = 3, seed 2"})
        EXPECT_THAT(ended.out, HasSubstr(words));
    EXPECT_FALSE(fs::exists(out()));
}

TEST_F(StudyVerb, MistakesWriteNothing) {
    const Ended many = run_program(words(write(replaced(four_members, "seeds = 2", "seeds = 6000"))), {});
    EXPECT_EQ(many.status, 2);
    EXPECT_THAT(many.err, tells({"study.toml:5:1", "12000 members"}));
    const Ended unknown = run_program(words(write(replaced(four_members, "drive.g_level", "drive.gee"))), {});
    EXPECT_EQ(unknown.status, 2);
    EXPECT_THAT(unknown.err, HasSubstr("study.toml:5:1: unknown key 'gee'"));
    EXPECT_FALSE(fs::exists(out()));
    const Ended none = run_program({"study", "none.toml"}, {});
    EXPECT_THAT(none.err, tells_only({"error: none.toml", "no such file", "(.toml)"}));
    const Ended no_scene = run_program(words(write(replaced(four_members, "fifty.toml", "sixty.toml"))), {});
    EXPECT_THAT(no_scene.err, tells({"study.toml:1:1", "'scene'", "\"sixty.toml\"", "no such file"}));
    fs::create_directory(out());
    write_text(out() / "thesis.txt", "all of it");
    const Ended taken = run_program(words(write(four_members)), {});
    EXPECT_EQ(taken.status, 2);
    EXPECT_THAT(taken.err, HasSubstr("no study"));
}

// A column that stays empty in all settings is refused before anything runs; one that has values in some of
// them is not.
TEST_F(StudyVerb, MeasuresNoColumnThatStaysEmpty) {
    const std::string lacey = replaced(four_members, "column = \"kinetic\"", "column = \"lacey\"");
    const std::string one = "species=[{name=\"all\", count=20, diameter=\"4 mm\", density=2500}]";
    const auto said = [&](const std::string& text) {
        return run_program(words(write(text), {"--dry-run"}), {});
    };
    EXPECT_EQ(said(lacey).status, 0);
    const Ended empty = said(replaced(lacey, "set = [", "set = ['" + one + "', "));
    EXPECT_EQ(empty.status, 2);
    EXPECT_THAT(empty.err, tells({"study.toml:9:1", "'lacey'", "two species", "another column"}));
    // 2 of 42 grains of which a sample has 21.
    const Ended rare = said(replaced(lacey, "set = [", "set = ['species.big.count=2', "));
    EXPECT_EQ(rare.status, 2);
    EXPECT_THAT(rare.err, tells({"study.toml:9:1", "'lacey'", "2 of 42", "height_difference"}));
    const std::string variants = "[[variant]]\nname = \"one\"\nset = ['" + one +
                                 "']\n[[variant]]\nname = \"two\"\nset = []\n[[measure]]";
    EXPECT_EQ(said(replaced(lacey, "[[measure]]", variants)).status, 0);
}

TEST_F(StudyVerb, AStudyIsNoSceneAndASceneNoStudy) {
    const Program::Setting here{folder_.path(), {}};
    write(four_members);
    for (const std::string verb : {"movie", "check"})
        EXPECT_THAT(run_program({verb, "study.toml", "--set", "drive.g_level=2"}, here).err,
                    tells_only({"error: study.toml", "a study", "grainreel study study.toml"}));
    EXPECT_THAT(run_program({"study", "fifty.toml"}, here).err,
                tells_only({"error: fifty.toml", "a scene", "grainreel movie fifty.toml"}));
    // A script that calls the program says how its user calls it.
    const Program::Setting by_script{folder_.path(), {"GRAINREEL_CALLED=./movie"}};
    EXPECT_THAT(run_program({"study", "fifty.toml"}, by_script).err,
                tells_only({"error: fifty.toml", "a scene", "./movie movie fifty.toml"}));
}

// One drive runs after the other. With rain, and with stiffness and step given, the second begins with the
// packing of the first; otherwise the study says why not.
TEST_F(StudyVerb, SharesPackings) {
    std::string text = replaced(four_members, "seeds = 2\n", "");
    const Program::Setting setting{
        ".", {"XDG_CACHE_HOME=" + (folder_ / "cache").string(), "GRAINREEL_PACKINGS=all"}};
    const auto dry = [&](const std::string& sets) {
        const std::string study =
            write(replaced(text, "\"run.duration=0.1 s\"", "\"run.duration=0.1 s\", " + sets));
        return run_program(words(study, {"--dry-run"}), setting).out;
    };
    EXPECT_THAT(dry("\"title=same\""), tells({"packings", "drive", "share no packing", "radii grow"}));
    const std::string shared = "\"start.method=rain\", \"contact.stiffness=700 N/m\", \"run.step=10 us\"";
    EXPECT_THAT(dry(shared), tells({"2 settings", "same packing"}));
    const Ended ended = run_program(
        words(write(replaced(text, "\"run.duration=0.1 s\"", "\"run.duration=0.1 s\", " + shared)),
              {"--jobs", "1"}),
        setting);
    EXPECT_EQ(ended.status, 0) << ended.err;
    EXPECT_THAT(ended.err, tells({"packings", "2 settings", "same packing"}));
    int found = 0;
    for (const fs::path& member : members())
        found += text_of(member / "log.txt").find("took the packing of an earlier run") != std::string::npos;
    EXPECT_EQ(found, 1);
}

}  // namespace
}  // namespace grainreel
