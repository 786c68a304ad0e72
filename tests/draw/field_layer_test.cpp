// Tests of the coloured layer that shows the mean of a quantity in front of pale grains.
#include "render/picture/marks/field_marks.hpp"

#include <gtest/gtest.h>

#include "render/scene/filmed_scene.hpp"
#include "tests/draw/support.hpp"

namespace grainreel::test {
namespace {

FilmedScene with_field() {
    FilmedScene scene = wedge();
    scene.film.shows.colour.by = GrainValue::vertical_velocity;
    scene.film.shows.colour.map = ColourMap::vik;
    scene.film.shows.colour.range = {-1, 1};
    scene.film.shows.colour.unit = "m/s";
    scene.film.shows.colour.as_field = true;
    return scene;
}

// The pixel of the layer where a place of its plane is seen. Its alpha is 0 where the layer has no cell.
Shapes::Vertex seen_at(const FilmedScene& scene, const State& frame, const Vec3& place) {
    Shapes shapes;
    const View view = view_of(scene);
    FieldLayer(scene).draw(view, frame, shapes);
    const Pixel at = view.project(Vec3(scene.container.depth / 2, place.y(), place.z()));
    Shapes::Vertex nearest{};
    double least = 9;  // pixels squared: a cell is larger
    for (const Shapes::Vertex& vertex : shapes.vertices()) {
        const double away = (Pixel(vertex.x, vertex.y) - at).squaredNorm();
        if (away < least) least = away, nearest = vertex;
    }
    return nearest;
}

void expect_colour(const Shapes::Vertex& vertex, const Colour& colour) {
    EXPECT_GT(vertex.alpha, 0);
    EXPECT_NEAR(vertex.red, colour.red, 2e-3);
    EXPECT_NEAR(vertex.green, colour.green, 2e-3);
    EXPECT_NEAR(vertex.blue, colour.blue, 2e-3);
}

TEST(FieldLayer, HasTheColourOfTheGrainsThatAreNear) {
    const FilmedScene scene = with_field();
    const Vec3 left(0, -0.04, 0.1), right(0, 0.04, 0.1);
    State frame = frame_of({{left}, {right}});
    frame.velocity = {Vec3(0, 0, 0.5), Vec3(0, 0, -0.5)};
    const ColourScale scale(scene.film.shows.colour);
    expect_colour(seen_at(scene, frame, left), scale.at(0.5));
    expect_colour(seen_at(scene, frame, right), scale.at(-0.5));
    EXPECT_EQ(seen_at(scene, frame, Vec3(0, 0, 0.1)).alpha, 0) << "nobody is there";
}

TEST(FieldLayer, MeanIsWeightedByMass) {
    const FilmedScene scene = with_field();
    const Vec3 place(0, 0, 0.08);
    State frame = frame_of({{place, 0.005}, {place, 0.010}});
    frame.velocity = {Vec3(0, 0, -0.9), Vec3(0, 0, 0.45)};
    const ColourScale scale(scene.film.shows.colour);
    expect_colour(seen_at(scene, frame, place), scale.at((8 * 0.45 - 0.9) / 9));
}

// A grain of volume v has the solid fraction v / (2 pi w^2 d) in its middle, where w is three quarters of the
// mean diameter and d is the depth. The layer has its full strength from 0.3 on.
TEST(FieldLayer, IsAsStrongAsItsCellsAreFull) {
    const FilmedScene scene = with_field();
    const auto strongest = [&](const std::vector<Ball>& balls) {
        Shapes shapes;
        FieldLayer(scene).draw(view_of(scene), frame_of(balls), shapes);
        double alpha = 0;
        for (const Shapes::Vertex& vertex : shapes.vertices()) alpha = std::max(alpha, double{vertex.alpha});
        return alpha;
    };
    const Vec3 place(0, 0, 0.08);
    const double width = 0.75 * (1500 * 0.005 + 120 * 0.010) / 1620;
    const double solid = 4 * pi / 3 * 1e-9 / (2 * pi * width * width * scene.container.depth);
    const double one = strongest({{place, 0.001}});
    EXPECT_NEAR(one, 0.8 * solid / 0.3, 0.05 * one);
    EXPECT_NEAR(strongest(std::vector<Ball>(20, {place, 0.005})), 0.8, 1e-6);
}

TEST(FieldLayer, EndsAtTheWalls) {
    FilmedScene scene = with_field();
    scene.container.shape = Container::Shape::box;
    scene.film.camera.field_of_view = 0;
    scene.film.camera.azimuth = scene.film.camera.elevation = 0;
    Shapes shapes;
    const View view = view_of(scene);
    FieldLayer(scene).draw(view, frame_of({{Vec3(0, 0.07, 0.08)}, {Vec3(0, 0, 0.005)}}), shapes);
    const Pixel corner = view.project(Vec3(scene.container.depth / 2, 0.075, 0));
    ASSERT_FALSE(shapes.vertices().empty());
    double right = 0, bottom = 0;
    for (const Shapes::Vertex& vertex : shapes.vertices()) {
        right = std::max(right, double{vertex.x});
        bottom = std::max(bottom, double{vertex.y});
    }
    EXPECT_NEAR(right, corner.x(), 0.5);
    EXPECT_NEAR(bottom, corner.y(), 0.5);
}

TEST(FieldLayer, GoesWithTheContainer) {
    const FilmedScene scene = with_field();
    const Vec3 place(0, 0, 0.08), moved(0, 0, 0.004);
    State frame = frame_of({{place + moved}});
    frame.velocity = {Vec3(0, 0, 0.5)};
    frame.container().place = moved;
    State still = frame_of({{place}});
    still.velocity = frame.velocity;
    Shapes one, other;
    FieldLayer layer(scene);
    layer.draw(view_of(scene).moved_by(moved), frame, one);
    layer.draw(view_of(scene), still, other);
    ASSERT_EQ(one.vertices().size(), other.vertices().size());
    for (std::size_t v = 0; v < one.vertices().size(); ++v) {
        EXPECT_NEAR(one.vertices()[v].y, other.vertices()[v].y, 1e-3);
        EXPECT_NEAR(one.vertices()[v].red, other.vertices()[v].red, 1e-6);
    }
}

TEST(FieldLayer, CoversPaleGrainsInThePicture) {
    FilmedScene scene = with_field();
    State frame = frame_of({{Vec3(0, 0, 0.08), 0.010}});
    frame.velocity = {Vec3(0, 0, 1)};
    Renderer with(scene, 1);
    const Picture layer = with.draw(frame, "");
    scene.film.shows.colour.as_field = false;
    Renderer without(scene, 1);
    const Extent extent = changed(layer, without.draw(frame, ""), plan_layout(scene).port, 30);
    EXPECT_GT(extent.count, 500) << "wider than the grain";
}

}  // namespace
}  // namespace grainreel::test
