// Tests of the members of a study: their settings, names and scenes.
#include "render/app/study/file/members.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fmt/format.h>

#include <set>

#include "engine/base/error.hpp"
#include "engine/base/text.hpp"
#include "engine/plan/reach.hpp"
#include "engine/plan/resolved_scene.hpp"
#include "render/app/study/members/runner.hpp"
#include "render/app/study/results/points.hpp"
#include "render/picture/camera/camera_path.hpp"
#include "render/picture/words/layout.hpp"
#include "render/scene/filmed_scene.hpp"
#include "tests/study/study_text.hpp"
#include "tests/support/tells.hpp"

namespace grainreel {
namespace {

using namespace test;
using testing::HasSubstr;

std::vector<Member> members_of(const Study& study) {
    return make_members(study, [](const FilmedScene&, const Plan&) {});
}

std::string name_of_first(const StudyFolderOfTest& folder, const std::string& text) {
    return members_of(folder.read(text)).front().name;
}

TEST(StudyMembers, GoThroughTheGridSeedBySeed) {
    const StudyFolderOfTest folder;
    const Study study = folder.read(small_study);
    const std::vector<Member> members = members_of(study);
    ASSERT_EQ(members.size(), 2u * 3 * 2);
    EXPECT_EQ(member_text(study, members[0]), "drive.g_level = 2, species.big.diameter = 5 mm, seed 1");
    EXPECT_EQ(member_text(study, members[1]), "drive.g_level = 2, species.big.diameter = 5 mm, seed 2");
    EXPECT_EQ(member_text(study, members[2]), "drive.g_level = 2, species.big.diameter = 5.5 mm, seed 1");
    EXPECT_EQ(member_text(study, members.back()), "drive.g_level = 3, species.big.diameter = 6 mm, seed 2");
    std::set<std::string> names;
    for (const Member& member : members) names.insert(member.name);
    EXPECT_EQ(names.size(), members.size());
}

// Pictures of all members have one scale and one layout: they reach as high as those of the wildest member.
TEST(StudyMembers, ShareTheHeightThatTheirPicturesReach) {
    const StudyFolderOfTest folder;
    const Study study = folder.read(small_study);
    double highest = 0;
    const std::vector<Member> members = members_of(study);
    for (const Member& member : members)
        highest = std::max(highest, estimated_reach(read_filmed_scene(study.scene, member.sets)).value());
    for (const Member& member : members) {
        ASSERT_GE(member.framing.size(), 1u);
        EXPECT_EQ(member.framing[0].text, fmt::format("film.camera.reach={:.6g}", highest));
    }
    const Study framed = folder.read("set = [\"film.camera.frame=container\"]\n" + small_study);
    EXPECT_TRUE(members_of(framed).front().framing.empty());
}

// Words stand at one place in all pictures, and a length is as long in each, although the vessels differ.
TEST(StudyMembers, ShareLayoutAndScale) {
    const StudyFolderOfTest folder;
    const std::string wider =
        with_line(small_study, "from = \"5 mm\"\nto = \"6 mm\"", "from = \"30 mm\"\nto = \"45 mm\"");
    const Study study = folder.read("set = [\"film.size=640x360\"]\n" +
                                    with_line(wider, "species.big.diameter", "container.width"));
    const std::vector<Member> members = members_of(study);
    std::vector<FilmedScene> scenes;
    for (const Member& member : members) {
        Assignments sets = member.sets;
        sets.insert(sets.end(), member.framing.begin(), member.framing.end());
        scenes.push_back(read_filmed_scene(study.scene, sets));
    }
    const PictureLayout first = plan_layout(scenes.front());
    for (const FilmedScene& scene : scenes) {
        EXPECT_TRUE(scene.film.gutters.wanted);
        const PictureLayout layout = plan_layout(scene);
        EXPECT_EQ(layout.port.width, first.port.width);
        EXPECT_EQ(layout.port.height, first.port.height);
        EXPECT_FALSE(layout.plates);
        EXPECT_NEAR(framed_scale(scene, layout) / framed_scale(scenes.front(), first), 1, 2e-3);
    }
}

// Members have the same scene as `movie --set ...`.
TEST(StudyMembers, HaveTheSceneThatSetWouldMake) {
    const StudyFolderOfTest folder;
    const Study study = folder.read("set = [\"run.duration=0.1 s\"]\n" + small_study);
    const Member last = members_of(study).back();
    const FilmedScene scene = read_filmed_scene(study.scene, last.sets);
    const FilmedScene typed = read_filmed_scene(
        study.scene, {"run.duration=0.1 s", "drive.g_level=3", "species.big.diameter=6 mm", "run.seed=2"});
    EXPECT_EQ(resolved_scene(scene, make_plan(scene)), resolved_scene(typed, make_plan(typed)));
}

TEST(StudyMembers, KeepTheirNamesWhileTheirRunIsTheSame) {
    const StudyFolderOfTest folder;
    const std::string first = name_of_first(folder, small_study);
    EXPECT_EQ(name_of_first(folder, with_line(small_study, "[2, 3]", "[2, 3, 4]")), first);
    EXPECT_EQ(name_of_first(folder, "set = [\"film.rate=25\"]\n" + small_study), first);
    EXPECT_NE(name_of_first(folder, "set = [\"run.duration=0.1 s\"]\n" + small_study), first);
    EXPECT_NE(name_of_first(folder, with_line(small_study, "[2, 3]", "[2.5, 3]")), first);
}

// TOML has values such as nan that are no numbers.
TEST(StudyMembers, ValuesThatAreNoNumberHaveTheirPlace) {
    const StudyFolderOfTest folder;
    for (const char* value : {"nan", "-nan", "inf"}) {
        const Study study =
            folder.read(with_line(small_study, "values = [2, 3]", fmt::format("values = [2, {}]", value)));
        try {
            members_of(study);
            ADD_FAILURE() << value;
        } catch (const UserError& error) {
            EXPECT_THAT(error.what(), HasSubstr("study.toml:5:14: 'g_level' must be ")) << value;
        }
    }
}

TEST(StudyMembers, ManyAreAskedAbout) {
    const StudyFolderOfTest folder;
    const Study study = folder.read(with_line(with_line(small_study, "seeds = 2", "seeds = 100"),
                                              "values = [2, 3]", "from = 1\nto = 3\ncount = 34"));
    EXPECT_EQ(count_members(study, true), 34u * 3 * 100);
    try {
        count_members(study, false);
        ADD_FAILURE();
    } catch (const UserError& error) {
        EXPECT_THAT(error.what(), tells({"study.toml:4:1", "10200 members"}));
        EXPECT_THAT(error.what(), HasSubstr("--yes"));
    }
    const Study vast = folder.read(with_line(with_line(small_study, "seeds = 2", "seeds = 100000"),
                                             "values = [2, 3]", "from = 1\nto = 3\ncount = 100000"));
    EXPECT_THROW(count_members(vast, true), UserError);
}

TEST(StudyMembers, NamesAreHarmless) {
    EXPECT_EQ(file_name_part("g_level-2"), "g_level-2");
    EXPECT_EQ(file_name_part("9 mm"), "9mm");
    EXPECT_EQ(file_name_part("../a b;$(x)"), "_..-ab---x-");
    EXPECT_EQ(file_name_part(""), "_");
    EXPECT_EQ(file_name_part(std::string(500, 'x')).size(), 60u);
}

const char* const one_triangle =
    "solid plate\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0.03\nvertex 0.01 0 0.03\nvertex 0 0.01 0.03\n"
    "endloop\nendfacet\nendsolid plate\n";

// What lies in a study's folder can be run again without the files from which it was made.
TEST(StudyCopy, IsAStudyAsItStands) {
    const TemporaryFolder made;
    const StudyFolder copies{made.path()};
    std::vector<std::string> names;
    {
        const StudyFolderOfTest folder;
        std::filesystem::create_directories(folder / "walls");
        write_text(folder / "walls/plate.stl", one_triangle);
        write_text(folder / "fifty.toml",
                   small_scene_text + "[[mesh]]\nname = \"plate\"\nfile = \"walls/plate.stl\"\n");
        write_text(folder / "points.csv", "x,y\n2,0.5\n");
        const Study study = folder.read("# Γ, and its \"scene\"\n" + small_study +
                                        "reference = \"points.csv\"  # of others\n");
        const auto members = make_members(study, [](const FilmedScene&, const Plan&) {});
        for (const Member& member : members) names.push_back(member.name);
        make_study_folder(study, members, copies);
    }
    const Study again = read_study(made / "study.toml");
    EXPECT_EQ(again.title, "study");
    EXPECT_EQ(read_reference(again.charts[0].reference_text, *again.charts[0].reference).size(), 1u);
    const auto members = make_members(again, [](const FilmedScene&, const Plan&) {});
    ASSERT_EQ(members.size(), names.size());
    for (std::size_t m = 0; m < members.size(); ++m) EXPECT_EQ(members[m].name, names[m]);
    // Written over itself it stays the same.
    const std::string text = text_of(made / "study.toml");
    make_study_folder(again, members, copies);
    EXPECT_EQ(text_of(made / "study.toml"), text);
}

}  // namespace
}  // namespace grainreel
