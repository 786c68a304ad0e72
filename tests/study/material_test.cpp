// Tests of one stiffness for all members, of runs that go on because they should be longer, and of the table
// of parameters.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "engine/base/error.hpp"
#include "engine/measure/columns.hpp"
#include "engine/scene/text/flat_toml.hpp"
#include "render/app/study/file/shared_stiffness.hpp"
#include "render/app/study/members/runner.hpp"
#include "render/app/study/results/parameters.hpp"
#include "tests/study/study_text.hpp"
#include "tests/support/tells.hpp"

namespace grainreel {
namespace {

using namespace test;
using testing::HasSubstr;

const std::string shaken = R"(scene = "fifty.toml"
[[vary]]
key = "drive.g_level"
values = [2.5, 4]
)";

// The stiffness between the first species' grains, setting by setting.
std::vector<double> stiffnesses(const Study& study) {
    std::vector<double> all;
    make_members(
        study, [&](const FilmedScene&, const Plan& plan) { all.push_back(plan.grain[0].loading_stiffness); });
    return all;
}

TEST(StudyMaterial, IsThatOfTheStiffestMember) {
    const StudyFolderOfTest folder;
    Study study = folder.read(shaken);
    const std::vector<double> own = stiffnesses(study);
    ASSERT_GT(own[1], 1.5 * own[0]) << "the plan chooses by the drive";
    const std::string told = share_stiffness(study);
    const std::vector<double> shared = stiffnesses(study);
    EXPECT_NEAR(shared[0] / own[1], 1, 1e-12);
    EXPECT_NEAR(shared[1] / own[1], 1, 1e-12);
    EXPECT_THAT(told, tells({"in all members", "Γ = 4"}));
}

TEST(StudyMaterial, StaysAsItIsWhereTheStudySaysSo) {
    const StudyFolderOfTest folder;
    for (const std::string& text :
         {"stiffness = \"own\"\n" + shaken,
          with_line(with_line(shaken, "drive.g_level", "run.overlap"), "[2.5, 4]", "[0.01, 0.02]")}) {
        Study study = folder.read(text);
        const std::vector<double> own = stiffnesses(study);
        EXPECT_THAT(share_stiffness(study), HasSubstr("differs from member to member"));
        EXPECT_EQ(stiffnesses(study), own);
    }
    Study given = folder.read("set = [\"contact.stiffness=5000\"]\n" + shaken);
    EXPECT_EQ(share_stiffness(given), "");
    EXPECT_EQ(stiffnesses(given), (std::vector<double>{5000, 5000}));
}

std::vector<Member> members_with(const StudyFolderOfTest& folder, const std::string& duration) {
    return make_members(folder.read("set = [\"run.duration=" + duration + "\"]\n" + shaken),
                        [](const FilmedScene&, const Plan&) {});
}

// A folder of a run that is complete, as far as the study looks.
void write_run(const std::filesystem::path& folder, const char* status) {
    std::filesystem::create_directories(folder);
    write_text(folder / "checkpoint.grs", "");
    write_text(folder / "run.json", std::string("{\"status\": \"") + status + "\"}");
}

TEST(StudyMembersThatGrow, GoOnFromTheLongestShorterRun) {
    const StudyFolderOfTest folder;
    const StudyFolder study{folder.path()};
    const std::vector<Member> brief = members_with(folder, "1 s"), longer = members_with(folder, "2 s"),
                              longest = members_with(folder, "3 s");
    EXPECT_EQ(brief[0].stem, longest[0].stem);
    EXPECT_NE(brief[0].name, longest[0].name);
    EXPECT_NE(brief[0].stem, brief[1].stem);
    EXPECT_TRUE(shorter_runs(longest, study).empty());
    write_run(study.member(brief[0]), "complete");
    write_run(study.member(longer[0]), "complete");
    write_run(study.member(longer[1]), "running");
    const std::vector<ShorterRun> runs = shorter_runs(longest, study);
    ASSERT_EQ(runs.size(), 1u) << "the other one is not complete";
    EXPECT_EQ(runs[0].member, 0u);
    EXPECT_EQ(runs[0].folder, study.member(longer[0]));
    EXPECT_TRUE(shorter_runs(brief, study).empty()) << "longer runs are of no use";
    EXPECT_THAT(go_on_command(longest[0], study),
                testing::ElementsAre("resume", study.member(longest[0]).string(), "--until", "3 s",
                                     "--no-film", "--no-report", "--threads", "1"));
}

TEST(FlatToml, HasARowForEachKey) {
    const auto flat =
        flat_toml("a = 1.5\n[b]\nlist = [1, 2]\nword = \"x\"\n[[c]]\nd = true\n[[c]]\nd = false\n");
    const std::vector<std::pair<std::string, std::string>> wanted{
        {"a", "1.5"}, {"b.list", "[1, 2]"}, {"b.word", "x"}, {"c[0].d", "true"}, {"c[1].d", "false"}};
    EXPECT_EQ(flat, wanted);
}

TEST(StudyParametersTable, TellsWhatDiffersAndWhatDoesNot) {
    const StudyFolderOfTest folder;
    const Study study = folder.read(shaken);
    StudyParameters parameters;
    std::size_t settings = 0;
    make_members(study, [&](const FilmedScene& scene, const Plan& plan) {
        parameters.add_setting(scene, plan);
        ++settings;
    });
    EXPECT_EQ(settings, 2u);
    const std::string table = parameters.table(study);
    EXPECT_THAT(table, testing::StartsWith("key,unit,value,1,2,meaning\nsetting,,,Γ = 2.5,Γ = 4,\n"
                                           "drive.g_level,,,2.5,4,\nprogram.version,"));
    EXPECT_THAT(table, HasSubstr("\ndrive.frequency,Hz,20,,,"));
    EXPECT_THAT(table, testing::AllOf(HasSubstr("\n\"contact.pair[small, big].stiffness\",N/m,,"),
                                      HasSubstr("\ndrive.amplitude,m,,"), HasSubstr("\nrun.step,s,"),
                                      HasSubstr("\nrun.accuracy,,"), HasSubstr("\nspecies.big.diameter,m,")));
    const Methods methods = parameters.methods(study);
    EXPECT_THAT(methods.paragraph, tells({"Γ (2.5, 4)", "first one", "Walton1986"}));
    EXPECT_THAT(methods.bibtex, testing::ContainsRegex("grainreel.*\n.*\n.*\n.*\n  year = .20[0-9][0-9]"));
    EXPECT_THAT(methods.bibtex, HasSubstr("@article{Walton1986"));
}

TEST(StudyParametersTable, HasSeedsAndUnitsOfWhatIsVaried) {
    const StudyFolderOfTest folder;
    const Study study = folder.read(small_study);
    StudyParameters parameters;
    make_members(study,
                 [&](const FilmedScene& scene, const Plan& plan) { parameters.add_setting(scene, plan); });
    const std::string table = parameters.table(study);
    EXPECT_THAT(table, HasSubstr("\nspecies.big.diameter,mm,,5,5.5,6,5,5.5,6,\n"));
    EXPECT_THAT(table, HasSubstr("\nrun.seed,,\"1, 2\",,,,,,,\n"));
    EXPECT_THAT(table, testing::Not(HasSubstr("packing.settled")));
}

// For how long the packings settled is known of members that have run.
TEST(StudyParametersTable, HasTheSettlingOfMembersThatHaveRun) {
    const StudyFolderOfTest folder;
    const Study study = folder.read(small_study);
    StudyParameters parameters;
    const std::vector<Member> members = make_members(
        study, [&](const FilmedScene& scene, const Plan& plan) { parameters.add_setting(scene, plan); });
    std::vector<MemberResult> results(members.size());
    results[0].settled = 0.25;
    results[1].settled = 0.375;
    results[3].settled = 0.5;
    EXPECT_THAT(parameters.table(study, members, results),
                HasSubstr("\npacking.settled,s,,\"0.25, 0.375\",0.5,,,,,\"Simulated time"));
}

}  // namespace
}  // namespace grainreel
