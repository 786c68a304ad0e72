// The keys of [[grain]].
#include <fmt/format.h>

#include "engine/base/text.hpp"
#include "engine/scene/chapters/chapters.hpp"
#include "engine/scene/chapters/container_keys.hpp"
#include "engine/scene/keys/bound_key.hpp"

namespace grainreel {
namespace {

using namespace keys;

constexpr double same_size = 1e-6;  // relative: a diameter written by hand is not exact to the last bit

void read_species_of(Document& document, const Scene& scene, const std::string& path, ListedGrain& grain) {
    grain.species = species_named(document, scene, path);
}

BoundKey<ListedGrain> species_key() {
    return bound_by<ListedGrain>(
        entry("species", KeyKind::text, note("the first"), "Grains placed one by one; whose numbers it has."),
        read_species_of, [](const ListedGrain& grain, const Scene& scene) {
            return quoted(scene.species[grain.species].name);
        });
}

enum Place { of_kind, of_motion };  // in the order of reading and writing

const KeyTable<ListedGrain>& grain_table() {
    using G = ListedGrain;
    static const KeyTable<G> table{
        species_key().placed_at(of_kind),
        vector("position", &G::position, Dimension::length, required(), "Of the centre.")
            .placed_at(of_motion),
        vector("velocity", &G::velocity, Dimension::speed, initial(), "At the start.").placed_at(of_motion),
        vector("spin", &G::spin, Dimension::spin, initial(), "Angular velocity at the start.")
            .placed_at(of_motion),
        quantity("diameter", &G::diameter, Dimension::length, positive, note("the species' mean"),
                 "Inside the species' spread.")
            .usually([](G& grain, const Scene& scene) {
                grain.diameter = scene.species[grain.species].diameter.mean;
            })
            .placed_at(of_kind),
    };
    return table;
}

ListedGrain read_grain(Document& document, const Scene& scene, const std::string& path) {
    ListedGrain grain;
    grain_table().read(document, scene, path, grain);
    const SizeSpread& spread = scene.species[grain.species].diameter;
    if (grain.diameter < spread.smallest * (1 - same_size) ||
        grain.diameter > spread.largest * (1 + same_size))
        document.fail(path + ".diameter",
                      fmt::format("of {:.6g} m is outside its species' {:.6g} to {:.6g} m; widen the spread",
                                  grain.diameter, spread.smallest, spread.largest));
    return grain;
}

}  // namespace

void list_grains(Keys& all) {
    grain_table().list(all, "grain[]");
}

void read_grains(Document& document, Scene& scene) {
    const std::size_t listed = document.size("grain");
    if (listed == 0) return;
    for (Species& species : scene.species) species.count = 0;
    for (std::size_t i = 0; i < listed; ++i) {
        scene.start.grains.push_back(read_grain(document, scene, fmt::format("grain[{}]", i)));
        ++scene.species[scene.start.grains.back().species].count;
    }
    for (std::size_t s = 0; s < scene.species.size(); ++s)
        if (scene.species[s].count == 0 && !is_fed(document, s, scene.species[s].name) &&
            !is_glued(document, s, scene.species[s].name))
            document.fail(fmt::format("species[{}].name", s),
                          fmt::format("\"{}\" has no grain among those listed; add one or remove the species",
                                      excerpt(scene.species[s].name)));
}

void write_grains(SceneText& out, const Scene& scene) {
    grain_table().write_elements(out, scene, "grain", scene.start.grains);
}

}  // namespace grainreel
