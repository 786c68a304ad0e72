// Chooses between gutters at the sides and gutters above and below, and the size of letters.
#include "render/picture/words/layout.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "render/picture/base/colour_scale.hpp"
#include "render/picture/camera/camera_path.hpp"
#include "render/picture/words/blocks.hpp"
#include "render/picture/words/caption_band.hpp"
#include "render/picture/words/captions.hpp"
#include "render/scene/filmed_scene.hpp"

namespace grainreel {

namespace {

int whole(double pixels) {
    return static_cast<int>(std::ceil(pixels)) + 1;
}

}  // namespace

State widest_frame() {
    State frame;
    frame.time = 888.888;
    frame.cycles = 88888;
    frame.phase = 0.88;
    return frame;
}

namespace {

constexpr double endless = 1e9;
constexpr double shrinks[] = {1, 0.9, 0.8};
constexpr double least_port = 0.36;  // share of the picture's height between gutters above and below

// Pixels: the height of the container where the picture's width decides its scale.
double natural_height(const FilmedScene& scene, const TypeScale& type, int width) {
    PictureLayout tall;
    tall.port = {0, 0, width, 8 * scene.film.height};
    return framed_height(scene, tall) + 2 * type.margin;
}

// The layout with gutters above and below. Plots take the height that the container does not need.
PictureLayout stacked(const FilmedScene& scene, PictureLayout layout, const Writer& measure) {
    const TypeScale& type = layout.type;
    const int width = scene.film.width, height = scene.film.height - layout.caption.height;
    layout.stacked = true;
    layout.first.height = static_cast<int>(0.34 * height);
    const FirstPart first = first_part(measure, scene, nullptr, layout, width);
    const int top = first.empty() ? 0 : whole(first.height + type.margin);
    const double most = (1 - least_port) * height - top;
    const auto needed = [&](double room) {
        const NumbersPlan plan = plan_numbers(measure, scene, width, room, true);
        return plan.empty ? 0 : plan.height + type.margin;
    };
    double bottom = std::min(most, needed(0));
    // Plots are left out where even the lowest would be too high.
    if (needed(0) > most) bottom = std::min(0.36 * height, needed(most));
    const double free = height - top - bottom - natural_height(scene, type, width);
    if (free > 0) bottom = std::max(bottom, needed(bottom + free));
    const int low = bottom > 0 ? whole(bottom) : 0;
    layout.first = top > 0 ? Rectangle{0, 0, width, top} : Rectangle();
    layout.second = low > 0 ? Rectangle{0, height - low, width, low} : Rectangle();
    layout.port = {0, top, width, height - low - top};
    return layout;
}

// Pixels: the width of the longest word above a colour bar.
double colour_words(const FilmedScene& scene, const Writer& measure) {
    double longest = 0;
    for (const ColourScale& scale : colour_scales(scene.film))
        longest = std::max(longest, longest_word(scale.title(), measure.minor()));
    return longest;
}

// Pixels: the least width between margins of a gutter at the side with words that wrap.
double least_column(const FilmedScene& scene, const Writer& measure, const std::string& title) {
    const double width = scene.film.width;
    const bool wraps = !title.empty() || has_colour_bar(scene.film) ||
                       marks_block(measure, scene, 1, 0, 0, width).height > 0;
    if (!wraps)
        return std::max(axes_block(measure, scene, nullptr, 0, 0).width,
                        scene.film.word_kinds.scale ? 4 * measure.type.main : 0);
    return std::min((width < 1.4 * scene.film.height ? 0.22 : 0.17) * width, 9 * measure.type.title);
}

// The layout with gutters at the left and right.
PictureLayout side_by_side(const FilmedScene& scene, PictureLayout layout, const Writer& measure) {
    const TypeScale& type = layout.type;
    const int width = scene.film.width, height = scene.film.height - layout.caption.height;
    const double most = 0.33 * width;
    const std::string title = shown_title(scene.film);
    const double words =
        std::max({legend_block(measure, scene, 0, 0, 0).width, colour_words(scene, measure),
                  arrows_block(measure, scene, nullptr, 0, 0).width, longest_word(title, measure.title()),
                  least_column(scene, measure, title)});
    const int left = words > 0 ? whole(std::min(most, words + 1.5 * type.margin)) : 0;
    const NumbersPlan numbers = plan_numbers(measure, scene, endless, height, false);
    const double least = numbers.wraps ? 0.12 * width : 0;
    const int right =
        numbers.empty ? 0 : whole(std::min(most, std::max(numbers.width, least) + 1.5 * type.margin));
    layout.first = left > 0 ? Rectangle{0, 0, left, height} : Rectangle();
    layout.second = right > 0 ? Rectangle{width - right, 0, right, height} : Rectangle();
    layout.port = {left, 0, width - left - right, height};
    return layout;
}

struct Judged {
    PictureLayout layout;
    double scale = 0;  // pixels a metre of the container
    bool fits = true;  // whether the words that must be there fit
};

// Judges a layout, and writes into it the names of the blocks that it has no room for.
Judged judged(const FilmedScene& scene, PictureLayout layout, const Writer& measure) {
    layout.left_out = first_part(measure, scene, nullptr, layout, layout.first.width).left_out;
    const NumbersPlan plan =
        plan_numbers(measure, scene, layout.second.width, layout.second.height, layout.stacked);
    const WordKinds& kinds = scene.film.word_kinds;
    const bool drive = scene.drive.present;
    if (drive && kinds.dial && !plan.has_dial) layout.left_out.emplace_back("dial");
    if (drive && kinds.arrows && layout.stacked && !plan.has_arrows) layout.left_out.emplace_back("arrows");
    if (plan.plots.size() < scene.film.shows.plots.size()) layout.left_out.emplace_back("plots");
    if (plan_captions(scene.film, scene.film.width).cut) layout.left_out.emplace_back("a part of a caption");
    const double scale = framed_scale(scene, layout);
    return {std::move(layout), scale, plan.fits};
}

// Whether one layout leaves out fewer words than the other.
bool says_more(const Judged& one, const Judged& other) {
    if (one.fits != other.fits) return one.fits;
    return one.layout.left_out.size() < other.layout.left_out.size();
}

// The layout with the largest letters that leave nothing out, or that leave out the least.
Judged largest_letters(const FilmedScene& scene, bool above_and_below) {
    const Palette palette = make_palette(scene.film.background);
    std::optional<Judged> best;
    for (const double shrink : shrinks) {
        PictureLayout layout;
        layout.type = type_scale(scene.film, shrink);
        const int band = plan_captions(scene.film, scene.film.width).band();
        if (band > 0) layout.caption = {0, scene.film.height - band, scene.film.width, band};
        const Writer measure{nullptr, layout.type, palette};
        layout = above_and_below ? stacked(scene, layout, measure) : side_by_side(scene, layout, measure);
        const Judged here = judged(scene, layout, measure);
        if (!best || says_more(here, *best)) best = here;
        if (best->fits && best->layout.left_out.empty()) break;
    }
    return *best;
}

// The layout that says more, or, where both say as much, the one in which the container is larger.
Judged better_of(const FilmedScene& scene) {
    const Judged upright = largest_letters(scene, true), wide = largest_letters(scene, false);
    if (says_more(upright, wide)) return upright;
    if (says_more(wide, upright)) return wide;
    return upright.scale > wide.scale ? upright : wide;
}

}  // namespace

PictureLayout plan_layout(const FilmedScene& scene) {
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
    if (layout.plates) layout.port = {0, 0, scene.film.width, scene.film.height - layout.caption.height};
    return layout;
}

}  // namespace grainreel
