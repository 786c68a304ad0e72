// Tests of profiles beside the grains.
#include "render/picture/plots/profile_plot.hpp"

#include <gtest/gtest.h>

#include "render/picture/base/cairo_text.hpp"
#include "render/scene/filmed_scene.hpp"
#include "tests/draw/support.hpp"

namespace grainreel::test {
namespace {

constexpr int width = 300, height = 220;

FilmPlot plot_of(ProfileOf profile, bool across) {
    FilmPlot plot;
    plot.profile = profile;
    plot.across = across;
    plot.label = "profile";
    if (plot.of_velocity()) plot.dimension = Dimension::speed;
    return plot;
}

FilmedScene boxed() {
    FilmedScene scene = wedge();
    scene.container.shape = Container::Shape::box;
    scene.film.camera.frame = FramingScope::container;
    return scene;
}

Picture drawn(const FilmedScene& scene, const FilmPlot& plot, const State& frame) {
    const Palette palette = make_palette({1, 1, 1});
    ProfilePlot profile(scene, plot, width, height, type_scale(scene.film), palette);
    EXPECT_TRUE(profile.take(frame));
    const CairoSurface surface = blank_surface({0, 0, width, height}, {1, 1, 1});
    profile.draw(CairoContext(cairo_create(surface.get())).get(), 0, 0);
    Picture picture(width, height);
    copy_surface(surface.get(), {0, 0, width, height}, picture);
    return picture;
}

std::array<double, 2> pixel_at(const FilmedScene& scene, const FilmPlot& plot, double value, double place) {
    return ProfilePlot(scene, plot, width, height, type_scale(scene.film), make_palette({1, 1, 1}))
        .pixel_of(value, place);
}

// Whether a pixel within two pixels of the place has the hue.
bool has_hue(const Picture& picture, const std::array<double, 2>& at, double wanted) {
    for (int dx = -2; dx <= 2; ++dx)
        for (int dy = -2; dy <= 2; ++dy) {
            const std::uint8_t* p = picture.pixel(static_cast<int>(at[0]) + dx, static_cast<int>(at[1]) + dy);
            const int spread = std::max({p[0], p[1], p[2]}) - std::min({p[0], p[1], p[2]});
            if (spread > 60 && std::abs(hue(p) - wanted) < 15) return true;
        }
    return false;
}

// A bed whose lower half is full of the first species and whose upper half is full of the second one.
State two_layers(bool upright) {
    std::vector<Ball> balls;
    for (int i = 0; i < 4; ++i)
        for (int j = 0; j < 30; ++j)
            for (int k = 0; k < 32; ++k) {
                const bool second = upright ? j >= 15 : k >= 16;
                balls.push_back(
                    {{-0.015 + 0.01 * i, -0.0725 + 0.005 * j, 0.0025 + 0.005 * k}, 0.0025, second ? 1 : 0});
            }
    return frame_of(balls);
}

TEST(ProfilePlots, SharesBySpeciesLieWhereTheyAre) {
    const FilmedScene scene = boxed();
    for (const bool across : {false, true}) {
        const FilmPlot plot = plot_of(ProfileOf::share, across);
        const Picture picture = drawn(scene, plot, two_layers(across));
        const auto seen = [&](double value, double place, const Colour& colour) {
            return has_hue(picture, pixel_at(scene, plot, value, place), hue(colour));
        };
        const double low = across ? -0.04 : 0.03, high = across ? 0.04 : 0.13;
        EXPECT_TRUE(seen(1, low, blue));
        EXPECT_TRUE(seen(0, low, orange));
        EXPECT_TRUE(seen(1, high, orange));
        EXPECT_TRUE(seen(0, high, blue));
        EXPECT_TRUE(seen(0.5, across ? 0.0 : 0.08, orange)) << "the border of the layers";
        EXPECT_FALSE(seen(0.5, low, blue));
        EXPECT_FALSE(seen(0.5, high, orange));
    }
}

// Four grains of 5 mm in a depth of 40 mm on a square lattice of 5 mm.
TEST(ProfilePlots, SolidFractionsAreVolumeOverVolume) {
    const FilmedScene scene = boxed();
    const FilmPlot plot = plot_of(ProfileOf::solid_fraction, false);
    const Picture picture = drawn(scene, plot, two_layers(false));
    const double solid = 4 * (pi / 6 * std::pow(0.005, 3)) / (0.04 * 0.005 * 0.005);
    EXPECT_TRUE(has_hue(picture, pixel_at(scene, plot, solid, 0.03), hue(blue)));
    EXPECT_TRUE(has_hue(picture, pixel_at(scene, plot, solid, 0.13), hue(orange)));
    EXPECT_FALSE(has_hue(picture, pixel_at(scene, plot, 1.3 * solid, 0.03), hue(blue)));
}

// An axis from -0.1 to 0.25 has a tick at 0 and none at 0.15.
TEST(ProfilePlots, TicksStandAtTheirValues) {
    const FilmedScene scene = boxed();
    FilmPlot plot = plot_of(ProfileOf::vertical_velocity, false);
    plot.range = std::array<double, 2>{-0.1, 0.25};
    const Picture picture = drawn(scene, plot, frame_of({}));
    const auto has_tick = [&](double value) {
        const auto [x, y] = pixel_at(scene, plot, value, 0);
        int darkest = 255;
        for (int dx = -1; dx <= 1; ++dx)
            darkest =
                std::min<int>(darkest, *picture.pixel(static_cast<int>(x) + dx, static_cast<int>(y) + 1));
        return darkest < 200;
    };
    EXPECT_TRUE(has_tick(0));
    EXPECT_FALSE(has_tick(0.15)) << "its mirror image";
}

TEST(ProfilePlots, HeightGoesUpAndWidthToTheRight) {
    const FilmedScene scene = boxed();
    const FilmPlot over_height = plot_of(ProfileOf::solid_fraction, false),
                   over_width = plot_of(ProfileOf::solid_fraction, true);
    EXPECT_LT(pixel_at(scene, over_height, 0, 0.1)[1], pixel_at(scene, over_height, 0, 0.05)[1]);
    EXPECT_GT(pixel_at(scene, over_height, 0.4, 0)[0], pixel_at(scene, over_height, 0.2, 0)[0]);
    EXPECT_GT(pixel_at(scene, over_width, 0, 0.05)[0], pixel_at(scene, over_width, 0, -0.05)[0]);
    EXPECT_LT(pixel_at(scene, over_width, 0.4, 0)[1], pixel_at(scene, over_width, 0.2, 0)[1]);
}

// Axes stand still; only the curve changes from frame to frame.
TEST(ProfilePlots, VelocitiesFollowTheFrame) {
    const FilmedScene scene = boxed();
    FilmPlot plot = plot_of(ProfileOf::vertical_velocity, true);
    plot.range = std::array<double, 2>{-0.2, 0.2};
    State frame = two_layers(false);
    const auto moving = [&](double speed) {
        for (Vec3& velocity : frame.velocity) velocity = Vec3(0, 0, speed);
        return drawn(scene, plot, frame);
    };
    const Picture up = moving(0.1), down = moving(-0.1);
    const auto dark = [&](const Picture& picture, double value) {
        const auto [x, y] = pixel_at(scene, plot, value, 0.01);
        int darkest = 255;
        for (int dy = -2; dy <= 2; ++dy)
            darkest = std::min<int>(darkest, *picture.pixel(static_cast<int>(x), static_cast<int>(y) + dy));
        return darkest < 120;
    };
    EXPECT_TRUE(dark(up, 0.1));
    EXPECT_FALSE(dark(up, -0.1));
    EXPECT_TRUE(dark(down, -0.1));
    EXPECT_FALSE(dark(down, 0.1));
}

}  // namespace
}  // namespace grainreel::test
