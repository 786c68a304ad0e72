// Laws and numbers of every kind of contact: [contact], what [contact.wall] changes in it, and what
// [[contact.pair]] changes in both.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>
#include <utility>

#include "engine/base/text.hpp"
#include "engine/scene/chapters/chapters.hpp"
#include "engine/scene/chapters/container_keys.hpp"

namespace grainreel {
namespace {

using namespace keys;

const ChoiceWords<LeverArms> arms_words{{"contact-plane", LeverArms::contact_plane},
                                        {"radius", LeverArms::radius}};

// What the tables say about one kind of contact, before defaults are filled in.
struct PairText {
    PairContact value;                        // only its laws count; all other values are taken from `said`
    std::map<std::string, PairContact> said;  // for each key that was written, a contact that holds its value
};

// Refuses combinations of laws that have no meaning.
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

// A table that gives the restitution in one way (by a damping, one value, or values by speed) replaces what
// the tables before it said in another way.
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

// A table that changes the normal law also changes to the friction law that suits it, unless friction was
// turned off.
void settle_laws(const Document& document, const std::string& table, PairText& pair) {
    const bool none = pair.said.contains("friction_law") && pair.value.tangential == TangentialLaw::none;
    if (document.has(table + ".law") && !none) pair.said.erase("friction_law");
}

// Laws are read first, because they decide what the other keys mean.
bool is_law(const BoundKey<PairContact>& bound) {
    return bound.turn < 0;
}

// Adds what a table says about the contact.
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

// Fills in defaults and leaves out what the laws do not use, so that two contacts that act alike are equal.
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

// The two partners of an exception, [[contact.pair]]. A number is the index of a species; the number of
// species stands for "wall", and the numbers after it for the meshes in their order.
struct Partners {
    std::size_t one = 0, other = 0;
};

// Throws UserError where the name is neither a species nor "wall" nor a mesh.
std::size_t partner(const Document& document, const Scene& scene, const std::string& path,
                    const std::string& name) {
    if (name == "wall") return scene.species.size();
    for (std::size_t i = 0; i < scene.species.size(); ++i)
        if (scene.species[i].name == name) return i;
    for (std::size_t i = 0; i < scene.meshes.size(); ++i)
        if (scene.meshes[i].name == name) return scene.species.size() + 1 + i;
    std::string known;
    for (const Species& s : scene.species) known += excerpt(s.name) + ", ";
    for (const SceneMesh& mesh : scene.meshes) known += excerpt(mesh.name) + ", ";
    document.fail(path, fmt::format("names \"{}\", which is no species{}; there are {}and wall",
                                    excerpt(name), scene.meshes.empty() ? "" : " and no mesh", known));
}

void read_partners(Document& document, const Scene& scene, const std::string& path, Partners& partners) {
    const auto names = document.names(path);
    partners.one = partner(document, scene, path, (*names)[0]);
    partners.other = partner(document, scene, path, (*names)[1]);
    if (std::min(partners.one, partners.other) >= scene.species.size())
        document.fail(path, "names two walls; at least one must be a species");
}

std::string partners_text(const Partners& partners, const Scene& scene) {
    const std::size_t wall = scene.species.size();
    const auto name = [&](std::size_t index) {
        return quoted(index < wall    ? scene.species[index].name
                      : index == wall ? "wall"
                                      : scene.meshes[index - wall - 1].name);
    };
    return toml_list({name(partners.one), name(partners.other)});
}

const KeyTable<Partners>& partners_table() {
    static const KeyTable<Partners> table{bound_by<Partners>(
        entry("between", KeyKind::species_pair, required(),
              "Two names of species, or one and \"wall\", all walls, or one and that of a mesh."),
        read_partners, partners_text)};
    return table;
}

// The keys that all contacts have in common.
const KeyTable<SceneContacts>& common_table() {
    static const KeyTable<SceneContacts> table{
        choice("arms", &SceneContacts::arms, arms_words, initial(),
               "Lever arms of the tangential force; radius loses angular momentum.")
            .unwritten_if([](const SceneContacts& contact) { return !contact.rubs(); })};
    return table;
}

// The keys that only contacts with glued grains have.
constexpr std::array keys_of_glued = {"glued_stiffness", "glued_modulus"};

void refuse_glued(const Document& document, const std::string& table, const char* reason) {
    for (const char* name : keys_of_glued) document.refuse(table + "." + name, reason);
}

void forget_glued(PairText& pair) {
    for (const char* name : keys_of_glued) pair.said.erase(name);
}

struct ContactText {
    std::vector<PairText> grain, wall, mesh;  // as in Contact
};

bool has_glued(Document& document, const Scene& scene, const Partners& partners) {
    return is_glued(document, partners.one, scene.species[partners.one].name) ||
           is_glued(document, partners.other, scene.species[partners.other].name);
}

void read_exception(Document& document, const Scene& scene, const std::string& table,
                    const Partners& partners, ContactText& contact) {
    const auto [a, b] = partners;
    const std::size_t count = scene.species.size(), species = std::min(a, b), other = std::max(a, b);
    if (other >= count) {
        refuse_glued(document, table, "a wall itself is smooth; name the two species");
        return read_pair(
            document, scene, table,
            other == count ? contact.wall[species] : contact.mesh[(other - count - 1) * count + species]);
    }
    if (!has_glued(document, scene, partners))
        refuse_glued(document, table, "'container.wall_grains' glues grains of neither species");
    read_pair(document, scene, table, contact.grain[a * count + b]);
    contact.grain[b * count + a] = contact.grain[a * count + b];
}

// An exception for "wall" holds for meshes too, wherever it stands in the file, because exceptions for meshes
// are applied after it.
void read_exceptions(Document& document, const Scene& scene, ContactText& contact) {
    const std::size_t count = scene.species.size();
    std::vector<std::pair<std::string, Partners>> of_meshes;
    for (std::size_t i = 0; i < document.size("contact.pair"); ++i) {
        const std::string table = fmt::format("contact.pair[{}]", i);
        Partners partners;
        partners_table().read(document, scene, table, partners);
        if (std::max(partners.one, partners.other) > count)
            of_meshes.emplace_back(table, partners);
        else
            read_exception(document, scene, table, partners, contact);
    }
    for (std::size_t m = 0; m < scene.meshes.size(); ++m)
        contact.mesh.insert(contact.mesh.end(), contact.wall.begin(), contact.wall.end());
    for (const auto& [table, partners] : of_meshes) read_exception(document, scene, table, partners, contact);
}

// Puts the reason above the stiffness of that kind of contact, where there is one.
void put_reason(SceneText& out, const std::string& key, const std::vector<std::string>& reasons,
                std::size_t kind) {
    if (kind < reasons.size() && !reasons[kind].empty())
        out.remark(key, fmt::format("chosen for: {}", reasons[kind]));
}

const char* stiffness_key(const PairContact& pair) {
    return pair.normal == NormalLaw::hertz ? "modulus" : "stiffness";
}

void write_pair(SceneText& out, const Scene& scene, const PairContact& pair, const Partners& partners) {
    out.element("contact.pair");
    partners_table().write(out, scene, partners);
    contact_table().write(out, scene, pair);
}

}  // namespace

void list_contact(Keys& all) {
    common_table().list(all, "contact");
    contact_table().list(all, "contact");
    Keys of_walls;
    contact_table().list(of_walls, "contact.wall", "as in [contact]");
    std::erase_if(of_walls, [](const Key& key) { return name_of(key.path).starts_with("glued_"); });
    all.insert(all.end(), of_walls.begin(), of_walls.end());
    partners_table().list(all, "contact.pair[]");
    contact_table().list(all, "contact.pair[]", "as in [contact] or [contact.wall]");
}

void read_contact(Document& document, Scene& scene) {
    PairText grain;
    if (!document.is_table("container.wall_grains"))
        refuse_glued(document, "contact", "no grains are glued to walls");
    read_pair(document, scene, "contact", grain);
    PairText wall = grain;
    forget_glued(wall);
    read_pair(document, scene, "contact.wall", wall);
    const std::size_t count = scene.species.size();
    ContactText text{std::vector(count * count, grain), std::vector(count, wall), {}};
    read_exceptions(document, scene, text);

    for (std::size_t k = 0; k < count * count; ++k)
        if (!has_glued(document, scene, {k / count, k % count})) forget_glued(text.grain[k]);
    SceneContacts& contact = scene.contact;
    for (const PairText& pair : text.grain) contact.grain.push_back(resolved(pair, scene));
    for (const PairText& pair : text.wall) contact.wall.push_back(resolved(pair, scene));
    for (const PairText& pair : text.mesh) contact.mesh.push_back(resolved(pair, scene));
    if (grain.value.tangential == TangentialLaw::none && !contact.rubs())
        document.refuse("contact.arms", "'friction_law' is \"none\"");
    common_table().read(document, scene, "contact", contact);
    if (!contact.rubs()) contact.arms = LeverArms::contact_plane;
}

void write_contact(SceneText& out, const Scene& scene, const Reasons& reasons) {
    out.table("contact");
    common_table().write(out, scene, scene.contact);
    const std::size_t count = scene.species.size();
    for (std::size_t a = 0; a < count; ++a) {
        for (std::size_t b = a; b < count; ++b) {
            const PairContact& pair = scene.between(a, b);
            put_reason(out, stiffness_key(pair), reasons.grain, a * count + b);
            put_reason(out, fmt::format("glued_{}", stiffness_key(pair)), reasons.glued, a * count + b);
            write_pair(out, scene, pair, {a, b});
        }
        put_reason(out, stiffness_key(scene.contact.wall[a]), reasons.wall, a);
        write_pair(out, scene, scene.contact.wall[a], {a, count});
    }
    for (std::size_t k = 0; k < scene.contact.mesh.size(); ++k) {
        put_reason(out, stiffness_key(scene.contact.mesh[k]), reasons.mesh, k);
        write_pair(out, scene, scene.contact.mesh[k], {k % count, count + 1 + k / count});
    }
}

}  // namespace grainreel
