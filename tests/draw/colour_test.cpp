// Tests of colours that stand for numbers.
#include <gtest/gtest.h>

#include "render/picture/base/colour_scale.hpp"
#include "render/picture/base/shot.hpp"
#include "render/picture/grains/shown_grains.hpp"
#include "render/picture/plots/axes.hpp"
#include "render/scene/shown_values.hpp"
#include "tests/draw/support.hpp"

namespace grainreel::test {
namespace {

void expect_colour(const Colour& found, const Colour& expected, double within) {
    EXPECT_NEAR(found.red, expected.red, within);
    EXPECT_NEAR(found.green, expected.green, within);
    EXPECT_NEAR(found.blue, expected.blue, within);
}

double light_of(const Colour& c) {
    return 0.2126 * to_linear(c.red) + 0.7152 * to_linear(c.green) + 0.0722 * to_linear(c.blue);
}

// Compares published colours at both ends and at places of the tables of 256 colours that ours leave out.
TEST(ColourMaps, ArePublishedOnes) {
    expect_colour(colour_of(ColourMap::viridis, 0), {0.267004, 0.004874, 0.329415}, 1e-12);
    expect_colour(colour_of(ColourMap::viridis, 1), {0.993248, 0.906157, 0.143936}, 1e-12);
    expect_colour(colour_of(ColourMap::viridis, 64 / 255.0), {0.229739, 0.322361, 0.545706}, 0.002);
    expect_colour(colour_of(ColourMap::viridis, 128 / 255.0), {0.127568, 0.566949, 0.550556}, 0.003);
    expect_colour(colour_of(ColourMap::viridis, 192 / 255.0), {0.369214, 0.788888, 0.382914}, 0.003);
    expect_colour(colour_of(ColourMap::cividis, 0), {0.0, 0.135112, 0.304751}, 1e-12);
    expect_colour(colour_of(ColourMap::cividis, 1), {0.995737, 0.909344, 0.217772}, 1e-12);
    expect_colour(colour_of(ColourMap::cividis, 128 / 255.0), {0.488697, 0.485318, 0.471008}, 0.005);
    expect_colour(colour_of(ColourMap::cividis, 192 / 255.0), {0.736488, 0.680629, 0.424028}, 0.003);
    expect_colour(colour_of(ColourMap::vik, 0), {0, 0x12 / 255.0, 0x61 / 255.0}, 1e-12);
    expect_colour(colour_of(ColourMap::vik, 0.5), {0xec / 255.0, 0xe5 / 255.0, 0xe0 / 255.0}, 1e-12);
    expect_colour(colour_of(ColourMap::vik, 1), {0x59 / 255.0, 0, 0x08 / 255.0}, 1e-12);
    expect_colour(colour_of(ColourMap::viridis, -3), colour_of(ColourMap::viridis, 0), 0);
    expect_colour(colour_of(ColourMap::viridis, 3), colour_of(ColourMap::viridis, 1), 0);
}

TEST(ColourMaps, LightnessRisesAllTheWayOrTowardsTheMiddle) {
    for (int i = 0; i < 1000; ++i) {
        const double a = i / 1000.0, b = (i + 1) / 1000.0;
        for (const ColourMap map : {ColourMap::viridis, ColourMap::cividis})
            ASSERT_LT(light_of(colour_of(map, a)), light_of(colour_of(map, b))) << a;
        ASSERT_LT(light_of(colour_of(ColourMap::vik, 0.5 * a)), light_of(colour_of(ColourMap::vik, 0.5 * b)));
        ASSERT_LT(light_of(colour_of(ColourMap::vik, 1 - 0.5 * a)),
                  light_of(colour_of(ColourMap::vik, 1 - 0.5 * b)));
    }
}

FilmedScene coloured(GrainValue by, double low, double high, const std::string& unit) {
    FilmedScene scene = wedge(1280, 720);
    scene.film.shows.colour = {
        by, is_signed(by) ? ColourMap::vik : ColourMap::viridis, {low, high}, false, unit, 5};
    return scene;
}

void expect_albedo(GrainColours& colours, const Shot& frame, std::size_t grain, const Colour& expected) {
    const Albedo& albedo = colours.of(frame)[grain];
    EXPECT_NEAR(to_srgb(albedo[0]), expected.red, 0.002);
    EXPECT_NEAR(to_srgb(albedo[1]), expected.green, 0.002);
    EXPECT_NEAR(to_srgb(albedo[2]), expected.blue, 0.002);
}

Shot two_balls() {
    Shot frame = frame_of({{{0, -0.02, 0.1}, 0.0025, 0}, {{0, 0.02, 0.08}, 0.005, 1}});
    frame.velocity[0] = {0.3, 0, -0.4};
    frame.spin[1] = {0, 30, 40};
    return frame;
}

TEST(GrainColours, FollowTheFormulaOfTheQuantity) {
    const Shot frame = two_balls();
    const auto check = [&](GrainValue by, double low, double high, double first, double second) {
        const FilmedScene scene = coloured(by, low, high, "");
        GrainColours colours(scene);
        const ColourMap map = scene.film.shows.colour.map;
        SCOPED_TRACE(static_cast<int>(by));
        expect_albedo(colours, frame, 0, colour_of(map, (first - low) / (high - low)));
        expect_albedo(colours, frame, 1, colour_of(map, (second - low) / (high - low)));
    };
    check(GrainValue::speed, 0, 0.8, 0.5, 0);
    check(GrainValue::vertical_velocity, -0.8, 0.8, -0.4, 0);
    check(GrainValue::spin, 0, 80, 0, 50);
    const double mass = 2500 * 4.0 / 3 * pi * 1.25e-7;  // of the second
    const double turning = 0.5 * 0.4 * mass * 2.5e-5 * 2500;
    check(GrainValue::kinetic_energy, 0, 2 * turning, 0.5 * mass / 8 * 0.25, turning);
}

// A velocity or spin of another program's file may be no number, in one component or in all.
TEST(GrainColours, AreNeutralWhereTheQuantityIsUnknown) {
    Shot frame = two_balls();
    frame.velocity[0].x() = frame.spin[0].y() = std::nan("");
    for (const GrainValue by : {GrainValue::speed, GrainValue::spin, GrainValue::kinetic_energy}) {
        GrainColours colours(coloured(by, 0, 100, ""));
        expect_albedo(colours, frame, 0, neutral_grain);
        EXPECT_EQ(colours.clipped().above, 0) << static_cast<int>(by);
    }
}

// A grain may have a mass of its own.
TEST(GrainColours, OfKineticEnergyFollowTheOwnMass) {
    Shot frame = two_balls();
    frame.mass = {0.4, 0.4};
    GrainColours colours(coloured(GrainValue::kinetic_energy, 0, 0.1, ""));
    expect_albedo(colours, frame, 0, colour_of(ColourMap::viridis, 0.5 * 0.4 * 0.25 / 0.1));
}

// 0.5 m/s lies in the middle of 0.05 to 5 m/s if equal ratios have equal distances. A grain at rest has the
// colour of the low end.
TEST(GrainColours, OfALogarithmicScaleFollowRatios) {
    FilmedScene scene = coloured(GrainValue::speed, 0.05, 5, "");
    scene.film.shows.colour.logarithmic = true;
    GrainColours colours(scene);
    expect_albedo(colours, two_balls(), 0, colour_of(scene.film.shows.colour.map, 0.5));
    expect_albedo(colours, two_balls(), 1, colour_of(scene.film.shows.colour.map, 0));
}

TEST(GrainColours, OfOwnValuesAreThoseOfTheMap) {
    FilmedScene scene = coloured(GrainValue::own, -2, 2, "");
    scene.film.shows.colour.title = "age (s)";
    Shot frame = frame_of({{{0, 0, 0.1}, 0.005, 0}, {{0, 0.02, 0.1}, 0.005, 0}, {{0, 0.04, 0.1}, 0.005, 1}});
    GrainColours colours(scene);
    expect_albedo(colours, frame, 0, neutral_grain);  // nothing is known
    frame.own = {-2, std::numeric_limits<double>::quiet_NaN(), 1};
    expect_albedo(colours, frame, 0, colour_of(ColourMap::viridis, 0));
    expect_albedo(colours, frame, 1, neutral_grain);
    expect_albedo(colours, frame, 2, colour_of(ColourMap::viridis, 0.75));
    const ColourScale scale(scene.film.shows.colour);
    EXPECT_EQ(scale.title(), "age (s)");
    EXPECT_TRUE(scale.open_below());  // a value may be lower than the range
    // Leaving out a grain keeps the values of the others.
    ShownGrains shown = ShownGrains::only(scene, {frame.id[2]});
    EXPECT_EQ(shown.of(frame).own, std::vector<double>{1});
}

TEST(GrainLabels, SayWhichGrainIsNotThere) {
    FilmedScene scene = coloured(GrainValue::speed, 0, 1, "m/s");
    scene.film.labels = {{0, "first"}, {7, "nobody"}};
    Renderer renderer(scene, 1);
    renderer.draw(two_balls(), "");
    EXPECT_EQ(renderer.last_note(), "label \"nobody\": no grain has had the id 7");
    Shot later = two_balls();
    later.id = {0, 7};
    renderer.draw(later, "");
    EXPECT_EQ(renderer.last_note(), "");
}

TEST(GrainColours, ContactsAreCountedOfBothPartners) {
    Shot frame = two_balls();
    frame.touches = {{0, 1, 0.3}, {1, -2, 0.5}};
    GrainColours number(coloured(GrainValue::coordination, 0, 4, ""));
    expect_albedo(number, frame, 0, colour_of(ColourMap::viridis, 0.25));
    expect_albedo(number, frame, 1, colour_of(ColourMap::viridis, 0.5));
    GrainColours force(coloured(GrainValue::contact_force, 0, 1, "N"));
    expect_albedo(force, frame, 0, colour_of(ColourMap::viridis, 0.3));
    expect_albedo(force, frame, 1, colour_of(ColourMap::viridis, 0.8));
}

TEST(GrainColours, LayersAreThoseOfTheFirstFrame) {
    GrainColours colours(coloured(GrainValue::start_height, 0, 0.125, "mm"));
    Shot frame = two_balls();  // heights 0.1 and 0.08, in the fifth and the fourth of five layers
    expect_albedo(colours, frame, 0, colour_of(ColourMap::viridis, 1));
    expect_albedo(colours, frame, 1, colour_of(ColourMap::viridis, 0.75));
    std::swap(frame.position[0], frame.position[1]);
    expect_albedo(colours, frame, 0, colour_of(ColourMap::viridis, 1));
    expect_albedo(colours, frame, 1, colour_of(ColourMap::viridis, 0.75));
    Shot more = two_balls();
    more.id = {0, 2};  // one of them was not there at the start
    expect_albedo(colours, more, 1, neutral_grain);
}

TEST(GrainColours, WithoutDisplacementsTheyAreGrey) {
    GrainColours colours(coloured(GrainValue::rise, -0.004, 0.004, "mm"));
    Shot frame = two_balls();
    expect_albedo(colours, frame, 0, neutral_grain);
    frame.displacement = {{0, 0, 0.001}, {0.003, 0, -0.002}};
    expect_albedo(colours, frame, 0, colour_of(ColourMap::vik, 0.625));
    expect_albedo(colours, frame, 1, colour_of(ColourMap::vik, 0.25));
}

// A fast grain that comes into the film does not change the colours of the others.
TEST(GrainColours, MeanTheSameInEveryFrame) {
    const FilmedScene scene = coloured(GrainValue::speed, 0, 1, "m/s");
    Renderer renderer(scene, 1);
    Shot frame = two_balls();
    const Picture before = renderer.draw(frame, "");
    frame.velocity[1] = {0, 0, 100};
    const Picture after = renderer.draw(frame, "");
    const View view = view_of(scene);
    const auto pixel = [&](const Picture& picture, const Vec3& at) {
        const Pixel p = view.project(at);
        return picture.pixel(view.port.x + static_cast<int>(p.x()), view.port.y + static_cast<int>(p.y()));
    };
    for (int c = 0; c < 3; ++c)
        EXPECT_EQ(pixel(before, frame.position[0])[c], pixel(after, frame.position[0])[c]);
    EXPECT_NEAR(hue(pixel(after, frame.position[1])), hue(colour_of(ColourMap::viridis, 1)), 8);
    EXPECT_NEAR(hue(pixel(before, frame.position[0])), hue(colour_of(ColourMap::viridis, 0.5)), 8);
}

// CIE L*a*b* of an sRGB colour, white D65.
std::array<double, 3> lab(const Colour& c) {
    const double r = to_linear(c.red), g = to_linear(c.green), b = to_linear(c.blue);
    const auto f = [](double t) { return t > 216.0 / 24389 ? std::cbrt(t) : (24389.0 / 27 * t + 16) / 116; };
    const double x = f((0.4124 * r + 0.3576 * g + 0.1805 * b) / 0.9505);
    const double y = f(0.2126 * r + 0.7152 * g + 0.0722 * b);
    const double z = f((0.0193 * r + 0.1192 * g + 0.9505 * b) / 1.089);
    return {116 * y - 16, 500 * (x - y), 200 * (y - z)};
}

double apart(const std::array<double, 3>& a, const std::array<double, 3>& b) {
    return std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]);
}

// Each pixel of a packed bed is read by the map: the value of the nearest colour.
TEST(GrainColours, AreReadThroughLightAndShade) {
    std::vector<Ball> balls;
    for (double z = 0.003; z < 0.12; z += 0.0045)
        for (double y = -0.07; y <= 0.07; y += 0.0055)
            for (double x = -0.017; x <= 0.017; x += 0.0055)
                if (std::abs(y) < 0.035 + 0.35 * z) balls.push_back({{x, y, z}, 0.00255, 0});
    for (const auto style : {FilmLook::Style::studio, FilmLook::Style::dark})
        for (const ColourMap map : {ColourMap::viridis, ColourMap::cividis}) {
            FilmedScene scene = coloured(GrainValue::speed, 0, 1, "m/s");
            scene.film.look = FilmLook::of(style);
            scene.film.look.ground = false;
            scene.film.shows.colour.map = map;
            Renderer renderer(scene, 2);
            Shot frame = frame_of(balls);
            std::vector<std::array<double, 3>> of_map;
            for (int k = 0; k <= 100; ++k) of_map.push_back(lab(colour_of(map, 0.01 * k)));
            // Without light, walls are the same with and without grains.
            FilmedScene plain = scene;
            plain.film.look.shadows = plain.film.look.occlusion = false;
            Renderer unlit(plain, 2);
            const Picture empty = unlit.draw(frame_of({}), "");
            double off = 0, colour_off = 0, pixels = 0;
            for (const double value : {0.1, 0.3, 0.5, 0.7, 0.9}) {
                frame.velocity.assign(balls.size(), Vec3(0, 0, value));
                const Picture grains = unlit.draw(frame, "");
                const Picture& picture = renderer.draw(frame, "");
                const Rectangle port = view_of(scene).port;
                const auto own = lab(colour_of(map, value));
                for (int y = port.y; y < port.y + port.height; y += 3)
                    for (int x = port.x; x < port.x + port.width; x += 3) {
                        if (difference(empty, grains, x, y) < 30) continue;
                        const std::uint8_t* p = picture.pixel(x, y);
                        const auto seen = lab({p[0] / 255.0, p[1] / 255.0, p[2] / 255.0});
                        double best = 0, nearest = 1e9;
                        for (int k = 0; k <= 100; ++k) {
                            const double d = apart(seen, of_map[k]);
                            if (d < nearest) nearest = d, best = 0.01 * k;
                        }
                        off += std::abs(best - value);
                        colour_off += apart(seen, own);
                        ++pixels;
                    }
            }
            ASSERT_GT(pixels, 5000);
            EXPECT_LT(off / pixels, 0.07);
            EXPECT_LT(colour_off / pixels, 11);  // in L*a*b*; it is 17 to 23 in the light of plain grains
        }
}

// Some row of the first gutter holds the whole bar: its left end and, `width` to the right, its right end.
TEST(ColourBar, EndsAreTheMapsEnds) {
    for (const GrainValue by : {GrainValue::speed, GrainValue::vertical_velocity, GrainValue::start_height}) {
        for (const auto& [width, height] : {std::pair{1280, 720}, {720, 1280}, {640, 360}}) {
            FilmedScene scene = coloured(by, -1, 1, "");
            scene.film.width = width;
            scene.film.height = height;
            const Rectangle part = plan_layout(scene).first;
            const Picture picture = Renderer(scene, 1).draw(frame_of({}), "");
            const ColourMap map = scene.film.shows.colour.map;
            const auto is = [&](int x, int y, const Colour& colour) {
                const std::uint8_t* p = picture.pixel(x, y);
                return std::abs(p[0] - 255 * colour.red) < 0.6 && std::abs(p[1] - 255 * colour.green) < 0.6 &&
                       std::abs(p[2] - 255 * colour.blue) < 0.6;
            };
            int rows = 0, longest = 0;
            for (int y = part.y; y < part.y + part.height; ++y) {
                int left = -1, right = -1;
                for (int x = part.x; x < part.x + part.width; ++x) {
                    if (left < 0 && is(x, y, colour_of(map, 0))) left = x;
                    if (is(x, y, colour_of(map, 1))) right = x;
                }
                if (left < 0 || right <= left) continue;
                ++rows;
                longest = std::max(longest, right - left + 1);
            }
            const TypeScale type = plan_layout(scene).type;
            EXPECT_GE(rows, static_cast<int>(0.3 * type.main));  // the tips of a bar that clips are narrower
            EXPECT_GE(longest, 0.6 * part.width);
        }
    }
}

TEST(Ticks, AreRoundAndInside) {
    EXPECT_EQ(round_ticks(0, 0.78, 6), (std::vector<double>{0, 0.2, 2 * 0.2, 3 * 0.2}));
    EXPECT_EQ(round_ticks(-6, 6, 4), (std::vector<double>{-5, 0, 5}));
    EXPECT_EQ(round_ticks(0, 1, 11).size(), 11u);
    // There is room for two ticks. Of the round numbers at distances of 1 only 0 lies inside, so the ends are
    // better.
    const AxisTicks ends = axis_ticks(-0.5, 0.5, 2, 5);
    EXPECT_EQ(ends.at, (std::vector<double>{-0.5, 0.5}));
    EXPECT_EQ(tick_text(ends.at[0], ends.distance), "−0.5");
    EXPECT_EQ(axis_ticks(-0.5, 0.5, 3, 5).at, (std::vector<double>{-0.5, 0, 0.5}));
    EXPECT_EQ(tick_text(0.4, 0.2), "0.4");
    EXPECT_EQ(tick_text(-50, 50), "−50");
    EXPECT_EQ(tick_text(-1e-17, 0.05), "0.00");
    EXPECT_EQ(round_limits(0.03, 0.92, 6), (std::array<double, 2>{0, 1}));
    const auto [low, high] = round_limits(0.5, 0.5, 5);
    EXPECT_LE(low, 0.5);
    EXPECT_GT(high, low);
}

// One species is coloured by its speed; the other keeps its own colour, and is not counted beyond the range.
TEST(GrainColours, MayBeThoseOfSomeSpeciesOnly) {
    FilmedScene scene = coloured(GrainValue::speed, 0, 0.8, "");
    scene.film.shows.colour.species = {0};
    scene.colours.at(1) = {0.2, 0.4, 0.6};
    Shot frame = two_balls();
    frame.velocity[1] = {0, 0, 9};
    GrainColours colours(scene);
    expect_albedo(colours, frame, 0, colour_of(ColourMap::viridis, 0.5 / 0.8));
    expect_albedo(colours, frame, 1, {0.2, 0.4, 0.6});
    EXPECT_EQ(colours.clipped().above, 0);
}

}  // namespace
}  // namespace grainreel::test
