// Tests of `grainreel report` as a user sees it: a finished run as a page. What the page does in a browser is
// tested in tests/browser.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <csignal>

#include "engine/files/contacts_file.hpp"
#include "engine/files/trajectory/trajectory.hpp"
#include "tests/cli/mesh_scene.hpp"
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

class ReportProgram : public testing::Test {
  protected:
    Ended program(const std::vector<std::string>& words) { return run_program(words, {here.path(), {}}); }
    void run(const std::vector<std::string>& more) {
        write_small_scene(here.path());
        std::vector<std::string> words = {"movie", "fifty.toml", "--out", "run"};
        words.insert(words.end(), more.begin(), more.end());
        const Ended ended = program(words);
        ASSERT_EQ(ended.status, 0) << ended.err;
    }

    TemporaryFolder here;
};

TEST_F(ReportProgram, MakesOnePageWithWordsFirstAndBytesLast) {
    run({"--set", "title=<i>No</i> markup"});
    const Ended ended = program({"report", "run"});
    ASSERT_EQ(ended.status, 0) << ended.err;
    EXPECT_EQ(ended.out, "run/report.html\n");
    const std::string page = text_of(here / "run/report.html");
    EXPECT_THAT(page, HasSubstr("<h1>&lt;i&gt;No&lt;/i&gt; markup</h1>"));
    EXPECT_THAT(page, Not(HasSubstr("<i>No")));
    const auto at = [&](const char* what) { return page.find(what); };
    EXPECT_LT(at("<h1>"), at("data:image/jpeg"));
    EXPECT_LT(at("data:image/jpeg"), at("id=\"facts\""));
    EXPECT_LT(at("id=\"facts\""), 500'000u);
    EXPECT_LT(at("id=\"facts\""), at("id=\"bed-bytes\""));
    EXPECT_LT(at("id=\"bed-bytes\""), at("id=\"film-bytes\""));
    EXPECT_NE(at("id=\"film-bytes\""), std::string::npos);
    for (const char* chapter :
         {"What was computed", "Methods", "BibTeX", "Where it comes from", "scene.toml"})
        EXPECT_THAT(page, HasSubstr(chapter));
    // Nothing comes from other places: the sources' links lead to the page's own files.
    for (const char* elsewhere : {"src=\"http", "href=\"http", "@import", "url(http"})
        EXPECT_THAT(page, Not(HasSubstr(elsewhere)));
}

TEST_F(ReportProgram, EachRunLeavesItsPage) {
    run({});
    const std::string first = text_of(here / "run/report.html");
    EXPECT_THAT(first, HasSubstr("id=\"film-bytes\""));
    EXPECT_THAT(first, HasSubstr("id=\"bed-bytes\""));
    EXPECT_THAT(first, Not(HasSubstr("what it kept until then")));  // the run is complete at that time
    const auto record = nlohmann::json::parse(text_of(here / "run/run.json"));
    EXPECT_EQ(record["written"]["page"], "report.html");
    EXPECT_EQ(record["status"], "complete");
    EXPECT_TRUE(record["wall_s"].contains("making the page"));
    // A run with a page can be replaced, and the new run has none if it is told so.
    const Ended again = program({"movie", "fifty.toml", "--out", "run", "--force", "--no-report"});
    ASSERT_EQ(again.status, 0) << again.err;
    EXPECT_FALSE(fs::exists(here / "run/report.html"));
    EXPECT_TRUE(nlohmann::json::parse(text_of(here / "run/run.json"))["written"]["page"].is_null());
}

// Runs beside each other have the script if one of them has meshes.
TEST_F(ReportProgram, OnlyPagesWithMeshesCarryTheirScript) {
    const char* const script = "class Meshes";
    run({"--no-film"});
    EXPECT_THAT(text_of(here / "run/report.html"), Not(HasSubstr(script)));
    write_mesh_scene(here.path());
    const Ended meshes = program({"movie", "plate.toml", "--out", "other", "--no-film"});
    ASSERT_EQ(meshes.status, 0) << meshes.err;
    EXPECT_THAT(text_of(here / "other/report.html"), HasSubstr(script));
    const Ended both = program({"report", "run", "other", "--out", "both.html"});
    ASSERT_EQ(both.status, 0) << both.err;
    EXPECT_THAT(text_of(here / "both.html"), HasSubstr(script));
}

// A film may leave out frames that nobody foresaw; charts and bed still go with it.
TEST_F(ReportProgram, TheFilmIsTiedByTheRunsOwnTable) {
    run({"--set", "film.segment=[{ kind = \"locked\", every = 1 }]"});
    const auto record = nlohmann::json::parse(text_of(here / "run/run.json"));
    const int frames = record["written"]["film_frames"].get<int>();
    std::string table = "frame,step,time_s\n";
    for (int k = 0; k < frames; ++k) table += fmt::format("{0},{0},{1}\n", k, 0.01 * k);
    write_text(here / "run/film_times.csv", table);
    ASSERT_EQ(program({"report", "run"}).status, 0);
    const std::string page = text_of(here / "run/report.html");
    EXPECT_THAT(page, HasSubstr(R"("times":[0.0,0.01,0.02)"));
    EXPECT_THAT(page, Not(HasSubstr("the film goes by itself")));
}

nlohmann::json facts_of(const std::string& page) {
    const std::size_t begin = page.find('>', page.find("id=\"facts\"")) + 1;
    return nlohmann::json::parse(page.substr(begin, page.find("</script>", begin) - begin));
}

// Without the files beside it the bed has only the trajectory's moments, five of them. Damaged files count as
// missing.
TEST_F(ReportProgram, TheBedHasTheMomentOfEachFrameOfTheFilm) {
    run({});
    const auto facts = facts_of(text_of(here / "run/report.html"));
    const auto times = facts["bed"]["times"].get<std::vector<double>>();
    const auto shown = facts["film"]["times"].get<std::vector<double>>();
    ASSERT_EQ(shown.size(), 13u);
    for (const double time : shown) EXPECT_THAT(times, testing::Contains(testing::DoubleNear(time, 1e-12)));
    EXPECT_TRUE(std::is_sorted(times.begin(), times.end()));
    EXPECT_EQ(std::adjacent_find(times.begin(), times.end()), times.end());
    for (const char* file : {"run/film_moments.nc", "run/key_moments.nc"})
        write_text(here / file, text_of(here / file).substr(0, 3000));
    ASSERT_EQ(program({"report", "run"}).status, 0);
    EXPECT_EQ(facts_of(text_of(here / "run/report.html"))["bed"]["times"].size(), 5u);
}

// Kept are the start, the end, 16 moments in the two periods before the end (of four that the run has), and
// 11 in between.
TEST_F(ReportProgram, ForcesOfKeyMomentsAreKept) {
    run({"--set", "film.caption=[{from=\"0.03 s\", to=\"0.06 s\", text=\"See\"}]"});
    const auto bed = facts_of(text_of(here / "run/report.html"))["bed"];
    const auto times = bed["times"].get<std::vector<double>>();
    std::vector<double> keys;
    for (const std::size_t moment : bed["forces"]["moments"]) keys.push_back(times.at(moment));
    EXPECT_EQ(keys.size(), TrajectoryReader(here / "run/key_moments.nc").frames());
    for (const double time : {0.0, 0.03, 0.1, 0.15, 0.2})
        EXPECT_THAT(keys, testing::Contains(testing::DoubleNear(time, 1e-4))) << time;
    const ContactsReader contacts(here / "run/key_contacts.nc");
    for (std::size_t k = 0; k < keys.size(); ++k)
        EXPECT_EQ(bed["forces"]["pairs"][k].get<std::size_t>(), contacts.touches(k).size());
    EXPECT_TRUE(bed["contacts"]);
    // Some rows of the last moment are missing.
    fs::resize_file(here / "run/key_contacts.nc", fs::file_size(here / "run/key_contacts.nc") - 4);
    const Ended cut = program({"report", "run"});
    EXPECT_THAT(cut.err, tells({"key_contacts.nc", "cut off", "last key moments"}));
    EXPECT_EQ(facts_of(text_of(here / "run/report.html"))["bed"]["forces"]["moments"].size(),
              keys.size() - 1);
    // A run without a page keeps no key moments, and its page says nothing about them.
    ASSERT_EQ(program({"movie", "fifty.toml", "--out", "other", "--no-report"}).status, 0);
    EXPECT_FALSE(fs::exists(here / "other/key_moments.nc"));
    ASSERT_EQ(program({"report", "other"}).status, 0);
    EXPECT_TRUE(facts_of(text_of(here / "other/report.html"))["bed"]["forces"].is_null());
}

// The page has charts of both runs, the differences between them, and elements of its own for each.
TEST_F(ReportProgram, SetsRunsSideBySide) {
    run({});
    ASSERT_EQ(
        program({"movie", "fifty.toml", "--out", "wild", "--set", "drive.g_level=3", "--no-film"}).status, 0);
    const Ended ended = program({"report", "run", "wild", "--out", "both.html"});
    ASSERT_EQ(ended.status, 0) << ended.err;
    const std::string page = text_of(here / "both.html");
    const auto facts = facts_of(page);
    ASSERT_EQ(facts["runs"].size(), 2u);
    EXPECT_EQ(facts["runs"][0]["name"], "Γ = 2");  // their titles are the same
    EXPECT_EQ(facts["runs"][1]["name"], "Γ = 3");
    EXPECT_EQ(facts["runs"][1]["folder"], "wild");
    EXPECT_THAT(page, HasSubstr("<h1>Fifty grains: Γ = 2, Γ = 3</h1>"));
    EXPECT_THAT(page, HasSubstr("<p class=\"faint\">Folder wild</p>"));
    EXPECT_THAT(page, Not(HasSubstr("href=\"./")));
    EXPECT_TRUE(facts["runs"][1]["film"].is_null());
    EXPECT_THAT(page, HasSubstr("id=\"film-0\""));
    EXPECT_THAT(page, Not(HasSubstr("id=\"film-1\"")));
    for (const char* id :
         {"bed-bytes-0", "bed-bytes-1", "measures-bytes-0", "measures-bytes-1", "film-bytes-0"})
        EXPECT_THAT(page, HasSubstr(fmt::format("id=\"{}\"", id)));
    EXPECT_THAT(page, HasSubstr("<th scope=\"row\">drive.amplitude</th>"));
    EXPECT_THAT(page, Not(HasSubstr("<th scope=\"row\">drive.frequency</th>")));
    EXPECT_EQ(program({"report", "run", "nowhere"}).status, 2);
}

TEST_F(ReportProgram, TheSamePageOfTheSameRun) {
    run({});
    ASSERT_EQ(program({"report", "run", "--out", "a.html"}).status, 0);
    ASSERT_EQ(program({"report", "run", "--out", "b.html"}).status, 0);
    EXPECT_TRUE(text_of(here / "a.html") == text_of(here / "b.html"));
    EXPECT_EQ(program({"report", "run", "--out", "b.html"}).status, 0) << "a page of ours is made anew";
    write_text(here / "b.html", "<!DOCTYPE html><title>mine</title>");
    const Ended ended = program({"report", "run", "--out", "b.html"});
    EXPECT_EQ(ended.status, 2);
    EXPECT_THAT(ended.err, tells({"--out b.html", "exists already", "no page"}));
    EXPECT_EQ(text_of(here / "b.html"), "<!DOCTYPE html><title>mine</title>");
}

TEST_F(ReportProgram, DoesWithoutFilmAndMeasures) {
    run({"--no-film"});
    fs::remove(here / "run/measures.csv");
    fs::remove(here / "run/run.json");
    const Ended ended = program({"report", "run"});
    ASSERT_EQ(ended.status, 0) << ended.err;
    const std::string page = text_of(here / "run/report.html");
    EXPECT_THAT(page, HasSubstr("no film and no poster"));
    EXPECT_THAT(page, HasSubstr("no charts: measures.csv: is missing"));
    EXPECT_THAT(page, HasSubstr("status is “unknown”"));
    EXPECT_THAT(ended.err, tells({"warning: run/measures.csv", "missing", "no charts"}));
    EXPECT_THAT(ended.err, HasSubstr("warning: run/run.json: is missing; "));
}

// Each file that is missing or damaged gets a line, and the page is made nevertheless. A file that
// contradicts the others is refused.
TEST_F(ReportProgram, SaysWhichFilesLackOrAreDamaged) {
    run({"--set", "output.contacts=true"});
    EXPECT_THAT(program({"report", "run"}).err, Not(HasSubstr("warning")));
    const auto damaged = [&](const char* file, const std::string& text) {
        fs::remove_all(here / "copy");
        fs::copy(here / "run", here / "copy", fs::copy_options::recursive);
        write_text(here / "copy" / file, text);
        const Ended ended = program({"report", "copy"});
        EXPECT_EQ(ended.status, 0) << ended.err;
        return ended.err;
    };
    const std::string rows = text_of(here / "run/measures.csv");
    const std::size_t second = rows.find('\n', rows.find('\n') + 1) + 1;
    EXPECT_THAT(damaged("measures.csv", rows.substr(0, second) + "x\n" + rows.substr(second)),
                tells({"warning: copy/measures.csv:3", "1 number"}));
    EXPECT_THAT(damaged("measures.csv", rows.substr(0, second)),
                testing::ContainsRegex("warning: copy/measures.csv: has 1 of the [0-9]+ rows"));
    EXPECT_THAT(damaged("measures.csv", "step,cycles\n1,2\n"),
                HasSubstr("copy/measures.csv:1: lacks the column time_s"));
    EXPECT_THAT(damaged("measures.csv", ""), tells({"copy/measures.csv", "empty", "no charts"}));
    EXPECT_THAT(damaged("run.json", "{"), tells({"copy/run.json", "damaged", "no JSON"}));
    EXPECT_THAT(damaged("run.json", "[]"), tells({"copy/run.json", "no record"}));
    EXPECT_THAT(damaged("key_moments.nc", "x"), HasSubstr("copy/key_moments.nc: cannot be read"));
    EXPECT_THAT(damaged("poster.png", "x"), HasSubstr("copy/poster.png: cannot be read"));
    EXPECT_THAT(damaged("film_times.csv", "x"), tells({"copy/film_times.csv", "not of this film"}));
    fs::remove(here / "copy/contacts.nc");
    EXPECT_THAT(program({"report", "copy"}).err, HasSubstr("copy/contacts.nc: is missing"));
    const std::size_t third = rows.find('\n', second) + 1, comma = rows.find(',', third);
    write_text(here / "copy/measures.csv",
               rows.substr(0, third) + "1" + rows.substr(third, comma - third) + rows.substr(comma));
    const Ended altered = program({"report", "copy"});
    EXPECT_EQ(altered.status, 2);
    EXPECT_THAT(altered.err, HasSubstr("copy/measures.csv:4: has "));
}

// If the page lies in another folder, its links would lead nowhere.
TEST_F(ReportProgram, LinksFilesOnlyWhereTheyAre) {
    run({});
    ASSERT_EQ(program({"report", "run"}).status, 0);
    const std::string beside = text_of(here / "run/report.html");
    EXPECT_THAT(beside, HasSubstr("href=\"./movie.mp4\""));
    EXPECT_THAT(beside, HasSubstr("lies in the run's folder, run."));
    ASSERT_EQ(program({"report", "run", "--out", "away.html"}).status, 0);
    EXPECT_THAT(text_of(here / "away.html"), Not(HasSubstr("href=\"./")));
    EXPECT_THAT(text_of(here / "away.html"), Not(HasSubstr("beside this page")));
    // Browsers do not play FFV1; the page says which file it is.
    run({"--force", "--set", "film.format=ffv1"});
    ASSERT_EQ(program({"report", "run", "--out", "away.html"}).status, 0);
    EXPECT_THAT(text_of(here / "away.html"),
                testing::ContainsRegex("the film itself is movie\\.[a-z0-9]+ in the run"));
}

// The page's bed has the colours of the film's grains: title, range and bands.
TEST_F(ReportProgram, TheBedHasTheFilmsColours) {
    run({"--set", "film.colour={by=\"start-height\",layers=3,range=[0,0.02],unit=\"mm\"}"});
    ASSERT_EQ(program({"report", "run"}).status, 0);
    const auto film = facts_of(text_of(here / "run/report.html"))["bed"]["film"];
    EXPECT_EQ(film["title"], "height at the start (mm)");
    EXPECT_EQ(film["high"], 20);
    EXPECT_EQ(film["bands"], 3);
    EXPECT_EQ(film["colours"].size(), 3u);
    const std::vector<std::pair<const char*, const char*>> others{{"speed", "speed ("},
                                                                  {"spin", "spin ("},
                                                                  {"rise", "rise in a period ("},
                                                                  {"coordination", "contacts of a grain"}};
    for (const auto& [by, title] : others) {
        run({"--force", "--duration", "0.1s", "--set", "output.contacts=true", "--set",
             fmt::format("film.colour={{by=\"{}\"}}", by)});
        const auto bed = facts_of(text_of(here / "run/report.html"))["bed"];
        EXPECT_THAT(bed["film"]["title"].get<std::string>(), testing::StartsWith(title));
        EXPECT_GT(bed["film"]["known"], 0) << by;
    }
    run({"--force", "--duration", "0.1s"});
    EXPECT_TRUE(facts_of(text_of(here / "run/report.html"))["bed"]["film"].is_null());
}

TEST_F(ReportProgram, ARunWithoutMomentsHasAPageWithoutABed) {
    run({"--set", "output.trajectory=false"});
    const std::string page = text_of(here / "run/report.html");
    EXPECT_THAT(page, HasSubstr("kept no moment"));
    EXPECT_THAT(page, Not(HasSubstr("id=\"bed-bytes\"")));
    EXPECT_THAT(page, HasSubstr("id=\"film-bytes\""));
    EXPECT_TRUE(facts_of(page)["bed"].is_null());
    EXPECT_EQ(facts_of(page)["end"], 0.2);
}

// The step is far too large, so the grains fly apart.
TEST_F(ReportProgram, AFailedRunHasAPageThatSaysSo) {
    write_small_scene(here.path());
    std::string text = text_of(here / "fifty.toml");
    text.replace(text.find("overlap = 0.05"), 14, "step = \"1.2e-3 s\"");
    write_text(here / "fifty.toml", text);
    const Ended ended = program({"movie", "fifty.toml", "--out", "run"});
    ASSERT_EQ(ended.status, 1) << ended.err;
    const std::string page = text_of(here / "run/report.html");
    EXPECT_THAT(page, HasSubstr("The run failed at "));
    EXPECT_THAT(page, HasSubstr("take a smaller run.step"));
    EXPECT_THAT(page, HasSubstr("kept until then"));
}

TEST_F(ReportProgram, APageSaysHowFarTheRunCame) {
    write_small_scene(here.path());
    for (const int signal : {SIGINT, SIGKILL}) {
        Program run({"movie", "fifty.toml", "--out", "run", "--duration", "600 s", "--no-film", "--force"},
                    {here.path(), {}});
        ASSERT_TRUE(wait_until(run, [&] {
            std::error_code none;
            return fs::exists(here / "run/key_moments.nc") &&
                   fs::file_size(here / "run/trajectory.nc", none) > 30'000;
        }));
        run.send(signal);
        EXPECT_EQ(run.wait().status, 128 + signal);
        ASSERT_EQ(program({"report", "run"}).status, 0);
        const std::string page = text_of(here / "run/report.html");
        EXPECT_THAT(page,
                    HasSubstr(signal == SIGINT ? "The run was stopped at " : "The run was broken off at "));
        EXPECT_THAT(page, HasSubstr("of 600 s"));
        EXPECT_FALSE(facts_of(page)["bed"].is_null());
    }
}

TEST_F(ReportProgram, MistakesAreOneLineAndWriteNothing) {
    const auto expect_mistake = [&](const std::vector<std::string>& words, const std::string& said) {
        const Ended ended = program(words);
        EXPECT_EQ(ended.status, 2) << ended.err;
        EXPECT_THAT(ended.err, HasSubstr(said));
        EXPECT_EQ(ended.out, "");
    };
    expect_mistake({"report", "nowhere"}, "nowhere: no such folder");
    write_text(here / "a.toml", small_scene_text);
    expect_mistake({"report", "a.toml"},
                   "a.toml: is a file; give the folder of a run, or run the scene: grainreel movie a.toml");
    fs::create_directory(here / "empty");
    expect_mistake({"report", "empty"}, "empty: has no scene.toml");
    run({"--no-film", "--no-report"});
    expect_mistake({"report", "run", "--out", "page.txt"}, "a page's name ends in .html");
    expect_mistake({"report", "run", "--out", "empty"}, "is a folder");
    expect_mistake({"report", "run", "--out", "none/page.html"}, "there is no folder none");
    write_text(here / "run/trajectory.nc", "no trajectory");
    expect_mistake({"report", "run"}, "trajectory.nc");
    EXPECT_FALSE(fs::exists(here / "run/report.html"));
}

}  // namespace
}  // namespace grainreel
