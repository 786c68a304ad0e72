// The keys of words: [[film.caption]], words that the film shows for a while; [[film.label]], words beside
// single grains; and the key `show` of [film].
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <algorithm>
#include <iterator>

#include "engine/base/error.hpp"
#include "engine/base/numbers.hpp"
#include "engine/base/text.hpp"
#include "engine/scene/chapters/drive_keys.hpp"
#include "engine/scene/keys/bound_key.hpp"
#include "render/scene/keys/film_keys.hpp"

namespace grainreel {

namespace {

using namespace keys;

constexpr double longest_hold = 60;  // s of film

const KeyTable<FilmCaption>& caption_table() {
    using C = FilmCaption;
    static const KeyTable<C> table{
        quantity("from", &C::from, Dimension::time, not_negative, required(),
                 "Simulated time at which the words appear."),
        quantity("to", &C::to, Dimension::time, positive, note("the next caption, or the end"),
                 "Simulated time at which they go."),
        text("text", &C::text, required(),
             "\"\\n\" begins another line; values as in film.text, {big_in_top_quarter:%}."),
        quantity("hold", &C::hold, Dimension::time, {0, longest_hold, false, false}, initial(),
                 "Time of the film for which the picture stands still when they appear, to read them."),
    };
    return table;
}

void check_caption(const Document& document, const FilmedScene& scene, std::size_t k) {
    const std::vector<FilmCaption>& captions = scene.film.captions;
    const std::string table = fmt::format("film.caption[{}]", k);
    const FilmCaption& caption = captions[k];
    if (k > 0 && clearly_less(caption.from, captions[k - 1].to))
        document.fail(
            table + ".from",
            fmt::format("is {:.6g} s, but the caption before it stays until {:.6g} s; captions follow "
                        "each other in time",
                        caption.from, captions[k - 1].to));
    if (!clearly_less(caption.from, scene.run.duration))
        document.fail(table + ".from",
                      fmt::format("is {:.6g} s, but the run ends at {:.6g} s; bring it forward or lengthen "
                                  "run.duration",
                                  caption.from, scene.run.duration));
    if (!clearly_more(caption.to, caption.from))
        document.fail(table + ".to",
                      fmt::format("is {:.6g} s, not later than 'from', {:.6g} s; write a later time",
                                  caption.to, caption.from));
    if (caption.text.empty()) document.fail(table + ".text", "must not be empty; take the caption out");
}

}  // namespace

void list_captions(Keys& all) {
    caption_table().list(all, "film.caption[]");
}

void read_captions(Document& document, FilmedScene& scene) {
    std::vector<FilmCaption>& captions = scene.film.captions;
    const std::size_t count = document.size("film.caption");
    caption_table().read_elements(document, scene, "film.caption", captions);
    for (std::size_t k = 0; k < count; ++k)
        if (captions[k].to == 0)
            captions[k].to =
                k + 1 < count ? captions[k + 1].from : std::max(scene.run.duration, captions[k].from);
    if (ends_early(document)) {
        std::size_t late = 0;
        while (late < count && !clearly_less(captions[count - 1 - late].from, scene.run.duration)) ++late;
        captions.resize(count - late);
        leave_out(scene, late, "caption", "captions");
    }
    for (std::size_t k = 0; k < captions.size(); ++k) {
        check_caption(document, scene, k);
        if (captions[k].text.find('{') == std::string::npos) continue;
        captions[k].words =
            parts_of_text(document, scene, fmt::format("film.caption[{}].text", k), captions[k].text);
    }
}

void write_captions(SceneText& out, const FilmedScene& scene) {
    caption_table().write_elements(out, scene, "film.caption", scene.film.captions);
}

namespace {

const KeyTable<FilmLabel>& label_table() {
    using L = FilmLabel;
    static const KeyTable<L> table{
        integer("id", &L::id, 0, most_grains, required(), "Of the grain; `inspect` tells ids."),
        text("text", &L::text, required(), "The words beside it."),
    };
    return table;
}

}  // namespace

void list_labels(Keys& all) {
    label_table().list(all, "film.label[]");
}

void read_labels(Document& document, FilmedScene& scene) {
    std::vector<FilmLabel>& labels = scene.film.labels;
    label_table().read_elements(document, scene, "film.label", labels);
    constexpr std::size_t most = 50;
    if (labels.size() > most)
        document.fail("film.label", fmt::format("there are {} labels; a picture has room for {} at most",
                                                labels.size(), most));
    for (std::size_t k = 0; k < labels.size(); ++k)
        if (labels[k].text.empty())
            document.fail(fmt::format("film.label[{}].text", k), "must not be empty; take the label out");
}

void write_labels(SceneText& out, const FilmedScene& scene) {
    label_table().write_elements(out, scene, "film.label", scene.film.labels);
}

namespace {

struct WordKind {
    const char* name;
    bool WordKinds::*member;
};
constexpr WordKind word_kinds[] = {
    {"title", &WordKinds::title},     {"legend", &WordKinds::legend},     {"time", &WordKinds::time},
    {"cycle", &WordKinds::cycle},     {"dial", &WordKinds::dial},         {"drive", &WordKinds::drive},
    {"shaking", &WordKinds::shaking}, {"playback", &WordKinds::playback}, {"scale", &WordKinds::scale},
    {"arrows", &WordKinds::arrows},   {"counts", &WordKinds::counts},     {"captions", &WordKinds::captions}};

std::vector<std::string> word_kind_names() {
    std::vector<std::string> names;
    for (const WordKind& kind : word_kinds) names.emplace_back(kind.name);
    return names;
}

void read_word_kinds(Document& document, const Scene&, const std::string& path, Film& film) {
    film.word_kinds = {};
    if (!document.has(path)) return;
    for (const WordKind& kind : word_kinds) film.word_kinds.*kind.member = false;
    const std::vector<std::string> names = document.name_list(path);
    for (std::size_t i = 0; i < names.size(); ++i) {
        const auto* const kind = std::find_if(std::begin(word_kinds), std::end(word_kinds),
                                              [&](const WordKind& known) { return known.name == names[i]; });
        if (kind == std::end(word_kinds))
            throw UserError("{}: 'show' has \"{}\", which is none of the words: {}",
                            document.place(fmt::format("{}[{}]", path, i)), excerpt(names[i]),
                            fmt::join(word_kind_names(), ", "));
        film.word_kinds.*kind->member = true;
    }
}

std::string word_kinds_text(const Film& film, const Scene&) {
    std::vector<std::string> names;
    for (const WordKind& kind : word_kinds)
        if (film.word_kinds.*kind.member) names.push_back(quoted(kind.name));
    return toml_list(names);
}

}  // namespace

keys::BoundKey<Film> word_kinds_key() {
    return bound_by<Film>(
               of_choices(entry("show", KeyKind::name_list, note("all but cycle, dial, drive and arrows"),
                                "Words and signs that the film has; [] for none. `words` says where."),
                          word_kind_names()),
               read_word_kinds, word_kinds_text)
        .unwritten_if([](const Film& film) { return film.word_kinds == WordKinds(); });
}

namespace {

const ChoiceWords<GutterPlace> gutter_words{{"sides", GutterPlace::sides},
                                            {"row-above", GutterPlace::row_above},
                                            {"row-below", GutterPlace::row_below},
                                            {"column", GutterPlace::column},
                                            {"above-and-below", GutterPlace::above_and_below},
                                            {"below", GutterPlace::below},
                                            {"above-and-side", GutterPlace::above_and_side},
                                            {"below-and-side", GutterPlace::below_and_side},
                                            {"side-and-below", GutterPlace::side_and_below}};

const KeyTable<FilmGutters>& gutter_table() {
    using G = FilmGutters;
    const Range share{0, 0.6, false, false};
    static const KeyTable<G> table{
        choice("place", &G::place, gutter_words, note("required in this table"),
               "Where title and legend lie, and where time, notes and plots do."),
        quantity("letters", &G::letters, Dimension::number, {0.7, 1, false, false}, initial(),
                 "Their size over the usual one."),
        quantity(
            "first", &G::first, Dimension::number, share, note("as the words need"),
            "At least so wide a column, or so high a row, as a share of the picture: of title and legend.")
            .unwritten_if([](const G& gutters) { return gutters.first == 0; }),
        quantity("second", &G::second, Dimension::number, share, note("as the words need"),
                 "The same for time, notes and plots; of one row its width.")
            .unwritten_if([](const G& gutters) { return gutters.second == 0; }),
    };
    return table;
}

}  // namespace

void list_gutters(Keys& all) {
    gutter_table().list(all, "film.gutters");
}

void read_gutters(Document& document, FilmedScene& scene) {
    if (!document.is_table("film.gutters")) return;
    if (!document.has("film.gutters.place")) document.fail_missing("film.gutters.place");
    gutter_table().read(document, scene, "film.gutters", scene.film.gutters);
    scene.film.gutters.wanted = true;
}

void write_gutters(SceneText& out, const FilmedScene& scene) {
    if (!scene.film.gutters.wanted) return;
    out.table("film.gutters");
    gutter_table().write(out, scene, scene.film.gutters);
}

Assignments gutter_keys(const FilmGutters& gutters) {
    if (!gutters.wanted) return {};
    return {fmt::format("film.gutters={{place={}, letters={:.6g}, first={:.6g}, second={:.6g}}}",
                        quoted(word_of(gutters.place, gutter_words)), gutters.letters, gutters.first,
                        gutters.second)};
}

}  // namespace grainreel
