// The keys of [film] and its tables. Each table has three functions: one lists its keys for the table of all
// keys, one reads them, and one writes them back. A key itself is an entry in one of the .cpp files of this
// folder.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "engine/scene/keys/bound_key.hpp"
#include "engine/scene/keys/document.hpp"
#include "engine/scene/keys/keys.hpp"
#include "engine/scene/text/toml_text.hpp"
#include "render/scene/filmed_scene.hpp"

namespace grainreel {

void list_camera(keys::Keys& all);
void read_camera(Document& document, FilmedScene& scene);
void write_camera(SceneText& out, const FilmedScene& scene);

// Style, light and cut.
void list_look(keys::Keys& all);
void list_cut(keys::Keys& all);
void read_look(Document& document, FilmedScene& scene);
void write_look(SceneText& out, const FilmedScene& scene);
void write_cut(SceneText& out, const FilmedScene& scene);

// How meshes are drawn.
void list_film_walls(keys::Keys& all);
void read_film_walls(Document& document, FilmedScene& scene);
void write_film_walls(SceneText& out, const FilmedScene& scene);

// *_marks() are for the keys that hide and ring grains, write_text() for `text`. *_shows() are for colours,
// plots, arrows and trails, and list_shows() also lists `text`. read_shows() reads all of these keys, marks
// and text too.
void list_marks(keys::Keys& all);
void list_shows(keys::Keys& all);
void read_shows(Document& document, FilmedScene& scene);
void write_text(SceneText& out, const FilmedScene& scene);
void write_marks(SceneText& out, const FilmedScene& scene);
void write_shows(SceneText& out, const FilmedScene& scene);

void list_colour(keys::Keys& all);
void read_colour(Document& document, FilmedScene& scene);
void write_colour(SceneText& out, const FilmedScene& scene);

void list_plots(keys::Keys& all);
void read_plots(Document& document, FilmedScene& scene);
void write_plots(SceneText& out, const FilmedScene& scene);

void list_arrows_and_trails(keys::Keys& all);
void read_arrows_and_trails(Document& document, FilmedScene& scene);
void write_arrows_and_trails(SceneText& out, const FilmedScene& scene);

void list_segments(keys::Keys& all);
void read_segments(Document& document, FilmedScene& scene);  // call it after the rate is read
void write_segments(SceneText& out, const FilmedScene& scene);

// The segments of a film whose scene gives none. With a drive: slow motion at both ends, each 4 s of film but
// at most a tenth of the run, and one frame a period between them. Without one: slow motion in which the eye
// can follow falling grains, in half a minute of film at most.
std::vector<FilmSegment> default_segments(const FilmedScene& scene);

// The length of the whole film.
void list_length(keys::Keys& all);
void read_length(Document& document, FilmedScene& scene);  // call it after segments and captions

void list_labels(keys::Keys& all);
void read_labels(Document& document, FilmedScene& scene);
void write_labels(SceneText& out, const FilmedScene& scene);

void list_captions(keys::Keys& all);
void read_captions(Document& document, FilmedScene& scene);  // call it after [run] is read
void write_captions(SceneText& out, const FilmedScene& scene);

// Where the gutters of words lie.
void list_gutters(keys::Keys& all);
void read_gutters(Document& document, FilmedScene& scene);
void write_gutters(SceneText& out, const FilmedScene& scene);
// The assignment that gives a film these gutters; none where they are not wanted.
Assignments gutter_keys(const FilmGutters& gutters);

// The own words of [film.wording]. Call it after `lang` is read and before plots are, whose labels follow.
void list_wording(keys::Keys& all);
void read_wording(Document& document, FilmedScene& scene);
void write_wording(SceneText& out, const FilmedScene& scene);

// The words and values of a text that stands at `path`.
std::vector<LiveWords> parts_of_text(const Document& document, const Scene& scene, const std::string& path,
                                     const std::string& text);

// The key `show` of [film]: which words and signs stand beside the grains.
keys::BoundKey<Film> word_kinds_key();

// Reads a colour by name or number. example: a colour that the message gives as an example.
Colour read_colour(Document& document, const std::string& path, const char* example);

// All of [film].
void list_film(keys::Keys& all);
void read_film(Document& document, FilmedScene& scene);  // call it after the tables of the engine
void write_film(SceneText& out, const FilmedScene& scene);

// From here on: keys whose values are lists of species by name or of grains by id (shows_keys.cpp).

// The indices of the species that the list at `path` names; empty without a list. Throws UserError for a name
// that no species has.
std::vector<std::size_t> species_list(Document& document, const Scene& scene, const std::string& path);
// The ids of the list at `path`. Throws UserError for an id that no grain has.
std::vector<std::int32_t> ids_at(Document& document, const Scene& scene, const std::string& path);

// The lists as TOML; empty for empty lists.
std::string species_text(const std::vector<std::size_t>& chosen, const Scene& scene);
std::string ids_text(const std::vector<std::int32_t>& ids);

// Keys of such lists.
template <class T>
keys::BoundKey<T> species_key(const char* name, std::vector<std::size_t> T::*member, const char* about) {
    return keys::bound_by<T>(
        keys::entry(name, KeyKind::name_list, keys::note("none"), about),
        [member](Document& document, const Scene& scene, const std::string& path, T& into) {
            into.*member = species_list(document, scene, path);
        },
        [member](const T& from, const Scene& scene) { return species_text(from.*member, scene); });
}

template <class T>
keys::BoundKey<T> ids_key(const char* name, std::vector<std::int32_t> T::*member, const char* about) {
    Key key = keys::integer(name, 0, keys::most_grains, keys::note("none"), about);
    key.kind = KeyKind::integer_list;
    return keys::bound_by<T>(
        std::move(key),
        [member](Document& document, const Scene& scene, const std::string& path, T& into) {
            into.*member = ids_at(document, scene, path);
        },
        [member](const T& from, const Scene&) { return ids_text(from.*member); });
}

}  // namespace grainreel
