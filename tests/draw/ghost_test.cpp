// Tests of transparent species, and of pictures of more than one moment.
#include <gtest/gtest.h>

#include <cmath>

#include "render/picture/base/picture.hpp"
#include "render/picture/base/shot.hpp"
#include "render/picture/whole/layers.hpp"
#include "render/picture/whole/renderer.hpp"
#include "render/scene/filmed_scene.hpp"
#include "tests/draw/support.hpp"

namespace grainreel::test {
namespace {

// There are two layers: species 0 is nearer to the camera, which looks along -x, and species 1 is behind and
// beside it.
const std::vector<Ball> kBalls{{{0.02, 0.00, 0.08}, 0.010, 0},
                               {{0.02, 0.018, 0.085}, 0.008, 0},
                               {{0.00, -0.01, 0.08}, 0.010, 1},
                               {{-0.01, 0.012, 0.09}, 0.009, 1},
                               {{0.025, -0.03, 0.08}, 0.008, 1}};

// Index of the ball nearest to the camera on the pixel's line of sight; -1 for none, and -2 too close to an
// outline.
int ball_at(const View& view, double x, double y) {
    int nearest = -1;
    for (int i = 0; i < static_cast<int>(kBalls.size()); ++i) {
        const Ball& ball = kBalls[i];
        const double away = (view.project(ball.at) - Pixel(x, y)).norm();
        const double radius = ball.radius * view.focal;
        if (std::abs(away - radius) < 2) return -2;
        const auto depth = [&](const Ball& b) {
            const double beside = (view.project(b.at) - Pixel(x, y)).norm() / view.focal;
            return b.at.x() + std::sqrt(std::max(0.0, b.radius * b.radius - beside * beside));
        };
        if (away < radius && (nearest < 0 || depth(ball) > depth(kBalls[nearest]))) nearest = i;
    }
    return nearest;
}

TEST(Ghosts, LetTheOthersShowThroughAndTakeNothingFromThem) {
    FilmedScene scene = straight_on();
    const Shot frame = frame_of(kBalls);
    const Picture opaque = Renderer(scene, 1).draw(frame, "");
    scene.film.shows.hidden = {0};
    const Picture without = Renderer(scene, 1).draw(frame, "");
    scene.film.shows.hidden = {};
    scene.film.shows.ghosts = {0};
    const Picture ghosts = Renderer(scene, 1).draw(frame, "");
    const View view = view_of(scene);
    const double strength = 90.0 / 255;  // the same as in compose.cpp
    int through = 0, others = 0;
    for (int y = view.port.y; y < view.port.y + view.port.height; ++y)
        for (int x = view.port.x; x < view.port.x + view.port.width; ++x) {
            const int ball = ball_at(view, x - view.port.x + 0.5, y - view.port.y + 0.5);
            if (ball == -2) continue;
            const bool ghost = ball >= 0 && kBalls[ball].species == 0;
            ++(ghost ? through : others);
            for (int c = 0; c < 3; ++c) {
                const double below = without.pixel(x, y)[c], colour = opaque.pixel(x, y)[c];
                const double expected = ghost ? below + strength * (colour - below) : below;
                // There are two roundings, and glass in front of both that was drawn before.
                ASSERT_NEAR(ghosts.pixel(x, y)[c], expected, ghost ? 4 : 0) << x << ", " << y;
            }
        }
    EXPECT_GT(through, 2000);
    EXPECT_GT(others, 100000);
}

TEST(Ghosts, DrawTheSameForAnyNumberOfThreads) {
    FilmedScene scene = straight_on();
    scene.film.shows.ghosts = {0};
    const Shot frame = frame_of(kBalls);
    const Picture alone = Renderer(scene, 1).draw(frame, "");
    for (const int threads : {2, 3}) EXPECT_EQ(Renderer(scene, threads).draw(frame, "").rgba, alone.rgba);
}

TEST(Exposure, IsTheMeanInLinearLight) {
    const Rectangle port{1, 0, 2, 1};
    Exposure exposure(port);
    Picture picture(3, 1);
    const auto fill = [&](std::uint8_t left, std::uint8_t alpha) {
        for (int x = 1; x < 3; ++x)
            for (int c = 0; c < 3; ++c) picture.pixel(x, 0)[c] = left;
        picture.pixel(1, 0)[3] = 255;
        picture.pixel(2, 0)[3] = alpha;
    };
    for (const int bright : {0, 1, 1, 1}) {
        const auto level = static_cast<std::uint8_t>(255 * bright);
        fill(level, level);
        exposure.add(picture);
    }
    exposure.develop(picture);
    // The value is that of IEC 61966-2-1 for 3/4 of full light.
    EXPECT_EQ(picture.pixel(1, 0)[0], std::lround(255 * (1.055 * std::pow(0.75, 1 / 2.4) - 0.055)));
    EXPECT_EQ(picture.pixel(1, 0)[3], 255);
    // An empty place has no colour: the white of three moments is seen there for 3/4 of the time.
    EXPECT_EQ(picture.pixel(2, 0)[0], 255);
    EXPECT_EQ(picture.pixel(2, 0)[3], 191);
    for (int level = 0; level < 256; level += 5) {
        fill(static_cast<std::uint8_t>(level), 255);
        exposure.add(picture);
        exposure.add(picture);
        exposure.develop(picture);
        EXPECT_EQ(picture.pixel(1, 0)[1], level);
    }
}

// The picture's pixel in the middle of a grain at (0, y, 0.08).
std::pair<int, int> whole(const View& view, double y) {
    const Pixel middle = view.project({0.0, y, 0.08});
    return {view.port.x + static_cast<int>(middle.x()), view.port.y + static_cast<int>(middle.y())};
}

TEST(Exposure, ShowsEachMomentsGrainsAndTheLastOnesMarks) {
    FilmedScene scene = straight_on();
    scene.film.shows.highlighted = {0};
    const auto at = [](double y) { return frame_of({{{0, y, 0.08}, 0.008, 0}}); };
    const Picture here = Renderer(scene, 1).draw(at(0.02), "");
    Shot exposed = at(0.02);
    for (const double y : {-0.02, 0.0}) exposed.exposed.push_back(std::make_shared<const Shot>(at(y)));
    Renderer renderer(scene, 1);
    const Picture streak = renderer.draw(exposed, "");
    const View view = view_of(scene);
    const Picture empty = Renderer(scene, 1).draw(frame_of({}), "");
    for (const double y : {-0.02, 0.0, 0.02}) {
        const auto [px, py] = whole(view, y);
        const auto [qx, qy] = whole(view, 0.02);
        const std::uint8_t* grain = here.pixel(qx, qy);
        for (int c = 0; c < 3; ++c) {
            const double third =
                to_srgb((to_linear(grain[c] / 255.0) + 2 * to_linear(empty.pixel(px, py)[c] / 255.0)) / 3);
            EXPECT_NEAR(streak.pixel(px, py)[c], 255 * third, 3);
        }
    }
    // The ring has its full strength around the last place, and is nowhere else.
    const auto [middle, row] = whole(view, 0.02);
    const int ring = middle + static_cast<int>(0.008 * view.focal) + 3;
    int darkest = 255;
    for (int x = ring - 4; x < ring + 8; ++x)
        darkest = std::min(darkest, std::abs(streak.pixel(x, row)[1] - here.pixel(x, row)[1]));
    EXPECT_LE(darkest, 1);
}

}  // namespace
}  // namespace grainreel::test
