// The keys of [[film.label]]: words beside single grains.
#include <fmt/format.h>

#include "engine/scene/keys/bound_key.hpp"
#include "render/scene/keys/film_keys.hpp"

namespace grainreel {
namespace {

using namespace keys;

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
        document.fail("film.label", fmt::format("there are {} labels; a picture has room for {} at most", labels.size(), most));
    for (std::size_t k = 0; k < labels.size(); ++k)
        if (labels[k].text.empty())
            document.fail(fmt::format("film.label[{}].text", k), "must not be empty; take the label out");
}

void write_labels(SceneText& out, const FilmedScene& scene) {
    label_table().write_elements(out, scene, "film.label", scene.film.labels);
}

}  // namespace grainreel
