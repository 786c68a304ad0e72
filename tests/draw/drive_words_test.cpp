// What the frame says of a drive that changes, and the captions beside it.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "engine/scene/drive/drive_schedule.hpp"
#include "render/draw/words/captions.hpp"
#include "tests/draw/support.hpp"

namespace grainreel::test {
namespace {

using testing::ElementsAre;
using Kind = DriveStage::Kind;

double amplitude_of(double g_level, double frequency) {
    return g_level * 9.81 / std::pow(2 * pi * frequency, 2);
}

// From 20 Hz at 1 s over 3 periods to 40 Hz, at 2 s to rest, from 3 s on taps.
Scene changing() {
    Scene scene = wedge();
    scene.drive.amplitude = amplitude_of(2, 20);
    scene.drive.stages = {{Kind::vibrate, 1, 3, 40, amplitude_of(3, 40)},
                          {Kind::rest, 2, 3, 0, 0},
                          {Kind::taps, 3, 3, 30, amplitude_of(4, 30), 0.5}};
    return scene;
}

std::vector<std::string> lines_at(const Scene& scene, double time) {
    Frame frame;
    frame.time = time;
    frame.cycles = DriveSchedule(scene.drive).times().cycles(time);
    return drive_lines(scene, frame);
}

TEST(DriveWords, AreThoseOfTheStageThatIsOn) {
    const Scene scene = changing();
    EXPECT_THAT(lines_at(scene, 0.5), ElementsAre("f = 20 Hz", "Γ = 2", "a = 1.24 mm"));
    // Half of the change, which takes 2 x 3 / 60 s: 30 Hz and Gamma 2.5.
    EXPECT_THAT(lines_at(scene, 1.05), ElementsAre("f = 30 Hz", "Γ = 2.5", "a = 690 µm"));
    EXPECT_THAT(lines_at(scene, 1.5), ElementsAre("f = 40 Hz", "Γ = 3", "a = 466 µm"));
    EXPECT_THAT(lines_at(scene, 2.5), ElementsAre("at rest"));
    EXPECT_THAT(lines_at(scene, 3.3), ElementsAre("taps of 30 Hz", "Γ = 4", "every 0.5 s"));
    EXPECT_EQ(longest_drive_lines(scene).front(), "taps of 30 Hz");
    EXPECT_THAT(lines_at(wedge(), 0), testing::Contains("a = 2 mm"));
}

TEST(CaptionWords, AreThereInTheirTime) {
    Scene scene = wedge();
    scene.film.captions = {{1, 2, "one", 0}, {2, 3, "two", 0}};
    const auto at = [&](double time) {
        Frame frame;
        frame.time = time;
        return note_text(scene, frame);
    };
    EXPECT_EQ(at(0.9), "");
    EXPECT_EQ(at(1), "one");
    EXPECT_EQ(at(2), "two");
    EXPECT_EQ(at(3), "");
    scene.film.shows.live_words = {{"always", "", "", 1}};
    EXPECT_EQ(at(2.5), "always\n\ntwo");
    EXPECT_THAT(longest_notes(scene), ElementsAre("always", "always\n\none", "always\n\ntwo"));
}

}  // namespace
}  // namespace grainreel::test
