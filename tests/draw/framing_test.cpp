// Tests of what the camera frames unless it is told: the container, its bed, or the room that the grains
// reach.
#include "render/picture/camera/framing.hpp"

#include <gtest/gtest.h>

#include "engine/measure/columns.hpp"
#include "engine/plan/reach.hpp"
#include "render/scene/filmed_scene.hpp"
#include "tests/draw/support.hpp"

namespace grainreel::test {
namespace {

using enum FramingScope;

FilmedScene framed(FramingScope frame, Container::Shape shape = Container::Shape::box, int width = 1280,
                   int height = 720) {
    FilmedScene scene = wedge(width, height);
    scene.container.shape = shape;
    scene.container.height = 0.5;
    set_species(scene, {{"small", 1500, 0.005, blue}});
    scene.film.camera.frame = frame;
    return scene;
}

double scale_of(const FilmedScene& scene) {
    return view_of(scene).pixels_per_metre(framed_middle(scene));
}

TEST(FramedPart, IsAsHighAsTheKeySays) {
    const double a = 0.002;
    FilmedScene scene = framed(reach);
    EXPECT_DOUBLE_EQ(framed_part(scene).top, *estimated_reach(scene));
    EXPECT_TRUE(framed_part(scene).cut);
    scene.film.camera.reach = 0.2;
    EXPECT_DOUBLE_EQ(framed_part(scene).top, 0.2);
    scene.film.exaggerate = 4;  // the picture shows grains moved with the container, three strokes further
    EXPECT_DOUBLE_EQ(framed_part(scene).top, 0.2 + 3 * a);
    scene.film.exaggerate = 1;
    scene.film.camera.reach = 0.49;  // all but the lid, which is not worth a cut
    EXPECT_DOUBLE_EQ(framed_part(scene).top, 0.5);
    EXPECT_FALSE(framed_part(scene).cut);
    EXPECT_DOUBLE_EQ(framed_part(framed(bed)).top, *resting_top(framed(bed)) + a);
    EXPECT_DOUBLE_EQ(framed_part(framed(container)).top, 0.5);
    EXPECT_FALSE(framed_part(framed(container)).cut);
    scene = framed(reach);
    scene.film.camera.elevation = 80;
    EXPECT_FALSE(framed_part(scene).cut);
}

TEST(FramedPart, AboveAnOpenTopIsWhatTheGrainsReach) {
    FilmedScene scene = framed(reach);
    scene.container.lid = false;
    scene.film.camera.reach = 0.6;
    EXPECT_DOUBLE_EQ(framed_part(scene).top, 0.6);
    scene.film.camera.reach = 3;
    EXPECT_DOUBLE_EQ(framed_part(scene).top, 0.75);  // one and a half times as high as the container
}

// Floor and marks included, everything is inside the margin on all sides and touches it on two opposite ones,
// while the container goes beyond the picture.
TEST(FramedPart, FillsThePicture) {
    for (const auto shape : {Container::Shape::box, Container::Shape::wedge, Container::Shape::cylinder})
        for (const auto& [width, height] : {std::pair{1280, 720}, {720, 1280}, {640, 360}})
            for (const double field : {0.0, 25.0, 60.0})
                for (const double elevation : {-10.0, 10.0, 45.0}) {
                    FilmedScene scene = framed(reach, shape, width, height);
                    scene.film.camera.elevation = elevation;
                    scene.film.camera.field_of_view = field;
                    const View view = view_of(scene);
                    const double margin = type_scale(scene.film).margin;
                    Pixel low(1e9, 1e9), high(-1e9, -1e9);
                    for (const Vec3& point : framing_points(scene)) {
                        low = low.cwiseMin(view.project(point));
                        high = high.cwiseMax(view.project(point));
                    }
                    const Pixel size(view.port.width, view.port.height);
                    ASSERT_GT(low.minCoeff(), margin - 1e-3);
                    ASSERT_GT((size - high).minCoeff(), margin - 1e-3);
                    for (const Vec3& corner : framing_points(scene, 20, whole_container(scene), {}))
                        ASSERT_TRUE(field == 0 || view.to_view(corner).z() > 0);
                }
}

// The bed has a tenth of the container's height. The picture limits its size, and the container does not.
TEST(FramedPart, ABedIsLargerThanInAFrameOfAllTheContainer) {
    for (const auto shape : {Container::Shape::box, Container::Shape::cylinder}) {
        const double all = scale_of(framed(container, shape)), some = scale_of(framed(reach, shape)),
                     least = scale_of(framed(bed, shape));
        EXPECT_GT(some, 1.5 * all);
        EXPECT_GE(least, 0.99 * some);  // as large, seen at the depth of another middle
    }
}

// If the width limits the scale, free height shows more of the container and is not left empty below the
// floor.
TEST(FramedPart, FreeHeightShowsMoreOfTheContainer) {
    FilmedScene scene = framed(reach, Container::Shape::box, 720, 1280);
    const View view = view_of(scene);
    double lowest = 0;
    for (const Vec3& point : framing_points(scene)) lowest = std::max(lowest, view.project(point).y());
    EXPECT_NEAR(view.port.height - lowest, type_scale(scene.film).margin, 1);
}

// A wedge is wider above the height that grains reach. No wall within the height of the picture is outside
// its width.
TEST(FramedPart, SlantedWallsStayInThePicture) {
    for (const auto& [width, height] : {std::pair{1280, 720}, {1000, 900}, {640, 360}, {720, 1280}})
        for (const double field : {0.0, 25.0})
            for (const double reach_height : {0.05, 0.1, 0.2, 0.4}) {
                FilmedScene scene = framed(reach, Container::Shape::wedge, width, height);
                scene.film.camera.reach = reach_height;
                scene.film.camera.field_of_view = field;
                const View view = view_of(scene);
                for (double top = 0.01; top <= 0.5; top += 0.01)
                    for (const Vec3& point :
                         framing_points(scene, scene.film.camera.azimuth, {top, true}, {})) {
                        const Pixel seen = view.project(point);
                        if (seen.y() < 0) continue;
                        // The camera looks only at some heights, so a wall may be off by half a pixel.
                        ASSERT_GE(seen.x(), -0.5) << width << " x " << height << ", " << top << " m";
                        ASSERT_LE(seen.x(), view.port.width + 0.5)
                            << width << " x " << height << ", " << top << " m";
                    }
            }
}

TEST(FramedPart, GrainsOfTheShippedBedsCoverTwiceTheArea) {
    for (const char* name : {"wedge_segregation", "wedge_mixing", "teaching_brazil_nut"}) {
        const std::string file = std::string(GRAINREEL_SOURCE "/scenes/") + name + ".toml";
        const FilmedScene scene = read_filmed_scene(file, {}, measurable_in),
                          whole = read_filmed_scene(file, {"film.camera.frame=container"}, measurable_in);
        // The area of grains in the picture grows with the square of the scale.
        EXPECT_GE(std::pow(scale_of(scene) / scale_of(whole), 2), 2) << name;
    }
}

// A camera that moves, or looks at a point of its own, frames the same part.
TEST(FramedPart, HoldsForCamerasThatMove) {
    for (const auto& change : {+[](Camera& c) { c.orbit = 360, c.orbit_time = 5; },
                               +[](Camera& c) { c.target = Vec3(0, 0, 0.02); }}) {
        FilmedScene all = framed(container), some = framed(reach);
        change(all.film.camera), change(some.film.camera);
        EXPECT_GT(scale_of(some), 1.4 * scale_of(all));
    }
}

}  // namespace
}  // namespace grainreel::test
