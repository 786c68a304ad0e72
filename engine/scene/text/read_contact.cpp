// Laws and the numbers of every kind of contact: [contact], what [contact.wall] changes of it, and what
// [[contact.pair]] changes of those.
#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "engine/base/utf8.hpp"
#include "engine/scene/keys/contact_table.hpp"
#include "engine/scene/text/reader_parts.hpp"

namespace grainreel {
namespace {

// What the tables say of one kind of contact, before defaults.
struct PairText {
    PairContact value;                        // its laws are settled, all else is in:
    std::map<std::string, PairContact> said;  // by the name of a key, a contact that has its value
};

// Combinations that have no meaning.
void check_laws(const Document& document, const PairContact& pair, const std::string& table) {
    const bool hertz = pair.normal == NormalLaw::hertz;
    const std::string key = table + (document.has(table + ".friction_law") ? ".friction_law" : ".law");
    if (pair.tangential == TangentialLaw::mindlin && !hertz)
        document.fail(key,
                      "puts mindlin with a linear normal law, but its stiffness follows from Hertz' "
                      "contact radius; write law = \"hertz\", or another friction_law");
    if (hertz && pair.tangential != TangentialLaw::mindlin && pair.tangential != TangentialLaw::none)
        document.fail(key,
                      "puts hertz with a tangential spring of constant stiffness, while its own grows "
                      "with the overlap; write friction_law = \"mindlin\" or \"none\"");
}

// Who says how the restitution is found takes back how it was said before.
void take_back_restitution(const Document& document, const std::string& table, PairText& pair) {
    const auto says = [&](const char* name) { return document.has(table + "." + name); };
    const auto refuse = [&](const char* name, const char* reason) {
        document.refuse(table + "." + name, reason);
    };
    if (says("normal_damping")) {
        refuse("restitution", "'normal_damping' is given, and the restitution follows from it");
        pair.said.erase("restitution");
    }
    if (says("restitution_table")) {
        for (const char* name : {"restitution", "restitution_speed"}) {
            refuse(name, "'restitution_table' is given");
            pair.said.erase(name);
        }
    }
    if (says("restitution"))
        for (const char* name : {"normal_damping", "restitution_table"}) pair.said.erase(name);
}

// Another normal law comes with the friction law that suits it, unless there is to be none.
void settle_laws(const Document& document, const std::string& table, PairText& pair) {
    const bool none = pair.said.contains("friction_law") && pair.value.tangential == TangentialLaw::none;
    if (document.has(table + ".law") && !none) pair.said.erase("friction_law");
}

// Read first: what the other keys mean follows from them.
bool is_law(const keys::BoundKey<PairContact>& bound) {
    return bound.turn < 0;
}

// Adds what a table says.
void read_pair(Document& document, const Scene& scene, const std::string& table, PairText& pair) {
    settle_laws(document, table, pair);
    const auto& all = contact_table().in_order_of_reading();
    const auto read = [&](const auto& bound) {
        const std::string path = table + "." + bound.key.path;
        if (!document.has(path)) return;
        bound.read(document, scene, path, pair.value);
        pair.said[bound.key.path] = pair.value;
    };
    for (const auto& bound : all)
        if (is_law(bound)) read(bound);
    if (!pair.said.contains("friction_law")) pair.value.tangential = suiting(pair.value.normal);
    check_laws(document, pair.value, table);
    for (const auto& bound : all)
        if (const char* reason = bound.useless ? bound.useless(pair.value) : nullptr)
            document.refuse(table + "." + bound.key.path, reason);
    take_back_restitution(document, table, pair);
    for (const auto& bound : all)
        if (!is_law(bound)) read(bound);
}

// Defaults filled in, and what the laws do not use left out: two contacts that act alike are then equal.
PairContact resolved(const PairText& text, const Scene& scene) {
    PairContact pair;
    pair.normal = text.value.normal;
    pair.tangential = text.value.tangential;
    const auto friction = text.said.find("friction");
    if (friction != text.said.end() && friction->second.friction == 0) pair.tangential = TangentialLaw::none;
    if (pair.tangential == TangentialLaw::none) pair.friction = 0;
    for (const auto& bound : contact_table().in_order_of_reading()) {
        if (is_law(bound) || (bound.useless && bound.useless(pair) != nullptr)) continue;
        if (bound.usual) bound.usual(pair, scene);
        const auto said = text.said.find(bound.key.path);
        if (said != text.said.end()) bound.copy(said->second, pair);
    }
    return pair;
}

// The index of a species by name; the number of species for "wall".
std::size_t partner(const Document& document, const Scene& scene, const std::string& path,
                    const std::string& name) {
    if (name == "wall") return scene.species.size();
    for (std::size_t i = 0; i < scene.species.size(); ++i)
        if (scene.species[i].name == name) return i;
    std::string known;
    for (const Species& s : scene.species) known += excerpt(s.name) + ", ";
    document.fail(
        path, fmt::format("names \"{}\", which is no species; there are {}and wall", excerpt(name), known));
}

struct ContactText {
    std::vector<PairText> grain, wall;  // as in Contact
};

void read_exception(Document& document, const Scene& scene, const std::string& table, ContactText& contact) {
    const std::string key = table + ".between";
    const auto names = document.names(key);
    if (!names) document.fail_missing(key);
    const std::size_t count = scene.species.size();
    const std::size_t a = partner(document, scene, key, (*names)[0]);
    const std::size_t b = partner(document, scene, key, (*names)[1]);
    if (a == count && b == count) document.fail(key, "names two walls; at least one must be a species");
    if (a == count || b == count) return read_pair(document, scene, table, contact.wall[std::min(a, b)]);
    read_pair(document, scene, table, contact.grain[a * count + b]);
    contact.grain[b * count + a] = contact.grain[a * count + b];
}

}  // namespace

void read_contact(Document& document, Scene& scene) {
    PairText grain;
    read_pair(document, scene, "contact", grain);
    PairText wall = grain;
    read_pair(document, scene, "contact.wall", wall);
    const std::size_t count = scene.species.size();
    ContactText text{std::vector(count * count, grain), std::vector(count, wall)};
    for (std::size_t i = 0; i < document.size("contact.pair"); ++i)
        read_exception(document, scene, fmt::format("contact.pair[{}]", i), text);

    Contact& contact = scene.contact;
    for (const PairText& pair : text.grain) contact.grain.push_back(resolved(pair, scene));
    for (const PairText& pair : text.wall) contact.wall.push_back(resolved(pair, scene));
    if (grain.value.tangential == TangentialLaw::none && !contact.rubs())
        document.refuse("contact.arms", "'friction_law' is \"none\"");
    const auto arms =
        chosen<LeverArms>(document, "contact.arms",
                          {{"contact-plane", LeverArms::contact_plane}, {"radius", LeverArms::radius}},
                          LeverArms::contact_plane);
    contact.arms = contact.rubs() ? arms : LeverArms::contact_plane;
}

}  // namespace grainreel
