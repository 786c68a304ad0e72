#include "engine/play/knobs.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <optional>

#include "engine/base/error.hpp"
#include "engine/base/mathematics.hpp"

namespace grainreel {

namespace {

struct Way {
    Knob knob;
    std::function<double(const Scene&)> get;
    std::function<void(Scene&, double)> set;
    bool usual = false;
};

double acceleration_of(const Drive& drive) {
    const double omega = 2 * std::numbers::pi * drive.frequency;
    return drive.amplitude * omega * omega;
}

// The drive with another frequency shakes as hard as before: its acceleration stays.
void set_frequency(Scene& scene, double frequency) {
    const double before = acceleration_of(scene.drive), omega = 2 * std::numbers::pi * frequency;
    scene.drive.frequency = frequency;
    scene.drive.amplitude = before / (omega * omega);
}

void set_g_level(Scene& scene, double level) {
    const double omega = 2 * std::numbers::pi * scene.drive.frequency;
    scene.drive.amplitude = level * scene.gravity.norm() / (omega * omega);
}

// Another gravity keeps its direction, and the drive its motion in metres.
void set_gravity(Scene& scene, double size) {
    const double before = scene.gravity.norm();
    scene.gravity = before > 0 ? Vec3(scene.gravity * (size / before)) : Vec3(0, 0, -size);
}

std::vector<Way> ways_of_drive(const Scene& scene) {
    if (!scene.drive.present) return {};
    std::vector<Way> ways;
    const double f = scene.drive.frequency, gravity = scene.gravity.norm();
    ways.push_back({{"drive.frequency", Dimension::frequency, f / 3, 3 * f},
                    [](const Scene& s) { return s.drive.frequency; },
                    set_frequency,
                    true});
    if (gravity > 0) {
        const double most = std::max(8.0, 2 * scene.drive.g_level(gravity));
        ways.push_back({{"drive.g_level", Dimension::number, 0.1, most},
                        [](const Scene& s) { return s.drive.g_level(s.gravity.norm()); },
                        set_g_level,
                        true});
    }
    return ways;
}

using Member = double PairContact::*;

Way way_of_pairs(const std::string& key, std::vector<PairContact> SceneContacts::*list, Member member,
                 double low, double high, bool usual) {
    return {{key, Dimension::number, low, high},
            [list, member](const Scene& s) { return (s.contact.*list).front().*member; },
            [list, member](Scene& s, double value) {
                for (PairContact& pair : s.contact.*list) pair.*member = value;
            },
            usual};
}

// Kinds of contact that differ in a value have no knob for it: one position could not stand for all of them.
bool alike(const std::vector<PairContact>& pairs, Member member) {
    return !pairs.empty() && std::all_of(pairs.begin(), pairs.end(), [&](const PairContact& pair) {
        return pair.*member == pairs.front().*member && std::isfinite(pair.*member);
    });
}

bool has_one_restitution(const std::vector<PairContact>& pairs) {
    return alike(pairs, &PairContact::restitution) &&
           std::all_of(pairs.begin(), pairs.end(), [](const PairContact& p) {
               return !p.restitution_speed && p.restitution_table.empty() && !p.normal_damping;
           });
}

std::vector<Way> ways_of_contacts(const Scene& scene) {
    std::vector<Way> ways;
    const auto& grain = scene.contact.grain;
    const auto& wall = scene.contact.wall;
    const auto rubs = [](const std::vector<PairContact>& pairs) {
        return alike(pairs, &PairContact::friction) && pairs.front().tangential != TangentialLaw::none;
    };
    constexpr double most_friction = 1.5;
    if (rubs(grain))
        ways.push_back(way_of_pairs("contact.friction", &SceneContacts::grain, &PairContact::friction, 0,
                                    most_friction, true));
    if (rubs(wall))
        ways.push_back(way_of_pairs("contact.wall.friction", &SceneContacts::wall, &PairContact::friction, 0,
                                    most_friction, true));
    if (has_one_restitution(grain))
        ways.push_back(way_of_pairs("contact.restitution", &SceneContacts::grain, &PairContact::restitution,
                                    0.2, 0.98, true));
    if (has_one_restitution(wall))
        ways.push_back(way_of_pairs("contact.wall.restitution", &SceneContacts::wall,
                                    &PairContact::restitution, 0.2, 0.98, false));
    return ways;
}

void scale_diameter(SizeSpread& size, double mean) {
    const double factor =
        mean / (size.kind == SizeSpread::Kind::normal ? size.mean : (size.smallest + size.largest) / 2);
    for (double* one : {&size.smallest, &size.largest, &size.mean, &size.deviation}) *one *= factor;
}

double mean_diameter(const SizeSpread& size) {
    return size.kind == SizeSpread::Kind::normal ? size.mean : (size.smallest + size.largest) / 2;
}

std::vector<Way> ways_of_species(const Scene& scene) {
    std::vector<Way> ways;
    if (!scene.start.packs()) return ways;
    for (std::size_t k = 0; k < scene.species.size(); ++k) {
        const Species& species = scene.species[k];
        if (species.count == 0 || species.fed > 0) continue;
        const auto count = static_cast<double>(species.count);
        const double mean = mean_diameter(species.diameter);
        Way number{{fmt::format("species.{}.count", species.name), Dimension::number, 1, 2 * count + 8},
                   [k](const Scene& s) { return static_cast<double>(s.species[k].count); },
                   [k](Scene& s, double value) { s.species[k].count = std::llround(value); },
                   true};
        number.knob.whole = number.knob.packs_anew = true;
        Way size{
            {fmt::format("species.{}.diameter", species.name), Dimension::length, 0.6 * mean, 1.5 * mean},
            [k](const Scene& s) { return mean_diameter(s.species[k].diameter); },
            [k](Scene& s, double value) { scale_diameter(s.species[k].diameter, value); },
            true};
        size.knob.packs_anew = true;
        ways.push_back(std::move(number));
        ways.push_back(std::move(size));
    }
    Way seed{{"run.seed", Dimension::number, 1, 9999},
             [](const Scene& s) { return static_cast<double>(s.run.seed); },
             [](Scene& s, double value) { s.run.seed = static_cast<std::uint64_t>(std::llround(value)); },
             true};
    seed.knob.whole = seed.knob.packs_anew = true;
    ways.push_back(std::move(seed));
    return ways;
}

std::vector<Way> ways_of(const Scene& scene) {
    std::vector<Way> ways = ways_of_drive(scene);
    for (Way& way : ways_of_contacts(scene)) ways.push_back(std::move(way));
    constexpr double most_gravity = 25;  // m/s2, Jupiter's
    ways.push_back({{"gravity", Dimension::acceleration, 0.5, most_gravity},
                    [](const Scene& s) { return s.gravity.norm(); },
                    set_gravity,
                    scene.gravity.norm() > 0});
    for (Way& way : ways_of_species(scene)) ways.push_back(std::move(way));
    return ways;
}

Way way_named(const Scene& scene, std::string_view key) {
    for (Way& way : ways_of(scene))
        if (way.knob.key == key) return std::move(way);
    throw UserError(fmt::format("'{}' is no knob of this scene", key));
}

// A range that holds the present value.
Knob around(const Way& way, const Scene& scene) {
    Knob knob = way.knob;
    const double now = way.get(scene);
    knob.low = std::min(knob.low, now);
    knob.high = std::max(knob.high, now);
    return knob;
}

void check_holds(const Scene& scene, const Knob& knob, std::size_t number) {
    const double now = knob_value(scene, knob.key);
    if (now >= knob.low * (1 - 1e-9) && now <= knob.high * (1 + 1e-9)) return;
    throw UserError(
        fmt::format("{}: the range of '{}' goes from {:.6g} to {:.6g}, and the scene has {:.6g}; widen it",
                    scene.where(fmt::format("knob[{}].range", number)), knob.key, knob.low, knob.high, now));
}

}  // namespace

std::vector<Knob> possible_knobs(const Scene& scene) {
    std::vector<Knob> knobs;
    for (const Way& way : ways_of(scene)) knobs.push_back(around(way, scene));
    return knobs;
}

std::vector<Knob> knobs_of(const Scene& scene) {
    std::vector<Knob> knobs;
    if (scene.knobs.empty()) {
        for (const Way& way : ways_of(scene))
            if (way.usual) knobs.push_back(around(way, scene));
        return knobs;
    }
    const std::vector<Knob> possible = possible_knobs(scene);
    for (std::size_t k = 0; k < scene.knobs.size(); ++k) {
        const SceneKnob& wanted = scene.knobs[k];
        const auto found = std::find_if(possible.begin(), possible.end(),
                                        [&](const Knob& one) { return one.key == wanted.key; });
        if (found == possible.end()) {
            std::vector<std::string> names;
            for (const Knob& one : possible) names.push_back(one.key);
            throw UserError(fmt::format("{}: '{}' cannot be turned in this scene; these can: {}",
                                        scene.where(fmt::format("knob[{}].key", k)), wanted.key,
                                        fmt::join(names, ", ")));
        }
        Knob knob = *found;
        if (wanted.range) knob.low = (*wanted.range)[0], knob.high = (*wanted.range)[1];
        knob.label = wanted.label;
        check_holds(scene, knob, k);
        knobs.push_back(std::move(knob));
    }
    return knobs;
}

double knob_value(const Scene& scene, std::string_view key) {
    return way_named(scene, key).get(scene);
}

void turn_knob(Scene& scene, std::string_view key, double value) {
    way_named(scene, key).set(scene, value);
}

}  // namespace grainreel
