// Laws and the numbers of every kind of contact: [contact], what [contact.wall] changes of it, and what
// [[contact.pair]] changes of those.
#include <fmt/format.h>

#include <algorithm>

#include "engine/scene/reader_parts.hpp"

namespace grainreel {
namespace {

constexpr double spring_ratio = 2.0 / 7;  // of linear-spring: equal periods in both directions for a sphere

// Keys that the laws in force do not look at, in one table.
void refuse_unused(Document& document, const Contact& contact, const std::string& table) {
    const auto refuse = [&](std::initializer_list<const char*> names, const char* reason) {
        for (const char* name : names) document.refuse(table + "." + name, reason);
    };
    if (contact.normal == NormalLaw::walton_braun)
        refuse({"normal_damping", "tangential_damping"}, "the law walton-braun has no damping");
    if (contact.tangential == TangentialLaw::none)
        refuse({"friction", "tangential_ratio", "gamma", "tangential_damping"}, "'friction_law' is \"none\"");
    if (contact.tangential == TangentialLaw::linear_spring) refuse({"gamma"}, "only incremental-slip has it");
    if (contact.tangential == TangentialLaw::incremental_slip)
        refuse({"tangential_damping"}, "incremental-slip has no damping");
    if (contact.normal == NormalLaw::spring_dashpot)
        refuse({"restitution_speed"}, "only the law walton-braun has it");
    if (document.has(table + ".normal_damping"))
        refuse({"restitution"}, "'normal_damping' is given, and the restitution follows from it");
}

// `inherited` with what a table changes of it.
PairContact read_pair(Document& document, const Contact& contact, const std::string& table,
                      PairContact inherited) {
    refuse_unused(document, contact, table);
    PairContact pair = inherited;
    const auto read = [&](const char* name, auto& value) {
        if (const auto given = document.quantity(table + "." + name)) value = *given;
    };
    if (document.has(table + ".restitution")) pair.normal_damping.reset();
    read("restitution", pair.restitution);
    read("restitution_speed", pair.restitution_speed);
    read("friction", pair.friction);
    read("stiffness", pair.stiffness);
    read("tangential_ratio", pair.tangential_ratio);
    read("gamma", pair.gamma);
    read("normal_damping", pair.normal_damping);
    if (pair.normal_damping) pair.restitution = PairContact{}.restitution;  // not used, so not kept
    read("tangential_damping", pair.tangential_damping);
    return pair;
}

void read_laws(Document& document, Contact& contact) {
    contact.normal = chosen<NormalLaw>(
        document, "contact.law",
        {{"walton-braun", NormalLaw::walton_braun}, {"spring-dashpot", NormalLaw::spring_dashpot}},
        NormalLaw::walton_braun);
    contact.tangential =
        chosen<TangentialLaw>(document, "contact.friction_law",
                              {{"incremental-slip", TangentialLaw::incremental_slip},
                               {"linear-spring", TangentialLaw::linear_spring},
                               {"none", TangentialLaw::none}},
                              contact.normal == NormalLaw::walton_braun ? TangentialLaw::incremental_slip
                                                                        : TangentialLaw::linear_spring);
    if (contact.tangential == TangentialLaw::none)
        document.refuse("contact.arms", "'friction_law' is \"none\"");
    contact.arms =
        chosen<LeverArms>(document, "contact.arms",
                          {{"contact-plane", LeverArms::contact_plane}, {"radius", LeverArms::radius}},
                          LeverArms::contact_plane);
}

// The index of a species by name; the number of species for "wall".
std::size_t partner(const Document& document, const Scene& scene, const std::string& path,
                    const std::string& name) {
    if (name == "wall") return scene.species.size();
    for (std::size_t i = 0; i < scene.species.size(); ++i)
        if (scene.species[i].name == name) return i;
    std::string known;
    for (const Species& s : scene.species) known += s.name + ", ";
    document.fail(path, fmt::format("names \"{}\", which is no species; there are {}and wall", name, known));
}

void read_exception(Document& document, Scene& scene, const std::string& table) {
    Contact& contact = scene.contact;
    const std::string key = table + ".between";
    const auto names = document.names(key);
    if (!names) document.fail_missing(key);
    const std::size_t count = scene.species.size();
    const std::size_t a = partner(document, scene, key, (*names)[0]);
    const std::size_t b = partner(document, scene, key, (*names)[1]);
    if (a == count && b == count) document.fail(key, "names two walls; at least one must be a species");
    if (a == count || b == count) {
        PairContact& wall = contact.wall[std::min(a, b)];
        wall = read_pair(document, contact, table, wall);
        return;
    }
    PairContact& pair = contact.grain[a * count + b];
    pair = read_pair(document, contact, table, pair);
    contact.grain[b * count + a] = pair;
}

// Without any friction there is no tangential law, nor a number for it.
void leave_out_friction(Contact& contact) {
    std::vector<PairContact*> pairs;
    for (PairContact& pair : contact.grain) pairs.push_back(&pair);
    for (PairContact& pair : contact.wall) pairs.push_back(&pair);
    if (std::any_of(pairs.begin(), pairs.end(), [](const PairContact* pair) { return pair->friction > 0; }))
        return;
    contact.tangential = TangentialLaw::none;
    contact.arms = LeverArms::contact_plane;
    for (PairContact* pair : pairs) {
        pair->tangential_ratio = PairContact{}.tangential_ratio;
        pair->gamma = PairContact{}.gamma;
        pair->tangential_damping.reset();
    }
}

}  // namespace

void read_contact(Document& document, Scene& scene) {
    Contact& contact = scene.contact;
    read_laws(document, contact);
    PairContact base;
    if (contact.tangential == TangentialLaw::linear_spring) base.tangential_ratio = spring_ratio;
    if (contact.tangential == TangentialLaw::none) base.friction = 0;
    const PairContact grain = read_pair(document, contact, "contact", base);
    const PairContact wall = read_pair(document, contact, "contact.wall", grain);
    const std::size_t count = scene.species.size();
    contact.grain.assign(count * count, grain);
    contact.wall.assign(count, wall);
    for (std::size_t i = 0; i < document.size("contact.pair"); ++i)
        read_exception(document, scene, fmt::format("contact.pair[{}]", i));

    leave_out_friction(contact);
}

}  // namespace grainreel
