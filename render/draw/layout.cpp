#include "render/draw/layout.hpp"

#include <algorithm>
#include <cmath>

#include "render/draw/container_drawing.hpp"
#include "render/draw/first_gutter.hpp"
#include "render/draw/numbers_plan.hpp"
#include "render/draw/writer.hpp"

namespace grainreel {
namespace {

double longest_word(const std::string& text, const TextStyle& style) {
    double longest = 0;
    for (std::size_t from = 0; from < text.size();) {
        const std::size_t to = std::min(text.find(' ', from), text.size());
        longest = std::max(longest, measure_text(text.substr(from, to - from), style).width);
        from = to + 1;
    }
    return longest;
}

int whole(double pixels) {
    return static_cast<int>(std::ceil(pixels)) + 1;
}

}  // namespace

Frame widest_frame() {
    Frame frame;
    frame.time = 888.888;
    frame.cycles = 88888;
    frame.phase = 0.88;
    return frame;
}

// By the height, but in very narrow pictures by the width.
TypeScale type_scale(const Film& film) {
    const double height = film.height, width = film.width;
    TypeScale type{};
    type.main = std::max(10.0, std::min(0.0265 * height, 0.05 * width));
    type.minor = std::max(10.0, std::min(0.0195 * height, 0.037 * width));
    type.title = std::max(11.0, std::min((width < height ? 0.029 : 0.034) * height, 0.055 * width));
    type.gap = 0.6 * type.main;
    type.margin = std::max(4.0, 0.03 * std::min(width, height));
    return type;
}

namespace {

constexpr double endless = 1e9;

// Gutters above and below, or left and right.
PictureLayout with_gutters(const Scene& scene, bool portrait) {
    const int width = scene.film.width, height = scene.film.height;
    const TypeScale type = type_scale(scene.film);
    const Palette palette = make_palette(scene.film.background);
    const Writer measure{nullptr, type, palette};
    PictureLayout layout;
    layout.portrait = portrait;
    if (layout.portrait) {
        layout.first.height = static_cast<int>(0.34 * height);
        const int top = whole(first_part(measure, scene, nullptr, layout, width).height + type.margin);
        // Plots want room of their own.
        const double most = (scene.film.shows.plots.empty() ? 0.36 : 0.49) * height;
        const int bottom =
            whole(std::min(most, plan_numbers(measure, scene, width, most, true).height + type.margin));
        layout.first = {0, 0, width, top};
        layout.second = {0, height - bottom, width, bottom};
        layout.port = {0, top, width, height - top - bottom};
        return layout;
    }
    const double most = 0.33 * width;
    const std::string& title = scene.film.title.empty() ? scene.title : scene.film.title;
    const double words =
        std::max({legend_block(measure, scene, 0, 0, 0).width,
                  arrows_block(measure, scene, nullptr, 0, 0).width, longest_word(title, measure.title()),
                  std::min((width < 1.4 * height ? 0.22 : 0.17) * width, 9 * type.title)});
    const int left = whole(std::min(most, words + 1.5 * type.margin));
    const double numbers = plan_numbers(measure, scene, endless, height, false).width;
    const int right = whole(std::min(most, std::max(numbers, 0.12 * width) + 1.5 * type.margin));
    layout.first = {0, 0, left, height};
    layout.second = {width - right, 0, right, height};
    layout.port = {left, 0, width - left - right, height};
    return layout;
}

struct Judged {
    PictureLayout layout;
    double scale = 0;  // pixels a metre of the container
    bool fits = true;  // the words that must be there
};

// With the names of what has no room in it.
Judged judged(const Scene& scene, PictureLayout layout) {
    const TypeScale type = type_scale(scene.film);
    const Palette palette = make_palette(scene.film.background);
    const Writer measure{nullptr, type, palette};
    layout.left_out = first_part(measure, scene, nullptr, layout, layout.first.width).left_out;
    const NumbersPlan plan =
        plan_numbers(measure, scene, layout.second.width, layout.second.height, layout.portrait);
    if (scene.drive.present && !plan.has_dial) layout.left_out.emplace_back("dial");
    if (scene.drive.present && layout.portrait && !plan.has_arrows) layout.left_out.emplace_back("arrows");
    if (plan.plots.size() < scene.film.shows.plots.size()) layout.left_out.emplace_back("plots");
    const double scale = frame_container(scene, layout).pixels_per_metre(framed_middle(scene));
    return {std::move(layout), scale, plan.fits};
}

// Where the container becomes larger, of those that have room for as much.
Judged better_of(const Scene& scene) {
    const double shape = static_cast<double>(scene.film.width) / scene.film.height;
    constexpr double kUpright = 0.75, kWide = 1.4;  // beyond these there is nothing to choose
    if (shape <= kUpright || shape >= kWide) return judged(scene, with_gutters(scene, shape <= kUpright));
    Judged upright = judged(scene, with_gutters(scene, true)),
           wide = judged(scene, with_gutters(scene, false));
    if (upright.fits != wide.fits) return upright.fits ? upright : wide;
    const std::size_t lacks = upright.layout.left_out.size(), wide_lacks = wide.layout.left_out.size();
    if (lacks != wide_lacks) return lacks < wide_lacks ? upright : wide;
    return upright.scale > wide.scale ? upright : wide;
}

}  // namespace

PictureLayout plan_layout(const Scene& scene) {
    const WordPlace words = scene.film.words;
    if (words == WordPlace::none) return bare_layout(scene.film);
    Judged best = better_of(scene);
    if (!best.fits) {
        PictureLayout bare = bare_layout(scene.film);
        bare.left_out = {"words"};
        return bare;
    }
    PictureLayout& layout = best.layout;
    layout.plates =
        words == WordPlace::plates || (words == WordPlace::automatic && scene.film.camera.framed_by_user());
    if (layout.plates) layout.port = bare_layout(scene.film).port;
    return layout;
}

PictureLayout bare_layout(const Film& film) {
    PictureLayout layout;
    layout.port = {0, 0, film.width, film.height};
    return layout;
}

}  // namespace grainreel
