// Species and container.
#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "engine/base/error.hpp"
#include "engine/scene/film/colours.hpp"
#include "engine/scene/film/film_keys.hpp"
#include "engine/scene/text/reader_parts.hpp"

namespace grainreel {
namespace {

SizeSpread read_diameter(Document& document, const std::string& path) {
    SizeSpread spread;
    if (!document.is_table(path)) {
        spread.mean = spread.smallest = spread.largest = document.required_quantity(path);
        return spread;
    }
    if (document.has(path + ".mean") || document.has(path + ".deviation")) {
        document.refuse(path + ".min", "'mean' and 'deviation' say the spread");
        document.refuse(path + ".max", "'mean' and 'deviation' say the spread");
        spread.kind = SizeSpread::Kind::normal;
        spread.mean = document.required_quantity(path + ".mean");
        spread.deviation = document.required_quantity(path + ".deviation");
        spread.smallest = spread.mean - 2 * spread.deviation;
        spread.largest = spread.mean + 2 * spread.deviation;
        if (spread.smallest <= 0)
            document.fail(path + ".deviation",
                          "must be less than half of the mean, at which the smallest grains vanish");
        return spread;
    }
    spread.kind = SizeSpread::Kind::uniform;
    spread.smallest = document.required_quantity(path + ".min");
    spread.largest = document.required_quantity(path + ".max");
    spread.mean = 0.5 * (spread.smallest + spread.largest);
    if (spread.smallest >= spread.largest)
        document.fail(path + ".min", "must be smaller than 'max'; exchange the two");
    return spread;
}

Species read_one_species(Document& document, const std::string& path) {
    Species species;
    species.name = document.required_text(path + ".name");
    if (document.size("grain") > 0) {
        document.refuse(path + ".count", "the grains are listed one by one");
    } else {
        const auto count = document.integer(path + ".count");
        if (!count) document.fail_missing(path + ".count");
        species.count = *count;
    }
    if (!document.has(path + ".diameter")) document.fail_missing(path + ".diameter");
    species.diameter = read_diameter(document, path + ".diameter");
    if (const auto mass = document.quantity(path + ".mass")) {
        document.refuse(path + ".density", "'mass' is given");
        species.density = *mass / (std::numbers::pi / 6 * std::pow(species.diameter.mean, 3));
        if (const Range bounds = find_key(path + ".density")->bounds(); !bounds.contains(species.density))
            document.fail(path + ".mass",
                          fmt::format("makes a density of {:.4g} kg/m3, which must be {}; is its unit, or "
                                      "that of the diameter, the one you mean?",
                                      species.density, bounds.text()));
    } else {
        species.density = document.required_quantity(path + ".density");
    }
    if (const std::string key = path + ".colour"; document.has(key))
        species.colour = read_colour(document, key, "\"orange\" or \"#e69f00\"");
    return species;
}

// Species without a colour get those that the others leave.
void choose_colours(const Document& document, std::vector<Species>& species) {
    std::vector<Colour> taken;
    const auto has_own = [&](std::size_t i) { return document.has(fmt::format("species[{}].colour", i)); };
    for (std::size_t i = 0; i < species.size(); ++i)
        if (has_own(i)) taken.push_back(species[i].colour);
    for (std::size_t i = 0; i < species.size(); ++i) {
        if (has_own(i)) continue;
        species[i].colour = default_colour(taken);
        taken.push_back(species[i].colour);
    }
}

}  // namespace

void read_species(Document& document, Scene& scene) {
    const std::size_t count = document.size("species");
    if (count == 0)
        throw UserError(document.place("species") +
                        ": there are no grains; write [[species]] and below it name, count, "
                        "diameter and density");
    for (std::size_t i = 0; i < count; ++i)
        scene.species.push_back(read_one_species(document, fmt::format("species[{}]", i)));
    choose_colours(document, scene.species);
}

void read_container(Document& document, Scene& scene) {
    using Shape = Container::Shape;
    Container& container = scene.container;
    document.required_text("container.shape");
    container.shape = chosen<Shape>(
        document, "container.shape",
        {{"wedge", Shape::wedge}, {"box", Shape::box}, {"cylinder", Shape::cylinder}, {"none", Shape::none}},
        Shape::wedge);
    if (container.shape == Shape::none) {
        for (const char* key : {"half_angle", "slant_height", "half_width", "width", "diameter", "depth",
                                "height", "periodic_depth", "top", "outlet"})
            document.refuse(std::string("container.") + key, "there is no container");
        return;
    }
    if (container.shape == Shape::wedge) {
        container.half_angle = document.required_quantity("container.half_angle");
        container.slant_height = document.required_quantity("container.slant_height");
        container.half_width = document.required_quantity("container.half_width");
        document.refuse("container.width", "a wedge has a 'half_width'");
    } else {
        document.refuse("container.half_angle", "only a wedge has slanted walls");
        document.refuse("container.slant_height", "only a wedge has slanted walls");
        document.refuse("container.half_width", "only a wedge has a half-width");
    }
    if (container.shape == Shape::box)
        container.half_width = document.required_quantity("container.width") / 2;
    if (container.shape == Shape::cylinder) {
        container.half_width = document.required_quantity("container.diameter") / 2;
        for (const char* key : {"container.width", "container.depth", "container.periodic_depth"})
            document.refuse(key, "a cylinder has a 'diameter'");
    } else {
        document.refuse("container.diameter", "only a cylinder has a diameter");
        container.depth = document.required_quantity("container.depth");
        container.periodic_depth = document.flag("container.periodic_depth").value_or(false);
    }
    container.height = document.required_quantity("container.height");
    container.lid = chosen<bool>(document, "container.top", {{"lid", true}, {"open", false}}, true);
    if (const auto outlet = document.text("container.outlet"); outlet && *outlet != "closed")
        document.fail("container.outlet",
                      fmt::format("is {}, but open outlets are not modelled yet; write \"closed\"",
                                  document.written_value("container.outlet")));
}

}  // namespace grainreel
