// Style, light and cut of the film.
#include "engine/scene/film/colours.hpp"
#include "engine/scene/text/reader_parts.hpp"
#include "engine/scene/text/words.hpp"

namespace grainreel {
namespace {

void read_cut(Document& document, FilmCut& cut) {
    cut.present = document.has("film.cut");
    if (!cut.present) return;
    if (const auto normal = document.vector("film.cut.normal")) {
        if (normal->norm() < 1e-9)
            document.fail("film.cut.normal", "has no direction; write for example [1, 0, 0]");
        cut.normal = normal->normalized();
    }
    cut.at = document.quantity("film.cut.at").value_or(cut.at);
    cut.thickness = document.quantity("film.cut.thickness").value_or(cut.thickness);
}

}  // namespace

void read_film_look(Document& document, Film& film) {
    using Style = FilmLook::Style;
    FilmLook& look = film.look;
    look.style = chosen<Style>(document, "film.style", style_words, Style::studio);
    look = FilmLook::of(look.style);
    look.occlusion = document.flag("film.occlusion").value_or(look.occlusion);
    look.shadows = document.flag("film.shadows").value_or(look.shadows);
    look.ground = document.flag("film.ground").value_or(look.ground);
    look.rotation = document.flag("film.rotation").value_or(false);
    film.background = default_background(look.style);
    read_cut(document, look.cut);
}

}  // namespace grainreel
