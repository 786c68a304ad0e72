// Tests of [[film.caption]]: what is read and written, and what is refused.
#include <gtest/gtest.h>

#include "engine/base/error.hpp"
#include "engine/plan/resolved_scene.hpp"
#include "render/scene/filmed_scene.hpp"
#include "tests/scene/scene_text.hpp"

namespace grainreel {
namespace {

std::string captioned(const std::string& captions) {
    return wedge_text + captions;
}

TEST(Captions, StayUntilTheNextOrTheEnd) {
    const FilmedScene scene = read_text(captioned(
        "[[film.caption]]\nfrom = 0.5\ntext = \"one\"\n[[film.caption]]\nfrom = 1\nto = 1.2\ntext = "
        "\"two\"\n[[film.caption]]\nfrom = 1.5\ntext = \"three\"\nhold = \"2 s\"\n"));
    const std::vector<FilmCaption> expected = {{0.5, 1, "one", 0}, {1, 1.2, "two", 0}, {1.5, 2, "three", 2}};
    EXPECT_EQ(scene.film.captions, expected);
    EXPECT_FALSE(shows_caption(expected[0], 0.4999));
    EXPECT_TRUE(shows_caption(expected[0], 0.5));
    EXPECT_FALSE(shows_caption(expected[0], 1));
    const FilmedScene back = read_filmed_scene_text(resolved_scene(scene, make_plan(scene)), "scene.toml");
    EXPECT_EQ(back.film.captions, expected);
}

TEST(Captions, MistakesAreToldWordForWord) {
    const std::pair<const char*, const char*> mistakes[] = {
        {"[[film.caption]]\nfrom = 1\nto = 1.5\ntext = \"a\"\n[[film.caption]]\nfrom = 1.4\ntext = \"b\"\n",
         "test.toml:33:1: 'from' is 1.4 s, but the caption before it stays until 1.5 s; "
         "captions "
         "follow each other in time"},
        {"[[film.caption]]\nfrom = 2\ntext = \"a\"\n",
         "test.toml:29:1: 'from' is 2 s, but the run ends at 2 s; bring it forward or "
         "lengthen "
         "run.duration"},
        {"[[film.caption]]\nfrom = 1\nto = 0.5\ntext = \"a\"\n",
         "test.toml:30:1: 'to' is 0.5 s, not later than 'from', 1 s; write a later time"},
        {"[[film.caption]]\nfrom = 1\ntext = \"\"\n",
         "test.toml:30:1: 'text' must not be empty; take the caption out"},
        {"[[film.caption]]\nfrom = 1\n",
         "test.toml:28:1: [[film.caption]] lacks 'text'; write for example text = \"small\""},
        {"[[film.caption]]\nfrom = 1\ntext = \"a\"\nhold = 90\n",
         "test.toml:31:1: 'hold' must be from 0 to 60, but is 90; write for example 0"},
    };
    for (const auto& [captions, message] : mistakes) {
        try {
            read_text(captioned(captions));
            ADD_FAILURE() << "accepted: " << captions;
        } catch (const UserError& error) {
            EXPECT_STREQ(error.what(), message);
        }
    }
}

TEST(Captions, MayHoldMeasuredValues) {
    const FilmedScene scene =
        read_text(captioned("[[film.caption]]\nfrom = 1\ntext = \"{{mixed}: {lacey:%} at {kinetic:mJ}\"\n"));
    const std::vector<LiveWords>& words = scene.film.captions.at(0).words;
    ASSERT_EQ(words.size(), 2u);
    EXPECT_EQ(words[0], (LiveWords{"{mixed}: ", "lacey", "%", 0.01}));
    EXPECT_EQ(words[1].column, "kinetic_J");
    EXPECT_TRUE(needs_measures(scene.film) && !needs_measures(scene.film.shows));
    const FilmedScene back = read_filmed_scene_text(resolved_scene(scene, make_plan(scene)), "scene.toml", {},
                                                    [&](const Scene&) { return scene.measurable; });
    EXPECT_EQ(back.film.captions, scene.film.captions);
    try {
        read_text(captioned("[[film.caption]]\nfrom = 1\ntext = \"{warmth}\"\n"));
        ADD_FAILURE() << "a column that is not there was accepted";
    } catch (const UserError& error) {
        EXPECT_NE(std::string(error.what()).find("{warmth}"), std::string::npos) << error.what();
    }
}

}  // namespace
}  // namespace grainreel
