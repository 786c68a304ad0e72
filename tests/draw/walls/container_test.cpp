// Tests of the container in the picture: it is at its place, and all of it is there.
#include <gtest/gtest.h>

#include "render/picture/words/blocks.hpp"
#include "render/scene/filmed_scene.hpp"
#include "tests/draw/support.hpp"

namespace grainreel::test {
namespace {

bool is_background(const std::uint8_t* p) {
    return p[0] > 250 && p[1] > 250 && p[2] > 250;
}

// Share of a pixel on the outer border of the outline that the dark line covers.
double covered(const std::uint8_t* p) {
    const double ink = 255 * make_palette({1, 1, 1}).ink.red;
    return std::min(1.0, (255 - p[0]) / (255 - ink));
}

// Seen level from the front, the lower edge of the floor plate and the upper edge of the lid are horizontal
// lines. The result is in pixels from the top of the port, with fractions from the darkness of the border
// pixel.
double floor_edge(const Picture& picture, const Rectangle& port) {
    const int x = port.x + port.width / 2;
    int y = port.y + port.height - 1;
    while (y > port.y && is_background(picture.pixel(x, y))) --y;
    return y + covered(picture.pixel(x, y)) - port.y;
}

double lid_edge(const Picture& picture, const Rectangle& port) {
    const int x = port.x + port.width / 2;
    int y = port.y;
    while (y < port.y + port.height && is_background(picture.pixel(x, y))) ++y;
    return y + 1 - covered(picture.pixel(x, y)) - port.y;
}

// All walls of glass hide nothing, from whatever side they are seen.
TEST(Container, OfGlassHidesNothing) {
    FilmedScene scene = wedge();
    const Palette palette = palette_of(scene.film);
    ContainerShapes shapes;
    const auto hidden = [&](bool clear) {
        Views views{view_of(scene), view_of(scene)};
        views.clear = clear;
        draw_container(scene, views, frame_of({}), palette, scene.film.height, shapes);
        int solid = 0;
        for (const WallSide* side : {&shapes.behind, &shapes.before})
            for (const WallSide::Face& face : side->faces) solid += face.alpha >= 0.5;
        return solid;
    };
    for (const auto shape : {Container::Shape::wedge, Container::Shape::cylinder}) {
        scene.container.shape = shape;
        EXPECT_GT(hidden(false), 2);
        EXPECT_EQ(hidden(true), 0);
    }
}

FilmedScene level_box() {
    FilmedScene scene = wedge(1280, 720);
    scene.container.shape = Container::Shape::box;
    scene.film.camera.azimuth = 0;
    scene.film.camera.elevation = 0;
    scene.drive.amplitude = 0.006;
    return scene;
}

TEST(ContainerPicture, OscillatesByTheProjectedStroke) {
    for (const double exaggerate : {1.0, 5.0}) {
        FilmedScene scene = level_box();
        scene.film.exaggerate = exaggerate;
        const View view = view_of(scene);
        const double bottom = -1.4 * drawn_thickness(scene.container), front = 0.5 * scene.container.depth;
        const double top = scene.container.height + drawn_thickness(scene.container);
        const double half_pen = 0.5 * std::max(1.0, scene.film.height / 600.0);
        Renderer renderer(scene, 1);
        for (const double phase : {0.0, 0.25, 0.5, 0.75}) {
            const Vec3 offset = scene.drive.amplitude * std::sin(2 * pi * phase) * scene.drive.direction;
            State frame = frame_of({});
            frame.phase = phase;
            frame.container().place = frame.floor().place = offset;
            const Picture& picture = renderer.draw(frame, "");
            const Vec3 drawn = exaggerate * offset;
            EXPECT_NEAR(floor_edge(picture, view.port),
                        view.project(Vec3(front, 0, bottom) + drawn).y() + half_pen, 0.3);
            EXPECT_NEAR(lid_edge(picture, view.port),
                        view.project(Vec3(front, 0, top) + drawn).y() - half_pen, 0.3);
        }
    }
}

// A plane is drawn at the place of its body in the frame, whatever place its velocity would give at that
// time.
TEST(ContainerPicture, APlaneIsWhereItsBodyIs) {
    FilmedScene scene = level_box();
    ScenePlane plane;
    plane.point = Vec3(0, 0, 0.03);
    plane.normal = Vec3(0, 0.5, 1).normalized();
    plane.velocity = Vec3(0, 0, 0.5);
    scene.walls = {plane};
    State frame = frame_of({});
    frame.time = 0.1;
    frame.bodies.resize(kFirstPlaneBody + 1);
    frame.bodies.back().place = Vec3(0, 0, 0.01);
    FilmedScene higher = scene;
    higher.walls[0].point += frame.bodies.back().place;
    State at_rest = frame;
    at_rest.bodies.back() = {};
    Renderer one(scene, 1), other(higher, 1);
    const Picture moved = one.draw(frame, ""), rests = one.draw(at_rest, "");
    EXPECT_EQ(moved.rgba, other.draw(at_rest, "").rgba);
    EXPECT_NE(moved.rgba, rests.rgba);
}

// Relative to the container, a grain in an exaggerated picture is at its place.
TEST(ContainerPicture, ExaggeratedGrainsStayInTheContainer) {
    FilmedScene scene = level_box();
    scene.film.exaggerate = 5;
    scene.film.look.shadows = scene.film.look.occlusion = false;  // walls show them beside the grain
    const View view = view_of(scene);
    const Vec3 offset(0, 0, 0.006), resting(0, 0.01, 0.02);
    State frame = frame_of({{resting + offset, 0.012, 1}});
    frame.container().place = frame.floor().place = offset;
    State empty = frame_of({});
    empty.container().place = empty.floor().place = offset;
    Renderer renderer(scene, 1);
    const Picture without = renderer.draw(empty, "");
    const Extent seen = changed(without, renderer.draw(frame, ""), view.port, 60);
    EXPECT_NEAR(0.5 * (seen.top + seen.bottom), view.project(resting + 5 * offset).y(), 1.5);
    scene.film.camera.follow = true;
    Renderer following(scene, 1);
    const Picture still = following.draw(empty, "");
    const Extent held = changed(still, following.draw(frame, ""), view.port, 60);
    EXPECT_NEAR(0.5 * (held.top + held.bottom), view.project(resting).y(), 1.5);
}

TEST(ContainerPicture, ExaggerationIsSaid) {
    FilmedScene scene = level_box();
    const TypeScale type = type_scale(scene.film);
    const Palette palette = make_palette({1, 1, 1});
    const Writer measure{nullptr, type, palette};
    const double plain = drive_block(measure, scene, nullptr, nullptr, 0, 0).height;
    scene.film.exaggerate = 5;
    EXPECT_GT(drive_block(measure, scene, nullptr, nullptr, 0, 0).height, plain + 2 * measure.type.minor);
}

// The ghost is the container's outline at rest, wherever the container is.
TEST(ContainerPicture, TheGhostRests) {
    for (const auto shape : {Container::Shape::box, Container::Shape::wedge, Container::Shape::cylinder}) {
        FilmedScene plain = level_box(), ghostly = level_box();
        plain.container.shape = ghostly.container.shape = shape;
        ghostly.film.wall_ghost = true;
        const View view = view_of(plain);
        Renderer one(plain, 1), other(ghostly, 1);
        Pixel low(1e9, 1e9), high(-1e9, -1e9);
        FilmedScene at_rest = plain;
        at_rest.drive.present = false;  // no stroke and no marks: the container's own corners
        for (const Vec3& corner : framing_points(at_rest)) {
            low = low.cwiseMin(view.project(corner));
            high = high.cwiseMax(view.project(corner));
        }
        for (const double offset : {-0.006, 0.004, 0.006}) {
            State frame = frame_of({});
            frame.container().place = frame.floor().place = {0, 0, offset};
            const Picture without = one.draw(frame, "");
            const test::Extent seen = changed(without, other.draw(frame, ""), view.port, 12);
            EXPECT_GT(seen.count, 200);
            EXPECT_NEAR(seen.left, low.x(), 2.5);
            EXPECT_NEAR(seen.right, high.x(), 2.5);
            EXPECT_NEAR(seen.top, low.y(), 2.5);
            EXPECT_NEAR(seen.bottom, high.y(), 2.5);
        }
    }
}

// A scene whose camera is `above` (m) the lid's lower side at rest and looks level at it.
FilmedScene seen_from_lid_height(Container::Shape shape, double above) {
    FilmedScene scene = level_box();
    scene.container.shape = shape;
    scene.drive.amplitude = 0.02;
    scene.film.look.shadows = scene.film.look.occlusion = false;  // walls seen through glass
    double low = -20, high = 40;
    for (int i = 0; i < 60; ++i) {
        scene.film.camera.elevation = 0.5 * (low + high);
        const bool higher = view_of(scene).eye.z() > scene.container.height + above;
        (higher ? high : low) = scene.film.camera.elevation;
    }
    return scene;
}

State moved_to(double height, const std::vector<Ball>& balls) {
    State frame = frame_of(balls);
    frame.container().place = frame.floor().place = {0, 0, height};
    return frame;
}

// The pixel of the lid's nearest part, at the share `up` of its thickness above its lower side.
const std::uint8_t* lid_pixel(const FilmedScene& scene, const Picture& picture, double offset, double up) {
    const Container& c = scene.container;
    const double t = drawn_thickness(c);
    const double front = c.shape == Container::Shape::cylinder ? c.half_width + t : 0.5 * c.depth;
    const View view = view_of(scene);
    const Pixel at = view.project({front, 0, c.height + up * t + offset});
    return picture.pixel(view.port.x + static_cast<int>(at.x()), view.port.y + static_cast<int>(at.y()));
}

TEST(ContainerPicture, TheLidLooksTheSameAllTheStroke) {
    for (const auto shape : {Container::Shape::box, Container::Shape::cylinder})
        for (const double above : {-0.003, 0.003}) {
            const FilmedScene scene = seen_from_lid_height(shape, above);
            Renderer renderer(scene, 1);
            const int rest = lid_pixel(scene, renderer.draw(moved_to(0, {}), ""), 0, 0.5)[0];
            // A few levels of leeway are needed: glass shows a little more of its upper face as it sinks. The
            // lid is opaque above the eye, and glass over a white background below it.
            EXPECT_EQ(rest < 200, above < 0);
            for (const double offset : {-0.019, -0.01, 0.01, 0.019})
                EXPECT_NEAR(lid_pixel(scene, renderer.draw(moved_to(offset, {}), ""), offset, 0.5)[0], rest,
                            10)
                    << "offset " << offset << ", eye above the lid by " << above;
        }
}

TEST(ContainerPicture, ALidThatSinksBelowTheEyeHidesGrains) {
    const FilmedScene scene = seen_from_lid_height(Container::Shape::box, -0.001);
    const double offset = -0.019, r = 0.015;
    const Ball touching{{r - 0.5 * scene.container.depth, 0, scene.container.height - r + offset}, r, 0};
    Renderer renderer(scene, 1);
    const Picture empty = renderer.draw(moved_to(offset, {}), "");
    const Picture& full = renderer.draw(moved_to(offset, {touching}), "");
    for (int c = 0; c < 3; ++c)
        EXPECT_EQ(lid_pixel(scene, full, offset, 0.12)[c], lid_pixel(scene, empty, offset, 0.12)[c]);
}

TEST(ContainerPicture, AFloorThatMovesAloneLeavesTheLid) {
    FilmedScene scene = level_box();
    scene.drive.moves = Drive::Moves::floor;
    const View view = view_of(scene);
    Renderer renderer(scene, 1);
    State frame = frame_of({});
    const Picture rest = renderer.draw(frame, "");
    frame.floor().place = {0, 0, -0.006};
    const Picture& lowered = renderer.draw(frame, "");
    EXPECT_EQ(lid_edge(rest, view.port), lid_edge(lowered, view.port));
    EXPECT_NEAR(floor_edge(lowered, view.port) - floor_edge(rest, view.port),
                0.006 * view.pixels_per_metre({0.5 * scene.container.depth, 0, 0}), 0.3);
}

TEST(ContainerPicture, FollowingHoldsTheContainerStill) {
    FilmedScene scene = level_box();
    scene.film.camera.follow = true;
    const View view = view_of(scene);
    Renderer renderer(scene, 1);
    State frame = frame_of({});
    const double rest = lid_edge(renderer.draw(frame, ""), view.port);
    frame.container().place = frame.floor().place = {0, 0, 0.006};
    EXPECT_EQ(lid_edge(renderer.draw(frame, ""), view.port), rest);
}

TEST(ContainerPicture, AnOpenTopLooksDifferent) {
    FilmedScene scene = level_box();
    const View view = view_of(scene);
    const double closed = lid_edge(Renderer(scene, 1).draw(frame_of({}), ""), view.port);
    scene.container.lid = false;
    const View open_view = view_of(scene);
    const double open = lid_edge(Renderer(scene, 1).draw(frame_of({}), ""), open_view.port);
    const double plate =
        drawn_thickness(scene.container) * view.pixels_per_metre({0, 0, scene.container.height});
    EXPECT_GT(plate, 3);
    // Room is counted from the projected rim: the lid stands above it, and an open top does not.
    const double front = 0.5 * scene.container.depth, h = scene.container.height;
    EXPECT_LT(closed, view.project({front, 0, h}).y() - 0.8 * plate);
    EXPECT_GT(open, open_view.project({front, 0, h}).y() - 2);
}

TEST(ContainerPicture, APeriodicDepthHasNoPanes) {
    FilmedScene scene = level_box();
    scene.container.lid = false;
    const View view = view_of(scene);
    const int x = view.port.x + view.port.width / 2;
    const int y = view.port.y + static_cast<int>(view.project({0, 0, 0.1}).y());
    EXPECT_FALSE(Renderer(scene, 1).draw(frame_of({}), "").pixel(x, y)[0] == 255);
    scene.container.periodic_depth = true;
    EXPECT_TRUE(Renderer(scene, 1).draw(frame_of({}), "").pixel(x, y)[0] == 255);
}

TEST(Framing, KeepsEverythingInThePictureAndFillsIt) {
    for (const auto shape : {Container::Shape::wedge, Container::Shape::box, Container::Shape::cylinder})
        for (const auto& [width, height] : {std::pair{1920, 1080}, {320, 240}, {360, 1080}, {1080, 1920}})
            for (const double tall : {0.05, 0.16, 1.5})
                for (const double field : {0.0, 25.0, 90.0})
                    for (const double azimuth : {0.0, 20.0, 135.0})
                        for (const double elevation : {-20.0, 10.0, 90.0}) {
                            FilmedScene scene = wedge(width, height);
                            scene.container.shape = shape;
                            scene.container.height = tall;
                            scene.film.camera.azimuth = azimuth;
                            scene.film.camera.elevation = elevation;
                            scene.film.camera.field_of_view = field;
                            const View view = view_of(scene);
                            const double margin = type_scale(scene.film).margin;
                            Pixel low(1e9, 1e9), high(-1e9, -1e9);
                            for (const Vec3& point : framing_points(scene)) {
                                ASSERT_GT(view.to_view(point).z(), view.nearest);
                                ASSERT_LT(view.to_view(point).z(), view.farthest);
                                low = low.cwiseMin(view.project(point));
                                high = high.cwiseMax(view.project(point));
                            }
                            // The container is inside the margin on all sides, and touches it on two opposite
                            // ones.
                            const Pixel size(view.port.width, view.port.height);
                            ASSERT_GT(low.minCoeff(), margin - 1e-6);
                            ASSERT_GT((size - high).minCoeff(), margin - 1e-6);
                            const Pixel slack =
                                (low.array() - margin).max(size.array() - high.array() - margin);
                            ASSERT_LT(slack.minCoeff(), 1e-6) << width << "x" << height << " fov " << field;
                        }
}

// If it is shaken gently, an open container ends at the picture's margin. If it is shaken hard, there is room
// above its rim for at least one throw of the bed: its height, and (2 pi f a)^2 / 2g above that.
TEST(Framing, AnOpenTopLeavesRoomForGrainsInFlight) {
    FilmedScene scene = level_box();
    Container& box = scene.container;
    box.lid = false;
    box.height = 0.3;  // so tall that the picture's height limits the scale
    scene.film.camera.field_of_view = 0;
    set_species(scene, {{"small", 23000, 0.003, blue}});
    const double bed = 23000 * pi / 6 * std::pow(0.003, 3) / 0.55 / (2 * box.half_width * box.depth);
    const auto room = [&] {  // m, from the rim at the top of its stroke
        const View view = view_of(scene);
        const double rim = view.project({0, 0, box.height + scene.drive.amplitude}).y();
        return (rim - type_scale(scene.film).margin) / view.focal;
    };
    scene.drive.amplitude = 0.0005;
    EXPECT_NEAR(room(), 0, 1e-9);
    scene.drive.amplitude = 0.020;
    const double speed = 2 * pi * scene.drive.frequency * scene.drive.amplitude;
    EXPECT_GT(room(), bed + speed * speed / (2 * 9.81) - box.height);
    EXPECT_LT(room(), 0.5 * box.height + 1e-9);
    box.lid = true;
    EXPECT_NEAR(room(), drawn_thickness(box), 1e-9);
}

TEST(Framing, AzimuthTurnsTheCameraToTheRight) {
    FilmedScene scene = wedge();
    scene.film.camera.azimuth = 30;
    scene.film.camera.elevation = 0;
    const View view = view_of(scene);
    EXPECT_NEAR((view.forward - Vec3(-std::cos(pi / 6), -0.5, 0)).norm(), 0, 1e-12);
    EXPECT_NEAR((view.up - Vec3(0, 0, 1)).norm(), 0, 1e-12);
    EXPECT_GT(view.right.y(), 0);
}

}  // namespace
}  // namespace grainreel::test
