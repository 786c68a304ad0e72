// Tests of keys for the camera's way and for what makes the walls' motion visible: they are read, refused and
// written back.
#include <gtest/gtest.h>

#include "engine/base/error.hpp"
#include "engine/plan/resolved_scene.hpp"
#include "render/scene/filmed_scene.hpp"
#include "tests/scene/scene_text.hpp"
#include "tests/support/tells.hpp"

namespace grainreel {
namespace {

using test::tells_only;

const std::string keyed = wedge_text + R"([film]
wall_ghost = true
exaggerate = 5
[[film.camera.key]]
time = 0
azimuth = "20 deg"
[[film.camera.key]]
time = "2 s"
azimuth = 400
zoom = 2
target = [0, "1 cm", 0.05]
)";

std::string complaint(const std::string& text) {
    try {
        read_text(text);
    } catch (const UserError& error) {
        return error.what();
    }
    return "none";
}

std::string about_camera(const std::string& keys) {
    return complaint(wedge_text + "[film.camera]\n" + keys);
}

TEST(CameraKeys, AreRead) {
    const Film film = read_text(keyed).film;
    EXPECT_TRUE(film.wall_ghost);
    EXPECT_TRUE(film.axes);  // the camera moves
    EXPECT_EQ(film.exaggerate, 5);
    ASSERT_EQ(film.camera.keys.size(), 2u);
    EXPECT_EQ(film.camera.keys[0].azimuth, 20);
    EXPECT_FALSE(film.camera.keys[0].zoom);
    EXPECT_EQ(film.camera.keys[1].time, 2);
    EXPECT_EQ(film.camera.keys[1].target, Vec3(0, 0.01, 0.05));
    const Film plain = read_text(wedge_text).film;
    EXPECT_FALSE(plain.axes || plain.wall_ghost || plain.camera.moves());
    EXPECT_EQ(plain.exaggerate, 1);
    EXPECT_EQ(read_text(wedge_text, {"film.camera.orbit=1 turn"}).film.camera.orbit, 360);
}

TEST(CameraKeys, AreWrittenBack) {
    for (const std::string& text :
         {keyed, wedge_text + "[film]\naxes = true\n",
          wedge_text + "[film.camera]\norbit = -90\norbit_time = \"3 s\"\ntarget = [0, 0, 0.1]\n",
          wedge_text + "[film.camera]\nposition = [1, 0, 0.25]\norbit = 720\n"}) {
        const FilmedScene scene = read_text(text);
        const FilmedScene back =
            read_filmed_scene_text(resolved_scene(scene, make_plan(scene)), "scene.toml", {}, measurable_in);
        EXPECT_EQ(back.film, scene.film);
    }
}

TEST(CameraKeys, WhatIsFramedIsReadAndWrittenBack) {
    EXPECT_EQ(read_text(wedge_text).film.camera.frame, FramingScope::reach);
    for (const char* words : {"frame = \"container\"\n", "frame = \"bed\"\n", "reach = \"90 mm\"\n"}) {
        const FilmedScene scene = read_text(wedge_text + "[film.camera]\n" + words);
        EXPECT_NE(scene.film, read_text(wedge_text).film) << words;
        EXPECT_EQ(
            read_filmed_scene_text(resolved_scene(scene, make_plan(scene)), "scene.toml", {}, measurable_in)
                .film,
            scene.film);
    }
    EXPECT_THAT(about_camera("frame = \"bed\"\nreach = 0.1\n"),
                tells_only({"test.toml:30:1", "'reach'", "of no use", "'frame'", "remove"}));
    EXPECT_THAT(about_camera("position = [1, 0, 0]\nframe = \"bed\"\n"),
                tells_only({"test.toml:30:1", "'frame'", "of no use", "'position'", "'target'", "remove"}));
}

TEST(CameraKeys, AreRefusedWhereTheyMeanNothing) {
    EXPECT_THAT(about_camera("position = [1, 0, 0]\nazimuth = 3\n"),
                tells_only({"test.toml:30:1", "'azimuth'", "of no use", "'position'", "'target'", "remove"}));
    EXPECT_THAT(about_camera("position = [0, 0, \"90 mm\"]\n"),
                tells_only({"test.toml:29:1", "'position'", "camera looks", "move"}));
    EXPECT_THAT(
        about_camera("position = [1, 0, 0]\nfield_of_view = 0\n"),
        tells_only({"test.toml:30:1", "'field_of_view'", "0", "'position'", "azimuth and elevation"}));
    EXPECT_THAT(about_camera("orbit_time = 3\n"),
                tells_only({"test.toml:29:1", "'orbit_time'", "of no use", "'orbit'", "remove"}));
    EXPECT_THAT(about_camera("orbit = 3\n[[film.camera.key]]\ntime = 1\n"),
                tells_only({"test.toml:29:1", "'orbit'", "of no use", "keys", "azimuth", "remove"}));
    EXPECT_THAT(about_camera("[[film.camera.key]]\ntime = 1\n[[film.camera.key]]\ntime = \"1 s\"\n"),
                tells_only({"test.toml:32:1", "'time'", "1 s", "not later", "1 s", "in order"}));
}

// These scenes once crashed the renderer.
TEST(CameraKeys, ACameraHasADirectionAndAnAngle) {
    EXPECT_THAT(about_camera("field_of_view = 1e-300\n"),
                tells_only({"test.toml:29:1", "'field_of_view'", "0", "at least 0.1", "1e-300", "write 0"}));
    for (const char* near : {"1e-300", "1e-9"})
        EXPECT_THAT(about_camera(std::string("position = [") + near + ", 0, \"90 mm\"]\n"),
                    tells_only({"test.toml:29:1", "'position'", "camera looks", "move"}));
    EXPECT_EQ(about_camera("position = [0, 0, 0]\ntarget = [0, \"1 mm\", 0]\n"), "none");
}

TEST(CameraKeys, WhatCannotBeShownIsSaid) {
    EXPECT_THAT(complaint(box_text + "[film]\nwall_ghost = true\n"),
                tells_only({"test.toml:26:1", "'wall_ghost'", "nothing moves", "[drive]"}));
    EXPECT_THAT(complaint(box_text + "[film]\nexaggerate = 2\n"),
                tells_only({"test.toml:26:1", "'exaggerate'", "nothing moves", "[drive]"}));
    EXPECT_THAT(complaint(with(wedge_text, "g_level = 3", "g_level = 3\nmoves = \"floor\"") +
                          "[film]\nexaggerate = 2\n"),
                tells_only({"test.toml:30:1", "'exaggerate'", "all move together", "take it out"}));
}

// A slope is seen as a slope.
TEST(CameraKeys, UpIsAgainstGravityUnlessTheSceneSaysOtherwise) {
    const auto up = [](const Assignments& sets) { return read_text(wedge_text, sets).film.camera.up; };
    EXPECT_EQ(up({}), Vec3(0, 0, 1));
    EXPECT_LT((up({"gravity=[0, 6, -8]"}) - Vec3(0, -0.6, 0.8)).norm(), 1e-15);
    EXPECT_EQ(up({"gravity=[0, 6, -8]", "film.camera.up=[0, 0, 2]"}), Vec3(0, 0, 1));
    EXPECT_EQ(read_text(box_text).film.camera.up, Vec3(0, 0, 1)) << "without gravity";
}

}  // namespace
}  // namespace grainreel
