// Tests of the band for captions below the picture.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "render/picture/words/caption_band.hpp"
#include "render/picture/words/layout.hpp"
#include "tests/draw/support.hpp"

namespace grainreel::test {
namespace {

FilmedScene with_captions(int width, int height, const std::vector<std::string>& texts) {
    FilmedScene scene = wedge(width, height);
    double time = 0;
    for (const std::string& text : texts) {
        scene.film.captions.push_back({time, time + 1, text, 0});
        time += 1;
    }
    return scene;
}

Shot at(double time) {
    Shot frame = frame_of({{Vec3(0, 0, 0.02)}});
    frame.time = time;
    return frame;
}

bool has_ink(const Picture& picture, const Rectangle& part) {
    for (int y = part.y; y < part.y + part.height; ++y)
        for (int x = part.x; x < part.x + part.width; ++x)
            if (picture.pixel(x, y)[0] < 128) return true;
    return false;
}

TEST(CaptionBand, LettersAreATwentyFifthOfTheHeight) {
    for (const auto& [width, height] : {std::pair{1920, 1080}, {854, 480}, {640, 640}}) {
        const FilmedScene scene = with_captions(width, height, {"Where do the big grains go?"});
        const CaptionPlan plan = plan_captions(scene.film, width);
        EXPECT_NEAR(plan.letters, height / 25.0, 1e-9);
        EXPECT_EQ(plan.lines, 1);
        EXPECT_FALSE(plan.cut);
    }
}

// The band is below everything else, as wide as the picture, and there before and after the captions.
TEST(CaptionBand, HasARoomOfItsOwn) {
    for (const WordPlace place : {WordPlace::gutters, WordPlace::plates}) {
        FilmedScene scene = with_captions(854, 480, {"one", "two words", "three words that are longer"});
        scene.film.words = place;
        const PictureLayout layout = plan_layout(scene);
        EXPECT_EQ(layout.caption.y + layout.caption.height, 480);
        EXPECT_EQ(layout.caption.width, 854);
        for (const Rectangle& other : {layout.first, layout.second, layout.port})
            EXPECT_LE(other.y + other.height, layout.caption.y);
        Renderer renderer(scene, 1, gl::Provider::automatic);
        Picture picture;
        renderer.draw_into(picture, at(0.5), "", 0);
        EXPECT_TRUE(has_ink(picture, layout.caption));
        renderer.draw_into(picture, at(9), "", 0);
        EXPECT_FALSE(has_ink(picture, layout.caption)) << "no caption is left when its time is over";
        renderer.draw_into(picture, at(2.5), "", 0);
        EXPECT_TRUE(has_ink(picture, layout.caption));
    }
}

TEST(CaptionBand, IsNotThereWithoutCaptions) {
    FilmedScene scene = wedge(854, 480);
    EXPECT_EQ(plan_layout(scene).caption.height, 0);
    scene = with_captions(854, 480, {"one"});
    scene.film.word_kinds.captions = false;
    EXPECT_EQ(plan_layout(scene).caption.height, 0);
}

TEST(CaptionBand, LongCaptionsWrapThenShrinkThenAreCut) {
    std::string sentence =
        "A sentence that is so long that it takes a second line of the picture, or a third line at most.";
    const CaptionPlan two = plan_captions(with_captions(854, 480, {sentence}).film, 854);
    EXPECT_GE(two.lines, 2);
    EXPECT_NEAR(two.letters, 480 / 25.0, 1e-9);
    std::string page;
    for (int k = 0; k < 6; ++k) page += sentence + " ";
    const CaptionPlan small = plan_captions(with_captions(1920, 1080, {page}).film, 1920);
    EXPECT_LT(small.letters, 1080 / 25.0);
    EXPECT_FALSE(small.cut);
    for (int k = 0; k < 4; ++k) page += page;
    const FilmedScene endless = with_captions(854, 480, {page});
    EXPECT_TRUE(plan_captions(endless.film, 854).cut);
    EXPECT_LE(plan_layout(endless).caption.height, 0.25 * 480);
    EXPECT_THAT(plan_layout(endless).left_out, testing::Contains("a part of a caption"));
}

}  // namespace
}  // namespace grainreel::test
