// Tests of forces on a body, drawn as arrows.
#include "render/picture/marks/force_marks.hpp"

#include <gtest/gtest.h>

#include "render/scene/filmed_scene.hpp"
#include "tests/draw/support.hpp"

namespace grainreel::test {
namespace {

// The camera looks along -x: y is to the right, z upwards.
TEST(PointForces, ArrowsAreAsLongAsTheForcesAndEndWhereTheyPush) {
    const View view = view_of(straight_on());
    const Vec3 at(0, 0.01, 0.05);
    const std::vector<PointForce> forces{
        {at, {0, 2, 0}, false}, {at, {0, 0, -1}, false}, {at, {0, 1, 0}, true}};
    const std::vector<ForceArrow> arrows = force_arrows(view, forces, 1);
    ASSERT_EQ(arrows.size(), 3u);
    const double longest = longest_force_arrow(view);
    EXPECT_GT(longest, 0.1 * std::min(view.port.width, view.port.height));
    const Pixel point = view.project(at);
    EXPECT_LT((arrows[0].tip - point).norm(), 1e-6);
    EXPECT_LT((arrows[0].tail - (point - longest * Pixel(1, 0))).norm(), 1e-6);
    EXPECT_LT((arrows[1].tip - point).norm(), 1e-6);
    EXPECT_LT((arrows[1].tail - (point - 0.5 * longest * Pixel(0, 1))).norm(), 1e-6);  // y is downwards
    EXPECT_LT((arrows[2].tail - point).norm(), 1e-6) << "a force that pulls begins where it acts";
    EXPECT_LT((arrows[2].tip - (point + 0.5 * longest * Pixel(1, 0))).norm(), 1e-6);
}

TEST(PointForces, AWeakForceIsLongEnoughToBeSeen) {
    const View view = view_of(straight_on());
    const auto length = [&](double force) {
        const std::vector<PointForce> forces{{{0, 0, 0.05}, {0, 1, 0}, false},
                                             {{0, 0, 0.05}, {0, force, 0}, false}};
        const ForceArrow arrow = force_arrows(view, forces, 1)[1];
        return (arrow.tip - arrow.tail).norm();
    };
    EXPECT_GT(length(1e-9), 5);
    EXPECT_NEAR(length(1e-9), length(1e-6), 1e-9);
    EXPECT_LT(length(1e-9), 0.2 * length(1));
    EXPECT_EQ(force_arrows(view, {{{0, 0, 0}, {0, 0, 0}, false}}, 1).size(), 0u);
}

// Around a grain of 1/40 pixel the ends of arrows lie on a circle, and around a large grain on its surface.
TEST(PointForces, ArrowsLeaveASmallGrainFreeToBeSeen) {
    const View view = view_of(straight_on());
    const Vec3 centre(0, 0, 0.05);
    const auto ends = [&](double radius) {
        std::vector<PointForce> forces;
        for (const Vec3& out : {Vec3(0, 1, 0), Vec3(0, 0, 1), Vec3(0, -0.6, 0.8)})
            forces.push_back({centre + radius * out, -out, false, centre});
        std::vector<double> distances;
        for (const ForceArrow& arrow : force_arrows(view, forces, 2)) {
            EXPECT_NEAR((arrow.tip - arrow.tail).norm(), longest_force_arrow(view), 1e-6);
            distances.push_back((arrow.tip - view.project(centre)).norm());
        }
        return distances;
    };
    const double tiny = 0.025 / view.focal;
    for (const double distance : ends(tiny)) EXPECT_NEAR(distance, 20, 1e-6);
    for (const double distance : ends(0.02)) EXPECT_NEAR(distance, 0.02 * view.focal, 1e-6);
    EXPECT_GT(0.02 * view.focal, 20);
}

int pixels_like(const Picture& picture, const Rectangle& port, const Colour& colour) {
    int count = 0;
    for (int y = port.y; y < port.y + port.height; ++y)
        for (int x = port.x; x < port.x + port.width; ++x) {
            const std::uint8_t* p = picture.pixel(x, y);
            count += std::abs(p[0] - 255 * colour.red) + std::abs(p[1] - 255 * colour.green) +
                         std::abs(p[2] - 255 * colour.blue) <
                     12;
        }
    return count;
}

// Grain 0 stands before grain 1, which is pointed out.
TEST(PointForces, ThePictureShowsTheGrainThroughPaleOnesAndItsArrows) {
    const FilmedScene scene = straight_on();
    const State frame =
        frame_of({{{0.015, 0, 0.08}, 0.008, 0}, {{-0.01, 0, 0.08}, 0.008, 1}, {{0, 0.04, 0.08}, 0.008, 0}});
    const View view = view_of(scene);
    const auto at = [&](const Picture& picture, const Vec3& place) {
        const Pixel pixel = view.project(place);
        return hue(picture.pixel(view.port.x + static_cast<int>(pixel.x()),
                                 view.port.y + static_cast<int>(pixel.y())));
    };
    Renderer plain(scene, 1);
    const Picture before = plain.draw(frame, "");
    Renderer renderer(scene, 1);
    renderer.point_out({{1}, {{{0, -0.008, 0.08}, {0, 1, 0}, false}}});
    const Picture after = renderer.draw(frame, "");
    EXPECT_NEAR(at(before, frame.position[0]), hue(blue), 15);
    EXPECT_NEAR(at(after, frame.position[0]), hue(orange), 25) << "the grain behind shows";
    EXPECT_NEAR(at(after, frame.position[2]), hue(blue), 15);
    const Pixel aside = view.project(frame.position[2]);
    const auto lightness = [&](const Picture& picture) {
        const std::uint8_t* p = picture.pixel(view.port.x + static_cast<int>(aside.x()),
                                              view.port.y + static_cast<int>(aside.y()));
        return p[0] + p[1] + p[2];
    };
    EXPECT_GT(lightness(after), lightness(before) + 60) << "others are pale";
    const Colour force = make_palette(scene.film.background).force;
    EXPECT_LT(pixels_like(before, view.port, force), 5);
    EXPECT_GT(pixels_like(after, view.port, force), 60);
    // A force along the line of sight is drawn as a circle.
    renderer.point_out({{1}, {{{0, -0.008, 0.08}, {1, 0, 0}, false}}});
    EXPECT_GT(pixels_like(renderer.draw(frame, ""), view.port, force), 30);
}

}  // namespace
}  // namespace grainreel::test
