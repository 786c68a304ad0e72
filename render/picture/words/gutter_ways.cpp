// Measures how much room each way to place the gutters needs, and lays them out.
#include "render/picture/words/gutter_ways.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "render/picture/base/colour_scale.hpp"
#include "render/picture/camera/camera_path.hpp"
#include "render/picture/words/captions.hpp"
#include "render/scene/filmed_scene.hpp"

namespace grainreel {

namespace {

int whole(double pixels) {
    return static_cast<int>(std::ceil(pixels)) + 1;
}

constexpr double endless = 1e9;
constexpr double least_port = 0.36;   // share of the picture's height between gutters above and below
constexpr double highest_row = 0.45;  // share of the picture's height for a row with both gutters
// Shares of the picture's width for a column with all words, and how much wider than their longest word such
// columns are tried: in a wider one, titles and legends have fewer lines.
constexpr double widest_column = 0.45, wider[] = {1, 1.2, 1.4};

// Pixels: the least height of a gutter's rows, or width of its column, as film.gutters wants it.
int least_height(const FilmedScene& scene, double share) {
    return static_cast<int>(std::lround(share * scene.film.height));
}
int least_width(const FilmedScene& scene, double share) {
    return static_cast<int>(std::lround(share * scene.film.width));
}

// Pixels: the height of the container where the picture's width decides its scale.
double natural_height(const FilmedScene& scene, const TypeScale& type, int width) {
    PictureLayout tall;
    tall.port = {0, 0, width, 8 * scene.film.height};
    return framed_height(scene, tall) + 2 * type.margin;
}

// Pixels: the height of the rows of the first gutter.
int first_rows(const FilmedScene& scene, PictureLayout layout, const Writer& measure) {
    layout.first.height = static_cast<int>(0.34 * (scene.film.height - layout.caption.height));
    const FirstPart first = first_part(measure, scene, nullptr, layout, scene.film.width);
    const int needed = first.empty() ? 0 : whole(first.height + layout.type.margin);
    return std::max(needed, least_height(scene, scene.film.gutters.first));
}

// Pixels: the height of the rows of the second gutter, where the first one takes `top` of the height. Plots
// take the height that the container does not need.
int second_rows(const FilmedScene& scene, const PictureLayout& layout, const Writer& measure, int top) {
    const TypeScale& type = layout.type;
    const int width = scene.film.width, height = scene.film.height - layout.caption.height;
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
    return std::max(bottom > 0 ? whole(bottom) : 0, least_height(scene, scene.film.gutters.second));
}

// The layout with gutters above and below, or with both of them below.
PictureLayout stacked(const FilmedScene& scene, PictureLayout layout, const Writer& measure,
                      GutterPlace place) {
    const int width = scene.film.width, height = scene.film.height - layout.caption.height;
    const int top = first_rows(scene, layout, measure), low = second_rows(scene, layout, measure, top);
    const int free_height = height - low - top;
    const bool above = place == GutterPlace::above_and_below;
    layout.stacked = true;
    layout.first = top > 0 ? Rectangle{0, above ? 0 : free_height, width, top} : Rectangle();
    layout.second = low > 0 ? Rectangle{0, height - low, width, low} : Rectangle();
    layout.port = {0, above ? top : 0, width, free_height};
    return layout;
}

// Whether legend, colour bar, marks and scale are not squeezed in rows of this width, pixels.
bool has_room_for_rows(const FilmedScene& scene, const Writer& measure, double width) {
    constexpr double most_legend = 0.6;                      // of the width
    constexpr double least_letters = 7, least_digits = 2.5;  // in a fifth and in an eighth of the width
    const bool thirds = has_colour_bar(scene.film) || marks_block(measure, scene, 1, 0, 0, width).height > 0;
    return width > 0.5 * scene.film.width &&
           legend_block(measure, scene, 0, 0, 0).width <= most_legend * width &&
           (!thirds || 0.2 * width >= least_letters * measure.type.minor) &&
           0.12 * width >= least_digits * measure.type.main;
}

// The layout with both gutters beside each other in one row. Plots are too high for it.
std::vector<PictureLayout> one_row(const FilmedScene& scene, PictureLayout layout, const Writer& measure,
                                   GutterPlace place) {
    const double margin = layout.type.margin;
    const int width = scene.film.width, height = scene.film.height - layout.caption.height;
    const NumbersPlan numbers = plan_numbers(measure, scene, width, height, true);
    if (numbers.empty || !scene.film.shows.plots.empty()) return {};
    const FilmGutters& wanted = scene.film.gutters;
    const int right = std::max(whole(numbers.width + 2 * margin), least_width(scene, wanted.second)),
              left = width - right;
    if (!has_room_for_rows(scene, measure, left)) return {};
    layout.stacked = layout.one_row = true;
    layout.first.height = static_cast<int>(highest_row * height);
    const FirstPart first = first_part(measure, scene, nullptr, layout, left);
    if (first.empty()) return {};
    const double second = plan_numbers(measure, scene, right, height, true).height;
    const int row =
        std::max(whole(std::max(first.height, second) + margin), least_height(scene, wanted.first));
    const bool above = place == GutterPlace::row_above;
    layout.first = {0, above ? 0 : height - row, left, row};
    layout.second = {left, layout.first.y, right, row};
    layout.port = {0, above ? row : 0, width, height - row};
    return {layout};
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

// Pixels: the width that the words of the first gutter need between margins, at the side; 0: there are none.
double first_words(const FilmedScene& scene, const Writer& measure) {
    const std::string title = shown_title(scene.film);
    return std::max({legend_block(measure, scene, 0, 0, 0).width, colour_words(scene, measure),
                     arrows_block(measure, scene, nullptr, 0, 0).width, longest_word(title, measure.title()),
                     least_column(scene, measure, title)});
}

// Pixels: the width that the words of the second gutter need at the side; 0: there are none.
double second_words(const FilmedScene& scene, const Writer& measure, double height) {
    const NumbersPlan numbers = plan_numbers(measure, scene, endless, height, false);
    if (numbers.empty) return 0;
    return std::max(numbers.width, numbers.wraps ? 0.12 * scene.film.width : 0);
}

// Pixels: the width of a gutter at the side whose words need so much between margins. least: as a share of
// the picture's width.
int side_gutter(const FilmedScene& scene, const PictureLayout& layout, double words, double least) {
    constexpr double most = 0.33;  // of the picture's width
    const int needed =
        words > 0 ? whole(std::min(most * scene.film.width, words + 1.5 * layout.type.margin)) : 0;
    return std::max(needed, least_width(scene, least));
}

// The layout with gutters at the left and right.
PictureLayout side_by_side(const FilmedScene& scene, PictureLayout layout, const Writer& measure) {
    const int width = scene.film.width, height = scene.film.height - layout.caption.height;
    const int left = side_gutter(scene, layout, first_words(scene, measure), scene.film.gutters.first),
              right =
                  side_gutter(scene, layout, second_words(scene, measure, height), scene.film.gutters.second);
    layout.first = left > 0 ? Rectangle{0, 0, left, height} : Rectangle();
    layout.second = right > 0 ? Rectangle{width - right, 0, right, height} : Rectangle();
    layout.port = {left, 0, width - left - right, height};
    return layout;
}

// The layout with the first gutter above or below, and the second one at the right.
PictureLayout row_and_side(const FilmedScene& scene, PictureLayout layout, const Writer& measure,
                           GutterPlace place) {
    const int width = scene.film.width, all = scene.film.height - layout.caption.height;
    const int row = first_rows(scene, layout, measure), height = all - row;
    const int right =
        side_gutter(scene, layout, second_words(scene, measure, height), scene.film.gutters.second);
    const bool above = place == GutterPlace::above_and_side;
    const int top = above ? row : 0;
    layout.first = row > 0 ? Rectangle{0, above ? 0 : height, width, row} : Rectangle();
    layout.second = right > 0 ? Rectangle{width - right, top, right, height} : Rectangle();
    layout.port = {0, top, width - right, height};
    return layout;
}

// The layout with the first gutter at the left, and the second one below.
PictureLayout side_and_row(const FilmedScene& scene, PictureLayout layout, const Writer& measure) {
    const int width = scene.film.width, height = scene.film.height - layout.caption.height;
    const int left = side_gutter(scene, layout, first_words(scene, measure), scene.film.gutters.first),
              low = second_rows(scene, layout, measure, 0);
    layout.stacked = true;
    layout.first = left > 0 ? Rectangle{0, 0, left, height - low} : Rectangle();
    layout.second = low > 0 ? Rectangle{0, height - low, width, low} : Rectangle();
    layout.port = {left, 0, width - left, height - low};
    return layout;
}

// The layout with all words in one column at the left: those of the first gutter, and below them those of the
// second one. wide: the column's width over that of its longest word.
PictureLayout one_column(const FilmedScene& scene, PictureLayout layout, const Writer& measure, double wide) {
    const double margin = layout.type.margin;
    const int width = scene.film.width, height = scene.film.height - layout.caption.height;
    const double words = std::max(first_words(scene, measure), second_words(scene, measure, height));
    const int left = std::max(whole(std::min(widest_column * width, wide * words + 1.5 * margin)),
                              least_width(scene, scene.film.gutters.first));
    const FirstPart part = first_part(measure, scene, nullptr, layout, left);
    const NumbersPlan numbers = plan_numbers(measure, scene, left, height, false, true);
    // What is written about time keeps its lines and its margin, and a pixel for rounding.
    const double most = std::floor(height - (numbers.empty ? 0 : numbers.height + margin + 1));
    // Where no height is left, all words of the first gutter are left out.
    const int top =
        part.empty() ? 0 : std::max(1, std::min(static_cast<int>(most), whole(part.height + margin)));
    layout.first = top > 0 ? Rectangle{0, 0, left, numbers.empty ? height : top} : Rectangle();
    layout.second = numbers.empty ? Rectangle() : Rectangle{0, top, left, height - top};
    layout.port = {left, 0, width - left, height};
    return layout;
}

}  // namespace

std::vector<PictureLayout> laid_out(const FilmedScene& scene, const PictureLayout& layout,
                                    const Writer& measure, GutterPlace place) {
    switch (place) {
        case GutterPlace::sides:
            return {side_by_side(scene, layout, measure)};
        case GutterPlace::row_above:
        case GutterPlace::row_below:
            return one_row(scene, layout, measure, place);
        case GutterPlace::above_and_below:
        case GutterPlace::below:
            return {stacked(scene, layout, measure, place)};
        case GutterPlace::above_and_side:
        case GutterPlace::below_and_side:
            return {row_and_side(scene, layout, measure, place)};
        case GutterPlace::side_and_below:
            return {side_and_row(scene, layout, measure)};
        case GutterPlace::column:
            break;
    }
    std::vector<PictureLayout> columns;
    for (const double wide : wider) {
        columns.push_back(one_column(scene, layout, measure, wide));
        if (scene.film.gutters.first > 0) break;  // its width is given
    }
    return columns;
}

}  // namespace grainreel
