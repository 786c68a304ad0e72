// Tests of the reader of study.toml.
#include "render/app/study/file/read_study.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>

#include "engine/base/error.hpp"
#include "render/app/study/file/members.hpp"
#include "render/scene/filmed_scene.hpp"
#include "tests/study/study_text.hpp"

namespace grainreel {
namespace {

using namespace test;
using testing::HasSubstr;

TEST(StudyReader, TakesWhatIsThere) {
    const StudyFolderOfTest folder;
    const Study study = folder.read(small_study);
    EXPECT_EQ(study.title, "study");
    EXPECT_EQ(study.scene, folder / "fifty.toml");
    EXPECT_THAT(study.seeds, testing::ElementsAre(1u, 2u));
    ASSERT_EQ(study.variations.size(), 2u);
    EXPECT_EQ(study.variations[1].values[1].words, "5.5 mm");
    ASSERT_EQ(study.measures.size(), 2u);
    EXPECT_EQ(study.measures[0].name, "kinetic_mean");
    EXPECT_EQ(study.measures[0].column, "kinetic_J");
    ASSERT_EQ(study.charts.size(), 1u);
    EXPECT_EQ(study.charts[0].y, 1u);
    EXPECT_EQ(study.charts[0].x, 0u);
}

TEST(StudyReader, ChartsEachMeasureWhenNoneIsAskedFor) {
    const StudyFolderOfTest folder;
    const Study study = folder.read(with_line(small_study, "[[chart]]\ny = \"rise\"\n", ""));
    ASSERT_EQ(study.charts.size(), 2u);
    EXPECT_EQ(study.charts[1].name, "rise");
}

struct Mistake {
    std::string line, other;
    std::string place;  // line and column in study.toml
    std::string words;
};

TEST(StudyReader, MistakesHaveTheirPlace) {
    const Mistake mistakes[] = {
        {"seeds = 2", "seed = 2", ":2:1", "unknown key 'seed' at the top level; did you mean 'seeds'?"},
        {"seeds = 2", "seeds = []", ":2:1", "empty list"},
        {"seeds = 2", "seeds = [1, 1]", ":2:1", "a seed twice"},
        {"seeds = 2", "seeds = 0", ":2:1", "'seeds' must be a whole number"},
        {"seeds = 2", "set = [\"run.duratoin=1\"]", ":2:8", "did you mean 'duration'?"},
        {"drive.g_level", "drive.glevel", ":4:1", "unknown key 'glevel'"},
        {"drive.g_level", "species.huge.count", ":4:1", "there is no 'huge'"},
        {"drive.g_level", "drive", ":4:1", "'drive'"},
        {"drive.g_level", "run.seed", ":4:1", "seeds = 3"},
        {"drive.g_level", "run.threads", ":4:1", "same bits"},
        {"drive.g_level", "species.big.diameter", ":7:1", "a second time"},
        {"values = [2, 3]", "values = []", ":5:1", "the grid would be empty"},
        {"values = [2, 3]", "values = 2", ":5:1", "must be a list"},
        {"values = [2, 3]", "values = [2, \"fast\"]", ":5:14", "'g_level' must be a plain number"},
        {"values = [2, 3]", "values = [2, -1]", ":5:14", "'g_level' must be"},
        {"values = [2, 3]", "values = [2, 2.0]", ":5:14", "are the same run"},
        {"values = [2, 3]", "", ":3:1", "lacks 'values'"},
        {"count = 3", "", ":8:1", "'count' or 'by'"},
        {"count = 3", "by = 0", ":8:1", "two units"},
        {"count = 3", "count = 1", ":10:1", "'count' must be"},
        {"column = \"kinetic\"", "column = \"cinetic\"", ":12:1", "must be a column of measures.csv"},
        {"reduce = \"mean\"", "reduce = \"median\"", ":13:1", "'reduce' must be"},
        {"reduce = \"mean\"", "reduce = \"first-passage\"", ":11:1", "lacks 'threshold'"},
        {"reduce = \"mean\"", "reduce = \"mean\"\nthreshold = 1", ":14:1", "is of no use here"},
        {"reduce = \"mean\"", "reduce = \"crossing\"\nthreshold = \"1 mm\"", ":14:1", "must be an energy"},
        {"reduce = \"mean\"", "reduce = \"mean\"\nfrom = \"1 s\"", ":14:1", "the run ends at 0.2 s"},
        {"reduce = \"mean\"", "reduce = \"mean\"\nfrom = 0.1\nto = 0.05", ":15:1", "later than 'from'"},
        {"name = \"rise\"", "name = \"kinetic_mean\"", ":15:1", "a second measure"},
        {"y = \"rise\"", "y = \"fall\"", ":19:1", "the name of a [[measure]]"},
        {"y = \"rise\"", "y = \"rise\"\nx = \"run.duration\"", ":20:1", "a key that is varied"},
        {"y = \"rise\"", "y = \"rise\"\nreference = \"none.csv\"", ":20:1", "no such file"},
    };
    const StudyFolderOfTest folder;
    for (const Mistake& mistake : mistakes) {
        const std::string text = with_line(small_study, mistake.line, mistake.other);
        ASSERT_FALSE(text.empty()) << mistake.line;
        try {
            make_members(folder.read(text), [](const FilmedScene&, const Plan&) {});
            ADD_FAILURE() << "accepted: " << mistake.other;
        } catch (const UserError& error) {
            EXPECT_THAT(error.what(), HasSubstr((folder / "study.toml").string() + mistake.place + ": "))
                << mistake.other;
            EXPECT_THAT(error.what(), HasSubstr(mistake.words)) << mistake.other;
        }
    }
}

TEST(StudyReader, AStudyVariesSomething) {
    const StudyFolderOfTest folder;
    EXPECT_THROW(folder.read("scene = \"fifty.toml\"\n"), UserError);
    EXPECT_EQ(folder.read("scene = \"fifty.toml\"\nseeds = 2\n").seeds.size(), 2u);
    EXPECT_THROW(folder.read("scene = \"none.toml\"\nseeds = 2\n"), UserError);
}

TEST(StudyKeys, DocsTellWhatTheReaderKnows) {
    const std::string page = GRAINREEL_SOURCE "/docs/reference/studies.md";
    const std::string begin_mark =
        "<!-- table of keys: generated from render/app/study/file/study_keys.cpp, begin -->\n";
    const std::string end_mark = "<!-- table of keys: end -->\n";
    std::string text = text_of(page);
    const auto begin = text.find(begin_mark), end = text.find(end_mark);
    ASSERT_NE(begin, std::string::npos);
    ASSERT_NE(end, std::string::npos);
    const auto start = begin + begin_mark.size();
    const std::string table = key_table_markdown(study_keys());
    if (std::getenv("GRAINREEL_WRITE_DOCS") != nullptr) {
        write_text(page, text.replace(start, end - start, table));
        return;
    }
    EXPECT_EQ(text.substr(start, end - start), table)
        << "docs/reference/studies.md is not what render/app/study/file/study_keys.cpp says; write it anew "
           "with\n"
           "  GRAINREEL_WRITE_DOCS=1 test_study --gtest_filter=StudyKeys.DocsTellWhatTheReaderKnows";
}

TEST(StudyKeys, EveryShippedStudyCanBeRead) {
    for (const auto& entry :
         std::filesystem::recursive_directory_iterator(GRAINREEL_SOURCE "/scenes/studies")) {
        if (entry.path().extension() != ".toml") continue;
        EXPECT_NO_THROW(make_members(read_study(entry.path()), [](const FilmedScene&, const Plan&) {}))
            << entry.path();
    }
}

}  // namespace
}  // namespace grainreel
