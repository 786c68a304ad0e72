// Tests of cameras that move on orbits, through keys, and from a place of their own; and of what stays right
// on the way.
#include <gtest/gtest.h>

#include <algorithm>

#include "engine/scene/bed.hpp"
#include "render/picture/camera/camera_path.hpp"
#include "render/scene/filmed_scene.hpp"
#include "tests/draw/support.hpp"

namespace grainreel::test {
namespace {

FilmedScene orbiting(double degrees = 360, double seconds = 8, int width = 640, int height = 360) {
    FilmedScene scene = wedge(width, height);
    scene.film.camera.orbit = degrees;
    scene.film.camera.orbit_time = seconds;
    scene.film.axes = true;
    return scene;
}

// Balls on a grid in the plane x = 0. None is before another one or near the container's edges.
std::vector<Ball> wall_of_balls() {
    std::vector<Ball> balls;
    for (int i = 0; i < 5; ++i)
        for (int j = 0; j < 5; ++j)
            balls.push_back({{0, 0.012 * (i - 2), 0.05 + 0.012 * j}, 0.005, (i + j) % 2});
    return balls;
}

TEST(CameraPath, ASphereIsWhereTheFormulaHasIt) {
    for (const double field : {25.0, 0.0})
        for (const double time : {0.0, 1.3, 4.0, 6.9}) {
            FilmedScene scene = orbiting(360, 8, 960, 540);
            set_species(scene, {{"black", 1, 0.01, {0, 0, 0}}});
            scene.film.camera.field_of_view = field;
            const View view = CameraPath(scene, plan_layout(scene)).at(time);
            // The directions are computed by hand: the orbit adds to the azimuth at a steady rate.
            const double a = (20 + 45 * time) * pi / 180, e = 10 * pi / 180;
            const Vec3 right(-std::sin(a), std::cos(a), 0);
            const Vec3 forward(-std::cos(e) * std::cos(a), -std::cos(e) * std::sin(a), -std::sin(e));
            const Vec3 up = right.cross(forward), at(0.006, -0.012, 0.1);
            const double r = 0.012, x = right.dot(at - view.eye), y = up.dot(at - view.eye),
                         z = forward.dot(at - view.eye);
            // These are tangents from the eye, in the plane of one picture axis and the line of sight; or
            // parallel lines.
            const auto reach = [&](double c, double side) {
                return field == 0 ? c + side * r
                                  : std::tan(std::atan2(c, z) + side * std::asin(r / std::hypot(c, z)));
            };
            Renderer renderer(scene, 1);
            const Picture empty = renderer.draw(frame_of({}), "", time);
            const Extent seen =
                changed(empty, renderer.draw(frame_of({{at, r, 0}}), "", time), view.port, 0.5 * 3 * 220);
            const double cx = 0.5 * view.port.width, cy = 0.5 * view.port.height;
            EXPECT_NEAR(seen.left, cx + view.focal * reach(x, -1), 1.2) << field << " " << time;
            EXPECT_NEAR(seen.right, cx + view.focal * reach(x, 1), 1.2) << field << " " << time;
            EXPECT_NEAR(seen.top, cy - view.focal * reach(y, 1), 1.2) << field << " " << time;
            EXPECT_NEAR(seen.bottom, cy - view.focal * reach(y, -1), 1.2) << field << " " << time;
        }
}

TEST(CameraPath, AFullTurnEndsWhereItBegan) {
    const FilmedScene scene = orbiting();
    Renderer renderer(scene, 1);
    const State frame = frame_of(wall_of_balls());
    const Picture first = renderer.draw(frame, "", 0);
    const Picture half = renderer.draw(frame, "", 4);
    EXPECT_EQ(renderer.draw(frame, "", 8).rgba, first.rgba);
    EXPECT_NE(half.rgba, first.rgba);
    // The axes in the gutter turn with the camera.
    EXPECT_GT(changed(first, half, plan_layout(scene).first).count, 20);
}

// Shading goes with the camera, and a small turn may not make grains flicker.
TEST(CameraPath, ATenthOfADegreeChangesColoursLittle) {
    FilmedScene scene = orbiting(0.1, 1);
    scene.container.shape = Container::Shape::box;
    const CameraPath path(scene, plan_layout(scene));
    Renderer renderer(scene, 1);
    const State frame = frame_of(wall_of_balls());
    const Picture one = renderer.draw(frame, "", 0), other = renderer.draw(frame, "", 1);
    ASSERT_NE(one.rgba, other.rgba);
    for (const Vec3& at : frame.position) {
        // Interpolated between four pixels: from one pixel to the next a ball changes by more than 3.
        const auto colour = [&](const Picture& picture, double time, int c) {
            const View view = path.at(time);
            const Pixel centre = view.project(at) - Pixel(0.5, 0.5), base = centre.array().floor();
            const Pixel share = centre - base;
            const int x = view.port.x + static_cast<int>(base.x()),
                      y = view.port.y + static_cast<int>(base.y());
            const auto row = [&](int of) {
                return (1 - share.x()) * picture.pixel(x, of)[c] + share.x() * picture.pixel(x + 1, of)[c];
            };
            return (1 - share.y()) * row(y) + share.y() * row(y + 1);
        };
        for (int c = 0; c < 3; ++c) EXPECT_NEAR(colour(one, 0, c), colour(other, 1, c), 3);
    }
}

TEST(CameraPath, AnOrbitKeepsAllOfTheContainerInThePortAtOneDistance) {
    for (const auto shape : {Container::Shape::wedge, Container::Shape::box, Container::Shape::cylinder})
        for (const auto& [width, height] : {std::pair{1280, 720}, {360, 640}})
            for (const double field : {0.0, 25.0, 80.0})
                for (const double elevation : {-20.0, 10.0, 60.0}) {
                    FilmedScene scene = orbiting(360, 10, width, height);
                    scene.container.shape = shape;
                    scene.film.camera.field_of_view = field;
                    scene.film.camera.elevation = elevation;
                    const CameraPath path(scene, plan_layout(scene));
                    const double margin = type_scale(scene.film).margin;
                    double slack = 1e9;
                    const View start = path.at(0);
                    for (int i = 0; i < 997; ++i) {
                        const View view = path.at(10 * i / 997.0);
                        ASSERT_NEAR(view.eye.z(), start.eye.z(), 1e-9);
                        ASSERT_NEAR(std::hypot(view.eye.x(), view.eye.y()),
                                    std::hypot(start.eye.x(), start.eye.y()), 1e-9);
                        ASSERT_EQ(view.focal, start.focal);
                        const double azimuth = scene.film.camera.azimuth + 360 * i / 997.0;
                        for (const Vec3& point : framing_points(scene, azimuth)) {
                            const Pixel at = view.project(point);
                            ASSERT_GT(view.to_view(point).z(), view.nearest);
                            slack = std::min(
                                {slack, at.x(), at.y(), view.port.width - at.x(), view.port.height - at.y()});
                        }
                    }
                    // Everything is inside the margin except what half a degree of a turn may hide, and
                    // touches the margin at one place.
                    ASSERT_NEAR(slack, margin, 0.1)
                        << width << " fov " << field << " elevation " << elevation;
                }
}

TEST(CameraPath, KeysAreHitExactlyAndNotOvershot) {
    FilmedScene scene = wedge();
    const auto key = [](double time, double azimuth, double elevation, double zoom) {
        CameraKey k;
        k.time = time, k.azimuth = azimuth, k.elevation = elevation, k.zoom = zoom;
        return k;
    };
    scene.film.camera.keys = {key(1, 20, 10, 1), key(2, 25, 40, 2), key(4, 190, 40, 0.5), key(5, 200, 5, 4)};
    const CameraPath path(scene, plan_layout(scene));
    const double focal = focal_length(scene.film.camera, scene.film.height);
    const auto azimuth_of = [](const View& view) {
        return std::atan2(-view.right.x(), view.right.y()) * 180 / pi;
    };
    for (const CameraKey& k : scene.film.camera.keys) {
        const View view = path.at(k.time), wanted = looking(*k.azimuth, *k.elevation);
        EXPECT_NEAR((view.forward - wanted.forward).norm(), 0, 1e-12);
        EXPECT_NEAR((view.up - wanted.up).norm(), 0, 1e-12);
        EXPECT_NEAR(view.focal / focal, *k.zoom, 1e-9);
    }
    for (std::size_t i = 0; i + 1 < scene.film.camera.keys.size(); ++i) {
        const CameraKey &from = scene.film.camera.keys[i], &to = scene.film.camera.keys[i + 1];
        for (double share = 0; share <= 1; share += 0.01) {
            const View view = path.at(from.time + share * (to.time - from.time));
            const double azimuth = std::fmod(azimuth_of(view) + 360, 360), zoom = view.focal / focal;
            EXPECT_GE(azimuth, std::min(*from.azimuth, *to.azimuth) - 1e-9);
            EXPECT_LE(azimuth, std::max(*from.azimuth, *to.azimuth) + 1e-9);
            EXPECT_GE(zoom, std::min(*from.zoom, *to.zoom) - 1e-9);
            EXPECT_LE(zoom, std::max(*from.zoom, *to.zoom) + 1e-9);
        }
    }
    EXPECT_EQ(path.at(0).forward, path.at(1).forward);
    EXPECT_EQ(path.at(9).forward, path.at(5).forward);
}

TEST(CameraPath, WhatTheFirstKeyLeavesOutIsTheCamerasOwn) {
    FilmedScene scene = wedge();
    scene.film.camera.zoom = 1.5;
    scene.film.camera.keys.resize(3);
    for (std::size_t i = 0; i < 3; ++i) scene.film.camera.keys[i].time = static_cast<double>(i);
    scene.film.camera.keys[2].target = Vec3(0, 0.01, 0.02);
    scene.film.camera.keys[2].zoom = 6;
    const CameraPath path(scene, plan_layout(scene));
    const auto offset =
        [&](double time) {  // of the point aimed at, from the container's middle, as a sideways distance
            return (path.at(time).eye - path.at(2).eye).dot(path.at(2).right);
        };
    const Vec3 way = extent_of(scene).middle() - *scene.film.camera.keys[2].target;
    EXPECT_NEAR(offset(0), way.dot(path.at(0).right), 1e-12);
    EXPECT_NEAR(offset(1), 0.5 * way.dot(path.at(0).right), 1e-12);  // half-way between two keys, by symmetry
    EXPECT_NEAR(path.at(1).focal / path.at(0).focal, 2, 1e-9);       // the zoom by its logarithm
    EXPECT_NEAR(path.at(2).focal / path.at(0).focal, 4, 1e-9);
}

TEST(CameraPath, CurvesAreSmoothAtTheirPoints) {
    const MonotoneCurve curve({0, 1, 3, 4, 6}, {0, 2, 3, 7, 7});
    const double h = 1e-6;
    for (const double knot : {0.0, 1.0, 3.0, 4.0, 6.0})
        EXPECT_NEAR((curve.at(knot) - curve.at(knot - h)) / h, (curve.at(knot + h) - curve.at(knot)) / h,
                    1e-4);
    EXPECT_GT((curve.at(1 + h) - curve.at(1 - h)) / h, 0.5);  // passes through without a stop
    // The harmonic mean of the slopes 2 and 1/2, weighted 5 and 4 (Fritsch and Butland 1984).
    EXPECT_NEAR((curve.at(1 + h) - curve.at(1 - h)) / (2 * h), 9 / (5 / 2.0 + 4 / 0.5), 1e-5);
}

TEST(CameraPath, APlaceOfItsOwn) {
    FilmedScene scene = wedge();
    Camera& camera = scene.film.camera;
    camera.position = Vec3(0.3, -0.4, 0.5);
    camera.target = Vec3(0.01, 0.02, 0.05);
    const auto middle_of = [&](const View& view) {
        return Pixel(0.5 * view.port.width, 0.5 * view.port.height);
    };
    const View view = view_of(scene);
    EXPECT_NEAR((view.eye - *camera.position).norm(), 0, 1e-12);
    EXPECT_NEAR((view.project(*camera.target) - middle_of(view)).norm(), 0, 1e-9);
    camera.orbit = 90;
    camera.orbit_time = 2;
    const View turned = CameraPath(scene, plan_layout(scene)).at(2);
    // The camera makes a quarter of a turn about the vertical through the target: (x, y) becomes (-y, x).
    EXPECT_NEAR((turned.eye - *camera.target - Vec3(0.42, 0.29, 0.45)).norm(), 0, 1e-12);
    EXPECT_NEAR((turned.project(*camera.target) - middle_of(view)).norm(), 0, 1e-9);
    // Without a place the camera is at the automatic distance.
    camera = Camera();
    camera.target = Vec3(0.01, 0.02, 0.05);
    const View aimed = view_of(scene);
    EXPECT_NEAR((aimed.project(*camera.target) - middle_of(aimed)).norm(), 0, 1e-9);
}

// Share of the picture that changes from each moment to the next.
std::vector<double> changes(Renderer& renderer, const FilmedScene& scene, double from, double to,
                            double step) {
    const Rectangle port = plan_layout(scene).port;
    std::vector<double> sums;
    Picture last;
    for (double time = from; time <= to; time += step) {
        const Picture& now = renderer.draw(frame_of({}), "", time);
        double sum = 0;
        for (int y = port.y; y < port.y + port.height && last.width > 0; ++y)
            for (int x = port.x; x < port.x + port.width; ++x) sum += difference(now, last, x, y);
        if (last.width > 0) sums.push_back(sum);
        last = now;
    }
    return sums;
}

// No change may be much larger than those around it. The turn itself changes more at some angles than at
// others.
void expect_no_pop(const std::vector<double>& changes, double from, double step) {
    for (std::size_t i = 4; i + 4 < changes.size(); ++i) {
        std::vector<double> around(changes.begin() + static_cast<std::ptrdiff_t>(i - 4),
                                   changes.begin() + static_cast<std::ptrdiff_t>(i + 5));
        std::nth_element(around.begin(), around.begin() + 4, around.end());
        EXPECT_LT(changes[i], 1.6 * around[4]) << "at " << from + step * static_cast<double>(i);
    }
}

// When the eye crosses the plane of a wall, near and far walls change places and glass becomes solid. This
// happens at azimuths of about 8 and 90 degrees.
TEST(CameraPath, NothingPopsOnAnOrbit) {
    for (const auto shape : {Container::Shape::wedge, Container::Shape::box, Container::Shape::cylinder}) {
        FilmedScene scene = orbiting(360, 360, 480, 270);  // a degree a second
        scene.container.shape = shape;
        Renderer renderer(scene, 1);
        for (const double from : {338.0, 420.0})
            expect_no_pop(changes(renderer, scene, from, from + 22, 0.25), from, 0.25);
    }
}

// The eye crosses the lid's plane at an elevation of about 6 degrees, and the floor's at -9.
TEST(CameraPath, NothingPopsOnTheWayUp) {
    for (const auto shape : {Container::Shape::box, Container::Shape::cylinder}) {
        FilmedScene scene = wedge(480, 270);
        scene.container.shape = shape;
        scene.film.camera.keys.resize(2);
        scene.film.camera.keys[0].elevation = -30;
        scene.film.camera.keys[1].elevation = 50;
        scene.film.camera.keys[1].time = 80;
        Renderer renderer(scene, 1);
        expect_no_pop(changes(renderer, scene, 15, 60, 0.25), 15, 0.25);
    }
}

}  // namespace
}  // namespace grainreel::test
