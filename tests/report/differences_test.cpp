// Tests of the differences between scenes.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fmt/format.h>

#include "render/page/facts/run_names.hpp"
#include "tests/support/temporary_folder.hpp"

namespace grainreel {
namespace {

using testing::HasSubstr;
using testing::Not;
using testing::Pair;
using testing::UnorderedElementsAre;

TEST(Differences, KeysHaveTheirTableAndItsNumber) {
    EXPECT_THAT(
        keys_of_scene("title = \"a # b\"  # not this\n[drive]\nfrequency = 20\n\n[[species]]\nname = \"a\"\n"
                      "[[species]]\nname = \"b\"\nlist = [\n  1,\n  2]\n"),
        UnorderedElementsAre(Pair("title", "\"a # b\""), Pair("drive.frequency", "20"),
                             Pair("species.1.name", "\"a\""), Pair("species.2.name", "\"b\""),
                             Pair("species.2.list", "[1,2]")));
}

TEST(Differences, EntriesOfInlineTablesAreKeys) {
    EXPECT_THAT(keys_of_scene("[container]\noutlet = { width = 0.018, name = \"a, b\", list = [1, 2] }\n"
                              "size = { min = 1, max = 2 }\n"),
                UnorderedElementsAre(
                    Pair("container.outlet.width", "0.018"), Pair("container.outlet.name", "\"a, b\""),
                    Pair("container.outlet.list", "[1, 2]"), Pair("container.size", "{ min = 1, max = 2 }")));
}

TEST(Differences, OnlyWhatDiffersIsInTheTable) {
    const test::TemporaryFolder here;
    test::write_text(here / "a.toml", "title = \"<i>a</i>\"\n[run]\nduration = 1\nstep = 0.3\n");
    test::write_text(here / "b.toml",
                     "title = \"b\"\n[run]\nduration = 1.0\nstep = 0.30000000000000004\nseed = 7\n");
    const std::string table =
        differences_html({{"first", here / "a.toml"}, {"second", here / "b.toml"}}, PageWords({}));
    EXPECT_THAT(
        table,
        HasSubstr(
            "<th scope=\"row\">title</th><td>&quot;&lt;i&gt;a&lt;/i&gt;&quot;</td><td>&quot;b&quot;</td>"));
    EXPECT_THAT(table, HasSubstr("<th scope=\"row\">run.seed</th><td>–</td><td>7</td>"));
    EXPECT_THAT(table, HasSubstr("SI units"));
    EXPECT_THAT(table, Not(HasSubstr("run.duration")));
    EXPECT_THAT(table, Not(HasSubstr("run.step")));
    EXPECT_THAT(differences_html({{"a", here / "a.toml"}, {"a", here / "a.toml"}}, PageWords({})),
                HasSubstr("The scenes are the same."));
}

// Two meshes with the same name are told apart by the content of their files.
TEST(Differences, MeshesDifferByTheirHash) {
    const test::TemporaryFolder here;
    const char* mesh = "[[mesh]]\nname = \"drum\"\nfile = \"meshes/drum.stl\"\nhash = \"{}\"\n";
    test::write_text(here / "a.toml", fmt::format(fmt::runtime(mesh), "0123456789abcdef"));
    test::write_text(here / "b.toml", fmt::format(fmt::runtime(mesh), "fedcba9876543210"));
    const std::string table =
        differences_html({{"first", here / "a.toml"}, {"second", here / "b.toml"}}, PageWords({}));
    EXPECT_THAT(table, HasSubstr("<th scope=\"row\">mesh.1.hash</th><td>&quot;0123456789abcdef&quot;</td>"));
    EXPECT_THAT(table, Not(HasSubstr("mesh.1.file")));
}

}  // namespace
}  // namespace grainreel
