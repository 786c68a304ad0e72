// Laws and the numbers of every kind of contact: [contact], what [contact.wall] changes of it, and what
// [[contact.pair]] changes of those.
#include <fmt/format.h>

#include <algorithm>

#include "engine/base/utf8.hpp"
#include "engine/scene/text/reader_parts.hpp"
#include "engine/scene/text/words.hpp"

namespace grainreel {
namespace {

constexpr double spring_ratio = 2.0 / 7;  // of linear-spring: equal periods in both directions for a sphere
constexpr double mindlin_ratio = 2 * (1 - 0.3) / (2 - 0.3);  // of Mindlin, at Poisson's ratio 0.3

// What the tables say of one kind of contact, before defaults.
struct PairText {
    std::optional<NormalLaw> normal;
    std::optional<TangentialLaw> tangential;
    std::optional<double> restitution, restitution_speed, friction, rolling_friction, stiffness, modulus,
        tangential_ratio, gamma, normal_damping, tangential_damping;
    std::optional<bool> attraction;
    std::vector<RestitutionPoint> restitution_table;

    NormalLaw normal_law() const { return normal.value_or(NormalLaw::walton_braun); }
    // Each normal law has a tangential one that suits it.
    TangentialLaw tangential_law() const {
        if (tangential) return *tangential;
        switch (normal_law()) {
            case NormalLaw::walton_braun:
                return TangentialLaw::incremental_slip;
            case NormalLaw::spring_dashpot:
                return TangentialLaw::linear_spring;
            case NormalLaw::hertz:
                return TangentialLaw::mindlin;
        }
        return TangentialLaw::none;
    }
};

// Keys that the laws in force do not look at, in one table.
void refuse_unused(const Document& document, const PairText& pair, const std::string& table) {
    const auto refuse = [&](std::initializer_list<const char*> names, const char* reason) {
        for (const char* name : names) document.refuse(table + "." + name, reason);
    };
    const NormalLaw normal = pair.normal_law();
    const TangentialLaw tangential = pair.tangential_law();
    if (normal == NormalLaw::walton_braun)
        refuse({"normal_damping", "tangential_damping", "attraction"}, "the law walton-braun has no damping");
    if (normal == NormalLaw::hertz) {
        refuse({"normal_damping", "tangential_damping"}, "the damping of hertz follows from the restitution");
        refuse({"stiffness"}, "hertz has a 'modulus'");
    } else {
        refuse({"modulus"}, "only the law hertz has it");
    }
    if (tangential == TangentialLaw::none)
        refuse({"friction", "tangential_ratio", "gamma", "tangential_damping", "rolling_friction"},
               "'friction_law' is \"none\"");
    if (tangential == TangentialLaw::linear_spring) refuse({"gamma"}, "only incremental-slip has it");
    if (tangential == TangentialLaw::mindlin) refuse({"gamma"}, "only incremental-slip has it");
    if (tangential == TangentialLaw::incremental_slip)
        refuse({"tangential_damping"}, "incremental-slip has no damping");
    if (normal != NormalLaw::walton_braun)
        refuse({"restitution_speed", "restitution_table"}, "only the law walton-braun has it");
    if (document.has(table + ".normal_damping"))
        refuse({"restitution"}, "'normal_damping' is given, and the restitution follows from it");
    if (document.has(table + ".restitution_table"))
        refuse({"restitution", "restitution_speed"}, "'restitution_table' is given");
}

// Combinations that have no meaning.
void check_laws(const Document& document, const PairText& pair, const std::string& table) {
    const bool hertz = pair.normal_law() == NormalLaw::hertz;
    const TangentialLaw tangential = pair.tangential_law();
    const std::string key = table + (document.has(table + ".friction_law") ? ".friction_law" : ".law");
    if (tangential == TangentialLaw::mindlin && !hertz)
        document.fail(key,
                      "puts mindlin with a linear normal law, but its stiffness follows from Hertz' "
                      "contact radius; write law = \"hertz\", or another friction_law");
    if (hertz && tangential != TangentialLaw::mindlin && tangential != TangentialLaw::none)
        document.fail(key,
                      "puts hertz with a tangential spring of constant stiffness, while its own grows "
                      "with the overlap; write friction_law = \"mindlin\" or \"none\"");
}

std::vector<RestitutionPoint> read_restitution_table(Document& document, const std::string& path) {
    std::vector<RestitutionPoint> points;
    for (const auto& [speed, restitution] : document.speed_table(path)) {
        if (restitution <= 0 || restitution > 1)
            document.fail(
                path,
                fmt::format("has a restitution of {:.6g}; it must be larger than 0, at most 1", restitution));
        if (speed < 0 || (!points.empty() && speed <= points.back().speed))
            document.fail(path, "must have rising speeds, none below 0; sort its rows");
        points.push_back({speed, restitution});
    }
    return points;
}

// Adds what a table says. Who says how the restitution is found takes back how it was said before.
void read_pair(Document& document, const std::string& table, PairText& pair) {
    const auto at = [&](const char* name) { return table + "." + name; };
    const auto read = [&](const char* name, auto& value) {
        if (const auto given = document.quantity(at(name))) value = *given;
    };
    if (document.has(at("law"))) {
        // Another normal law comes with the friction law that suits it, unless there is to be none.
        if (pair.tangential != TangentialLaw::none) pair.tangential.reset();
        pair.normal = chosen<NormalLaw>(document, at("law"), normal_law_words, NormalLaw::walton_braun);
    }
    if (document.has(at("friction_law")))
        pair.tangential =
            chosen<TangentialLaw>(document, at("friction_law"), tangential_law_words, TangentialLaw::none);
    check_laws(document, pair, table);
    refuse_unused(document, pair, table);

    if (document.has(at("restitution"))) pair.normal_damping.reset(), pair.restitution_table.clear();
    if (document.has(at("normal_damping"))) pair.restitution.reset();
    read("restitution", pair.restitution);
    read("restitution_speed", pair.restitution_speed);
    if (document.has(at("restitution_table"))) {
        pair.restitution_table = read_restitution_table(document, at("restitution_table"));
        pair.restitution.reset(), pair.restitution_speed.reset();
    }
    read("friction", pair.friction);
    read("rolling_friction", pair.rolling_friction);
    read("stiffness", pair.stiffness);
    read("modulus", pair.modulus);
    read("tangential_ratio", pair.tangential_ratio);
    read("gamma", pair.gamma);
    read("normal_damping", pair.normal_damping);
    read("tangential_damping", pair.tangential_damping);
    if (const auto attraction = document.flag(at("attraction"))) pair.attraction = *attraction;
}

// Defaults filled in, and what the laws do not use left out: two contacts that act alike are then equal.
PairContact resolved(const PairText& text) {
    const PairContact defaults;
    PairContact pair;
    pair.normal = text.normal_law();
    pair.tangential = text.tangential_law();
    pair.friction = text.friction.value_or(defaults.friction);
    if (pair.friction == 0) pair.tangential = TangentialLaw::none;
    const bool walton_braun = pair.normal == NormalLaw::walton_braun;
    const bool dashpot = pair.normal == NormalLaw::spring_dashpot;
    pair.restitution = text.restitution.value_or(defaults.restitution);
    if (walton_braun) pair.restitution_speed = text.restitution_speed;
    if (walton_braun) pair.restitution_table = text.restitution_table;
    pair.stiffness = pair.normal == NormalLaw::hertz ? text.modulus : text.stiffness;
    if (dashpot) pair.normal_damping = text.normal_damping;
    if (!walton_braun) pair.attraction = text.attraction.value_or(defaults.attraction);
    if (pair.tangential == TangentialLaw::none) {
        pair.friction = 0;
        return pair;
    }
    pair.rolling_friction = text.rolling_friction.value_or(defaults.rolling_friction);
    const double ratio = pair.tangential == TangentialLaw::linear_spring ? spring_ratio
                         : pair.tangential == TangentialLaw::mindlin     ? mindlin_ratio
                                                                         : defaults.tangential_ratio;
    pair.tangential_ratio = text.tangential_ratio.value_or(ratio);
    if (pair.tangential == TangentialLaw::incremental_slip) pair.gamma = text.gamma.value_or(defaults.gamma);
    if (dashpot && pair.tangential == TangentialLaw::linear_spring)
        pair.tangential_damping = text.tangential_damping;
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
    if (a == count || b == count) return read_pair(document, table, contact.wall[std::min(a, b)]);
    read_pair(document, table, contact.grain[a * count + b]);
    contact.grain[b * count + a] = contact.grain[a * count + b];
}

}  // namespace

void read_contact(Document& document, Scene& scene) {
    PairText grain;
    read_pair(document, "contact", grain);
    PairText wall = grain;
    read_pair(document, "contact.wall", wall);
    const std::size_t count = scene.species.size();
    ContactText text{std::vector(count * count, grain), std::vector(count, wall)};
    for (std::size_t i = 0; i < document.size("contact.pair"); ++i)
        read_exception(document, scene, fmt::format("contact.pair[{}]", i), text);

    Contact& contact = scene.contact;
    for (const PairText& pair : text.grain) contact.grain.push_back(resolved(pair));
    for (const PairText& pair : text.wall) contact.wall.push_back(resolved(pair));
    if (grain.tangential_law() == TangentialLaw::none && !contact.rubs())
        document.refuse("contact.arms", "'friction_law' is \"none\"");
    const auto arms =
        chosen<LeverArms>(document, "contact.arms",
                          {{"contact-plane", LeverArms::contact_plane}, {"radius", LeverArms::radius}},
                          LeverArms::contact_plane);
    contact.arms = contact.rubs() ? arms : LeverArms::contact_plane;
}

}  // namespace grainreel
