// Tests of questions to files of other programs, pages about them, comparisons of files, and the cache into
// which files are imported.
#include <gmock/gmock.h>

#include <nlohmann/json.hpp>

#include "tests/cli/foreign/foreign_bed.hpp"
#include "tests/support/tells.hpp"

namespace grainreel {
namespace {

namespace fs = std::filesystem;
using namespace test;
using testing::HasSubstr;
using testing::Not;

class ForeignAnswers : public ForeignBed {
  protected:
    nlohmann::json answer(std::vector<std::string> words) {
        words.emplace_back("--json");
        const Ended ended = timed(std::move(words));
        EXPECT_EQ(ended.status, 0) << ended.err;
        return nlohmann::json::parse(ended.out, nullptr, false);
    }
    // Number of entries in the folder, without the test's own files and the cache.
    std::ptrdiff_t entries() const {
        std::ptrdiff_t count = 0;
        for (const auto& one : fs::directory_iterator(here.path())) count += one.path().filename() != "cache";
        return count;
    }
    void expect_refused(const std::vector<std::string>& words, const std::string& why) {
        const std::ptrdiff_t before = entries();
        const Ended ended = program(words);
        EXPECT_EQ(ended.status, 2) << ended.err;
        EXPECT_THAT(ended.err, HasSubstr(why));
        EXPECT_EQ(entries(), before);
        EXPECT_THAT(imports(), testing::IsEmpty());
    }
};

TEST_F(ForeignAnswers, AreOfTheFrameThatIsAskedFor) {
    const nlohmann::json said =
        answer({"inspect", "bed.dump", "--frame", "2", "--where", "radius > 3.5 mm", "--limit", "40"});
    EXPECT_EQ(said["moment"]["step"], 2000);
    EXPECT_DOUBLE_EQ(said["moment"]["time"].get<double>(), 2000 * kForeignStep);
    const nlohmann::json& grains = said["tables"]["grains"];
    ASSERT_EQ(grains["rows"].size(), kForeignGrains / 2);
    EXPECT_EQ(grains["rows"][0][0], 2);  // the first even id
    EXPECT_EQ(grains["rows"][0][1], "type 1");
    EXPECT_NEAR(grains["rows"][0][4].get<double>(), 0.015 + 0.002, 1e-12);  // z of the upper layer
}

// A grain whose velocity is no number is in no count, whatever is asked, unless the rest of the condition
// decides.
TEST_F(ForeignAnswers, CountNoGrainWhoseValueIsUnknown) {
    write_text(here / "a.csv",
               "time,id,x,y,z,radius,mass,vx,vy,vz\n0,1,0,0,0,0.1,2,0,0,1\n0,2,1,0,0,0.1,2,0,0,nan\n"
               "0,3,2,0,0,0.1,8,0,0,3\n");
    const auto count = [&](const char* condition) {
        return answer({"inspect", "a.csv", "--where", condition})["tables"]["count"]["rows"][0][1].get<int>();
    };
    EXPECT_EQ(count("speed < 2 m/s"), 1);
    EXPECT_EQ(count("not (speed < 2 m/s)"), 1);
    EXPECT_EQ(count("speed != 1 m/s"), 1);
    EXPECT_EQ(count("max(speed, 5 m/s) > 4 m/s"), 2);
    EXPECT_EQ(count("speed < 2 m/s or id == 2"), 2);
    EXPECT_EQ(count("not (speed < 2 m/s and id == 3)"), 3);
    const nlohmann::json all = answer({"inspect", "a.csv"});
    const nlohmann::json& species = all["tables"]["species"]["rows"][0];
    EXPECT_DOUBLE_EQ(species[2].get<double>(), 12);  // mass of each grain
    EXPECT_DOUBLE_EQ(species[7].get<double>(), 2);   // mean speed of the two that are known
    EXPECT_TRUE(species[8].is_null());               // kinetic energy of all
    EXPECT_THAT(all["notes"].dump(), tells({"velocity", "not known", "1 grain"}));
}

// A dump has only places. Columns that need velocities or spins are left out of tables, and refused if a
// question asks for them.
TEST_F(ForeignAnswers, SayNothingOfVelocitiesThatAFileDoesNotHave) {
    std::string text = foreign_frame(0);
    const auto replace_all = [&](const std::string& from, const std::string& to) {
        for (std::size_t at = text.find(from); at != std::string::npos; at = text.find(from, at + to.size()))
            text.replace(at, from.size(), to);
    };
    replace_all(" vx vy vz", "");
    replace_all(" 0 0 0.1\n", "\n");
    std::ofstream(here / "places.dump") << text;

    const nlohmann::json said = answer({"inspect", "places.dump"});
    const nlohmann::json& species = said["tables"]["species"];
    const auto column = [&](const char* name) {
        for (std::size_t k = 0; k < species["columns"].size(); ++k)
            if (species["columns"][k]["name"] == name) return k;
        return species["columns"].size();
    };
    ASSERT_LT(column("mean_speed"), species["columns"].size());
    for (const nlohmann::json& row : species["rows"]) {
        EXPECT_TRUE(row[column("mean_speed")].is_null()) << row;
        EXPECT_FALSE(row[column("mean_height")].is_null()) << row;
    }
    for (const nlohmann::json& row : said["tables"]["extremes"]["rows"])
        EXPECT_THAT(row[0].get<std::string>(), Not(HasSubstr("fastest")));
    expect_refused({"inspect", "places.dump", "--where", "speed > 1 m/s"}, "'speed' needs velocities");
    expect_refused({"inspect", "places.dump", "--histogram", "spin"}, "'spin' needs spins");
}

TEST_F(ForeignAnswers, AColourThatFilesDoNotSayIsRefused) {
    const Ended ended = program({"render", "bed.dump", "--frame", "1", "--set", "film.colour.by=spin",
                                 "--set", "film.colour.range=[0, 1]", "--out", "spin.png"});
    EXPECT_EQ(ended.status, 2) << ended.err;
    EXPECT_THAT(ended.err, tells({"--set film.colour.by", "say nothing", "\"spin\""}));
    EXPECT_FALSE(fs::exists(here / "spin.png"));
}

TEST_F(ForeignAnswers, KnowTheContactsOfAContactDump) {
    const nlohmann::json said =
        answer({"inspect", "bed.dump", "--frame", "1", "--grain", "39", "--contacts", "contacts.dump"});
    const nlohmann::json& rows = said["tables"]["contacts"]["rows"];
    ASSERT_EQ(rows.size(), 2u);
    double sum = 0;
    for (const nlohmann::json& row : rows) sum += row[2].get<double>();
    EXPECT_DOUBLE_EQ(sum, 0.75);  // N
}

TEST_F(ForeignAnswers, APageLiesBesideTheFile) {
    fs::create_directory(here / "post");
    fs::rename(here / "bed.dump", here / "post/bed.dump");
    const Ended ended = timed({"report", "post/bed.dump"});
    ASSERT_EQ(ended.status, 0) << ended.err;
    EXPECT_EQ(ended.out, "post/bed.dump-report.html\n");
    EXPECT_THAT(text_of(here / "post/bed.dump-report.html"), HasSubstr("<html"));
    EXPECT_EQ(std::distance(fs::directory_iterator(here / "post"), {}), 2);
}

TEST_F(ForeignAnswers, TwoFilesAreFilmedSideBySide) {
    write_old_text(here / "other.dump", foreign_dump());
    const Ended ended =
        timed({"compare", "bed.dump", "other.dump", "--at", "0.01", "--size", "640x360", "--out", "both"});
    EXPECT_EQ(ended.status, 0) << ended.err;
    EXPECT_EQ(imports().size(), 2u);
}

TEST_F(ForeignAnswers, WithoutARadiusNothingIsDrawn) {
    write_old_text(here / "points.dump", foreign_dump(2, false));
    for (const char* verb : {"render", "inspect", "report"})
        expect_refused({verb, "points.dump"}, "says no radius of its grains; give one by --radius 2mm");
    expect_refused({"export", "points.dump", "--to", "csv"}, "--radius");
    const nlohmann::json said =
        answer({"inspect", "points.dump", "--radius", "1=4mm,2=3mm", "--where", "radius > 3.5 mm"});
    EXPECT_EQ(said["tables"]["count"]["rows"][2][1], kForeignGrains / 2);
}

TEST_F(ForeignAnswers, MistakesAreRefused) {
    expect_refused({"render", "nothing_*.dump"}, "nothing_*.dump");
    expect_refused({"inspect", "nothing_*.dump"}, "nothing_*.dump");
    expect_refused({"report", "not_there.dump"}, "not_there.dump");
    expect_refused({"render", "bed.dump", "--radius", "minus"}, "--radius");
    expect_refused({"render", "bed.dump", "--units", "feet"}, "there are no such units");
    expect_refused({"render", "bed.dump", "--columns", "colour=type"}, "there is no such meaning");
    expect_refused({"render", "bed.dump", "--columns", "radius=c_rad"}, "c_rad");
    expect_refused({"render", "bed.dump", "--contacts", "no_*.dump"}, "no_*.dump");
    expect_refused({"render", "bed.dump", "--container", "no.toml"}, "no.toml");
    expect_refused({"render", "bed.dump", "--walls", "no.stl"}, "no.stl");
}

// Grains as large as boulders are likely to be in mm; whoever says the units is not asked.
TEST_F(ForeignAnswers, GrainsOfMetresAskForTheirUnits) {
    write_text(here / "large.csv", "id,x,y,z,radius\n1,0,0,0,2\n2,0,5,0,2\n");
    const auto told = [&](std::vector<std::string> words) {
        const Ended ended = timed(std::move(words));
        EXPECT_EQ(ended.status, 0) << ended.err;
        return ended.err;
    };
    EXPECT_THAT(told({"report", "large.csv"}), tells({"large.csv", "4 m large", "--units mm"}));
    EXPECT_THAT(told({"report", "large.csv", "--units", "si"}), Not(HasSubstr("--units")));
    EXPECT_THAT(told({"report", "large.csv", "--units", "mm"}), Not(HasSubstr("--units")));
}

// The log of a film says what was told while its files were read, and calls them as the user does.
TEST_F(ForeignAnswers, TheLogOfAFilmSaysWhatWasGuessed) {
    EXPECT_EQ(timed({"render", "bed.dump", "--size", "160x120", "--out", "film"}).status, 0);
    const std::string log = text_of(here / "film/log.txt");
    EXPECT_THAT(log, tells({"bed.dump", "says no density"}));
    EXPECT_THAT(log, tells({"took", "frames of bed.dump"}));
    EXPECT_THAT(log, Not(HasSubstr("imports/")));
}

// Without a density there are no masses. A condition that no grain meets for want of them would look like a
// result.
TEST_F(ForeignAnswers, QuestionsAboutMassesNeedADensity) {
    const auto weighed = [](std::vector<std::string> words) {
        words.insert(words.end(), {"--density", "2500"});
        return words;
    };
    for (const std::vector<std::string>& words : std::vector<std::vector<std::string>>{
             {"inspect", "bed.dump", "--where", "kinetic_energy > 1 nJ"},
             {"inspect", "bed.dump", "--where", "mass > 1 mg"},
             {"inspect", "bed.dump", "--histogram", "potential_energy"},
             {"inspect", "bed.dump", "--where", "radius > 0", "--over-time", "--mean", "kinetic_energy"}}) {
        const Ended refused = timed(words);
        EXPECT_EQ(refused.status, 2) << words.back();
        EXPECT_THAT(refused.err, tells({"needs masses", "--density"}));
        const Ended told = timed(weighed(words));
        EXPECT_EQ(told.status, 0) << told.err;
    }
    EXPECT_EQ(timed({"inspect", "bed.dump"}).status, 0);
    expect_refused({"inspect", "bed.dump", "--measure", "kinetic_J"}, "--over-time");
    const Ended drawn =
        timed({"render", "bed.dump", "--set", "film.plot=[{y=\"kinetic_J\"}]", "--out", "film"});
    EXPECT_EQ(drawn.status, 2);
    EXPECT_THAT(drawn.err, tells({"kinetic_J", "needs masses", "--density"}));
}

// The runs of a folder are named; the folder of a film, which holds tables too, is no folder of another
// program.
TEST_F(ForeignAnswers, AFolderOfRunsNamesThem) {
    fs::create_directories(here / "output/a film");
    write_text(here / "output/a film/run.json", "{}");
    write_text(here / "output/a film/film_times.csv", "time_s,frame\n0,0\n");
    fs::create_directories(here / "output/run");
    write_text(here / "output/run/scene.toml", "title = \"x\"\n");
    expect_refused({"render", "output"}, "name one of the runs in it: output/run");
}

TEST_F(ForeignAnswers, OptionsOfReadingAreNotForRunsOfOurs) {
    ASSERT_EQ(imported().status, 0);
    fs::rename(import(), here / "ours");
    for (const char* verb : {"render", "inspect", "report"}) {
        const Ended ended = program({verb, "ours", "--radius", "2mm"});
        EXPECT_EQ(ended.status, 2) << verb;
        EXPECT_THAT(ended.err, tells({"--radius", "other programs"}));
    }
}

TEST_F(ForeignAnswers, ASecondCallUsesWhatTheFirstRead) {
    ASSERT_EQ(timed({"report", "bed.dump"}).status, 0);
    ASSERT_EQ(imports().size(), 1u);
    const fs::path measures = import() / "measures.csv";
    const auto written = fs::last_write_time(measures);
    const Ended again = timed({"report", "bed.dump"});
    EXPECT_EQ(again.status, 0);
    EXPECT_THAT(again.err, HasSubstr("says no density"));  // also if the file was imported before
    EXPECT_EQ(imports().size(), 1u);
    EXPECT_EQ(fs::last_write_time(measures), written);
}

TEST_F(ForeignAnswers, AChangedFileIsReadAnew) {
    const std::vector<std::string> words = {"report", "bed.dump"};
    ASSERT_EQ(timed(words).status, 0);
    write_text(here / "bed.dump", foreign_dump(2));
    ASSERT_EQ(timed(words).status, 0);
    EXPECT_EQ(imports().size(), 2u);
    const nlohmann::json said = answer({"inspect", "bed.dump", "--where", "radius > 1 mm"});
    EXPECT_EQ(said["moment"]["step"], 1000);  // the last of two
}

TEST_F(ForeignAnswers, ACacheThatCannotBeWrittenIsDoneWithout) {
    write_text(here / "cache", "a file where the folder would be");
    const Ended ended =
        timed({"render", "bed.dump", "--at", "0.01", "--size", "160x120", "--out", "one.png"});
    EXPECT_EQ(ended.status, 0) << ended.err;
    EXPECT_TRUE(fs::exists(here / "one.png"));
}

}  // namespace
}  // namespace grainreel
