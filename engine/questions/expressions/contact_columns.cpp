// Columns about contacts: what touches a grain and what that does to it.

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <algorithm>
#include <charconv>
#include <cstdint>
#include <numbers>
#include <string>

#include "engine/base/error.hpp"
#include "engine/base/mathematics.hpp"
#include "engine/base/numbers.hpp"
#include "engine/base/text.hpp"
#include "engine/questions/expressions/grain_columns.hpp"

namespace grainreel {

namespace {

// For each of these grains the sum of value_of(touch) over its touches.
template <class See>
std::vector<double> over_touches(const Snapshot& s, const GrainList& grains, const See& value_of) {
    std::vector<double> sums(s.frame.size(), 0), values;
    for (const Link& touch : s.touches)
        for (const std::int32_t id : {touch.first, touch.second})
            if (id >= 0)
                if (const auto grain = s.place_of(id)) sums[*grain] += value_of(touch);
    for (const std::size_t i : grains) values.push_back(sums[i]);
    return values;
}

std::vector<double> contacts(const Snapshot& s, const GrainList& grains) {
    return over_touches(s, grains, [](const Link&) { return 1.0; });
}

std::vector<double> contact_force(const Snapshot& s, const GrainList& grains) {
    return over_touches(s, grains, [](const Link& touch) { return touch.force; });
}

// One side of a contact, at a moment that was brought back.
struct ContactSide {
    const DetailedContact& contact;
    bool is_first;
    Vec3 force() const { return is_first ? contact.on_first() : contact.on_second(); }
    const Vec3& torque() const { return is_first ? contact.torque_on_first : contact.torque_on_second; }
    Vec3 outwards() const { return is_first ? contact.normal : Vec3(-contact.normal); }
};

// Sums over the contacts of each grain; add(sum, grain, side) adds one.
template <class Sum, class Add>
std::vector<Sum> over_contacts(const Snapshot& s, const Sum& zero, const Add& add) {
    std::vector<Sum> sums(s.frame.size(), zero);
    for (const DetailedContact& one : s.forces->contacts)
        for (const bool is_first : {true, false}) {
            const std::int32_t id = is_first ? one.first : one.second;
            if (id < 0) continue;
            if (const auto grain = s.place_of(id)) add(sums[*grain], *grain, ContactSide{one, is_first});
        }
    return sums;
}

template <class Sum, class Value>
std::vector<double> listed(const std::vector<Sum>& sums, const GrainList& grains, const Value& value) {
    std::vector<double> values;
    for (const std::size_t i : grains) values.push_back(value(sums[i], i));
    return values;
}

std::vector<Vec3> forces(const Snapshot& s) {
    return over_contacts(s, Vec3(0, 0, 0),
                         [](Vec3& sum, std::size_t, const ContactSide& side) { sum += side.force(); });
}

template <int axis>
std::vector<double> force_along(const Snapshot& s, const GrainList& grains) {
    return listed(forces(s), grains, [](const Vec3& sum, std::size_t) { return sum[axis]; });
}

std::vector<double> force(const Snapshot& s, const GrainList& grains) {
    return listed(forces(s), grains, [](const Vec3& sum, std::size_t) { return sum.norm(); });
}

std::vector<double> torque(const Snapshot& s, const GrainList& grains) {
    const auto sums = over_contacts(
        s, Vec3(0, 0, 0), [](Vec3& sum, std::size_t, const ContactSide& side) { sum += side.torque(); });
    return listed(sums, grains, [](const Vec3& sum, std::size_t) { return sum.norm(); });
}

std::vector<double> acceleration(const Snapshot& s, const GrainList& grains) {
    return listed(std::vector<int>(s.frame.size()), grains, [&](int, std::size_t i) {
        return s.forces->acceleration.empty() ? kUnknown : s.forces->acceleration[i].norm();
    });
}

std::vector<double> sliding(const Snapshot& s, const GrainList& grains) {
    const auto sums = over_contacts(
        s, 0.0, [](double& sum, std::size_t, const ContactSide& side) { sum += side.contact.slides(); });
    return listed(sums, grains, [](double sum, std::size_t) { return sum; });
}

std::vector<double> largest_overlap(const Snapshot& s, const GrainList& grains) {
    const auto sums = over_contacts(s, 0.0, [](double& most, std::size_t, const ContactSide& side) {
        most = std::max(most, side.contact.overlap / side.contact.smaller_radius);
    });
    return listed(sums, grains, [](double most, std::size_t) { return most; });
}

std::vector<double> elastic_energy(const Snapshot& s, const GrainList& grains) {
    const auto sums = over_contacts(s, 0.0, [](double& sum, std::size_t, const ContactSide& side) {
        sum += (side.contact.second >= 0 ? 0.5 : 1) * side.contact.stored_energy;
    });
    return listed(sums, grains, [](double sum, std::size_t) { return sum; });
}

// Mean pressure in the grain, a third of the trace of its stress: sum(r f) / V over its contacts at r from
// its centre. Compression is positive.
std::vector<double> pressure(const Snapshot& s, const GrainList& grains) {
    const auto sums = over_contacts(s, 0.0, [&](double& sum, std::size_t i, const ContactSide& side) {
        const double reach = s.frame.radius[i] - 0.5 * side.contact.overlap;
        sum -= reach * side.outwards().dot(side.force());
    });
    return listed(sums, grains, [&](double sum, std::size_t i) {
        return sum / (4 * std::numbers::pi * math::cube(s.frame.radius[i]));
    });
}

}  // namespace

std::vector<GrainColumn> contact_columns() {
    using enum Dimension;
    std::vector<GrainColumn> all = {
        {.name = "contacts",
         .dimension = number,
         .about = "that carry force, walls included; 0 in flight",
         .of = contacts,
         .needs = Needs::contacts,
         .coloured_as = "coordination",
         .also = "coordination"},
        {.name = "contact_force",
         .dimension = Dimension::force,
         .about = "sum of the normal forces on it",
         .of = contact_force,
         .needs = Needs::contacts,
         .coloured_as = "contact-force"},
        {"fx", Dimension::force, "force of all contacts along the depth", force_along<0>},
        {"fy", Dimension::force, "force of all contacts across", force_along<1>},
        {"fz", Dimension::force, "force of all contacts upwards", force_along<2>},
        {"force", Dimension::force, "magnitude of that force", grainreel::force},
        {"torque", moment, "magnitude of the torque of all contacts", torque},
        {"acceleration", Dimension::acceleration, "magnitude, from its motion to the next step",
         grainreel::acceleration},
        {"pressure", Dimension::pressure,
         "a third of the trace of the stress of its contacts, over its volume", grainreel::pressure},
        {"sliding", number, "contacts whose friction is all used up", sliding},
        {"largest_overlap", number, "of its contacts, divided by the smaller radius", largest_overlap},
        {"elastic_energy", energy, "that its contacts would give back; half of it where it is shared",
         elastic_energy},
    };
    for (GrainColumn& column : all)
        if (column.needs == Needs::nothing) column.needs = Needs::forces;
    return all;
}

namespace {

// Numbers of the columns touches(...): one for any wall, then a range for species, a range for walls, and
// -2 - id for a grain.
constexpr int kAnyWall = 100'000, kFirstSpecies = kAnyWall + 1, kFirstWall = 2 * kAnyWall, kFirstId = -2;

std::string spaced(std::string name) {
    std::replace(name.begin(), name.end(), '_', ' ');
    return name;
}

// Whether `other`, the partner in a touch (grain or wall), is what the column's number means.
bool is_meant(const Snapshot& s, int number, std::int32_t other) {
    if (number <= kFirstId) return other == kFirstId - number;
    if (number == kAnyWall) return other < 0;
    if (number >= kFirstWall) return other == -1 - (number - kFirstWall);
    const auto place = other >= 0 ? s.place_of(other) : std::nullopt;
    return place && s.frame.species[*place] == number - kFirstSpecies;
}

}  // namespace

int touches_column(const Snapshot& snapshot, std::string_view who) {
    if (!snapshot.has(Needs::contacts))
        throw UserError(
            "'touches' needs contacts, and none were kept; run the scene with output.contacts = true, or "
            "name "
            "another program's files of contacts by --contacts");
    const std::string name(who);
    std::int32_t id = 0;
    const auto [end, failure] = std::from_chars(who.data(), who.data() + who.size(), id);
    if (failure == std::errc() && end == who.data() + who.size() && id >= 0) {
        if (!snapshot.place_of(id)) throw UserError("touches: no grain has the id {}", id);
        return kFirstId - id;
    }
    const auto& species = snapshot.scene.species;
    for (std::size_t k = 0; k < species.size(); ++k)
        if (species[k].name == name) return kFirstSpecies + static_cast<int>(k);
    if (name == "wall") return kAnyWall;
    const std::vector<std::string> walls = wall_names(snapshot.scene);
    for (std::size_t k = 0; k < walls.size(); ++k)
        if (spaced(walls[k]) == spaced(name)) return kFirstWall + static_cast<int>(k);
    std::vector<std::string> all{"wall"};
    for (const Species& one : species) all.push_back(one.name);
    all.insert(all.end(), walls.begin(), walls.end());
    throw UserError("touches: '{}' is no species, no wall and no id of a grain; there are {}", excerpt(name),
                    fmt::join(all, ", "));
}

bool is_touches_column(int number) {
    return number >= kAnyWall || number <= kFirstId;
}

std::vector<double> values_of_touches(const Snapshot& s, int number, const GrainList& grains) {
    std::vector<double> found(s.frame.size(), 0), values;
    const auto note = [&](std::int32_t one, std::int32_t other) {
        if (one < 0 || !is_meant(s, number, other)) return;
        if (const auto place = s.place_of(one)) found[*place] = 1;
    };
    for (const Link& touch : s.touches) {
        note(touch.first, touch.second);
        note(touch.second, touch.first);
    }
    for (const std::size_t i : grains) values.push_back(found[i]);
    return values;
}

}  // namespace grainreel
