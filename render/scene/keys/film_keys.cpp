// The keys of [film] itself, about the picture and the file, and the rules of each file format. The keys of
// what else a film shows have files of their own (film_keys.hpp).
#include "render/scene/keys/film_keys.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <algorithm>
#include <charconv>
#include <cmath>

#include "engine/scene/chapters/chapters.hpp"
#include "engine/scene/keys/bound_key.hpp"
#include "engine/scene/text/units.hpp"
#include "render/scene/film.hpp"
#include "render/scene/purposes.hpp"
#include "render/scene/shown_values.hpp"

namespace grainreel {

namespace {

using namespace keys;

constexpr std::int64_t least_pixels = 64, most_pixels = 8192;
constexpr std::int64_t most_tiles = 12;  // columns or rows of a contact sheet
constexpr int capped_quality = 18;       // crf, the default of a film that is kept below a size (a cap)

// Whether a film in this format can be kept below a size.
bool can_be_capped(FilmFormat format) {
    return format == FilmFormat::mp4 || format == FilmFormat::webm || format == FilmFormat::gif;
}

constexpr double gif_ticks = 100;         // ticks a second: a GIF counts whole hundredths
constexpr double shortest_gif_ticks = 2;  // browsers slow down films that ask for less

// The nearest of the rates that a GIF can have, 100/n frames a second.
double gif_rate(double wanted) {
    const double below = std::max(shortest_gif_ticks, std::ceil(gif_ticks / wanted));
    const double above = std::max(shortest_gif_ticks, below - 1);
    const double slow = gif_ticks / below, fast = gif_ticks / above;
    return wanted - slow <= fast - wanted ? slow : fast;
}

void fit_gif_rate(FilmedScene& scene) {
    Film& film = scene.film;
    const double rate = gif_rate(film.rate);
    if (std::abs(rate - film.rate) > 1e-9 * rate)
        scene.notes.push_back(
            fmt::format("{}: a GIF shows each frame for whole hundredths of a second: the "
                        "film gets {:.4g} frames/s in place of {:.4g}",
                        scene.where("film.rate"), rate, film.rate));
    film.rate = rate;
}

void check_max_size(const Document& document, const Film& film) {
    const char* path = "film.max_size";
    if (document.has(path) && film.max_size && !can_be_capped(film.format))
        document.fail(
            path, fmt::format("goes with the formats mp4, webm and gif, but the film is {}; remove it, or "
                              "write \"none\"",
                              word_of(film.format, film_format_words)));
}

void check_transparent(const Document& document, const Film& film) {
    if (film.transparent && film.format != FilmFormat::png && film.format != FilmFormat::ffv1)
        document.fail(
            "film.transparent",
            fmt::format("goes with the formats png and ffv1, but a film in {} keeps no alpha; write "
                        "format = \"png\"",
                        word_of(film.format, film_format_words)));
}

// A scene that sets size, rate or format keeps its own value, and a note tells this to a user who asked for a
// purpose.
void tell_what_stays(const Document& document, FilmedScene& scene) {
    const Purpose* purpose = find_purpose(scene.film.purpose);
    if (purpose == nullptr) return;
    const Film& film = scene.film;
    std::vector<std::string> stays;
    if (film.width != purpose->width || film.height != purpose->height)
        stays.push_back(
            fmt::format("size {}x{} ({}x{})", film.width, film.height, purpose->width, purpose->height));
    if (film.rate != purpose->rate)
        stays.push_back(fmt::format("rate {:.4g} ({:.4g})", film.rate, purpose->rate));
    if (film.format != purpose->format)
        stays.push_back(fmt::format("format {} ({})", word_of(film.format, film_format_words),
                                    word_of(purpose->format, film_format_words)));
    if (!stays.empty())
        scene.notes.push_back(
            fmt::format("{}: what is set elsewhere stays, the default of \"{}\" in brackets: {}",
                        document.place("film.for"), purpose->name, fmt::join(stays, ", ")));
}

// Refuses settings that do not go with the film's format, and fits the rate to it. The keys of size, rate and
// file must have been read before.
void settle_film_file(const Document& document, FilmedScene& scene) {
    check_max_size(document, scene.film);
    check_transparent(document, scene.film);
    if (scene.film.format == FilmFormat::gif) fit_gif_rate(scene);
    tell_what_stays(document, scene);
}

// Reads "1920x1080" or [1920, 1080]; gives zeros for anything else.
std::array<std::int64_t, 2> two_counts(Document& document, const std::string& path) {
    std::array<std::int64_t, 2> size{0, 0};
    if (document.is_array(path)) {
        size = document.two_integers(path).value_or(size);
    } else if (document.is_text(path)) {
        const std::optional<std::string> text = document.text(path);
        const char* end = text->data() + text->size();
        const auto width = std::from_chars(text->data(), end, size[0]);
        if (width.ptr != end && *width.ptr == 'x') {
            const auto height = std::from_chars(width.ptr + 1, end, size[1]);
            if (height.ptr != end) size[1] = 0;
        }
    }
    return size;
}

void read_size(Document& document, const Scene&, const std::string& path, Film& film) {
    if (!document.has(path)) return;
    const std::array<std::int64_t, 2> size = two_counts(document, path);
    const auto wrong = [](std::int64_t pixels) { return pixels < least_pixels || pixels > most_pixels; };
    if (wrong(size[0]) || wrong(size[1]))
        document.fail(path,
                      fmt::format("must be width x height, each from {} to {} pixels, but is {}; write for "
                                  "example \"1920x1080\"",
                                  least_pixels, most_pixels, document.written_value(path)));
    film.width = static_cast<int>(size[0]);
    film.height = static_cast<int>(size[1]);
}

void read_sheet(Document& document, const Scene&, const std::string& path, Film& film) {
    if (!document.has(path)) return;
    const std::array<std::int64_t, 2> sheet = two_counts(document, path);
    const auto wrong = [](std::int64_t count) { return count < 1 || count > most_tiles; };
    if (wrong(sheet[0]) || wrong(sheet[1]))
        document.fail(
            path,
            fmt::format("must be columns x rows, each from 1 to {}, but is {}; write for example \"4x3\"",
                        most_tiles, document.written_value(path)));
    film.sheet = {static_cast<int>(sheet[0]), static_cast<int>(sheet[1])};
}

void read_purpose(Document& document, const Scene&, const std::string& path, Film& film) {
    const Purpose* purpose = find_purpose(document.text(path).value_or(""));
    if (purpose == nullptr) return;
    film.purpose = purpose->name;
    film.width = purpose->width;
    film.height = purpose->height;
    film.rate = purpose->rate;
    film.format = purpose->format;
    film.quality = purpose->quality;
    film.preset = purpose->preset;
    film.max_size = purpose->max_size;
    film.sheet = purpose->sheet;
}

// The cap is read after the format, because some formats have no use for the purpose's cap.
void read_max_size(Document& document, const Scene&, const std::string& path, Film& film) {
    if (!can_be_capped(film.format)) film.max_size.reset();
    const auto text = document.text(path);
    if (!text) return;
    const bool none = *text == "none";
    film.max_size = none ? std::nullopt : parse_data_size(*text);
    if (!none && !film.max_size)
        document.fail(path, fmt::format("must be a size in kB, MB, GB, KiB, MiB or GiB, but is {}; write "
                                        "for example \"10 MB\"",
                                        document.written_value(path)));
}

void read_background(Document& document, const Scene&, const std::string& path, Film& film) {
    film.background = document.has(path) ? read_colour(document, path, "\"white\" or \"#ffffff\"")
                                         : default_background(film.look.style);
}

BoundKey<Film> size_key() {
    return bound_by<Film>(
        entry("size", KeyKind::picture_size, literal("\"1920x1080\""), "Width and height, pixels."),
        read_size, [](const Film& film, const Scene&) {
            return toml_list({as_toml(film.width), as_toml(film.height)});
        });
}

BoundKey<Film> purpose_key() {
    return bound_by<Film>(choice("for", purpose_names(), note("none"),
                                 "Defaults for what the film is for: size, rate, format, quality, max_size."),
                          read_purpose,
                          [](const Film& film, const Scene&) {
                              return film.purpose.empty() ? "" : quoted(film.purpose);
                          })
        .read_at(-3);
}

BoundKey<Film> preset_key() {
    Key key = choice(
        "preset",
        {"ultrafast", "superfast", "veryfast", "faster", "fast", "medium", "slow", "slower", "veryslow"},
        initial(), "x264's preset (veryfast with subme=1): slower makes smaller files.");
    return bound(std::move(key), &Film::preset);
}

BoundKey<Film> max_size_key() {
    return bound_by<Film>(
               entry("max_size", KeyKind::text, literal("\"none\""),
                     "mp4, webm and gif only: largest file, as in \"10 MB\" (kB, MB, GB, KiB, MiB, GiB)."),
               read_max_size,
               [](const Film& film, const Scene&) {
                   return quoted(film.max_size ? fmt::format("{} B", *film.max_size) : "none");
               })
        .read_at(-1);
}

BoundKey<Film> sheet_key() {
    return bound_by<Film>(entry("sheet", KeyKind::picture_size, note("none"),
                                "Columns x rows of sheet.png, frames spread evenly over the film."),
                          read_sheet, [](const Film& film, const Scene&) {
                              const auto& [columns, rows] = film.sheet;
                              return columns > 0 ? toml_list({as_toml(columns), as_toml(rows)}) : "";
                          });
}

BoundKey<Film> background_key() {
    return bound_by<Film>(entry("background", KeyKind::colour, note("\"#ffffff\"; \"#12151b\" with dark"),
                                "As species.colour."),
                          read_background,
                          [](const Film& film, const Scene&) { return quoted(colour_text(film.background)); })
        .unwritten_if(
            [](const Film& film) { return film.background == default_background(film.look.style); });
}

// Keys of the picture and of how it follows time.
const KeyTable<Film>& picture_table() {
    static const KeyTable<Film> table{
        size_key(),
        quantity("rate", &Film::rate, Dimension::number, {1, 240, false, false}, initial(),
                 "Frames a second."),
        integer("periods", &Film::periods, 1, 4, note("as the bed does"),
                "How many periods of the drive locked frames are apart, and displacements and means last.")
            .unwritten_if([](const Film& film) { return film.periods == 0; })
            .written_at(1),
        text("title", &Film::title, note("`title`"), "Shown on the frame; \"\" for none.")
            .usually([](Film& film, const Scene& scene) { film.title = scene.title; }),
        bound_by<Film>(
            choice("lang", all_of(language_words()), literal("\"en\""),
                   "Language of the fixed words of films and pages; [film.wording] has your own."),
            [](Document& document, const Scene&, const std::string& path, Film& film) {
                const auto word = document.text(path);
                for (const auto& [said, language] : language_words())
                    if (word && *word == said) film.wording.language = language;
            },
            [](const Film& film, const Scene&) {
                return quoted(word_of(film.wording.language, language_words()));
            })
            .unwritten_if([](const Film& film) { return film.wording.language == Language::en; }),
    };
    return table;
}

const KeyTable<Film>& file_table() {
    static const KeyTable<Film> table{
        integer("quality", &Film::quality, 0, 51, note("20; 18 with `max_size`"),
                "x264's crf: 18 near-lossless, 23 small; other codecs take what looks alike.")
            .usually([](Film& film, const Scene&) {
                if (film.max_size) film.quality = capped_quality;
            }),
        preset_key(),
        purpose_key(),
        choice("format", &Film::format, film_format_words, initial(),
               "mp4 is H.264, webm VP9, ffv1 lossless; docs/guide/films.md compares them.")
            .read_at(-2),
        flag("transparent", &Film::transparent, initial(),
             "png and ffv1 only: alpha in place of the background."),
        max_size_key(),
        sheet_key(),
        background_key(),
    };
    return table;
}

// Keys for things drawn beside grains and walls, and for how the walls' motion is shown.
const KeyTable<Film>& scenery_table() {
    static const KeyTable<Film> table{
        choice("words", &Film::words, word_place_words, initial(),
               "Words beside the picture, on plates over it, or none; automatic: plates with a "
               "zoom, position or target of your own."),
        word_kinds_key(),
        // The key is not written where its value follows from the camera, since a finished run may be drawn
        // again with another camera.
        flag("axes", &Film::axes, note("true where the camera moves"),
             "Arrows along x, y and z as the camera sees them.")
            .usually([](Film& film, const Scene&) { film.axes = film.camera.moves(); })
            .unwritten_if([](const Film& film) { return film.axes == film.camera.moves(); }),
        flag("wall_ghost", &Film::wall_ghost, initial(), "A faint outline of the container at rest."),
        quantity("exaggerate", &Film::exaggerate, Dimension::number, {1, 1000, false, false}, initial(),
                 "The container's motion drawn so many times as large, its grains with it."),
    };
    return table;
}

}  // namespace

void list_film(Keys& all) {
    picture_table().list(all, "film");
    file_table().list(all, "film");
    list_look(all);
    scenery_table().list(all, "film");
    list_marks(all);
    list_cut(all);
    list_film_walls(all);
    list_camera(all);
    list_length(all);
    list_segments(all);
    list_captions(all);
    list_labels(all);
    list_gutters(all);
    list_shows(all);
    list_wording(all);
}

// Style and purpose are read first, because the style sets the default of the background and the purpose sets
// the defaults of the picture.
void read_film(Document& document, FilmedScene& scene) {
    Film& film = scene.film;
    read_look(document, scene);
    read_film_walls(document, scene);
    file_table().read(document, scene, "film", film);
    picture_table().read(document, scene, "film", film);
    settle_film_file(document, scene);
    read_wording(document, scene);
    read_camera(document, scene);
    scenery_table().read(document, scene, "film", film);
    read_segments(document, scene);
    read_captions(document, scene);
    read_length(document, scene);
    read_labels(document, scene);
    read_gutters(document, scene);
    read_shows(document, scene);
}

void write_film(SceneText& out, const FilmedScene& scene) {
    out.table("film");
    picture_table().write(out, scene, scene.film);
    write_text(out, scene);
    file_table().write(out, scene, scene.film);
    scenery_table().write(out, scene, scene.film);
    write_look(out, scene);
    write_marks(out, scene);
    write_cut(out, scene);
    write_film_walls(out, scene);
    write_shows(out, scene);
    write_camera(out, scene);
    write_segments(out, scene);
    write_captions(out, scene);
    write_labels(out, scene);
    write_gutters(out, scene);
    write_wording(out, scene);
}

Colour read_colour(Document& document, const std::string& path, const char* example) {
    const auto colour = parse_colour(*document.text(path));
    if (!colour)
        document.fail(path, fmt::format("must be a colour, but is {}; write for example {}",
                                        document.written_value(path), example));
    return *colour;
}

}  // namespace grainreel
