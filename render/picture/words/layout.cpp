// Chooses where the gutters for words lie, and the size of letters.
#include "render/picture/words/layout.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <set>
#include <utility>
#include <vector>

#include "render/picture/base/colour_scale.hpp"
#include "render/picture/camera/camera_path.hpp"
#include "render/picture/camera/framing.hpp"
#include "render/picture/words/blocks.hpp"
#include "render/picture/words/caption_band.hpp"
#include "render/picture/words/captions.hpp"
#include "render/picture/words/gutter_ways.hpp"
#include "render/scene/filmed_scene.hpp"

namespace grainreel {

State widest_frame() {
    State frame;
    frame.time = 888.888;
    frame.cycles = 88888;
    frame.phase = 0.88;
    return frame;
}

namespace {

constexpr double shrinks[] = {1, 0.9, 0.8, 0.7};
// By these factors a vessel must be larger than another one to be chosen: if words cut it off at its top, if
// the column is too narrow for all words of the legend, or if there are words only at one side, or at two
// that do not face each other.
constexpr double price_of_a_cut = 1.6, price_of_a_short_legend = 1.5, price_of_unevenness = 1.08;

const std::vector<GutterPlace> all_places = {
    GutterPlace::sides,          GutterPlace::row_above,       GutterPlace::row_below,
    GutterPlace::column,         GutterPlace::above_and_below, GutterPlace::below,
    GutterPlace::above_and_side, GutterPlace::below_and_side,  GutterPlace::side_and_below};
// The first gutter lies below only where the container runs out of the picture above.
bool begins_below(GutterPlace place) {
    return place == GutterPlace::row_below || place == GutterPlace::below ||
           place == GutterPlace::below_and_side;
}

struct Judged {
    PictureLayout layout;
    GutterPlace place = GutterPlace::sides;
    double letters = 1;  // over their usual size
    bool fits = true;    // whether the words that must be there fit
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
    Judged judged;
    judged.layout = std::move(layout);
    judged.fits = plan.fits && titled;
    return judged;
}

// What Judged::size says.
double judged_size(const FilmedScene& scene, const PictureLayout& layout, const Writer& measure,
                   GutterPlace place) {
    const View view = frame_container(scene, layout);
    double size = view.pixels_per_metre(framed_middle(scene)) * layout.type.main;
    if (layout.port.y > 0 && runs_out_above(scene, view)) size /= price_of_a_cut;
    const double inner = layout.first.width - 1.5 * layout.type.margin;
    if (has_column(scene, layout) && legend_block(measure, scene, 0, 0, 0).width > inner)
        size /= price_of_a_short_legend;
    const bool even = place == GutterPlace::sides || place == GutterPlace::above_and_below || layout.one_row;
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

// Replaces the best layout by a better one: one that says more, or that says as much and has a larger
// container. The size of letters counts as much as that of the container.
void take_better(const FilmedScene& scene, std::optional<Judged>& best, Judged here, const Writer& measure,
                 GutterPlace place) {
    if (best &&
        (says_more(*best, here) || (!says_more(here, *best) && surely_smaller(here.layout, best->layout))))
        return;
    here.size = judged_size(scene, here.layout, measure, place);
    here.place = place;
    if (!best || says_more(here, *best) || here.size > best->size) best = std::move(here);
}

// Whether words lie on plates over the picture.
bool on_plates(const Film& film) {
    return film.words == WordPlace::plates ||
           (film.words == WordPlace::automatic && film.camera.framed_by_user());
}

// The picture without words, but for the band of captions.
PictureLayout without_words(const FilmedScene& scene) {
    PictureLayout empty = bare_layout(scene.film);
    const int band = plan_captions(scene.film, scene.film.width).band();
    empty.port.height -= band;
    if (band > 0) empty.caption = {0, empty.port.height, scene.film.width, band};
    return empty;
}

// Tries all places with all sizes of letters.
Judged best_of_all(const FilmedScene& scene) {
    constexpr double nearly = 0.93;  // a container so much smaller than the largest one is not worth a search
    const Palette palette = make_palette(scene.film.background);
    const bool cut = framed_part(scene).cut;
    PictureLayout empty = without_words(scene);
    const double largest = framed_scale(scene, empty);
    std::optional<Judged> best;
    double last = 0;
    for (const double shrink : shrinks) {
        empty.type = type_scale(scene.film, shrink);
        if (empty.type.main == last) break;
        last = empty.type.main;
        const Writer measure{nullptr, empty.type, palette};
        for (const GutterPlace place : all_places) {
            if (begins_below(place) && !cut) continue;
            // Plates over the picture hide least of it at its sides.
            if (on_plates(scene.film) && place != GutterPlace::sides && best && best->fits) continue;
            if (best && best->fits && best->layout.left_out.empty() && best->size > nearly * largest * last)
                return *best;
            for (PictureLayout& layout : laid_out(scene, empty, measure, place)) {
                Judged here = judged_words(scene, std::move(layout), measure);
                here.letters = shrink;
                take_better(scene, best, std::move(here), measure, place);
            }
        }
    }
    return *best;
}

// The layout with the place and the letters that film.gutters gives; none where the words do not fit there.
std::optional<Judged> layout_as_wanted(const FilmedScene& scene) {
    const FilmGutters& wanted = scene.film.gutters;
    if (!wanted.wanted) return std::nullopt;
    PictureLayout empty = without_words(scene);
    empty.type = type_scale(scene.film, wanted.letters);
    const Palette palette = make_palette(scene.film.background);
    const Writer measure{nullptr, empty.type, palette};
    std::optional<Judged> best;
    for (PictureLayout& layout : laid_out(scene, empty, measure, wanted.place)) {
        Judged here = judged_words(scene, std::move(layout), measure);
        here.letters = wanted.letters;
        take_better(scene, best, std::move(here), measure, wanted.place);
    }
    return best && best->fits ? best : std::nullopt;
}

Judged best_layout(const FilmedScene& scene) {
    if (std::optional<Judged> wanted = layout_as_wanted(scene)) return *std::move(wanted);
    return best_of_all(scene);
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

FilmGutters gutters_of(const FilmedScene& scene) {
    const Judged best = best_layout(scene);
    const PictureLayout& layout = best.layout;
    const double width = scene.film.width, height = scene.film.height;
    const bool first_is_row = layout.one_row || !has_column(scene, layout);
    const bool second_is_row = layout.stacked && !layout.one_row;
    return {true, best.place, best.letters,
            first_is_row ? layout.first.height / height : layout.first.width / width,
            second_is_row ? layout.second.height / height : layout.second.width / width};
}

namespace {

// Gutters at this place that are large enough for the words of all scenes.
FilmGutters wide_enough(std::vector<FilmedScene>& scenes, FilmGutters gutters) {
    gutters.first = gutters.second = 0;
    FilmGutters all = gutters;
    for (FilmedScene& scene : scenes) {
        scene.film.gutters = gutters;
        const FilmGutters own = gutters_of(scene);
        all.first = std::max(all.first, own.first), all.second = std::max(all.second, own.second);
    }
    for (FilmedScene& scene : scenes) scene.film.gutters = all;
    return all;
}

}  // namespace

FilmGutters gutters_for_all(std::vector<FilmedScene> scenes) {
    std::vector<FilmGutters> tried;
    for (const FilmedScene& scene : scenes) tried.push_back(gutters_of(scene));
    std::optional<Judged> best;  // left_out: of all scenes; size: the sum of all
    FilmGutters chosen;
    std::set<std::pair<GutterPlace, double>> known;
    for (const FilmGutters& one : tried) {
        if (!known.insert({one.place, one.letters}).second) continue;
        const FilmGutters all = wide_enough(scenes, one);
        Judged sum;
        for (const FilmedScene& scene : scenes) {
            const Judged here = best_layout(scene);
            sum.fits = sum.fits && here.fits && here.place == one.place && here.letters == one.letters;
            sum.size += here.size;
            sum.layout.left_out.insert(sum.layout.left_out.end(), here.layout.left_out.begin(),
                                       here.layout.left_out.end());
        }
        if (best && (says_more(*best, sum) || (!says_more(sum, *best) && sum.size <= best->size))) continue;
        best = std::move(sum), chosen = all;
    }
    return best && best->fits ? chosen : FilmGutters();
}

}  // namespace grainreel
