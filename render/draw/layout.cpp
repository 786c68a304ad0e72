#include "render/draw/layout.hpp"

#include <algorithm>
#include <cmath>

#include "render/draw/overlay.hpp"
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

TypeScale type_scale(const Film& film) {
    const double height = film.height;
    TypeScale type{};
    type.main = std::max(10.0, 0.0265 * height);
    type.minor = std::max(10.0, 0.0195 * height);
    type.title = std::max(11.0, (film.width < film.height ? 0.029 : 0.034) * height);
    type.gap = 0.6 * type.main;
    type.margin = std::max(4.0, 0.03 * std::min(film.width, film.height));
    return type;
}

namespace {

PictureLayout with_gutters(const Scene& scene) {
    const int width = scene.film.width, height = scene.film.height;
    const TypeScale type = type_scale(scene.film);
    const Palette palette = make_palette(scene.film.background);
    const Writer measure{nullptr, type, palette};
    PictureLayout layout;
    layout.portrait = width < 1.15 * height;
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
    const double words = std::max(
        {legend_block(measure, scene, 0, 0, 0).width, arrows_block(measure, scene, nullptr, 0, 0).width,
         longest_word(title, measure.title()), std::min(0.17 * width, 9 * type.title)});
    const int left = whole(std::min(most, words + 1.5 * type.margin));
    const double numbers = plan_numbers(measure, scene, most, height, false).width;
    const int right = whole(std::min(most, std::max(numbers, 0.12 * width) + 1.5 * type.margin));
    layout.first = {0, 0, left, height};
    layout.second = {width - right, 0, right, height};
    layout.port = {left, 0, width - left - right, height};
    return layout;
}

}  // namespace

namespace {

std::vector<std::string> without_room(const Scene& scene, const PictureLayout& layout) {
    const TypeScale type = type_scale(scene.film);
    const Palette palette = make_palette(scene.film.background);
    const Writer measure{nullptr, type, palette};
    std::vector<std::string> names = first_part(measure, scene, nullptr, layout, layout.first.width).left_out;
    const NumbersPlan plan =
        plan_numbers(measure, scene, layout.second.width, layout.second.height, layout.portrait);
    if (plan.plots.size() < scene.film.shows.plots.size()) names.emplace_back("plots");
    return names;
}

}  // namespace

PictureLayout plan_layout(const Scene& scene) {
    const WordPlace words = scene.film.words;
    if (words == WordPlace::none) return bare_layout(scene.film);
    PictureLayout layout = with_gutters(scene);
    layout.left_out = without_room(scene, layout);
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
