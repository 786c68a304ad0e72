#include "engine/scene/text/writer.hpp"

#include <fmt/format.h>

#include "engine/scene/film/colours.hpp"
#include "engine/scene/film/film_keys.hpp"
#include "engine/scene/keys/contact_table.hpp"
#include "engine/scene/text/chapters.hpp"

namespace grainreel {
namespace {

void write_species(SceneText& out, const Species& species, bool listed) {
    out.element("species");
    out.put("name", quoted(species.name));
    if (!listed) out.put("count", as_toml(species.count));
    const SizeSpread& d = species.diameter;
    switch (d.kind) {
        case SizeSpread::Kind::fixed:
            out.put("diameter", as_toml(d.mean));
            break;
        case SizeSpread::Kind::uniform:
            out.put("diameter",
                    fmt::format("{{ min = {}, max = {} }}", toml_number(d.smallest), toml_number(d.largest)));
            break;
        case SizeSpread::Kind::normal:
            out.put("diameter", fmt::format("{{ mean = {}, deviation = {} }}", toml_number(d.mean),
                                            toml_number(d.deviation)));
            break;
    }
    out.put("density", as_toml(species.density));
    out.put("colour", quoted(colour_text(species.colour)));
}

void write_pair(SceneText& out, const Scene& scene, const PairContact& pair, const PairPlan& plan,
                const std::string& other, const Species& species) {
    out.element("contact.pair");
    out.put("between", fmt::format("[{}, {}]", quoted(species.name), quoted(other)));
    PairContact chosen = pair;
    const bool hertz = pair.normal == NormalLaw::hertz;
    chosen.stiffness = hertz ? plan.modulus : plan.loading_stiffness;
    if (!pair.stiffness)
        out.remark(hertz ? "modulus" : "stiffness", fmt::format("chosen for: {}", plan.stiffness_reason));
    contact_table().write(out, scene, chosen);
}

void write_contact(SceneText& out, const Scene& scene, const Plan& plan) {
    const Contact& contact = scene.contact;
    out.table("contact");
    if (contact.rubs())
        out.put("arms", quoted(contact.arms == LeverArms::contact_plane ? "contact-plane" : "radius"));
    const std::size_t count = scene.species.size();
    for (std::size_t a = 0; a < count; ++a) {
        for (std::size_t b = a; b < count; ++b)
            write_pair(out, scene, scene.between(a, b), plan.between(a, b), scene.species[b].name,
                       scene.species[a]);
        write_pair(out, scene, contact.wall[a], plan.wall[a], "wall", scene.species[a]);
    }
}

void write_container(SceneText& out, const Container& container) {
    out.table("container");
    switch (container.shape) {
        case Container::Shape::wedge:
            out.put("shape", quoted("wedge"));
            out.put("half_angle", as_toml(container.half_angle));
            out.put("slant_height", as_toml(container.slant_height));
            out.put("half_width", as_toml(container.half_width));
            break;
        case Container::Shape::box:
            out.put("shape", quoted("box"));
            out.put("width", as_toml(2 * container.half_width));
            break;
        case Container::Shape::cylinder:
            out.put("shape", quoted("cylinder"));
            out.put("diameter", as_toml(2 * container.half_width));
            break;
        case Container::Shape::none:
            out.put("shape", quoted("none"));
            return;
    }
    if (container.shape != Container::Shape::cylinder) {
        out.put("depth", as_toml(container.depth));
        out.put("periodic_depth", as_toml(container.periodic_depth));
    }
    out.put("height", as_toml(container.height));
    out.put("top", quoted(container.lid ? "lid" : "open"));
    out.put("outlet", quoted("closed"));
}

void write_exact(SceneText& out, const Scene& scene) {
    for (const FreeWall& wall : scene.walls) {
        out.element("wall");
        out.put("name", quoted(wall.name));
        out.put("point", as_toml(wall.point));
        out.put("normal", as_toml(wall.normal));
        out.put("velocity", as_toml(wall.velocity));
        out.put("moves", as_toml(wall.moves));
    }
    for (const ListedGrain& grain : scene.start.grains) {
        out.element("grain");
        out.put("species", quoted(scene.species[grain.species].name));
        out.put("diameter", as_toml(grain.diameter));
        out.put("position", as_toml(grain.position));
        out.put("velocity", as_toml(grain.velocity));
        out.put("spin", as_toml(grain.spin));
    }
}

}  // namespace

std::string resolved_scene(const Scene& scene, const Plan& plan) {
    SceneText out;
    out.comment("Every value as it was used, in SI units; phases in turns, the camera in degrees.");
    out.put("title", quoted(scene.title));
    out.put("gravity", as_toml(scene.gravity));
    for (const Species& species : scene.species) write_species(out, species, !scene.start.grains.empty());
    write_contact(out, scene, plan);
    write_container(out, scene.container);
    write_exact(out, scene);
    write_drive(out, scene);
    write_start(out, scene);
    write_run(out, scene, plan);
    write_film(out, scene);
    return out.take();
}

}  // namespace grainreel
