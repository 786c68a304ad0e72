#include "engine/scene/keys/keys.hpp"

#include "engine/scene/film/film_keys.hpp"
#include "engine/scene/keys/contact_table.hpp"
#include "engine/scene/keys/key_parts.hpp"
#include "engine/scene/text/chapters.hpp"

namespace grainreel {
namespace {

using namespace keys;

void add_species(Keys& keys) {
    keys.push_back(
        entry("title", KeyKind::text, note("the file's name"), "Shown on the film unless it has its own."));
    keys.push_back(of_dimension(entry("gravity", KeyKind::gravity, literal("9.81"),
                                      "Downwards along -z; or a vector [x, y, z]; 0 for none."),
                                Dimension::acceleration, not_negative));
    keys.push_back(
        entry("species[].name", KeyKind::text, required(), "For the legend and for [[contact.pair]]."));
    keys.push_back(
        integer("species[].count", 1, most_grains, note("required, but for [[grain]]"), "How many grains."));
    keys.push_back(of_dimension(entry("species[].diameter", KeyKind::diameter, required(),
                                      "One length, or a spread: { min, max } or { mean, deviation }."),
                                Dimension::length, positive));
    keys.push_back(quantity("species[].diameter.min", Dimension::length, positive, note("none"),
                            "Smallest of evenly spread diameters."));
    keys.push_back(
        quantity("species[].diameter.max", Dimension::length, positive, note("none"), "Largest of them."));
    keys.push_back(quantity("species[].diameter.mean", Dimension::length, positive, note("none"),
                            "Mean of normally spread diameters."));
    keys.push_back(quantity("species[].diameter.deviation", Dimension::length, positive, note("none"),
                            "Their standard deviation; cut off at two of them."));
    keys.push_back(quantity("species[].density", Dimension::density, positive, note("required, or `mass`"),
                            "Of the solid."));
    keys.push_back(quantity("species[].mass", Dimension::mass, positive, note("none"),
                            "Of a grain of mean diameter, instead of the density."));
    keys.push_back(entry("species[].colour", KeyKind::colour, note("the next Okabe-Ito colour that is free"),
                         "\"#rrggbb\" or a name: black, white, grey, orange, sky-blue, green, yellow, blue, "
                         "vermilion, purple."));
}

void add_contact(Keys& keys) {
    keys.push_back(choice("contact.arms", {"contact-plane", "radius"}, literal("\"contact-plane\""),
                          "Lever arms of the tangential force; radius loses angular momentum."));
    contact_table().list(keys, "contact");
    contact_table().list(keys, "contact.wall", "as in [contact]");
    keys.push_back(entry("contact.pair[].between", KeyKind::species_pair, required(),
                         "Two names of species, or one and \"wall\"."));
    contact_table().list(keys, "contact.pair[]", "as in [contact] or [contact.wall]");
}

void add_container(Keys& keys) {
    keys.push_back(choice(
        "container.shape", {"wedge", "box", "cylinder", "none"}, required(),
        "none: empty space. The origin is the middle of the floor; x along the depth, y across, z up."));
    keys.push_back(
        quantity("container.height", Dimension::length, positive, required(), "Floor to lid or rim."));
    keys.push_back(quantity("container.depth", Dimension::length, positive, note("required; wedge, box"),
                            "Front to back, along x."));
    keys.push_back(quantity("container.half_width", Dimension::length, positive, note("required; wedge"),
                            "At and above the slanted part, from the middle to the wall."));
    keys.push_back(quantity("container.half_angle", Dimension::angle, positive, note("required; wedge"),
                            "Between slanted wall and the vertical."));
    keys.push_back(quantity("container.slant_height", Dimension::length, positive, note("required; wedge"),
                            "Height of the slanted part."));
    keys.push_back(
        quantity("container.width", Dimension::length, positive, note("required; box"), "Along y."));
    keys.push_back(
        quantity("container.diameter", Dimension::length, positive, note("required; cylinder"), "Inside."));
    keys.push_back(choice("container.top", {"lid", "open"}, literal("\"lid\""), "Sealed, or open above."));
    keys.push_back(entry("container.outlet", KeyKind::text, literal("\"closed\""),
                         "Only \"closed\": open outlets are not modelled yet."));
    keys.push_back(entry("container.periodic_depth", KeyKind::flag, literal("false"),
                         "No front and back walls: what leaves at one enters at the other."));
}

void add_exact(Keys& keys) {
    const auto vector = [&](const char* path, Dimension dimension, Fallback fallback, const char* about) {
        keys.push_back(
            of_dimension(entry(path, KeyKind::vector, std::move(fallback), about), dimension, any));
    };
    keys.push_back(entry("wall[].name", KeyKind::text, note("wall 1, wall 2, ..."),
                         "A plane anywhere, beside the container's faces or without any; for messages."));
    vector("wall[].point", Dimension::length, required(), "Any point of it.");
    vector("wall[].normal", Dimension::number, required(), "Towards the grains; any length.");
    vector("wall[].velocity", Dimension::speed, literal("[0, 0, 0]"), "Steady, from the start.");
    keys.push_back(entry("wall[].moves", KeyKind::flag, literal("false"), "Follows the drive as well."));
    keys.push_back(entry("grain[].species", KeyKind::text, note("the first"),
                         "Grains placed one by one; whose numbers it has."));
    vector("grain[].position", Dimension::length, required(), "Of the centre.");
    vector("grain[].velocity", Dimension::speed, literal("[0, 0, 0]"), "At the start.");
    vector("grain[].spin", Dimension::spin, literal("[0, 0, 0]"), "Angular velocity at the start.");
    keys.push_back(quantity("grain[].diameter", Dimension::length, positive, note("the species' mean"),
                            "Inside the species' spread."));
}

}  // namespace

const std::vector<Key>& scene_keys() {
    static const Keys keys = [] {
        Keys all;
        add_species(all);
        add_contact(all);
        add_container(all);
        add_exact(all);
        list_drive(all);
        list_start(all);
        list_run(all);
        list_film(all);
        return all;
    }();
    return keys;
}

}  // namespace grainreel
