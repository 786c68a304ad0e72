// Tests of grains in the picture against geometry.
#include <gtest/gtest.h>

#include "render/scene/filmed_scene.hpp"
#include "tests/draw/support.hpp"

namespace grainreel::test {
namespace {

// The silhouette of a sphere along one picture axis: the direction of the centre, plus and minus the
// half-angle asin(r / distance) in the plane of that axis and the line of sight.
std::pair<double, double> silhouette(double c, double z, double r) {
    const double direction = std::atan2(c, z), half = std::asin(r / std::hypot(c, z));
    return {std::tan(direction - half), std::tan(direction + half)};
}

void expect_silhouette(FilmedScene scene, Ball ball) {
    add_species(scene, {"black", 1, 0.01, {0, 0, 0}});
    ball.species = 2;
    const View view = view_of(scene);
    Renderer renderer(scene, 1);
    const Picture empty = renderer.draw(frame_of({}), "");
    const Picture picture = renderer.draw(frame_of({ball}), "");
    // Black lies on nearly white: a border pixel counts if about half of it is covered.
    const Extent seen = changed(empty, picture, view.port, 0.5 * 3 * 235);
    const Vec3 from = ball.at - view.eye;
    const double x = from.dot(view.right), y = from.dot(view.up), z = from.dot(view.forward);
    const bool flat = scene.film.camera.field_of_view == 0;
    const auto [x0, x1] = flat ? std::pair{x - ball.radius, x + ball.radius} : silhouette(x, z, ball.radius);
    const auto [y0, y1] = flat ? std::pair{y - ball.radius, y + ball.radius} : silhouette(y, z, ball.radius);
    const double middle_x = 0.5 * view.port.width, middle_y = 0.5 * view.port.height;
    EXPECT_NEAR(0.5 * (seen.left + seen.right), middle_x + view.focal * 0.5 * (x0 + x1), 0.7);
    EXPECT_NEAR(0.5 * (seen.top + seen.bottom), middle_y - view.focal * 0.5 * (y0 + y1), 0.7);
    EXPECT_NEAR(0.5 * (seen.right - seen.left), view.focal * 0.5 * (x1 - x0), 0.7);
    EXPECT_NEAR(0.5 * (seen.bottom - seen.top), view.focal * 0.5 * (y1 - y0), 0.7);
}

TEST(Spheres, SilhouetteFollowsThePerspective) {
    expect_silhouette(wedge(), {{0.01, 0.02, 0.09}, 0.012});
    FilmedScene wide = wedge(960, 540);
    wide.film.camera.field_of_view = 75;
    expect_silhouette(wide, {{0.01, -0.03, 0.11}, 0.011});
}

TEST(Spheres, SilhouetteOfAnOrthographicCamera) {
    FilmedScene scene = wedge();
    scene.film.camera.field_of_view = 0;
    expect_silhouette(scene, {{0.0, -0.02, 0.08}, 0.012});
}

TEST(Spheres, TheFieldOfViewSpansThePicture) {
    FilmedScene scene = wedge();
    scene.film.camera.field_of_view = 30;
    EXPECT_NEAR(view_of(scene).focal, 0.5 * scene.film.height / std::tan(15 * pi / 180), 1e-9);
}

// In the row through both centres, finds the place where two overlapping spheres are equally near.
TEST(Spheres, MeetAtTheirTrueIntersection) {
    FilmedScene scene = wedge(960, 540);
    scene.film.camera.field_of_view = 0;
    scene.film.camera.azimuth = 0;
    scene.film.camera.elevation = 0;
    const View view = view_of(scene);
    const double r = 0.012;
    const Ball near{{0.004, -0.006, 0.09}, r, 0}, far{{0.0, 0.006, 0.09}, r, 1};
    Renderer renderer(scene, 1);
    const Picture& picture = renderer.draw(frame_of({near, far}), "");

    const auto ahead = [&](double y) {  // how much nearer the first sphere is; it falls with y
        const auto front = [&](const Ball& b) {
            return b.at.x() + std::sqrt(r * r - std::pow(y - b.at.y(), 2));
        };
        return front(near) - front(far);
    };
    double low = -0.005, high = 0.005;
    for (int i = 0; i < 60; ++i) (ahead(0.5 * (low + high)) > 0 ? low : high) = 0.5 * (low + high);
    const Pixel expected = view.project({0, low, 0.09});

    const int row = view.port.y + static_cast<int>(expected.y());
    int boundary = -1;
    for (int x = view.port.x; x + 1 < view.port.x + view.port.width && boundary < 0; ++x)
        if (std::abs(x - view.port.x - expected.x()) < 15 && std::abs(hue(picture.pixel(x, row))) > 90 &&
            std::abs(hue(picture.pixel(x + 1, row))) < 90)
            boundary = x + 1 - view.port.x;
    ASSERT_GE(boundary, 0) << "no change of colour along the row";
    EXPECT_NEAR(boundary, expected.x(), 1.0);
}

TEST(Spheres, TheNearerOneHidesTheFarther) {
    FilmedScene scene = wedge();
    const View view = view_of(scene);
    const Vec3 at(0, 0, 0.09);
    const Vec3 behind = at + 0.01 * (at - view.eye).normalized();
    Renderer renderer(scene, 1);
    const State alone = frame_of({{at, 0.008, 1}});
    for (const bool first : {true, false}) {
        // The order of grains in the frame does not matter.
        const Ball front{at, 0.008, 1}, back{behind, 0.004, 0};
        const Picture both =
            renderer.draw(frame_of(first ? std::vector{front, back} : std::vector{back, front}), "");
        const Pixel centre = view.project(at);
        const auto* pixel = both.pixel(view.port.x + static_cast<int>(centre.x()),
                                       view.port.y + static_cast<int>(centre.y()));
        EXPECT_NEAR(hue(pixel), hue(orange), 8);
    }
}

TEST(Spheres, SpeciesColoursComeOut) {
    FilmedScene scene = wedge();
    add_species(scene, {"green", 1, 0.01, {0.0, 0.62, 0.45}});
    const View view = view_of(scene);
    Renderer renderer(scene, 1);
    for (int k = 0; k < 3; ++k) {
        const Vec3 at(0, 0.01, 0.1);
        const Picture& picture = renderer.draw(frame_of({{at, 0.015, k}}), "");
        const Pixel centre = view.project(at);
        const auto* pixel = picture.pixel(view.port.x + static_cast<int>(centre.x()),
                                          view.port.y + static_cast<int>(centre.y()));
        EXPECT_NEAR(hue(pixel), hue(scene.colours[static_cast<std::size_t>(k)]), 10) << k;
    }
}

TEST(Spheres, CrossingTheEyesPlaneDoesNotVanish) {
    const FilmedScene scene = wedge();
    const View view = view_of(scene);
    Renderer renderer(scene, 1);
    const Picture empty = renderer.draw(frame_of({}), "");
    const int pixels = view.port.width * view.port.height;
    // The sphere is just in front of the eye, reaches past it to the side, or is around it.
    const Vec3 ahead = view.eye + 0.06 * view.forward;
    EXPECT_EQ(changed(empty, renderer.draw(frame_of({{ahead, 0.05, 1}}), ""), view.port).count, pixels);
    const Vec3 beside = view.eye + 0.002 * view.forward + 0.06 * view.right;
    EXPECT_GT(changed(empty, renderer.draw(frame_of({{beside, 0.0595, 1}}), ""), view.port).count,
              pixels / 20);
    EXPECT_EQ(changed(empty, renderer.draw(frame_of({{view.eye, 0.05, 1}}), ""), view.port).count, pixels);
    const Vec3 back = view.eye - 0.1 * view.forward;
    EXPECT_EQ(changed(empty, renderer.draw(frame_of({{back, 0.05, 1}}), ""), view.port).count, 0);
}

// A disc of n pixels radius covers pi n^2 pixels, if fractions are counted: the edge is smooth and unbiased.
TEST(Spheres, EdgesAreSmoothAndUnbiased) {
    FilmedScene scene = wedge();
    scene.film.camera.field_of_view = 0;
    scene.film.look.shadows = scene.film.look.occlusion = false;  // on the wall behind
    set_species(scene, {{"dark", 1, 0.01, {0, 0, 0}}});
    const View view = view_of(scene);
    const double radius = 0.012, pixels = view.focal * radius;
    Renderer renderer(scene, 1);
    const Picture& empty = renderer.draw(frame_of({}), "");
    const Rectangle port = view.port;
    std::vector<double> before;
    for (int y = 0; y < port.height; ++y)
        for (int x = 0; x < port.width; ++x) before.push_back(empty.pixel(port.x + x, port.y + y)[0]);
    const Picture& picture = renderer.draw(frame_of({{{0, 0.003, 0.1}, radius, 0}}), "");
    double covered = 0;
    int partly = 0;
    std::size_t i = 0;
    for (int y = 0; y < port.height; ++y)
        for (int x = 0; x < port.width; ++x, ++i) {
            const double now = picture.pixel(port.x + x, port.y + y)[0];
            if (std::abs(now - before[i]) < 3) continue;
            const double share = std::min(1.0, (before[i] - now) / (before[i] - 40));
            covered += share;
            partly += share > 0.15 && share < 0.85;
        }
    EXPECT_NEAR(covered / (pi * pixels * pixels), 1, 0.02);
    EXPECT_GT(partly, pi * pixels);  // half a pixel of transition for each pixel of the outline, at least
}

TEST(Spheres, EdgesBetweenGrainsAreSmooth) {
    FilmedScene scene = wedge();
    scene.film.camera.field_of_view = 0;
    set_species(scene, {{"black", 1, 0.01, {0, 0, 0}}, {"white", 1, 0.02, {1, 1, 1}}});
    const View view = view_of(scene);
    const Vec3 at(0, 0, 0.1);
    Renderer renderer(scene, 1);
    const double radius = 0.008;
    const State frame = frame_of({{at - 0.04 * view.forward, radius, 0}, {at, 0.03, 1}});
    const Picture& picture = renderer.draw(frame, "");
    const Pixel centre = view.project(at);
    int partly = 0;
    for (int y = 0; y < view.port.height; ++y)
        for (int x = 0; x < view.port.width; ++x) {
            const double away = std::hypot(x + 0.5 - centre.x(), y + 0.5 - centre.y()) - view.focal * radius;
            const int value = picture.pixel(view.port.x + x, view.port.y + y)[0];
            partly += std::abs(away) < 1 && value > 70 && value < 180;
        }
    EXPECT_GT(partly, 0.5 * pi * view.focal * radius);
}

}  // namespace
}  // namespace grainreel::test
