// Tests of films without a background: their words can be read on any paper.
#include <gtest/gtest.h>

#include "engine/measure/measures.hpp"
#include "render/picture/base/picture.hpp"
#include "render/picture/base/shot.hpp"
#include "render/picture/panels/side_by_side.hpp"
#include "render/picture/words/blocks.hpp"
#include "render/scene/filmed_scene.hpp"
#include "tests/draw/support.hpp"

namespace grainreel::test {
namespace {

FilmedScene scene_of(bool transparent) {
    FilmedScene scene = wedge(960, 540);
    scene.film.transparent = transparent;
    scene.run.duration = 2;
    scene.film.shows.plots = {{"lacey", "mixing", std::array<double, 2>{0, 1}}};
    return scene;
}

Shot half_way() {
    const auto table = std::make_shared<MeasureTable>(std::vector<std::string>{"time_s", "lacey"});
    for (int row = 0; row < 40; ++row) table->add({0.02 * row, 0.5 + 0.4 * std::sin(0.1 * row)});
    Shot frame = frame_of({{{0, 0, 0.08}, 0.01, 1}});
    frame.time = 0.8;
    frame.measures = table;
    frame.measure_rows = 40;
    return frame;
}

Colour colour_at(const Picture& picture, int x, int y, const Colour& paper) {
    const std::uint8_t* p = picture.pixel(x, y);
    return mix(paper, {p[0] / 255.0, p[1] / 255.0, p[2] / 255.0}, p[3] / 255.0);
}

// Number of pixels of the part that are plain ink on the film's own background; and the number of these that,
// on the paper, have a pixel within `reach` with a contrast of 4.5 against them.
struct Ink {
    int all = 0, read = 0;
};
Ink ink_in(const Rectangle& part, const Picture& opaque, const Picture& clear, const Colour& paper,
           int reach) {
    const Colour background = colour_at(opaque, part.x, part.y, paper);
    Ink ink;
    for (int y = part.y + reach; y < part.y + part.height - reach; ++y)
        for (int x = part.x + reach; x < part.x + part.width - reach; ++x) {
            if (contrast(colour_at(opaque, x, y, paper), background) < 4.5) continue;
            ++ink.all;
            bool read = false;
            for (int j = y - reach; j <= y + reach && !read; ++j)
                for (int i = x - reach; i <= x + reach && !read; ++i)
                    read = contrast(colour_at(clear, x, y, paper), colour_at(clear, i, j, paper)) >= 4.5;
            ink.read += read;
        }
    return ink;
}

constexpr Colour kPapers[] = {{1, 1, 1}, {0.5, 0.5, 0.5}, {0, 0, 0}};

TEST(TransparentFilm, WordsReadOnAnyPaper) {
    for (const Colour& background : {Colour{1, 1, 1}, Colour{0.05, 0.06, 0.08}}) {
        FilmedScene scene = scene_of(false);
        scene.film.background = background;
        scene.film.word_kinds.legend = false;  // its balls are no words, and wider than halos
        const PictureLayout layout = plan_layout(scene);
        const Picture opaque = Renderer(scene, 1).draw(half_way(), "slow motion, 1/10 speed");
        scene.film.transparent = true;
        const Picture clear = Renderer(scene, 1).draw(half_way(), "slow motion, 1/10 speed");
        for (const Colour& paper : kPapers)
            for (const Rectangle& gutter : {layout.first, layout.second}) {
                const Ink ink = ink_in(gutter, opaque, clear, paper, 6);
                EXPECT_GT(ink.all, 500);
                EXPECT_GT(ink.read, 0.98 * ink.all) << background.red << " on " << paper.red;
            }
    }
}

TEST(TransparentFilm, PlotsHaveNoBox) {
    const FilmedScene scene = scene_of(true);
    const PictureLayout layout = plan_layout(scene);
    const Palette palette = make_palette(scene.film.background);
    const NumbersPlan plan = plan_numbers({nullptr, layout.type, palette}, scene, layout);
    ASSERT_EQ(plan.plots.size(), 1u);
    Rectangle part = plan.plots[0];
    part.x += layout.second.x, part.y += layout.second.y;
    const Picture clear = Renderer(scene, 1).draw(half_way(), "");
    int empty = 0;
    for (int y = part.y; y < part.y + part.height; ++y)
        for (int x = part.x; x < part.x + part.width; ++x) empty += clear.pixel(x, y)[3] == 0;
    EXPECT_GT(empty, 0.4 * part.width * part.height);
}

}  // namespace
}  // namespace grainreel::test
