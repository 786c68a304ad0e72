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

// Where the ground takes more than half of the plate's shadow, along y: its middle and its width, m.
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
            EXPECT_NEAR(ShadowMap(scene).height(), floor - 0.15 * thickness, 1e-12)
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
    EXPECT_NEAR(ShadowMap(scene).height(), lowest - 0.15 * drawn_thickness(scene.container), 1e-6);
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
    scene.container.turn = BodyTurn{.axis = {1, 0, 0}, .through = {0, 0, 0.05}, .rate = pi / 3};
    const BodyPose floor = bodies_of(scene)[kFloorBody].at(DrivePose{.time = 1});
    const double thick = 1.4 * drawn_thickness(scene.container);
    const Shadow shadow = shadow_of_plate(scene, floor);
    EXPECT_NEAR(shadow.middle, floor.moved({0, 0, -0.5 * thick}).y(), 1.5 * shadow.cell);
    EXPECT_NEAR(shadow.width,
                2 * outer_floor_half_width(scene.container) * std::cos(pi / 3) + thick * std::sin(pi / 3),
                4 * shadow.cell);
}

}  // namespace
}  // namespace grainreel::test
