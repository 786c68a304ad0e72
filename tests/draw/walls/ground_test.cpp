// Tests of the ground under the container: how low it lies, and where the shadow of the floor's plate falls.
#include "render/picture/container/ground.hpp"

#include <gtest/gtest.h>

#include "engine/state/body.hpp"
#include "render/picture/container/drawing_kit.hpp"
#include "tests/draw/support.hpp"

namespace grainreel::test {
namespace {

const Vec3 straight_down(0, 0, 1);  // towards a lamp right above

FilmedScene box_on_ground(const Vec3& direction, double exaggerate) {
    FilmedScene scene = wedge();
    scene.container.shape = Container::Shape::box;
    scene.container.half_width = 0.05;
    scene.container.height = 0.1;
    scene.drive.direction = direction;
    scene.drive.amplitude = 0.006;
    scene.film.exaggerate = exaggerate;
    return scene;
}

// Where the ground takes more than three quarters of the plate's shadow, which walls do not reach, along y:
// its middle and its width, m.
struct Shadow {
    double middle, width, cell;
};
Shadow shadow_of_plate(const FilmedScene& scene, const BodyPose& floor) {
    State frame = frame_of({});
    frame.container() = frame.floor() = floor;
    ShadowMap map(scene);
    map.cast(frame, straight_down);
    const double cell = map.side() / ShadowMap::kSide;
    double first = 1e9, last = -1e9;
    for (int j = 0; j < ShadowMap::kSide; ++j)
        for (int i = 0; i < ShadowMap::kSide; ++i) {
            if (map.cells()[static_cast<std::size_t>(j * ShadowMap::kSide + i)] < 0.5f) continue;
            first = std::min(first, map.low().y() + j * cell);
            last = std::max(last, map.low().y() + (j + 1) * cell);
        }
    return {0.5 * (first + last), last - first, cell};
}

TEST(Ground, LiesUnderTheStrokeAsItIsDrawn) {
    for (const Vec3& direction : {Vec3(0, 0, 1), Vec3(0, 0.8, 0.6), Vec3(0, 0.6, -0.8), Vec3(0, 1, 0)})
        for (const double exaggerate : {1.0, 5.0}) {
            const FilmedScene scene = box_on_ground(direction, exaggerate);
            const double thickness = drawn_thickness(scene.container);
            const double floor = -1.4 * thickness - exaggerate * 0.006 * std::abs(direction.z());
            EXPECT_NEAR(ShadowMap(scene).height(), floor, 1e-12)
                << direction.transpose() << ", " << exaggerate << " times";
        }
}

TEST(Ground, LiesUnderAContainerThatTurns) {
    FilmedScene scene = box_on_ground({0, 0, 1}, 1);
    scene.drive.present = false;
    scene.container.turn = BodyTurn{.axis = Vec3(1, 0.2, 0.1).normalized(), .through = {0, 0.01, 0.04}};
    const BodyTurn& turn = *scene.container.turn;
    double lowest = 1e9;
    for (int k = 0; k < 3600; ++k) {
        const Eigen::AngleAxisd by(2 * pi * k / 3600, turn.axis);
        for (const Vec3& corner : prism_corners(scene.container, 1e300))
            lowest = std::min(lowest, (turn.through + by * (corner - turn.through)).z());
    }
    EXPECT_NEAR(ShadowMap(scene).height(), lowest, 1e-6);
}

TEST(Ground, HasTheShadowWhereverTheDriveIsDrawn) {
    const FilmedScene scene = box_on_ground({0, 1, 0}, 10);
    const double width = 2 * outer_floor_half_width(scene.container);
    for (const double offset : {-0.06, 0.0, 0.06}) {
        BodyPose floor;
        floor.place = {0, offset, 0};
        const Shadow shadow = shadow_of_plate(scene, floor);
        EXPECT_NEAR(shadow.middle, offset, 1.5 * shadow.cell);
        EXPECT_NEAR(shadow.width, width, 4 * shadow.cell);
    }
}

// The plate has turned by 60 degrees. Light from above then meets half of its width, and its thickness.
TEST(Ground, HasTheShadowOfAPlateThatHasTurned) {
    FilmedScene scene = box_on_ground({0, 0, 1}, 1);
    scene.drive.present = false;
    scene.container.height = 1e-4;  // walls that lean throw shadows too
    scene.container.turn = BodyTurn{.axis = {1, 0, 0}, .through = {0, 0, 0.05}, .rate = pi / 3};
    const BodyPose floor = bodies_of(scene)[kFloorBody].at(DrivePose{.time = 1});
    const double thick = 1.4 * drawn_thickness(scene.container);
    const Shadow shadow = shadow_of_plate(scene, floor);
    EXPECT_NEAR(shadow.middle, floor.moved({0, 0, -0.5 * thick}).y(), 1.5 * shadow.cell);
    EXPECT_NEAR(shadow.width,
                2 * outer_floor_half_width(scene.container) * std::cos(pi / 3) + thick * std::sin(pi / 3),
                4 * shadow.cell);
}

// Beside a long wall of height h the ground loses (1 - d / root(d^2 + h^2)) / 2 of the light from all around.
// The vessel touches the ground, so this begins at its foot.
TEST(Ground, IsDarkAtTheFootOfTheVessel) {
    FilmedScene scene = box_on_ground({0, 0, 1}, 1);
    scene.drive.present = false;
    ShadowMap map(scene);
    map.cast(frame_of({}), straight_down);
    const double high = 0.3 * extent_of(scene).size().norm() / std::sqrt(3.0);
    const double cell = map.side() / ShadowMap::kSide, foot = outer_floor_half_width(scene.container);
    const int i = static_cast<int>((0 - map.low().x()) / cell);
    int beside = 0;
    for (int j = 0; j < ShadowMap::kSide; ++j) {
        const double d = map.low().y() + (j + 0.5) * cell - foot;
        if (d <= 0) continue;
        EXPECT_NEAR(map.closed()[static_cast<std::size_t>(j * ShadowMap::kSide + i)],
                    0.5 * (1 - d / std::hypot(d, high)), 1e-6);
        beside += d < high;
    }
    EXPECT_GT(beside, 5);
}

// A wall that the eye sees as solid throws a shadow that begins at its foot and goes away from the lamp.
TEST(Ground, HasTheShadowOfTheWalls) {
    FilmedScene scene = box_on_ground({0, 0, 1}, 1);
    scene.drive.present = false;
    ShadowMap map(scene);
    map.cast(frame_of({}), Vec3(0, -0.6, 0.8));
    const double cell = map.side() / ShadowMap::kSide, foot = outer_floor_half_width(scene.container);
    const auto taken = [&](double y) {
        return map.cells()[static_cast<std::size_t>(static_cast<int>((y - map.low().y()) / cell) *
                                                        ShadowMap::kSide +
                                                    static_cast<int>(-map.low().x() / cell))];
    };
    EXPECT_GT(taken(foot + 0.5 * 0.1 * 0.75), 0.3);
    EXPECT_LT(taken(-foot - 8 * cell), 0.01);
}

TEST(Ground, LiesWhereGrainsLeave) {
    FilmedScene scene = box_on_ground({0, 0, 1}, 1);
    scene.drive.present = false;
    scene.exits.push_back({.low = {-1, -1, -2}, .high = {1, 1, -0.3}});
    EXPECT_NEAR(ShadowMap(scene).height(), -0.3, 1e-12);
}

// A level camera's ground is level for the camera, whatever way gravity has in the box.
TEST(Ground, IsLevelForTheCamera) {
    FilmedScene scene = box_on_ground({0, 0, 1}, 1);
    scene.drive.present = false;
    scene.film.camera.up = Vec3(0, std::sin(0.2), std::cos(0.2));
    double lowest = 1e9;
    for (const Vec3& corner : prism_corners(scene.container, 1e300))
        lowest = std::min(lowest, corner.dot(scene.film.camera.up));
    const ShadowMap map(scene);
    EXPECT_NEAR(map.height(), lowest, 1e-12);
    EXPECT_NEAR((map.in_lab({0, 0, 1}) - scene.film.camera.up).norm(), 0, 1e-12);
}

// Ground and backdrop have two tones, the same along each row of the picture, also below the words.
TEST(Ground, GoesOverIntoTheBackdrop) {
    FilmedScene scene = box_on_ground({0, 0, 1}, 1);
    scene.film.width = 640, scene.film.height = 360;
    const Palette palette = palette_of(scene.film);
    const Rectangle port{100, 0, 440, 360};
    Ground ground(scene, palette, port);
    View view = view_of(scene);
    view.port = port;
    ground.stand(view);
    ground.update(frame_of({}), view);
    std::vector<std::vector<std::uint32_t>> rows(360, std::vector<std::uint32_t>(440));
    for (int y = 0; y < 360; ++y) ground.paint(y, rows[static_cast<std::size_t>(y)].data());
    const auto level = [&](int x, int y) {
        return rows[static_cast<std::size_t>(y)][static_cast<std::size_t>(x)] & 255;
    };
    Picture words(640, 360);
    std::fill(words.rgba.begin(), words.rgba.end(), std::uint8_t{255});
    words.pixel(20, 300)[0] = 30;  // ink
    ground.tint({0, 0, 100, 360}, words);
    for (int y = 0; y < 360; y += 7) EXPECT_EQ(words.pixel(10, y)[0], level(0, y)) << y;
    EXPECT_LT(words.pixel(20, 300)[0], 30);
    EXPECT_EQ(words.pixel(200, 300)[0], 255);  // not in the part
    EXPECT_GT(level(5, 0), 250);
    int step = 0;
    for (int y = 40; y + 20 < 320; ++y)
        step = std::max(step, static_cast<int>(level(5, y)) - static_cast<int>(level(5, y + 20)));
    EXPECT_GE(step, 3);                      // the bend
    EXPECT_LT(level(5, 270), level(5, 40));  // the ground is darker than the backdrop
}

}  // namespace
}  // namespace grainreel::test
