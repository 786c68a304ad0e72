// Tests of [output.fields]: defaults, and what is refused.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "engine/base/error.hpp"
#include "engine/plan/plan.hpp"
#include "engine/plan/resolved_scene.hpp"
#include "render/scene/filmed_scene.hpp"
#include "tests/scene/scene_text.hpp"
#include "tests/support/tells.hpp"

namespace grainreel {
namespace {

using test::tells;
using testing::HasSubstr;

std::string complaint(const std::string& text, const Assignments& sets) {
    try {
        make_plan(read_text(text, sets));
    } catch (const UserError& error) {
        return error.what();
    }
    return "none";
}

TEST(FieldKeys, OneLineIsEnough) {
    const FilmedScene scene = read_text(wedge_text, {"output.fields.grid=yz"});
    const FieldOutput& fields = scene.output.fields;
    EXPECT_DOUBLE_EQ(fields.width, 0.5 * (100 * 5e-3 + 10 * 10e-3) / 110) << "half of the mean diameter";
    EXPECT_EQ(fields.cell, fields.width);
    EXPECT_EQ(fields.interval, 0);
    EXPECT_EQ(read_text(wedge_text, {"output.fields.grid=xyz"}).output.fields.cell, 2 * fields.width);
    EXPECT_DOUBLE_EQ(read_text(box_text, {"output.fields.grid=yz"}).output.fields.interval, 0.01);
    EXPECT_FALSE(read_text(wedge_text).output.fields.wanted());
}

// There are 110 grains at the start, and big ones come at 100 a second; the length of the run does not
// matter. In the second scene there are only those that come.
TEST(FieldKeys, TheMeanDiameterCountsGrainsThatCome) {
    std::string text = wedge_text + "[[feed]]\nspecies = \"big\"\nrate = 100\n";
    const double width = read_text(text, {"output.fields.grid=yz"}).output.fields.width;
    EXPECT_DOUBLE_EQ(width, 0.5 * (100 * 5e-3 + 110 * 10e-3) / 210);
    EXPECT_EQ(read_text(text, {"output.fields.grid=yz", "run.duration=7"}).output.fields.width, width)
        << "a run that is made longer has the grid of one that was so long from the beginning";
    const std::size_t small = text.find("[[species]]"), big = text.find("[[species]]", small + 1);
    text.erase(small, big - small);
    text.erase(text.find("count = 10\n"), 11);
    EXPECT_DOUBLE_EQ(read_text(text, {"output.fields.grid=yz"}).output.fields.width, 0.5 * 10e-3);
}

TEST(FieldKeys, WrittenSceneReadsBack) {
    for (const auto& [text, sets] :
         {std::pair<std::string, Assignments>{wedge_text,
                                              {"output.fields.grid=yz", "output.fields.phase=90 deg"}},
          {wedge_text, {"output.fields.grid=xyz", "output.fields.kernel=lucy", "output.fields.samples=8"}},
          {box_text, {"output.fields.grid=yz", "output.fields.interval=0.05"}}}) {
        const FilmedScene scene = read_text(text, sets);
        const std::string written = resolved_scene(scene, make_plan(scene));
        const FilmedScene again = read_text(written);
        EXPECT_EQ(again.output.fields, scene.output.fields) << written;
    }
}

TEST(FieldKeys, RefusesWhatMakesNoSense) {
    const auto with_grid = [](Assignments sets) {
        sets.insert(sets.begin(), "output.fields.grid=yz");
        return sets;
    };
    EXPECT_THAT(complaint(wedge_text, {"output.fields.width=1 mm"}),
                tells({"'width'", "of no use", "'grid'"}));
    EXPECT_THAT(complaint(wedge_text, with_grid({"output.fields.cell=20 mm"})),
                tells({"twice", "0.00273 m"}));
    EXPECT_THAT(complaint(wedge_text, with_grid({"output.fields.interval=1 s"})),
                tells({"drive", "'periods'"}));
    EXPECT_THAT(complaint(wedge_text, with_grid({"output.fields.phase=0.25", "output.fields.samples=4"})),
                tells({"'phase'", "one moment"}));
    EXPECT_THAT(complaint(wedge_text, with_grid({"run.duration=0.04 s"})),
                tells({"shorter than one", "run.duration"}));
    EXPECT_THAT(complaint(box_text, with_grid({"output.fields.periods=3"})),
                tells({"by the drive", "nothing oscillates", "'interval'"}));
    EXPECT_THAT(complaint(box_text, with_grid({"output.fields.interval=1 s"})),
                tells({"longer than the run", "shorten"}));
    EXPECT_THAT(complaint(wedge_text, with_grid({"output.fields.width=10 um", "output.fields.cell=10 um"})),
                HasSubstr("raise output.fields.cell or lower output.fields.samples"));
    const std::string cylinder =
        with(with(with(box_text, "\"box\"", "\"cylinder\""), "width = 0.02\n", "diameter = 0.02\n"),
             "depth = 0.02\n", "");
    EXPECT_THAT(complaint(cylinder, with_grid({})), tells({"cylinder", "not as deep", "\"xyz\""}));
    EXPECT_EQ(complaint(cylinder, {"output.fields.grid=xyz"}), "none");
}

}  // namespace
}  // namespace grainreel
