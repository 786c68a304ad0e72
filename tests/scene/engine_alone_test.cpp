// Tests of the engine's reader, which takes a scene with a film and keeps the film as text.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>

#include "engine/base/error.hpp"
#include "engine/measure/columns.hpp"
#include "engine/mesh/room.hpp"
#include "engine/plan/resolved_scene.hpp"
#include "engine/scene/scene_file.hpp"
#include "render/scene/filmed_scene.hpp"
#include "tests/scene/scene_text.hpp"
#include "tests/support/tells.hpp"

namespace grainreel {
namespace {

using test::tells;

std::string message_of(const std::string& text, const Assignments& sets = {}) {
    try {
        read_scene_text(text, "test.toml", sets, measurable_in);
    } catch (const UserError& error) {
        return error.what();
    }
    return "";
}

// A scene that the engine wrote still has the film of the scene that it read, and the engine's part is
// unchanged.
TEST(EngineAlone, KeepsTheFilmOfEveryShippedScene) {
    int read = 0;
    for (const auto& file : std::filesystem::directory_iterator(GRAINREEL_SOURCE "/scenes")) {
        if (file.path().extension() != ".toml") continue;
        SCOPED_TRACE(file.path());
        const Scene alone = read_scene(file.path(), {}, measurable_in);
        const FilmedScene filmed = read_filmed_scene(file.path(), {}, measurable_in);
        const Plan plan = make_plan(alone);
        const std::string written = resolved_scene(alone, plan);
        const FilmedScene back = read_filmed_scene_text(written, file.path(), {}, measurable_in);
        EXPECT_EQ(back.film, filmed.film);
        EXPECT_EQ(back.colours, filmed.colours);
        EXPECT_EQ(back.container, filmed.container);
        EXPECT_EQ(back.drive, filmed.drive);
        EXPECT_EQ(make_plan(back).clock.step, plan.clock.step);
        // Reading and writing once more changes nothing.
        EXPECT_EQ(read_scene_text(written, file.path(), {}, measurable_in).film_text, alone.film_text);
        ++read;
    }
    EXPECT_GT(read, 10);
}

TEST(EngineAlone, KeepsAFilmThatStandsInOneLine) {
    const std::string text = "film = { rate = 25, camera = { zoom = 2 } }\n" + wedge_text;
    const Scene alone = read_scene_text(text, "test.toml", {}, measurable_in);
    const FilmedScene back =
        read_filmed_scene_text(resolved_scene(alone, make_plan(alone)), "test.toml", {}, measurable_in);
    EXPECT_EQ(back.film.rate, 25);
    EXPECT_EQ(back.film.camera.zoom, 2);
}

TEST(EngineAlone, LooksAtNoKeyOfTheFilm) {
    const std::string film = "[film]\nno_such_key = [1, { a = 2 }]\n[[film.segment]]\nwhat = \"ever\"\n";
    const Scene scene = read_scene_text(wedge_text + film, "test.toml", {"film.another=3"}, measurable_in);
    EXPECT_THAT(scene.film_text, testing::HasSubstr("no_such_key = [ 1, { a = 2 } ]"));
    EXPECT_THAT(scene.film_text, testing::HasSubstr("[[film.segment]]"));
    EXPECT_THAT(scene.film_text, testing::HasSubstr("another = 3"));
    EXPECT_THROW(read_filmed_scene_text(wedge_text + film, "test.toml"), UserError);
}

TEST(EngineAlone, StillComplainsOfItsOwn) {
    EXPECT_EQ(message_of(wedge_text + "[film]\nrate = 30\n"), "");
    EXPECT_THAT(message_of("film = 3\n" + wedge_text), tells({"test.toml:1:1", "'film'", "table"}));
    EXPECT_THAT(message_of(wedge_text + "[output]\ncontact = true\n"),
                testing::HasSubstr("unknown key 'contact' in [output]"));
    EXPECT_THAT(message_of(wedge_text, {"films.rate=3"}), tells({"unknown key", "'films'", "top level"}));
}

}  // namespace
}  // namespace grainreel
