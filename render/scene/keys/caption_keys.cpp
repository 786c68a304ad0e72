// The keys of [[film.caption]]: words that the film shows for a while, and how long it stands still for them.
#include <fmt/format.h>

#include <algorithm>

#include "engine/base/numbers.hpp"
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
        text("text", &C::text, required(), "\"\\n\" begins another line."),
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
    for (std::size_t k = 0; k < captions.size(); ++k) check_caption(document, scene, k);
}

void write_captions(SceneText& out, const FilmedScene& scene) {
    caption_table().write_elements(out, scene, "film.caption", scene.film.captions);
}

}  // namespace grainreel
