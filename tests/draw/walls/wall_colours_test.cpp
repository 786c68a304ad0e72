// Tests of meshes that are coloured by what grains do to them: the colours of triangles, and the bar that
// explains them.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <memory>

#include "engine/measure/walls/mesh_wear.hpp"
#include "engine/mesh/load_mesh.hpp"
#include "engine/mesh/surface.hpp"
#include "render/picture/base/colour_scale.hpp"
#include "render/picture/base/shot.hpp"
#include "render/picture/mesh/scene_meshes.hpp"
#include "render/picture/panels/panels.hpp"
#include "render/picture/plots/axes.hpp"
#include "render/picture/words/blocks.hpp"
#include "tests/draw/support.hpp"

namespace grainreel::test {
namespace {

constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();

// A plate of four triangles, seen from above. Its triangle k is the one whose middle is middle(k).
struct Plate {
    FilmedScene scene = wedge(480, 360);
    static constexpr double kHalf = 0.05;  // m

    Plate() {
        scene.container.shape = Container::Shape::none;
        scene.drive.present = false;
        scene.film.camera.elevation = 70;
        TriangleMesh square{
            {{-kHalf, -kHalf, 0}, {kHalf, -kHalf, 0}, {kHalf, kHalf, 0}, {-kHalf, kHalf, 0}, {0, 0, 0}},
            {{0, 1, 4}, {1, 2, 4}, {2, 3, 4}, {3, 0, 4}}};
        SceneMesh& mesh = scene.meshes.emplace_back();
        mesh.name = "plate";
        mesh.low = {-kHalf, -kHalf, 0}, mesh.high = {kHalf, kHalf, 0};
        become(square);
        scene.film.look.walls.colour = FilmWalls::Colour::pressure;
        scene.film.look.walls.range = {10, 1000};
    }
    void become(TriangleMesh mesh) {
        MeshFacts facts;
        mend(mesh, facts);
        scene.meshes[0].surface.of = std::make_shared<const Surface>(mesh, facts, "plate");
    }
    // A strip of thin triangles; its corners come in pairs, one of each side.
    void become_strip(const std::vector<Vec3>& corners) {
        TriangleMesh strip{corners, {}};
        for (int k = 0; k + 3 < static_cast<int>(corners.size()); k += 2) {
            strip.triangles.push_back({k, k + 2, k + 1});
            strip.triangles.push_back({k + 1, k + 2, k + 3});
        }
        become(std::move(strip));
    }
    Vec3 middle(std::size_t k) const {
        const Surface& surface = *scene.meshes[0].surface;
        const auto t = static_cast<std::int32_t>(k);
        return (surface.corner(t, 0) + surface.corner(t, 1) + surface.corner(t, 2)) / 3;
    }
    Shot frame(const std::vector<double>& pressure, const std::vector<double>& wear) const {
        Shot frame = frame_of({{{0, 0, 0.2}, 0.001, 0}});
        frame.worn = std::make_shared<const std::vector<MeshWear>>(std::vector<MeshWear>{{pressure, wear}});
        return frame;
    }
    const std::uint8_t* pixel(const Picture& picture, std::size_t k) const {
        const View view = view_of(scene);
        const Pixel at = view.project(middle(k));  // from the port's corner
        return picture.pixel(view.port.x + static_cast<int>(at.x()), view.port.y + static_cast<int>(at.y()));
    }
};

// The colours go in their own order, from the light end of bilbao to its dark one.
TEST(WallColours, GoByPowersOfTen) {
    FilmWalls walls;
    walls.colour = FilmWalls::Colour::pressure;
    walls.range = {10, 1000};
    const ColourScale scale(walls);
    EXPECT_NEAR(scale.share_of(100), 0.5, 1e-12);
    EXPECT_NEAR(scale.share_of(1000), 1, 1e-12);
    EXPECT_LE(scale.share_of(0), 0);
    EXPECT_EQ(scale.title(), "pressure on walls (kPa)");
    EXPECT_TRUE(scale.open_below());
    EXPECT_GT(scale.at(10).green, scale.at(100).green);
    EXPECT_GT(scale.at(100).green, scale.at(1000).green);
    EXPECT_EQ(scale.at(0), scale.at(10));
    walls.range = {0, 1000};
    EXPECT_NEAR(ColourScale(walls).share_of(250), 0.25, 1e-12);
    walls.colour = FilmWalls::Colour::wear;
    walls.range = {1e-3, 0.1};
    EXPECT_EQ(ColourScale(walls).title(), "wear of walls (mJ/m²)");
    EXPECT_EQ(ColourScale(walls).unit_size(), 1e-3);
}

TEST(WallColours, TicksArePowersOfTen) {
    const auto expect = [](const std::vector<double>& found, const std::vector<double>& wanted) {
        ASSERT_EQ(found.size(), wanted.size());
        for (std::size_t i = 0; i < found.size(); ++i) EXPECT_NEAR(found[i], wanted[i], 1e-9 * wanted[i]);
    };
    expect(power_ticks(0.02, 20, 6), {0.1, 1, 10});
    expect(power_ticks(0.01, 10, 6), {0.01, 0.1, 1, 10});
    expect(power_ticks(1e-6, 1, 3), {1e-6, 1e-3, 1});
    expect(power_ticks(3, 40, 6), {5, 10, 20});
}

// A triangle has the bar's colour under the full light of the lamp, or is darker by as much as it is turned
// away from the lamp.
TEST(WallColours, ATriangleHasTheColourOfItsPressure) {
    Plate plate;
    const ColourScale scale(plate.scene.film.look.walls);
    const std::vector<double> pressure{10, 100, 1000, kUnknown};
    Renderer renderer(plate.scene, 1);
    const Picture coloured = renderer.draw(plate.frame(pressure, {5, 5, 5, 5}), "");
    for (std::size_t k = 0; k < 3; ++k) {
        const std::uint8_t* seen = plate.pixel(coloured, k);
        const Colour wanted = scale.at(pressure[k]);
        const double light = seen[0] / (255 * wanted.red);
        EXPECT_GT(light, 0.69) << k;
        EXPECT_LT(light, 1.01) << k;
        EXPECT_NEAR(seen[1], 255 * wanted.green * light, 2.5) << k;
        EXPECT_NEAR(seen[2], 255 * wanted.blue * light, 2.5) << k;
    }
    // If the pressure is not known, triangles look like other walls.
    Plate plain;
    plain.scene.film.look.walls = {};
    const Picture without = Renderer(plain.scene, 1).draw(plain.frame(pressure, {5, 5, 5, 5}), "");
    for (int c = 0; c < 3; ++c) EXPECT_EQ(plate.pixel(coloured, 3)[c], plain.pixel(without, 3)[c]);
    EXPECT_NE(plate.pixel(coloured, 2)[0], plain.pixel(without, 2)[0]);
}

// A strip of long thin triangles: each shares its wear with its neighbours, so that no spikes are seen.
TEST(WallColours, ThinTrianglesShareTheirWear) {
    Plate plate;
    constexpr int kAlong = 12;
    std::vector<Vec3> corners;
    for (int k = 0; k <= kAlong; ++k)
        for (const double y : {0.0, 0.1}) corners.emplace_back(0.01 * k, y, 0);
    plate.become_strip(corners);
    SceneMeshes meshes(plate.scene);
    std::vector<double> pressure;
    for (int t = 0; t < 2 * kAlong; ++t) pressure.push_back(t % 4 == 0 ? 900 : 15);
    meshes.colour_by(plate.frame(pressure, pressure));
    const auto& colours = *meshes.at(frame_of({})).front().colours;
    for (std::size_t t = 4; t + 5 < colours.size(); ++t)
        EXPECT_NEAR(colours[t][1], colours[t + 1][1], 12) << t;
    const ColourScale scale(plate.scene.film.look.walls);
    EXPECT_LT(colours[10][1], 255 * scale.at(15).green - 20);
}

// A thin triangle's colour goes from corner to corner, and neighbours meet in one colour: along a line over
// the strip no pixel differs much from the next.
TEST(WallColours, ThinTrianglesBlendIntoEachOther) {
    Plate plate;
    constexpr int kAlong = 10;
    std::vector<Vec3> corners;
    for (int k = 0; k <= kAlong; ++k)
        for (const double x : {0.05, -0.05}) corners.emplace_back(x, 0.01 * k - 0.05, 0);
    plate.become_strip(corners);
    std::vector<double> pressure;
    for (int t = 0; t < 2 * kAlong; ++t) pressure.push_back(t < kAlong ? 12 : 900);
    const Picture picture = Renderer(plate.scene, 1).draw(plate.frame(pressure, pressure), "");
    const View view = view_of(plate.scene);
    const Pixel from = view.project({0, -0.045, 0}), to = view.project({0, 0.045, 0});
    int largest = 0, all = 0;
    const auto green = [&](double share) {
        const Pixel at = from + share * (to - from);
        return int{
            picture.pixel(view.port.x + static_cast<int>(at.x()), view.port.y + static_cast<int>(at.y()))[1]};
    };
    const int steps = static_cast<int>((to - from).norm());
    ASSERT_GT(steps, 80);
    for (int k = 0; k < steps; ++k) {
        const int step = std::abs(green((k + 1.0) / steps) - green(1.0 * k / steps));
        largest = std::max(largest, step), all += step;
    }
    EXPECT_GT(all, 60);
    EXPECT_LE(largest, 12);
}

TEST(WallColours, WearIsAnotherQuantityAndNothingFlickers) {
    Plate plate;
    plate.scene.film.look.walls.colour = FilmWalls::Colour::wear;
    SceneMeshes meshes(plate.scene);
    meshes.colour_by(plate.frame({10, 10, 10, 10}, {1, 10, 100, 5000}));
    const auto first = *meshes.at(frame_of({})).front().colours;
    const ColourScale scale(plate.scene.film.look.walls);
    EXPECT_NEAR(first[2][0], 255 * scale.at(100).red, 1e-3);
    EXPECT_EQ(first[0], first[1]);  // both at the low end
    meshes.colour_by(plate.frame({10, 10, 10, 10}, {1, 10, 100, 1e6}));
    EXPECT_EQ(*meshes.at(frame_of({})).front().colours, first);
    EXPECT_EQ(meshes.clipped().all, 8);
    EXPECT_EQ(meshes.clipped().above, 2);
    EXPECT_EQ(
        clipped_words(plate.scene.film.look.walls, meshes.clipped()),
        "walls by wear: 25 % of the triangles lie above 1 kJ/m², where the bar ends (film.walls.range)");
    meshes.colour_by(frame_of({}));  // the wear at that moment is not known
    EXPECT_EQ(meshes.at(frame_of({})).front().colours, nullptr);
}

// If grains are coloured too, there are two bars.
TEST(WallColours, HaveABarOfTheirOwn) {
    Plate plate;
    const TypeScale type = type_scale(plate.scene.film);
    const Palette palette = make_palette(plate.scene.film.background);
    const Writer measure{nullptr, type, palette};
    const auto height = [&](const FilmedScene& scene) {
        return colour_bar_block(measure, scene, 0, 0, 150).height;
    };
    FilmedScene grains = plate.scene, both = plate.scene, none = plate.scene;
    none.film.look.walls = {};
    grains.film.look.walls = {};
    grains.film.shows.colour = {GrainValue::speed, ColourMap::viridis, {0, 0.3}, false, "cm/s", 5};
    both.film.shows.colour = grains.film.shows.colour;
    EXPECT_EQ(height(none), 0);
    EXPECT_GT(height(plate.scene), 0);
    EXPECT_NEAR(height(both), height(grains) + type.gap + height(plate.scene),
                1);  // bars lie on whole pixels
    EXPECT_EQ(colour_scales(both.film).size(), 2u);
}

TEST(WallColours, OneRangeHoldsInAllPanels) {
    std::vector<Panel> panels(2);
    for (Panel& panel : panels) panel.scene = Plate().scene;
    panels[1].scene.film.look.walls.range = {1, 500};
    share_colours(panels);
    for (const Panel& panel : panels)
        EXPECT_EQ(panel.scene.film.look.walls.range, (std::array<double, 2>{1, 1000}));
    panels[0].scene.film.look.walls.range = {1, 2};
    EXPECT_FALSE(common_of(panels).colours);
    panels[0].scene.film.look.walls.fixed = true;
    share_colours(panels);
    EXPECT_EQ(panels[1].scene.film.look.walls.range[1], 1000);
}

}  // namespace
}  // namespace grainreel::test
