// The keys of [[species]].
#include <fmt/format.h>

#include <numbers>

#include "engine/base/error.hpp"
#include "engine/base/mathematics.hpp"
#include "engine/base/text.hpp"
#include "engine/scene/chapters/chapters.hpp"
#include "engine/scene/chapters/container_keys.hpp"
#include "engine/scene/keys/bound_key.hpp"

namespace grainreel {
namespace {

using namespace keys;
using Spread = SizeSpread::Kind;

const char* beside_mean(const SizeSpread& spread) {
    return spread.kind == Spread::normal ? "'mean' and 'deviation' say the spread" : nullptr;
}

const char* beside_ends(const SizeSpread& spread) {
    return spread.kind == Spread::uniform ? "'min' and 'max' say the spread" : nullptr;
}

// The keys of a diameter that is a table.
const KeyTable<SizeSpread>& spread_table() {
    using S = SizeSpread;
    const auto length = [](const char* name, double S::*member, const char* about) {
        return quantity(name, member, Dimension::length, positive, note("none"), about).needed();
    };
    static const KeyTable<S> table{
        length("min", &S::smallest, "Smallest of evenly spread diameters.").useless_for(beside_mean),
        length("max", &S::largest, "Largest of them.").useless_for(beside_mean),
        length("mean", &S::mean, "Mean of normally spread diameters.").useless_for(beside_ends),
        length("deviation", &S::deviation, "Their standard deviation; cut off at two of them.")
            .useless_for(beside_ends),
    };
    return table;
}

void read_spread(Document& document, const Scene& scene, const std::string& path, SizeSpread& spread) {
    const bool normal = document.has(path + ".mean") || document.has(path + ".deviation");
    spread.kind = normal ? Spread::normal : Spread::uniform;
    spread_table().read(document, scene, path, spread);
    if (normal) {
        spread.smallest = spread.mean - 2 * spread.deviation;
        spread.largest = spread.mean + 2 * spread.deviation;
        if (spread.smallest <= 0)
            document.fail(path + ".deviation",
                          "must be less than half of the mean, at which the smallest grains vanish");
        return;
    }
    spread.mean = 0.5 * (spread.smallest + spread.largest);
    if (spread.smallest >= spread.largest)
        document.fail(path + ".min", "must be smaller than 'max'; exchange the two");
}

void read_diameter(Document& document, const Scene& scene, const std::string& path, Species& species) {
    SizeSpread& spread = species.diameter;
    if (document.is_table(path)) return read_spread(document, scene, path, spread);
    spread.mean = spread.smallest = spread.largest = document.required_quantity(path);
}

std::string diameter_text(const Species& species, const Scene& scene) {
    const SizeSpread& spread = species.diameter;
    if (spread.kind == Spread::fixed) return as_toml(spread.mean, Dimension::length);
    return spread_table().inline_text(scene, spread);
}

void read_count(Document& document, const Scene& scene, const std::string& path, Species& species) {
    if (document.size("grain") > 0) return document.refuse(path, "the grains are listed one by one");
    const auto count = document.integer(path);
    const std::size_t number = scene.species.size();
    if (!count && !is_fed(document, number, species.name) && !is_glued(document, number, species.name))
        document.fail_missing(path);
    species.count = count.value_or(0);
}

// Another way to give the density; the density is kept and written.
void read_mass(Document& document, const Scene&, const std::string& path, Species& species) {
    const auto mass = document.quantity(path);
    if (!mass) return;
    const std::string density = parent_of(path) + ".density";
    document.refuse(density, "'mass' is given");
    species.density = *mass / (std::numbers::pi / 6 * math::cube(species.diameter.mean));
    if (const Range bounds = find_key(density)->bounds(); !bounds.contains(species.density))
        document.fail(path, fmt::format("makes a density of {:.4g} kg/m3, which must be {}; is its unit, or "
                                        "that of the diameter, the one you mean?",
                                        species.density, bounds.text()));
}

void read_density(Document& document, const Scene&, const std::string& path, Species& species) {
    if (species.density == 0) species.density = document.required_quantity(path);
}

void read_colour_of(Document& document, const Scene&, const std::string& path, Species& species) {
    species.colour_text = document.as_it_stands(path);
}

BoundKey<Species> diameter_key() {
    return bound_by<Species>(
               of_dimension(entry("diameter", KeyKind::diameter, required(),
                                  "One length, or a spread: { min, max } or { mean, deviation }."),
                            Dimension::length, positive),
               read_diameter, diameter_text)
        .holding(spread_table());
}

BoundKey<Species> count_key() {
    return bound_by<Species>(
        integer("count", 1, most_grains, note("required, but for [[grain]], [[feed]] and `wall_grains`"),
                "How many grains there are at the start."),
        read_count, [](const Species& species, const Scene& scene) {
            return scene.start.grains.empty() && species.count > 0 ? as_toml(species.count) : "";
        });
}

BoundKey<Species> density_key() {
    return bound_by<Species>(
        quantity("density", Dimension::density, positive, note("required, or `mass`"), "Of the solid."),
        read_density,
        [](const Species& species, const Scene&) { return as_toml(species.density, Dimension::density); });
}

BoundKey<Species> mass_key() {
    return bound_by<Species>(quantity("mass", Dimension::mass, positive, note("none"),
                                      "Of a grain of mean diameter, instead of the density."),
                             read_mass, [](const Species&, const Scene&) { return std::string(); })
        .excludes({"density"});
}

BoundKey<Species> colour_key() {
    return bound_by<Species>(
        entry("colour", KeyKind::colour, note("the next Okabe-Ito colour that is free"),
              "\"#rrggbb\" or a name: black, white, grey, orange, sky-blue, green, yellow, blue, "
              "vermilion, purple."),
        read_colour_of, [](const Species& species, const Scene&) { return species.colour_text; });
}

const KeyTable<Species>& species_table() {
    static const KeyTable<Species> table{
        text("name", &Species::name, required(), "For the legend and for [[contact.pair]]."),
        count_key(),
        diameter_key(),
        density_key().read_at(2),
        mass_key().read_at(1),
        colour_key().read_at(2).decides_nothing(),
    };
    return table;
}

}  // namespace

std::size_t species_named(Document& document, const Scene& scene, const std::string& path) {
    const auto name = document.text(path);
    if (!name) return 0;
    for (std::size_t s = 0; s < scene.species.size(); ++s)
        if (scene.species[s].name == *name) return s;
    document.fail(path,
                  fmt::format("names \"{}\", which is no species; name one of [[species]]", excerpt(*name)));
}

void list_species(Keys& all) {
    species_table().list(all, "species[]");
}

void read_species(Document& document, Scene& scene, TableReader* further) {
    const std::size_t count = document.size("species");
    if (count == 0)
        throw UserError(document.place("species") +
                        ": there are no grains; write [[species]] and below it name, count, "
                        "diameter and density");
    for (std::size_t i = 0; i < count; ++i) {
        Species species;
        species_table().read(document, scene, fmt::format("species[{}]", i), species);
        scene.species.push_back(std::move(species));
        if (further != nullptr) further->read_species(document, i);
    }
}

void write_species(SceneText& out, const Scene& scene) {
    species_table().write_elements(out, scene, "species", scene.species);
}

}  // namespace grainreel
