// Tests of the words on the frame about a drive that changes, and of the captions beside it.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "engine/scene/drive_schedule.hpp"
#include "render/picture/panels/panel_words.hpp"
#include "render/picture/words/captions.hpp"
#include "render/scene/filmed_scene.hpp"
#include "tests/draw/support.hpp"

namespace grainreel::test {
namespace {

using testing::ElementsAre;
using Kind = DriveStage::Kind;

double amplitude_of(double g_level, double frequency) {
    return g_level * 9.81 / std::pow(2 * pi * frequency, 2);
}

// The drive goes from 20 Hz at 1 s over 3 periods to 40 Hz, to rest at 2 s, and makes taps from 3 s on.
FilmedScene changing() {
    FilmedScene scene = wedge();
    scene.drive.amplitude = amplitude_of(2, 20);
    scene.drive.stages = {{Kind::vibrate, 1, 3, 40, amplitude_of(3, 40)},
                          {Kind::rest, 2, 3, 0, 0},
                          {Kind::taps, 3, 3, 30, amplitude_of(4, 30), 0.5}};
    return scene;
}

std::vector<std::string> lines_at(const FilmedScene& scene, double time) {
    State frame;
    frame.time = time;
    frame.cycles = DriveSchedule(scene.drive).times().cycles(time);
    return drive_lines(scene, frame);
}

TEST(DriveWords, AreThoseOfTheStageThatIsOn) {
    const FilmedScene scene = changing();
    EXPECT_THAT(lines_at(scene, 0.5), ElementsAre("f = 20 Hz", "Γ = 2", "a = 1.24 mm"));
    // This is half of the change, which takes 2 x 3 / 60 s: 30 Hz and Gamma 2.5.
    EXPECT_THAT(lines_at(scene, 1.05), ElementsAre("f = 30 Hz", "Γ = 2.5", "a = 690 µm"));
    EXPECT_THAT(lines_at(scene, 1.5), ElementsAre("f = 40 Hz", "Γ = 3", "a = 466 µm"));
    EXPECT_THAT(lines_at(scene, 2.5), ElementsAre("at rest"));
    EXPECT_THAT(lines_at(scene, 3.3), ElementsAre("taps of 30 Hz", "Γ = 4", "every 0.5 s"));
    EXPECT_EQ(longest_drive_lines(scene).front(), "taps of 30 Hz");
}

// The ramp s(u) = 10 u^3 - 15 u^4 + 6 u^5 is a half in its middle, and the container moves with that share.
TEST(DriveWords, GrowWithTheDriveAtFirst) {
    FilmedScene scene = wedge();
    scene.drive.ramp = 4;
    scene.drive.amplitude = amplitude_of(3, 20);
    const auto at = [&](double cycles) {
        State frame;
        frame.time = cycles / 20;
        frame.cycles = cycles;
        return drive_lines(scene, frame);
    };
    EXPECT_THAT(at(-1), ElementsAre("f = 20 Hz", "Γ = 0", "a = 0 µm"));
    EXPECT_THAT(at(0), ElementsAre("f = 20 Hz", "Γ = 0", "a = 0 µm"));
    // s(1/4) = 0.1035; the words have as many decimals as those of the whole drive.
    EXPECT_THAT(at(1), ElementsAre("f = 20 Hz", "Γ = 0.31", "a = 190 µm"));
    EXPECT_THAT(at(2), ElementsAre("f = 20 Hz", "Γ = 1.5", "a = 930 µm"));
    EXPECT_THAT(at(4), ElementsAre("f = 20 Hz", "Γ = 3", "a = 1.86 mm"));
    EXPECT_TRUE(drive_lines_change(scene.drive));
    for (double cycles = 0; cycles < 4; cycles += 0.01)
        for (std::size_t k = 0; k < 3; ++k)
            EXPECT_LE(at(cycles)[k].size(), longest_drive_lines(scene)[k].size()) << at(cycles)[k];
    scene.drive.ramp = 0;
    EXPECT_THAT(at(0), testing::Contains("Γ = 3"));
    EXPECT_FALSE(drive_lines_change(scene.drive));
}

// The numbers of taps are longer than those of a vibration.
TEST(DriveWords, ShortOnesHaveRoomForTaps) {
    const FilmedScene scene = changing();
    State frame;
    frame.time = 3.3;
    frame.cycles = DriveSchedule(scene.drive).times().cycles(frame.time);
    EXPECT_EQ(shaking_text(scene, frame), "taps of 30 Hz, Γ = 4");
    EXPECT_EQ(longest_shaking_text(scene), shaking_text(scene, frame));
    EXPECT_EQ(longest_shaking_text(scene, {true, false}), "taps of 30 Hz");
}

TEST(CaptionWords, AreThereInTheirTime) {
    FilmedScene scene = wedge();
    scene.film.captions = {{1, 2, "one", 0}, {2, 3, "two", 0}};
    const auto at = [&](double time) {
        Shot frame;
        frame.time = time;
        return panel_note(scene, frame);
    };
    EXPECT_EQ(at(0.9), "");
    EXPECT_EQ(at(1), "one");
    EXPECT_EQ(at(2), "two");
    EXPECT_EQ(at(3), "");
    scene.run.duration = 3;  // players stop at the last picture
    EXPECT_EQ(at(3), "two");
    EXPECT_EQ(at(3.1), "");
    scene.film.shows.live_words = {{"always", "", "", 1}};
    EXPECT_EQ(at(2.5), "always\n\ntwo");
    EXPECT_EQ(longest_note(scene), "always");
    EXPECT_THAT(longest_panel_notes(scene), ElementsAre("always", "always\n\none", "always\n\ntwo"));
}

}  // namespace
}  // namespace grainreel::test
