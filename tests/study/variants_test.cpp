// Tests of studies with [[variant]], whose settings are no grid.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <set>

#include "engine/base/error.hpp"
#include "engine/plan/resolved_scene.hpp"
#include "render/app/study/page.hpp"
#include "render/app/study/results/points.hpp"
#include "render/app/study/results/results.hpp"
#include "render/scene/filmed_scene.hpp"
#include "tests/study/study_text.hpp"

namespace grainreel {
namespace {

using namespace test;
using testing::HasSubstr;

const std::string with_variants = R"(scene = "fifty.toml"
seeds = [1]
set = ["run.duration=0.1 s"]
[[variant]]
name = "as it is"
set = []
seeds = 3
[[variant]]
name = "long, soft"
set = ["run.duration=0.3 s", "run.overlap=0.02"]
[[vary]]
key = "drive.g_level"
values = [2, 3]
[[measure]]
name = "late"
column = "kinetic"
reduce = "mean"
from = "0.15 s"
)";

std::vector<Member> members_of(const Study& study) {
    return make_members(study, [](const FilmedScene&, const Plan&) {});
}

TEST(StudyVariants, ComeFirstAndCrossWithWhatIsVaried) {
    const StudyFolderOfTest folder;
    const Study study = folder.read(with_variants);
    const std::vector<Member> members = members_of(study);
    EXPECT_EQ(count_members(study, false), 2u * 3 + 2u * 1);
    ASSERT_EQ(members.size(), 8u);
    EXPECT_EQ(member_text(study, members[0]), "variant = as it is, drive.g_level = 2, seed 1");
    EXPECT_EQ(member_text(study, members[2]), "variant = as it is, drive.g_level = 2, seed 3");
    EXPECT_EQ(member_text(study, members[5]), "variant = as it is, drive.g_level = 3, seed 3");
    EXPECT_EQ(member_text(study, members[6]), "variant = long, soft, drive.g_level = 2, seed 1");
    EXPECT_EQ(member_text(study, members[7]), "variant = long, soft, drive.g_level = 3, seed 1");
    EXPECT_EQ(members[7].setting, 3u);
    EXPECT_THAT(members[7].name, testing::StartsWith("variant-long-soft_g_level-3_seed-1_"));
}

// The variant's values come after those of the study.
TEST(StudyVariants, HaveTheSceneThatSetWouldMake) {
    const StudyFolderOfTest folder;
    const Study study = folder.read(with_variants);
    const FilmedScene scene = read_filmed_scene(study.scene, members_of(study).back().sets);
    const FilmedScene typed = read_filmed_scene(
        study.scene, {"run.duration=0.3 s", "run.overlap=0.02", "drive.g_level=3", "run.seed=1"});
    EXPECT_EQ(resolved_scene(scene, make_plan(scene)), resolved_scene(typed, make_plan(typed)));
}

// If a name changes or a variant is added, runs that exist are still found by the hash at the end of their
// names.
TEST(StudyVariants, KeepTheirHash) {
    const StudyFolderOfTest folder;
    const auto hash = [&](const std::string& text) {
        const std::string name = members_of(folder.read(text)).back().stem;
        return name.substr(name.rfind('_'));
    };
    const std::string first = hash(with_variants);
    EXPECT_EQ(hash(with_line(with_variants, "long, soft", "soft")), first);
    EXPECT_EQ(hash(with_line(with_variants, "[2, 3]", "[3]")), first);
    EXPECT_NE(hash(with_line(with_variants, "overlap=0.02", "overlap=0.03")), first);
}

TEST(StudyVariants, WithoutSeedsHaveThoseOfTheScene) {
    const StudyFolderOfTest folder;
    const Study study = folder.read(with_line(with_variants, "seeds = [1]\n", ""));
    const std::vector<Member> members = members_of(study);
    EXPECT_EQ(members[5].seed, 3u);
    EXPECT_EQ(members[6].seed, std::nullopt);
    std::vector<MemberResult> results(members.size());
    EXPECT_THAT(study_table(study, members, results), HasSubstr("\n\"long, soft\",2,,missing,"));
}

TEST(StudyVariants, AreAColumnALineOfAChartAndARowOfThePage) {
    const StudyFolderOfTest folder;
    const Study study = folder.read(with_variants);
    const std::vector<Member> members = members_of(study);
    std::vector<MemberResult> results;
    for (std::size_t m = 0; m < members.size(); ++m) {
        MemberResult result;
        result.status = MemberResult::Status::complete;
        result.values = {static_cast<double>(m)};
        results.push_back(result);
    }
    const std::string table = study_table(study, members, results);
    EXPECT_THAT(table,
                testing::StartsWith("variant,drive.g_level,run.seed,state,late,warnings,error,folder\nas it "
                                    "is,2,1,complete,0,"));
    EXPECT_THAT(table, HasSubstr("\n\"long, soft\",3,1,complete,7,"));
    const std::vector<ChartSeries> series = chart_series(study, members, results, study.charts[0]);
    ASSERT_EQ(series.size(), 2u);
    EXPECT_EQ(series[0].name, "variant = as it is");
    EXPECT_EQ(series[0].points[1].y.value, (3 + 4 + 5) / 3.0);
    EXPECT_EQ(series[1].points[1].y.value, 7);
    const std::string page = study_page(study, members, results, {folder.path()}, {});
    EXPECT_THAT(page, HasSubstr("<td>as it is</td><td>2</td>"));
    EXPECT_THAT(page, HasSubstr("3 of 3</td>"));
    EXPECT_THAT(page, HasSubstr("1 of 1</td>"));
}

TEST(StudyVariants, AreTheAxisWhereNothingElseIsVaried) {
    const StudyFolderOfTest folder;
    const Study study =
        folder.read(with_line(with_variants, "[[vary]]\nkey = \"drive.g_level\"\nvalues = [2, 3]\n", ""));
    ASSERT_EQ(study.charts.size(), 1u);
    EXPECT_EQ(study.variations[study.charts[0].x].key, "variant");
}

TEST(StudyVariants, MistakesHaveTheirPlace) {
    struct Mistake {
        std::string line, other, place, words;
    };
    const Mistake mistakes[] = {
        {"seeds = 3", "sets = 3", ":7:1", "unknown key 'sets' in [[variant]]; did you mean 'set'?"},
        {"name = \"as it is\"\n", "", ":4:1", "[[variant]] lacks 'name'"},
        {"name = \"as it is\"", "name = \"\"", ":5:1", "'name' is empty"},
        {"name = \"long, soft\"", "name = \"as it is\"", ":9:1", "a second variant the name \"as it is\""},
        {"set = []\n", "", ":4:1", "[[variant]] lacks 'set'"},
        {"seeds = 3", "seeds = 0", ":7:1", "'seeds' must be a whole number"},
        {"seeds = 3", "seeds = [3, 3]", ":7:1", "a seed twice"},
        {"run.overlap=", "run.overlpa=", ":10:30", "did you mean 'overlap'?"},
        {"run.overlap=0.02", "run.overlap=-1", ":10:30", "'overlap' must be"},
        {"run.overlap=0.02", "drive.g_level=2", ":12:1", "varies drive.g_level, which the variant"},
        {"set = []", "set = [\"run.duration=0.3 s\", \"run.overlap=0.02\"]", ":9:1", "are the same run"},
        {"from = \"0.15 s\"", "from = \"0.4 s\"", ":18:1", "the run ends at 0.3 s"},
    };
    const StudyFolderOfTest folder;
    for (const Mistake& mistake : mistakes) {
        const std::string text = with_line(with_variants, mistake.line, mistake.other);
        ASSERT_FALSE(text.empty()) << mistake.line;
        try {
            members_of(folder.read(text));
            ADD_FAILURE() << "accepted: " << mistake.other;
        } catch (const UserError& error) {
            EXPECT_THAT(error.what(), HasSubstr((folder / "study.toml").string() + mistake.place + ": "))
                << mistake.line << " -> " << mistake.other;
            EXPECT_THAT(error.what(), HasSubstr(mistake.words)) << mistake.other;
        }
    }
}

}  // namespace
}  // namespace grainreel
