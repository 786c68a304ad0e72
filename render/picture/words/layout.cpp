// Chooses where the gutters for words lie, and the size of letters.
#include "render/picture/words/layout.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "render/picture/base/colour_scale.hpp"
#include "render/picture/camera/camera_path.hpp"
#include "render/picture/camera/framing.hpp"
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
constexpr double shrinks[] = {1, 0.9, 0.8, 0.7};
constexpr double least_port = 0.36;   // share of the picture's height between gutters above and below
constexpr double highest_row = 0.45;  // share of the picture's height for a row with both gutters
// Shares of the picture's width for a column with all words, and how much wider than their longest word such
// columns are tried: in a wider one, titles and legends have fewer lines.
constexpr double widest_column = 0.45, wider[] = {1, 1.2, 1.4};
// By these factors a vessel must be larger than another one to be chosen: if words cut it off at its top, if
// the column is too narrow for all words of the legend, or if there are words only at one side, or at two
// that do not face each other.
constexpr double price_of_a_cut = 1.6, price_of_a_short_legend = 1.5, price_of_unevenness = 1.08;

// Pixels: the height of the container where the picture's width decides its scale.
double natural_height(const FilmedScene& scene, const TypeScale& type, int width) {
    PictureLayout tall;
    tall.port = {0, 0, width, 8 * scene.film.height};
    return framed_height(scene, tall) + 2 * type.margin;
}

// Where the two gutters lie. A gutter as wide as the picture has its words in rows, another has a column.
enum class Way {
    sides,            // columns left and right
    row_above,        // both beside each other in one row above
    row_below,        // the same below
    column,           // one column at the left, with the words of both gutters below each other
    above_and_below,  // rows above and below
    below,            // both below
    above_and_side,   // the first above, the second at the right
    below_and_side,   // the first below, the second at the right
    side_and_below,   // the first at the left, the second below
};
constexpr Way ways[] = {Way::sides,          Way::row_above,       Way::row_below,
                        Way::column,         Way::above_and_below, Way::below,
                        Way::above_and_side, Way::below_and_side,  Way::side_and_below};
// The first gutter lies below only where the container runs out of the picture above.
bool begins_below(Way way) {
    return way == Way::row_below || way == Way::below || way == Way::below_and_side;
}

// Pixels: the height of the rows of the first gutter.
int first_rows(const FilmedScene& scene, PictureLayout layout, const Writer& measure) {
    layout.first.height = static_cast<int>(0.34 * (scene.film.height - layout.caption.height));
    const FirstPart first = first_part(measure, scene, nullptr, layout, scene.film.width);
    return first.empty() ? 0 : whole(first.height + layout.type.margin);
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
    return bottom > 0 ? whole(bottom) : 0;
}

// The layout with gutters above and below, or with both of them below.
PictureLayout stacked(const FilmedScene& scene, PictureLayout layout, const Writer& measure, Way way) {
    const int width = scene.film.width, height = scene.film.height - layout.caption.height;
    const int top = first_rows(scene, layout, measure), low = second_rows(scene, layout, measure, top);
    const int free_height = height - low - top;
    const bool above = way == Way::above_and_below;
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
                                   Way way) {
    const double margin = layout.type.margin;
    const int width = scene.film.width, height = scene.film.height - layout.caption.height;
    const NumbersPlan numbers = plan_numbers(measure, scene, width, height, true);
    if (numbers.empty || !scene.film.shows.plots.empty()) return {};
    const int right = whole(numbers.width + 2 * margin), left = width - right;
    if (!has_room_for_rows(scene, measure, left)) return {};
    layout.stacked = layout.one_row = true;
    layout.first.height = static_cast<int>(highest_row * height);
    const FirstPart first = first_part(measure, scene, nullptr, layout, left);
    if (first.empty()) return {};
    const double second = plan_numbers(measure, scene, right, height, true).height;
    const int row = whole(std::max(first.height, second) + margin);
    const bool above = way == Way::row_above;
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

// Pixels: the width of a gutter at the side whose words need so much between margins.
int side_gutter(const FilmedScene& scene, const PictureLayout& layout, double words) {
    constexpr double most = 0.33;  // of the picture's width
    return words > 0 ? whole(std::min(most * scene.film.width, words + 1.5 * layout.type.margin)) : 0;
}

// The layout with gutters at the left and right.
PictureLayout side_by_side(const FilmedScene& scene, PictureLayout layout, const Writer& measure) {
    const int width = scene.film.width, height = scene.film.height - layout.caption.height;
    const int left = side_gutter(scene, layout, first_words(scene, measure)),
              right = side_gutter(scene, layout, second_words(scene, measure, height));
    layout.first = left > 0 ? Rectangle{0, 0, left, height} : Rectangle();
    layout.second = right > 0 ? Rectangle{width - right, 0, right, height} : Rectangle();
    layout.port = {left, 0, width - left - right, height};
    return layout;
}

// The layout with the first gutter above or below, and the second one at the right.
PictureLayout row_and_side(const FilmedScene& scene, PictureLayout layout, const Writer& measure, Way way) {
    const int width = scene.film.width, all = scene.film.height - layout.caption.height;
    const int row = first_rows(scene, layout, measure), height = all - row;
    const int right = side_gutter(scene, layout, second_words(scene, measure, height));
    const bool above = way == Way::above_and_side;
    const int top = above ? row : 0;
    layout.first = row > 0 ? Rectangle{0, above ? 0 : height, width, row} : Rectangle();
    layout.second = right > 0 ? Rectangle{width - right, top, right, height} : Rectangle();
    layout.port = {0, top, width - right, height};
    return layout;
}

// The layout with the first gutter at the left, and the second one below.
PictureLayout side_and_row(const FilmedScene& scene, PictureLayout layout, const Writer& measure) {
    const int width = scene.film.width, height = scene.film.height - layout.caption.height;
    const int left = side_gutter(scene, layout, first_words(scene, measure)),
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
    const int left = whole(std::min(widest_column * width, wide * words + 1.5 * margin));
    const FirstPart part = first_part(measure, scene, nullptr, layout, left);
    const NumbersPlan numbers = plan_numbers(measure, scene, left, height, false, true);
    const double most = height - (numbers.empty ? 0 : numbers.height);
    // Where no height is left, all words of the first gutter are left out.
    const int top = part.empty() ? 0 : std::max(1, whole(std::min(most, part.height + margin)));
    layout.first = top > 0 ? Rectangle{0, 0, left, numbers.empty ? height : top} : Rectangle();
    layout.second = numbers.empty ? Rectangle() : Rectangle{0, top, left, height - top};
    layout.port = {left, 0, width - left, height};
    return layout;
}

struct Judged {
    PictureLayout layout;
    bool fits = true;  // whether the words that must be there fit
    // Pixels a metre of the container, over what the way of the words costs, times the size of letters. 0:
    // not known.
    double size = 0;
};

// Whether the container is higher than what the port shows.
bool runs_out_above(const FilmedScene& scene, const View& view) {
    const std::vector<Vec3> all =
        framing_points(scene, scene.film.camera.azimuth, whole_container(scene), {});
    return std::any_of(all.begin(), all.end(), [&](const Vec3& point) {
        return view.to_view(point).z() <= 0 || view.project(point).y() < -1;
    });
}

// Whether the first gutter is a column.
bool has_column(const FilmedScene& scene, const PictureLayout& layout) {
    return !layout.one_row && layout.first.width > 0 && layout.first.width < scene.film.width;
}

// Writes into the layout the names of the blocks that it has no room for.
Judged judged_words(const FilmedScene& scene, PictureLayout layout, const Writer& measure) {
    layout.left_out = first_part(measure, scene, nullptr, layout, layout.first.width).left_out;
    const NumbersPlan plan = plan_numbers(measure, scene, layout);
    const WordKinds& kinds = scene.film.word_kinds;
    const bool drive = scene.drive.present;
    if (drive && kinds.dial && !plan.has_dial) layout.left_out.emplace_back("dial");
    if (drive && kinds.arrows && !has_column(scene, layout) && !(layout.stacked && plan.has_arrows))
        layout.left_out.emplace_back("arrows");
    if (plan.plots.size() < scene.film.shows.plots.size()) layout.left_out.emplace_back("plots");
    if (plan_captions(scene.film, scene.film.width).cut) layout.left_out.emplace_back("a part of a caption");
    const bool titled =
        std::find(layout.left_out.begin(), layout.left_out.end(), "title") == layout.left_out.end();
    return {std::move(layout), plan.fits && titled, 0};
}

// What Judged::size says.
double judged_size(const FilmedScene& scene, const PictureLayout& layout, const Writer& measure, Way way) {
    const View view = frame_container(scene, layout);
    double size = view.pixels_per_metre(framed_middle(scene)) * layout.type.main;
    if (layout.port.y > 0 && runs_out_above(scene, view)) size /= price_of_a_cut;
    const double inner = layout.first.width - 1.5 * layout.type.margin;
    if (has_column(scene, layout) && legend_block(measure, scene, 0, 0, 0).width > inner)
        size /= price_of_a_short_legend;
    const bool even = way == Way::sides || way == Way::above_and_below || layout.one_row;
    return even ? size : size / price_of_unevenness;
}

// Whether one layout leaves out fewer words than the other.
bool says_more(const Judged& one, const Judged& other) {
    if (one.fits != other.fits) return one.fits;
    return one.layout.left_out.size() < other.layout.left_out.size();
}

// Whether a container in this layout is surely not larger than in another one.
bool surely_smaller(const PictureLayout& one, const PictureLayout& other) {
    return one.port.width <= other.port.width && one.port.height <= other.port.height &&
           one.type.main <= other.type.main && (one.port.y > 0 || other.port.y == 0);
}

std::vector<PictureLayout> laid_out(const FilmedScene& scene, const PictureLayout& layout,
                                    const Writer& measure, Way way) {
    switch (way) {
        case Way::sides:
            return {side_by_side(scene, layout, measure)};
        case Way::row_above:
        case Way::row_below:
            return one_row(scene, layout, measure, way);
        case Way::above_and_below:
        case Way::below:
            return {stacked(scene, layout, measure, way)};
        case Way::above_and_side:
        case Way::below_and_side:
            return {row_and_side(scene, layout, measure, way)};
        case Way::side_and_below:
            return {side_and_row(scene, layout, measure)};
        case Way::column:
            break;
    }
    std::vector<PictureLayout> columns;
    for (const double wide : wider) columns.push_back(one_column(scene, layout, measure, wide));
    return columns;
}

// Replaces the best layout by a better one: one that says more, or that says as much and has a larger
// container. The size of letters counts as much as that of the container.
void take_better(const FilmedScene& scene, std::optional<Judged>& best, Judged here, const Writer& measure,
                 Way way) {
    if (best &&
        (says_more(*best, here) || (!says_more(here, *best) && surely_smaller(here.layout, best->layout))))
        return;
    here.size = judged_size(scene, here.layout, measure, way);
    if (!best || says_more(here, *best) || here.size > best->size) best = std::move(here);
}

// Whether words lie on plates over the picture.
bool on_plates(const Film& film) {
    return film.words == WordPlace::plates ||
           (film.words == WordPlace::automatic && film.camera.framed_by_user());
}

Judged best_layout(const FilmedScene& scene) {
    constexpr double nearly = 0.93;  // a container so much smaller than the largest one is not worth a search
    const Palette palette = make_palette(scene.film.background);
    const int band = plan_captions(scene.film, scene.film.width).band();
    const bool cut = framed_part(scene).cut;
    PictureLayout empty = bare_layout(scene.film);
    empty.port.height -= band;
    if (band > 0) empty.caption = {0, empty.port.height, scene.film.width, band};
    const double largest = framed_scale(scene, empty);
    std::optional<Judged> best;
    double last = 0;
    for (const double shrink : shrinks) {
        empty.type = type_scale(scene.film, shrink);
        if (empty.type.main == last) break;
        last = empty.type.main;
        const Writer measure{nullptr, empty.type, palette};
        for (const Way way : ways) {
            if (begins_below(way) && !cut) continue;
            // Plates over the picture hide least of it at its sides.
            if (on_plates(scene.film) && way != Way::sides && best && best->fits) continue;
            if (best && best->fits && best->layout.left_out.empty() && best->size > nearly * largest * last)
                return *best;
            for (PictureLayout& layout : laid_out(scene, empty, measure, way))
                take_better(scene, best, judged_words(scene, std::move(layout), measure), measure, way);
        }
    }
    return *best;
}

}  // namespace

PictureLayout plan_layout(const FilmedScene& scene) {
    if (scene.film.words == WordPlace::none) return bare_layout(scene.film);
    Judged best = best_layout(scene);
    if (!best.fits) {
        PictureLayout bare = bare_layout(scene.film);
        bare.left_out = {"words"};
        return bare;
    }
    PictureLayout& layout = best.layout;
    layout.plates = on_plates(scene.film);
    if (layout.plates) layout.port = {0, 0, scene.film.width, scene.film.height - layout.caption.height};
    return layout;
}

}  // namespace grainreel
