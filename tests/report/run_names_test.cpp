// Tests of the names that a page gives to its runs.
#include "render/page/facts/run_names.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "engine/plan/resolved_scene.hpp"
#include "render/scene/filmed_scene.hpp"
#include "tests/support/small_scene.hpp"
#include "tests/support/temporary_folder.hpp"

namespace grainreel {
namespace {

using testing::ElementsAre;

// Runs of the small scene with other values for some keys.
struct Runs {
    test::TemporaryFolder here;
    std::vector<FilmedScene> scenes;
    std::vector<std::string> folders;

    void add(const std::string& folder, const std::vector<std::string>& sets) {
        Assignments all;
        for (const std::string& set : sets) all.push_back(set);
        scenes.push_back(read_filmed_scene_text(test::small_scene_text, "fifty.toml", all));
        folders.push_back(folder);
        std::filesystem::create_directories(here / folder);
        test::write_text(here / (folder + "/scene.toml"),
                         resolved_scene(scenes.back(), make_plan(scenes.back())));
    }
    std::vector<std::string> names() const {
        std::vector<RunToName> runs;
        for (std::size_t k = 0; k < scenes.size(); ++k) runs.push_back({here / folders[k], scenes[k]});
        return names_of_runs(runs);
    }
};

TEST(RunNames, AreTheTitlesWhereTheyDiffer) {
    Runs runs;
    runs.add("a", {"title=\"Calm\"", "drive.g_level=2"});
    runs.add("b", {"title=\"Wild\"", "drive.g_level=3"});
    EXPECT_THAT(runs.names(), ElementsAre("Calm", "Wild"));
}

// Values that follow from the drive (stiffness, step) do not count, nor how the film looks.
TEST(RunNames, SayWhatDiffersUnderOneTitle) {
    Runs level, frequency, two, wall;
    level.add("a", {"drive.g_level=2"});
    level.add("b", {"drive.g_level=3", "film.rate=25"});
    EXPECT_THAT(level.names(), ElementsAre("Γ = 2", "Γ = 3"));
    frequency.add("a", {"contact.friction=0.4"});
    frequency.add("b", {"contact.friction=0.2"});  // all pairs have the same friction, so it stands once
    EXPECT_THAT(frequency.names(), ElementsAre("friction = 0.4", "friction = 0.2"));
    two.add("a", {"run.seed=1", "species.big.diameter=6 mm"});
    two.add("b", {"run.seed=2", "species.big.diameter=6 mm"});
    two.add("c", {"run.seed=2", "species.big.diameter=5 mm"});
    EXPECT_THAT(two.names(), ElementsAre("seed = 1, diameter = 6 mm", "seed = 2, diameter = 6 mm",
                                         "seed = 2, diameter = 5 mm"));
    Runs german;
    german.add("a", {"contact.friction=0.4", "film.lang=de"});
    german.add("b", {"contact.friction=0.2", "film.lang=de"});
    EXPECT_THAT(german.names(), ElementsAre("Reibung = 0.4", "Reibung = 0.2"));
    Runs outlet;  // an inline table in scene.toml
    outlet.add("a", {"container.outlet={ width=\"8 mm\", opens=0.05 }"});
    outlet.add("b", {"container.outlet={ width=\"9 mm\", opens=0.05 }"});
    EXPECT_THAT(outlet.names(), ElementsAre("width = 8 mm", "width = 9 mm"));
}

TEST(RunNames, AreTheFoldersWhereNothingElseTellsThemApart) {
    Runs same, much;
    same.add("a", {});
    same.add("b", {});
    EXPECT_THAT(same.names(), ElementsAre("a", "b"));
    much.add("a", {});
    much.add("b",
             {"run.seed=3", "container.width=32 mm", "container.depth=22 mm", "contact.restitution=0.5"});
    EXPECT_THAT(much.names(), ElementsAre("a", "b"));
    Runs twice;
    twice.add("x/run", {});
    twice.add("y/run", {});
    EXPECT_THAT(twice.names(), ElementsAre(twice.here / "x/run", twice.here / "y/run"));
}

}  // namespace
}  // namespace grainreel
