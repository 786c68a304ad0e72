// What touches a grain and what that does to it.
#include <cmath>
#include <limits>
#include <numbers>

#include "engine/questions/grain_columns.hpp"

namespace grainreel {
namespace {

constexpr double none = std::numeric_limits<double>::quiet_NaN();

// see(grain, touch) for both grains of each touch.
template <class See>
std::vector<double> over_touches(const Snapshot& s, const GrainList& grains, const See& value_of) {
    std::vector<double> sums(s.frame.size(), 0), values;
    for (const Touch& touch : s.frame.touches)
        for (const std::int32_t id : {touch.first, touch.second})
            if (id >= 0)
                if (const auto grain = s.place_of(id)) sums[*grain] += value_of(touch);
    for (const std::size_t i : grains) values.push_back(sums[i]);
    return values;
}

std::vector<double> contacts(const Snapshot& s, const GrainList& grains) {
    return over_touches(s, grains, [](const Touch&) { return 1.0; });
}

std::vector<double> contact_force(const Snapshot& s, const GrainList& grains) {
    return over_touches(s, grains, [](const Touch& touch) { return touch.force; });
}

// One side of a contact of a moment that was brought back.
struct Side {
    const ContactForce& contact;
    bool is_first;
    Vec3 force() const { return is_first ? contact.on_first() : contact.on_second(); }
    const Vec3& torque() const { return is_first ? contact.torque_on_first : contact.torque_on_second; }
    Vec3 outwards() const { return is_first ? contact.normal : Vec3(-contact.normal); }
};

// add(sum, side) for each contact of a grain.
template <class Sum, class Add>
std::vector<Sum> over_contacts(const Snapshot& s, const Sum& zero, const Add& add) {
    std::vector<Sum> sums(s.frame.size(), zero);
    for (const ContactForce& one : s.forces->contacts)
        for (const bool is_first : {true, false}) {
            const std::int32_t id = is_first ? one.first : one.second;
            if (id < 0) continue;
            if (const auto grain = s.place_of(id)) add(sums[*grain], *grain, Side{one, is_first});
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
                         [](Vec3& sum, std::size_t, const Side& side) { sum += side.force(); });
}

template <int axis>
std::vector<double> force_along(const Snapshot& s, const GrainList& grains) {
    return listed(forces(s), grains, [](const Vec3& sum, std::size_t) { return sum[axis]; });
}

std::vector<double> force(const Snapshot& s, const GrainList& grains) {
    return listed(forces(s), grains, [](const Vec3& sum, std::size_t) { return sum.norm(); });
}

std::vector<double> torque(const Snapshot& s, const GrainList& grains) {
    const auto sums = over_contacts(s, Vec3(0, 0, 0),
                                    [](Vec3& sum, std::size_t, const Side& side) { sum += side.torque(); });
    return listed(sums, grains, [](const Vec3& sum, std::size_t) { return sum.norm(); });
}

std::vector<double> acceleration(const Snapshot& s, const GrainList& grains) {
    return listed(std::vector<int>(s.frame.size()), grains, [&](int, std::size_t i) {
        return s.forces->acceleration.empty() ? none : s.forces->acceleration[i].norm();
    });
}

std::vector<double> sliding(const Snapshot& s, const GrainList& grains) {
    const auto sums = over_contacts(
        s, 0.0, [](double& sum, std::size_t, const Side& side) { sum += side.contact.slides(); });
    return listed(sums, grains, [](double sum, std::size_t) { return sum; });
}

std::vector<double> largest_overlap(const Snapshot& s, const GrainList& grains) {
    const auto sums = over_contacts(s, 0.0, [](double& most, std::size_t, const Side& side) {
        most = std::max(most, side.contact.overlap / side.contact.smaller_radius);
    });
    return listed(sums, grains, [](double most, std::size_t) { return most; });
}

std::vector<double> elastic_energy(const Snapshot& s, const GrainList& grains) {
    const auto sums = over_contacts(s, 0.0, [](double& sum, std::size_t, const Side& side) {
        sum += (side.contact.second >= 0 ? 0.5 : 1) * side.contact.stored_energy;
    });
    return listed(sums, grains, [](double sum, std::size_t) { return sum; });
}

// A third of the trace of the stress in the grain, sum(r f) / V over its contacts at r from its centre;
// compression is above 0.
std::vector<double> pressure(const Snapshot& s, const GrainList& grains) {
    const auto sums = over_contacts(s, 0.0, [&](double& sum, std::size_t i, const Side& side) {
        const double reach = s.frame.radius[i] - 0.5 * side.contact.overlap;
        sum -= reach * side.outwards().dot(side.force());
    });
    return listed(sums, grains, [&](double sum, std::size_t i) {
        return sum / (4 * std::numbers::pi * std::pow(s.frame.radius[i], 3));
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
        {"largest_overlap", number, "of its contacts, over the smaller radius", largest_overlap},
        {"elastic_energy", energy, "that its contacts would give back; half of it where it is shared",
         elastic_energy},
    };
    for (GrainColumn& column : all)
        if (column.needs == Needs::nothing) column.needs = Needs::forces;
    return all;
}

}  // namespace grainreel
