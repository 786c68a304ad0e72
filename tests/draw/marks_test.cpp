// Tests of plots, arrows, trails, and grains that are left out or ringed.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <limits>

#include "engine/measure/columns.hpp"
#include "engine/measure/measures.hpp"
#include "engine/scene/bed.hpp"
#include "render/picture/base/shot.hpp"
#include "render/picture/grains/shown_grains.hpp"
#include "render/picture/marks/marks.hpp"
#include "render/picture/plots/plot.hpp"
#include "render/picture/words/overlay.hpp"
#include "render/scene/filmed_scene.hpp"
#include "tests/draw/support.hpp"

namespace grainreel::test {
namespace {

FilmedScene with_plot(int width, int height) {
    FilmedScene scene = wedge(width, height);
    scene.run.duration = 4;
    scene.film.shows.plots = {{"lacey", "mixing", std::array<double, 2>{0, 1}}};
    return scene;
}

// A frame with all rows of a table that has times and one column.
Shot frame_with_rows(const std::vector<std::array<double, 2>>& rows) {
    const auto table = std::make_shared<MeasureTable>(std::vector<std::string>{"time_s", "lacey"});
    for (const auto& [time, value] : rows) table->add({time, value});
    Shot frame = frame_of({});
    frame.measures = table;
    frame.measure_rows = rows.size();
    return frame;
}

// The middle of the accent-coloured pixels in the gutter of plots, below the dial. Pixels are weighted by
// their difference from a picture without rows.
Pixel marker(const Picture& picture, const Rectangle& part, const Colour& accent) {
    double weight = 0, x = 0, y = 0;
    for (int j = part.y; j < part.y + part.height; ++j)
        for (int i = part.x; i < part.x + part.width; ++i) {
            const std::uint8_t* p = picture.pixel(i, j);
            const double away = std::abs(p[0] - 255 * accent.red) + std::abs(p[1] - 255 * accent.green) +
                                std::abs(p[2] - 255 * accent.blue);
            if (away > 60) continue;
            weight += 1;
            x += i + 0.5;
            y += j + 0.5;
        }
    return {x / weight, y / weight};
}

TEST(Plots, TheMarkerIsWhereTheLastRowIs) {
    for (const auto& [width, height] : {std::pair{1280, 720}, {720, 1280}}) {
        const FilmedScene scene = with_plot(width, height);
        const PictureLayout layout = plan_layout(scene);
        const Palette palette = make_palette(scene.film.background);
        const NumbersPlan plan = plan_numbers({nullptr, layout.type, palette}, scene, layout);
        ASSERT_EQ(plan.plots.size(), 1u);
        Rectangle part = plan.plots[0];
        part.x += layout.second.x;
        part.y += layout.second.y;
        ASSERT_LE(part.y + part.height, height);
        Renderer renderer(scene, 1);
        const auto at = [&](double time, double value) {
            return marker(renderer.draw(frame_with_rows({{0, 0.5}, {time, value}}), ""), part,
                          palette.accent);
        };
        // Times and values are linear along the axes: this checks corners and a point between them.
        const Pixel origin = at(0, 0), right = at(4, 0), top = at(0, 1), between = at(1, 0.75);
        EXPECT_NEAR(origin.x(), top.x(), 0.6);
        EXPECT_NEAR(origin.y(), right.y(), 0.6);
        EXPECT_GT(right.x() - origin.x(), 0.4 * part.width);
        EXPECT_GT(origin.y() - top.y(), 0.3 * part.height);
        EXPECT_NEAR(between.x(), origin.x() + 0.25 * (right.x() - origin.x()), 0.6);
        EXPECT_NEAR(between.y(), origin.y() + 0.75 * (top.y() - origin.y()), 0.6);
    }
}

PlotRange any_plot() {
    PlotRange frame;
    frame.column = "lacey";
    frame.label = "mixing";
    frame.time = {0, 10};
    frame.width = 300;
    frame.height = 160;
    return frame;
}

TEST(Plots, LimitsOnlyGrowAndDependOnTheRowsAlone) {
    const FilmedScene scene = wedge(1280, 720);
    const TypeScale type = type_scale(scene.film);
    const Palette palette = make_palette(scene.film.background);
    std::vector<std::array<double, 2>> rows;
    Plot step_by_step(any_plot(), type, palette);
    double above = -1e9, below = 1e9;  // the ends of the limits, as values
    for (int i = 0; i < 200; ++i) {
        rows.push_back({0.05 * i, 3 + 0.01 * i * std::sin(0.3 * i)});
        step_by_step.take(frame_with_rows(rows));
        // A pixel's row is linear in the value between the ends, so two values give both ends.
        const double y0 = step_by_step.y_of(rows.back()[1]);
        EXPECT_GE(y0, 0);
        const double size = std::abs(step_by_step.y_of(3) - step_by_step.y_of(3.0001)) / 0.0001;
        if (i == 0) continue;
        EXPECT_LE(size, below * (1 + 1e-6)) << i;  // pixels for a unit: the axis never zooms in again
        below = size;
        above = std::max(above, size);
    }
    EXPECT_LT(below, 0.5 * above);
    Plot at_once(any_plot(), type, palette);
    at_once.take(frame_with_rows(rows));
    EXPECT_EQ(at_once.y_of(3.3), step_by_step.y_of(3.3));
    // An earlier frame is drawn as if the later ones had not been.
    rows.resize(20);
    step_by_step.take(frame_with_rows(rows));
    Plot early(any_plot(), type, palette);
    early.take(frame_with_rows(rows));
    EXPECT_EQ(early.y_of(3.05), step_by_step.y_of(3.05));
}

TEST(Plots, KnowWhatColumnsCannotBeNegative) {
    FilmedScene scene = wedge(1280, 720);
    scene.container.height = 0.3;
    std::vector<std::string> names;
    for (const MeasureColumn& column : measure_columns(scene)) names.push_back(column.name);
    for (const std::string& column : columns_from_zero())
        EXPECT_EQ(std::count(names.begin(), names.end(), column), 1) << column;
    FilmPlot plot;
    plot.column = column_part(scene.species[0].name) + "_height_m";
    EXPECT_EQ(std::count(names.begin(), names.end(), plot.column), 1);
    EXPECT_TRUE(plot_frame(scene, plot).from_zero);
    EXPECT_EQ(plot_frame(scene, plot).expected, 0.3);
    plot.column = "height_difference";
    EXPECT_FALSE(plot_frame(scene, plot).from_zero);
    plot.column = "outflow_kg";
    EXPECT_EQ(plot_frame(scene, plot).expected, total_mass(scene));
}

// The axis of a measure that cannot be negative begins at 0, whatever value comes first.
TEST(Plots, AxesOfWhatCannotBeNegativeBeginAtZero) {
    const FilmedScene scene = wedge(1280, 720);
    const TypeScale type = type_scale(scene.film);
    for (const auto& rows : {std::vector<std::array<double, 2>>{{0, 0}, {1, 0}, {2, 0.02}, {3, 0.04}},
                             {{0, 0.04}, {1, 0.02}, {2, 0.03}},
                             {{0, 5}, {1, 5.1}},
                             {{0, 0}}}) {
        PlotRange frame = any_plot();
        frame.from_zero = true;
        Plot plot(frame, type, make_palette(scene.film.background));
        plot.take(frame_with_rows(rows));
        ASSERT_TRUE(plot.limits());
        EXPECT_EQ((*plot.limits())[0], 0);
        for (const auto& [time, value] : rows) EXPECT_GE((*plot.limits())[1], value);
        EXPECT_LE((*plot.limits())[1], 2 * rows.back()[1] + 0.1);
    }
}

// The title with its unit is the same from the first row on if the size is known.
TEST(Plots, TheUnitIsThatOfWhatIsExpected) {
    const FilmedScene scene = wedge(1280, 720);
    const TypeScale type = type_scale(scene.film);
    const auto title = [&](double expected, const std::vector<std::array<double, 2>>& rows) {
        PlotRange frame = any_plot();
        frame.dimension = Dimension::mass;
        frame.from_zero = true;
        frame.expected = expected;
        Plot plot(frame, type, make_palette(scene.film.background));
        plot.take(frame_with_rows(rows));
        const CairoSurface surface = blank_surface({0, 0, 300, 160}, {1, 1, 1});
        plot.draw(CairoContext(cairo_create(surface.get())).get(), 0, 0);
        Picture picture(300, 160);
        copy_surface(surface.get(), {0, 0, 300, 160}, picture);
        std::vector<int> pixels;
        for (int y = 0; y < 14; ++y)
            for (int x = 0; x < 300; ++x) pixels.push_back(picture.pixel(x, y)[0]);
        return pixels;
    };
    const auto late = title(0.05, {{0, 0}, {1, 0.02}});
    EXPECT_EQ(title(0.05, {{0, 0}}), late);
    EXPECT_EQ(title(0.05, {{0, 0}, {1, 2e-8}}), late);
    EXPECT_NE(title(0, {{0, 0}, {1, 2e-8}}), late) << "not known";
}

// "sand (g)" is drawn as the words "sand" with that unit are, and not as "sand (g) (mg)".
TEST(Plots, ALabelMaySayItsUnit) {
    const FilmedScene scene = wedge(1280, 720);
    const auto drawn = [&](const std::string& label, double expected) {
        PlotRange size = any_plot();
        FilmPlot shown;
        shown.column = size.column;  // of which no range is known
        shown.label = label;
        shown.dimension = Dimension::mass;
        PlotRange frame = plot_frame(scene, shown);
        frame.width = size.width;
        frame.height = size.height;
        frame.expected = expected;
        Plot plot(frame, type_scale(scene.film), make_palette(scene.film.background));
        plot.take(frame_with_rows({{0, 0}, {1, 2e-4}}));
        const CairoSurface surface = blank_surface({0, 0, frame.width, frame.height}, {1, 1, 1});
        plot.draw(CairoContext(cairo_create(surface.get())).get(), 0, 0);
        Picture picture(frame.width, frame.height);
        copy_surface(surface.get(), {0, 0, frame.width, frame.height}, picture);
        std::vector<int> pixels;
        for (int y = 0; y < frame.height; ++y)
            for (int x = 0; x < frame.width; ++x) pixels.push_back(picture.pixel(x, y)[0]);
        return pixels;
    };
    EXPECT_EQ(drawn("sand (mg)", 0), drawn("sand", 0)) << "the unit that it would choose";
    EXPECT_EQ(drawn("sand (g)", 0), drawn("sand", 1e-3)) << "another one";
    EXPECT_NE(drawn("sand (g)", 0), drawn("sand", 0));
}

// There are four rows a period, which vary by 1 about the number of the period.
TEST(Plots, MeansOfAPeriodHaveNoSwing) {
    const FilmedScene scene = wedge(1280, 720);
    PlotRange shown = any_plot();
    shown.smooth = true;
    shown.range = std::array<double, 2>{-1, 3};
    Plot plot(shown, type_scale(scene.film), make_palette(scene.film.background));
    const auto table = std::make_shared<MeasureTable>(std::vector<std::string>{"time_s", "cycles", "lacey"});
    const double none = std::numeric_limits<double>::quiet_NaN();
    for (int k = 0; k <= 40; ++k) table->add({0.25 * k, 0.25 * k, k == 31 ? none : k % 2 == 0 ? 2 : 0});
    Shot frame = frame_of({});
    frame.measures = table;
    const auto now = [&](std::size_t rows) {
        frame.measure_rows = rows;
        plot.take(frame);
        const CairoSurface surface = blank_surface({0, 0, 300, 160}, {1, 1, 1});
        plot.draw(CairoContext(cairo_create(surface.get())).get(), 0, 0);
        Picture picture(300, 160);
        copy_surface(surface.get(), {0, 0, 300, 160}, picture);
        return marker(picture, {0, 0, 300, 160}, make_palette(scene.film.background).accent);
    };
    EXPECT_TRUE(std::isnan(now(3).y())) << "not one period";
    for (const std::size_t rows : {5u, 6u, 7u, 20u, 40u}) {
        EXPECT_NEAR(now(rows).y(), plot.y_of(1), 0.6) << rows;
        EXPECT_NEAR(now(rows).x(), plot.x_of(0.25 * static_cast<double>(rows - 1)), 0.6) << rows;
    }
}

// The axis of time is as long as the window and moves along: the newest row stands at its end.
TEST(Plots, AWindowMovesAlongWithTime) {
    const FilmedScene scene = wedge(1280, 720);
    PlotRange shown = any_plot();
    shown.range = std::array<double, 2>{0, 1};
    shown.window = 2;
    Plot plot(shown, type_scale(scene.film), make_palette(scene.film.background));
    std::vector<std::array<double, 2>> rows;
    const auto drawn = [](Plot& from) {
        const CairoSurface surface = blank_surface({0, 0, 300, 160}, {1, 1, 1});
        from.draw(CairoContext(cairo_create(surface.get())).get(), 0, 0);
        Picture picture(300, 160);
        copy_surface(surface.get(), {0, 0, 300, 160}, picture);
        return picture;
    };
    for (int k = 0; k <= 900; ++k) {  // up to 9 s of 10
        rows.push_back({0.01 * k, k % 100 < 50 ? 0.2 : 0.8});
        plot.take(frame_with_rows(rows));
        const double now = rows.back()[0], begin = std::max(0.0, now - 2);
        ASSERT_NEAR(plot.x_of(begin + 2) - plot.x_of(begin), plot.x_of(2) - plot.x_of(0), 1e-9);
        ASSERT_NEAR(plot.x_of(begin), plot.x_of(now) - (now - begin) * (plot.x_of(1) - plot.x_of(0)), 1e-9);
    }
    const Picture picture = drawn(plot);
    const Colour accent = make_palette(scene.film.background).accent;
    EXPECT_NEAR(marker(picture, {0, 0, 300, 160}, accent).x(), plot.x_of(9), 0.6);
    // One step up in each second, and the line has both heights over the whole axis.
    for (const double time : {7.2, 8.2}) {
        const int x = static_cast<int>(plot.x_of(time)), y = static_cast<int>(plot.y_of(0.2));
        EXPECT_LT(picture.pixel(x, y)[0], 128) << time;
        EXPECT_GT(picture.pixel(x, static_cast<int>(plot.y_of(0.8)))[0], 128) << time;
    }
    Plot at_once(shown, type_scale(scene.film), make_palette(scene.film.background));
    at_once.take(frame_with_rows(rows));
    EXPECT_EQ(drawn(at_once).rgba, picture.rgba);
}

// These rows give no scale yet: their axis shows only 0, and no label goes beyond the plot.
TEST(Plots, ZerosAloneAreCalledZero) {
    const FilmedScene scene = wedge(1280, 720);
    const TypeScale type = type_scale(scene.film);
    Plot plot(any_plot(), type, make_palette(scene.film.background));
    plot.take(frame_with_rows({{0, 0}, {1, 0}, {2, 0}}));
    const CairoSurface surface = blank_surface({0, 0, 300, 160}, {1, 1, 1});
    plot.draw(CairoContext(cairo_create(surface.get())).get(), 0, 0);
    Picture picture(300, 160);
    copy_surface(surface.get(), {0, 0, 300, 160}, picture);
    int at_the_edge = 0;  // below the title
    for (int y = 40; y < 160; ++y) at_the_edge += picture.pixel(0, y)[0] < 200;
    EXPECT_EQ(at_the_edge, 0);
}

TEST(Plots, ThePictureDependsOnTheRowsAlone) {
    const FilmedScene scene = with_plot(960, 540);
    std::vector<std::array<double, 2>> rows;
    Renderer renderer(scene, 1);
    for (int i = 0; i < 30; ++i) {
        rows.push_back({0.1 * i, 0.5 + 0.4 * std::sin(i)});
        renderer.draw(frame_with_rows(rows), "");
    }
    const Picture step_by_step = renderer.draw(frame_with_rows(rows), "");
    EXPECT_EQ(Renderer(scene, 1).draw(frame_with_rows(rows), "").rgba, step_by_step.rgba);
}

// The pixels of a plot of those rows, with values from 0 to 1 over 10 s.
std::vector<std::uint32_t> drawn_plot(const std::vector<std::array<double, 2>>& rows, double x_of_time) {
    PlotRange frame = any_plot();
    frame.range = std::array<double, 2>{0, 1};
    const Palette palette = make_palette(wedge().film.background);
    Plot plot(frame, type_scale(wedge(1280, 720).film), palette);
    plot.take(frame_with_rows(rows));
    const CairoSurface surface = blank_surface({0, 0, frame.width, frame.height}, palette.background);
    {
        const CairoContext on(cairo_create(surface.get()));
        plot.draw(on.get(), 0, 0);
    }
    cairo_surface_flush(surface.get());
    const auto column = static_cast<int>(plot.x_of(x_of_time));
    std::vector<std::uint32_t> pixels;
    for (int y = 0; y < frame.height; ++y) {
        std::uint32_t pixel;
        std::memcpy(&pixel,
                    cairo_image_surface_get_data(surface.get()) +
                        y * cairo_image_surface_get_stride(surface.get()) + 4 * column,
                    sizeof pixel);
        pixels.push_back(pixel);
    }
    return pixels;
}

// While an index is not defined, its curve has a gap, and the present is not marked there.
TEST(Plots, RowsWithoutAValueLeaveAGap) {
    constexpr double none = std::numeric_limits<double>::quiet_NaN();
    const std::vector<std::array<double, 2>> whole{{0, 0.2}, {2, 0.2}, {4, 0.2}, {6, 0.2}};
    const std::vector<std::array<double, 2>> holed{{0, 0.2}, {2, 0.2}, {3, none}, {4, 0.2}, {6, 0.2}};
    const std::vector<std::array<double, 2>> ended{{0, 0.2}, {2, 0.2}, {4, 0.2}, {5, none}};
    EXPECT_NE(drawn_plot(whole, 3), drawn_plot({}, 3));
    EXPECT_EQ(drawn_plot(holed, 3), drawn_plot({}, 3));
    for (const double time : {1.0, 5.0}) EXPECT_EQ(drawn_plot(holed, time), drawn_plot(whole, time)) << time;
    EXPECT_EQ(drawn_plot(ended, 4.1), drawn_plot({}, 4.1));
    EXPECT_EQ(drawn_plot({{0, none}, {1, none}}, 0.5), drawn_plot({}, 0.5));
}

TEST(Arrows, PointTheirWay) {
    FilmedScene scene = wedge(960, 540);
    scene.film.shows.arrows = {1, 0.1, false};
    set_species(scene, {{"small", 3, 2e-4, blue}});
    scene.film.camera.field_of_view = 0;
    scene.film.camera.azimuth = scene.film.camera.elevation = 0;
    Shot frame = frame_of({{{0, 0, 0.07}, 1e-4, 0}, {{0, 0, 0.075}, 1e-4, 0}, {{0, 0, 0.08}, 1e-4, 0}});
    Renderer renderer(scene, 1);
    const Picture still = renderer.draw(frame, "");
    frame.velocity.assign(3, Vec3(0, 0.05, 0));
    const Picture moving = renderer.draw(frame, "");
    const View view = view_of(scene);
    const Extent seen = changed(still, moving, view.port, 60);
    // The arrow is half a cell long, and a cell is as wide as the container; the border adds a few pixels.
    EXPECT_NEAR(seen.right - seen.left, 0.5 * 0.15 * view.focal, 6);
    EXPECT_LT(seen.bottom - seen.top, 20);
}

TEST(HiddenSpecies, LeaveThePictureAsIfTheyWereNotThere) {
    FilmedScene scene = wedge();
    std::vector<Ball> all, big;
    for (int k = 0; k < 60; ++k) {
        const Ball ball{
            {0.012 * std::sin(2.0 * k), -0.04 + 0.0013 * k, 0.02 + 0.09 * std::fmod(k * 0.618, 1)},
            k % 3 ? 0.003 : 0.007,
            k % 3 ? 0 : 1};
        all.push_back(ball);
        if (ball.species == 1) big.push_back(ball);
    }
    const Picture without = Renderer(scene, 1).draw(frame_of(big), "");
    const Picture with = Renderer(scene, 1).draw(frame_of(all), "");
    EXPECT_NE(with.rgba, without.rgba);
    scene.film.shows.hidden = {0};
    const Picture hidden = Renderer(scene, 1).draw(frame_of(all), "");
    const Extent away = changed(hidden, without, {0, 0, hidden.width, hidden.height}, 1);
    EXPECT_EQ(away.count, 0) << away.left << " to " << away.right << ", " << away.top << " to "
                             << away.bottom;
}

// Two frames of a bed with everything that leaves marks. The first grain is in the middle of all.
struct MarkedBed {
    FilmedScene scene = wedge(480, 270);
    std::vector<Shot> frames;

    MarkedBed() {
        std::vector<Ball> balls;
        for (int k = 0; k < 200; ++k)
            balls.push_back({{0.018 * std::sin(2.4 * k), -0.05 + 0.1 * std::fmod(k * 0.618034, 1),
                              0.02 + 0.09 * std::fmod(k * 0.754878, 1)},
                             0.003,
                             k % 2});
        scene.film.words = WordPlace::none;
        FilmShows& shows = scene.film.shows;
        shows.arrows = {6, 0.1, false};
        shows.streamlines = {8, 0.1, false};
        shows.trails = {{0, 1}, {}, 1};
        shows.force_chains = true;
        shows.highlighted = {3, 17, 60, 90};
        shows.highlight_if = {GrainValue::speed, true, 0.09, "speed"};
        for (const double time : {0.0, 0.1}) {
            Shot frame = frame_of(balls);
            frame.time = time;
            for (std::size_t i = 0; i < frame.size(); ++i) {
                frame.velocity[i] = {0.02, 0.1 * std::sin(static_cast<double>(i)), 0.05};
                frame.position[i] += time * frame.velocity[i];
            }
            for (std::int32_t i = 0; i + 1 < 200; ++i) frame.touches.push_back({i, i + 1, 1});
            frames.push_back(frame);
        }
    }
    Picture picture(const std::vector<Shot>& of) const {
        Renderer renderer(scene, 1);
        renderer.draw(of[0], "");
        return renderer.draw(of[1], "");
    }
    // Removes from both frames the grains for which `gone` is true.
    template <class Gone>
    std::vector<Shot> without(const Gone& gone) const {
        std::vector<Shot> kept;
        for (const Shot& all : frames) {
            Shot frame = all;
            frame.id.clear(), frame.species.clear(), frame.radius.clear();
            frame.position.clear(), frame.velocity.clear(), frame.spin.clear();
            for (std::size_t i = 0; i < all.size(); ++i) {
                if (gone(all, i)) continue;
                frame.id.push_back(all.id[i]);
                frame.species.push_back(all.species[i]);
                frame.radius.push_back(all.radius[i]);
                frame.position.push_back(all.position[i]);
                frame.velocity.push_back(all.velocity[i]);
                frame.spin.push_back(all.spin[i]);
            }
            kept.push_back(std::move(frame));
        }
        return kept;
    }
};

// Marks of grains that are cut away or hidden (trails, chains, arrows, rings) are left out, as if those
// grains had never been there.
TEST(MarksOfGrainsThatAreGone, GoWithThem) {
    MarkedBed bed;
    const Rectangle all{0, 0, bed.scene.film.width, bed.scene.film.height};
    const auto expect_none = [&](const char* what, const auto& gone) {
        const std::vector<Shot> left = bed.without(gone);
        ASSERT_GT(left[1].size(), 20u);
        ASSERT_LT(left[1].size(), 180u);
        EXPECT_EQ(changed(bed.picture(bed.frames), bed.picture(left), all, 1).count, 0) << what;
    };
    bed.scene.film.look.cut = {true, {1, 0, 0}, 0.002, 0};
    expect_none("cut", [](const Shot& f, std::size_t i) { return f.position[i].x() - f.radius[i] >= 0.002; });
    bed.scene.film.look.cut = {true, {1, 0, 0}, 0.002, 0.006};
    expect_none("slab", [](const Shot& f, std::size_t i) {
        return f.position[i].x() - f.radius[i] >= 0.002 || f.position[i].x() + f.radius[i] <= -0.004;
    });
    bed.scene.film.look.cut = {};
    bed.scene.film.shows.hidden = {1};
    expect_none("hide", [](const Shot& f, std::size_t i) { return f.species[i] == 1; });
}

TEST(Rings, GoAroundTheirGrain) {
    FilmedScene scene = wedge(960, 540);
    scene.film.camera.field_of_view = 0;
    const Shot frame = frame_of({{{0, -0.02, 0.08}, 0.008, 0}, {{0, 0.02, 0.1}, 0.004, 1}});
    const Picture plain = Renderer(scene, 1).draw(frame, "");
    scene.film.shows.highlighted = {1};
    const Picture ringed = Renderer(scene, 1).draw(frame, "");
    const View view = view_of(scene);
    const Extent ring = changed(plain, ringed, view.port, 60);
    const Pixel middle = view.project(frame.position[1]);
    EXPECT_NEAR(0.5 * (ring.left + ring.right), middle.x(), 0.7);
    EXPECT_NEAR(0.5 * (ring.top + ring.bottom), middle.y(), 0.7);
    EXPECT_GT(ring.right - ring.left, 2 * 0.004 * view.focal);
    EXPECT_LT(ring.right - ring.left, 2 * 0.004 * view.focal + 16);
}

TEST(Rings, GoAroundThoseThatMeetTheCondition) {
    FilmedScene scene = wedge(960, 540);
    Shot frame =
        frame_of({{{0, -0.02, 0.08}, 0.008, 0}, {{0, 0.02, 0.1}, 0.004, 1}, {{0, 0, 0.12}, 0.005, 1}});
    frame.velocity = {{0, 0, 0.1}, {0, 0.3, 0}, {0, 0, -0.19}};
    for (const auto& [above, ids] : {std::pair{true, std::vector<std::int32_t>{1}}, {false, {0, 2}}}) {
        scene.film.shows.highlighted = ids;
        scene.film.shows.highlight_if = {};
        const Picture by_id =
            Renderer(scene, bare_layout(scene.film), 1, gl::Provider::automatic).draw(frame, "");
        scene.film.shows.highlighted = {};
        scene.film.shows.highlight_if = {GrainValue::speed, above, 0.2, "speed"};
        EXPECT_EQ(Renderer(scene, bare_layout(scene.film), 1, gl::Provider::automatic).draw(frame, "").rgba,
                  by_id.rgba);
    }
}

TEST(Rings, OfAConditionGoAroundGrainsThatAreSeen) {
    FilmedScene scene = wedge(960, 540);
    scene.film.words = WordPlace::none;
    scene.film.camera.azimuth = scene.film.camera.elevation = 0;
    // One grain is behind a larger one, and one is beside it.
    Shot frame =
        frame_of({{{0.01, 0, 0.08}, 0.008, 0}, {{-0.01, 0, 0.08}, 0.004, 1}, {{0, 0.03, 0.08}, 0.004, 1}});
    frame.velocity = {{0, 0, 0}, {0, 0, 1}, {0, 0, 1}};
    const View view = frame_container(scene, bare_layout(scene.film));
    const auto rings = [&](std::vector<std::int32_t> ids, bool by_speed) {
        scene.film.shows.highlighted = {};
        scene.film.shows.highlight_if = {};
        const Picture plain = Renderer(scene, 1).draw(frame, "");
        scene.film.shows.highlighted = std::move(ids);
        if (by_speed) scene.film.shows.highlight_if = {GrainValue::speed, true, 0.5, "speed"};
        return changed(plain, Renderer(scene, 1).draw(frame, ""), view.port, 60);
    };
    const Extent seen = rings({}, true), beside = rings({2}, false), hidden = rings({1}, false);
    EXPECT_GT(hidden.count, 100);  // chosen by id, it is ringed
    EXPECT_EQ(seen.count, beside.count);
    EXPECT_EQ(seen.left, beside.left);
}

TEST(TrailsOfGrains, AreThePositionsOfTheLastFrames) {
    FilmedScene scene = wedge();
    scene.film.shows.trails = {{}, {1}, 0.25};
    Trails trails(scene);
    const auto frame_at = [](int k) {
        Shot frame = frame_of({{{0, 0, 0}}, {{0, 0.001 * k, 0.1}}});
        frame.time = 0.1 * k;
        return frame;
    };
    for (int k = 0; k < 9; ++k) {
        trails.take(frame_at(k));
        trails.take(frame_at(k));  // drawn twice
    }
    const auto paths = trails.paths();
    ASSERT_EQ(paths.size(), 1u);
    ASSERT_EQ(paths[0].size(), 3u);  // now, 0.1 s and 0.2 s ago
    for (std::size_t k = 0; k < 3; ++k) {
        EXPECT_NEAR(paths[0][k].at.y(), 0.001 * (8.0 - static_cast<double>(k)), 1e-12);
        EXPECT_NEAR(paths[0][k].age, 0.1 * static_cast<double>(k) / 0.25, 1e-12);
    }
    trails.take(frame_at(2));  // back in time
    EXPECT_EQ(trails.paths()[0].size(), 1u);
}

// A grain that rises steadily and is shaken has a trail that rises steadily, but for its two ends.
TEST(TrailsOfGrains, AreWithoutTheShaking) {
    FilmedScene scene = wedge();
    scene.drive.present = true;
    scene.drive.frequency = 10;
    const auto highest_step_back = [&](double duration) {
        scene.film.shows.trails = {{}, {1}, duration};
        Trails trails(scene);
        for (int k = 0; k <= 80; ++k) {
            const double time = 0.0125 * k;  // eight frames a period
            Shot frame = frame_of({{{0, 0, 0}}, {{0, 0, 0.01 * time + 0.004 * std::sin(20 * M_PI * time)}}});
            frame.time = time;
            trails.take(frame);
        }
        const auto path = trails.paths().at(0);
        EXPECT_EQ(path.front().at.z(), 0.01 + 0.004 * std::sin(20 * M_PI));
        double most = 0;
        for (std::size_t k = 9; k + 9 < path.size(); ++k)  // more than a period from the ends
            most = std::max(most, path[k].at.z() - path[k - 1].at.z());
        return most;
    };
    EXPECT_LT(highest_step_back(0.8), 0.0001);
    EXPECT_GT(highest_step_back(0.35), 0.001);  // too short a trail to leave the shaking out
}

}  // namespace
}  // namespace grainreel::test
