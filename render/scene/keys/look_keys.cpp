// The keys of style, light and cut: part of [film], and [film.cut].
#include "engine/scene/keys/bound_key.hpp"
#include "render/scene/film.hpp"
#include "render/scene/keys/film_keys.hpp"

namespace grainreel {
namespace {

using namespace keys;

BoundKey<FilmLook> style_key() {
    BoundKey<FilmLook> style =
        choice("style", &FilmLook::style, style_words, initial(),
               "Of the light: soft shadows; even colours with outlines, for print; for dark "
               "rooms.");
    return style.read_at(-1);
}

// Light that comes with a style unless the scene says otherwise. Written only where it does, so that a
// written scene can be given another style.
BoundKey<FilmLook> light(const char* name, bool FilmLook::*member, const char* about) {
    return flag(name, member, note("true; false with flat"), about)
        .usually([member](FilmLook& look, const Scene&) { look.*member = FilmLook::of(look.style).*member; })
        .unwritten_if(
            [member](const FilmLook& look) { return look.*member == FilmLook::of(look.style).*member; });
}

const KeyTable<FilmLook>& look_table() {
    static const KeyTable<FilmLook> table{
        style_key(),
        light("occlusion", &FilmLook::occlusion, "Less light reaches the gaps between grains."),
        light("shadows", &FilmLook::shadows, "Of grains on other grains."),
        light("ground", &FilmLook::ground,
              "Under the container, to show its shadow; none where grains leave below an outlet."),
        flag("rotation", &FilmLook::rotation, initial(),
             "Grains are light on one half and dark on the other and so show how they turn."),
    };
    return table;
}

const KeyTable<FilmCut>& cut_table() {
    static const KeyTable<FilmCut> table{
        vector("normal", &FilmCut::normal, Dimension::number, note("[1, 0, 0]"),
               "Opens the bed along a plane: what lies on this side of it is taken away."),
        quantity("at", &FilmCut::at, Dimension::length, any, note("0"),
                 "Distance of that plane from the origin, along the normal."),
        quantity("thickness", &FilmCut::thickness, Dimension::length, positive, note("all behind it"),
                 "Of the slab behind the plane that is kept.")
            .unwritten_if([](const FilmCut& cut) { return cut.thickness == 0; }),
    };
    return table;
}

}  // namespace

void list_look(Keys& all) {
    look_table().list(all, "film");
}

void list_cut(Keys& all) {
    cut_table().list(all, "film.cut");
}

void read_look(Document& document, FilmedScene& scene) {
    look_table().read(document, scene, "film", scene.film.look);
    FilmCut& cut = scene.film.look.cut;
    cut.present = document.has("film.cut");
    if (!cut.present) return;
    cut_table().read(document, scene, "film.cut", cut);
    if (cut.normal.norm() < 1e-9)
        document.fail("film.cut.normal", "has no direction; write for example [1, 0, 0]");
    if (document.has("film.cut.normal")) cut.normal.normalize();
}

void write_look(SceneText& out, const FilmedScene& scene) {
    look_table().write(out, scene, scene.film.look);
}

void write_cut(SceneText& out, const FilmedScene& scene) {
    if (!scene.film.look.cut.present) return;
    out.table("film.cut");
    cut_table().write(out, scene, scene.film.look.cut);
}

}  // namespace grainreel
