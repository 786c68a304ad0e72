#include "engine/inspect/grain_columns.hpp"

#include <algorithm>
#include <limits>

#include <fmt/format.h>

#include "engine/base/error.hpp"
#include "engine/inspect/dimensions.hpp"

namespace grainreel {
namespace {

constexpr double none = std::numeric_limits<double>::quiet_NaN();

template <int axis>
double place(const Snapshot& s, std::size_t i) {
    return s.frame.position[i][axis];
}

template <int axis>
double velocity(const Snapshot& s, std::size_t i) {
    return s.frame.velocity[i][axis];
}

template <int axis>
double spin(const Snapshot& s, std::size_t i) {
    return s.frame.spin[i][axis];
}

// J, of translation and rotation of a solid sphere.
double kinetic_energy(const Snapshot& s, std::size_t i) {
    const double r = s.frame.radius[i];
    return 0.5 * s.mass(i) *
           (s.frame.velocity[i].squaredNorm() + 0.4 * r * r * s.frame.spin[i].squaredNorm());
}

std::optional<std::size_t> place_at_start(const Snapshot& s, std::size_t i) {
    const auto& ids = s.start.id;
    const auto at = std::lower_bound(ids.begin(), ids.end(), s.frame.id[i]);
    if (at == ids.end() || *at != s.frame.id[i]) return std::nullopt;
    return static_cast<std::size_t>(at - ids.begin());
}

double start_height(const Snapshot& s, std::size_t i) {
    const auto start = place_at_start(s, i);
    return start ? (s.start.position[*start] - s.start.floor().place).z() : none;
}

// Against the container, which moves itself.
double rise(const Snapshot& s, std::size_t i) {
    return s.height(i) - start_height(s, i);
}

double moved(const Snapshot& s, std::size_t i) {
    const auto start = place_at_start(s, i);
    if (!start) return none;
    return ((s.frame.position[i] - s.frame.container().place) -
            (s.start.position[*start] - s.start.container().place))
        .norm();
}

std::vector<GrainColumn> make_columns() {
    using enum Dimension;
    return {
        {"id", number, "number of the grain", false, false,
         [](const Snapshot& s, std::size_t i) { return static_cast<double>(s.frame.id[i]); }},
        {"species", number, "species", true, false,
         [](const Snapshot& s, std::size_t i) { return static_cast<double>(s.frame.species[i]); }},
        {"x", length, "along the depth", false, false, place<0>},
        {"y", length, "across", false, false, place<1>},
        {"z", length, "upwards, from the floor's place at rest", false, false, place<2>},
        {"height", length, "of the centre above the floor where that is now", false, false,
         [](const Snapshot& s, std::size_t i) { return s.height(i); }},
        {"vx", Dimension::speed, "velocity along the depth", false, false, velocity<0>},
        {"vy", Dimension::speed, "velocity across", false, false, velocity<1>},
        {"vz", Dimension::speed, "velocity upwards", false, false, velocity<2>},
        {"speed", Dimension::speed, "magnitude of the velocity", false, false,
         [](const Snapshot& s, std::size_t i) { return s.frame.velocity[i].norm(); }},
        {"wx", Dimension::spin, "spin about x", false, false, grainreel::spin<0>},
        {"wy", Dimension::spin, "spin about y", false, false, grainreel::spin<1>},
        {"wz", Dimension::spin, "spin about z", false, false, grainreel::spin<2>},
        {"spin", Dimension::spin, "magnitude of the spin", false, false,
         [](const Snapshot& s, std::size_t i) { return s.frame.spin[i].norm(); }},
        {"radius", length, "radius", false, false,
         [](const Snapshot& s, std::size_t i) { return s.frame.radius[i]; }},
        {"diameter", length, "diameter", false, false,
         [](const Snapshot& s, std::size_t i) { return 2 * s.frame.radius[i]; }},
        {"mass", Dimension::mass, "mass", false, false,
         [](const Snapshot& s, std::size_t i) { return s.mass(i); }},
        {"kinetic_energy", energy, "of translation and rotation", false, false, kinetic_energy},
        {"start_height", length, "height at the run's first moment", false, false, start_height},
        {"rise", length, "height gained since then", false, false, rise},
        {"moved", length, "distance from its place in the container then", false, false, moved},
        {"contacts", number, "number of contacts", false, true, nullptr},
        {"contact_force", force, "sum of the normal forces on it", false, true, nullptr},
    };
}

// Of each grain of the frame the number of its contacts, or the sum of their normal forces.
std::vector<double> sums_of_contacts(const Snapshot& s, bool forces) {
    std::vector<double> sums(s.frame.size(), 0);
    for (const Touch& touch : s.frame.touches)
        for (const std::int32_t id : {touch.first, touch.second})
            if (id >= 0)
                if (const auto place = s.place_of(id)) sums[*place] += forces ? touch.force : 1;
    return sums;
}

}  // namespace

const std::vector<GrainColumn>& grain_columns() {
    static const std::vector<GrainColumn> all = make_columns();
    return all;
}

std::vector<double> values_of(const Snapshot& snapshot, int number) {
    const GrainColumn& column = grain_columns().at(static_cast<std::size_t>(number));
    if (column.needs_contacts) return sums_of_contacts(snapshot, column.name == "contact_force");
    std::vector<double> values(snapshot.frame.size());
    for (std::size_t i = 0; i < values.size(); ++i) values[i] = column.of(snapshot, i);
    return values;
}

std::optional<Vocabulary::Word> GrainVocabulary::find(std::string_view name) const {
    const auto& columns = grain_columns();
    for (std::size_t k = 0; k < columns.size(); ++k) {
        if (columns[k].name != name) continue;
        if (columns[k].needs_contacts && !snapshot_.contacts)
            throw UserError(fmt::format(
                "'{}' needs contacts, and the run kept none; run it with output.contacts = true", name));
        const ValueType::Kind kind =
            columns[k].is_species ? ValueType::Kind::species : ValueType::Kind::number;
        return Word{{kind, powers_of(columns[k].dimension)}, std::nullopt, static_cast<int>(k)};
    }
    const auto& species = snapshot_.scene.species;
    for (std::size_t k = 0; k < species.size(); ++k)
        if (species[k].name == name) return Word{{ValueType::Kind::species, {}}, static_cast<double>(k), -1};
    return std::nullopt;
}

std::vector<std::string> GrainVocabulary::names() const {
    std::vector<std::string> names;
    for (const GrainColumn& column : grain_columns()) names.push_back(column.name);
    for (const Species& species : snapshot_.scene.species) names.push_back(species.name);
    return names;
}

std::vector<std::size_t> grains_where(const Snapshot& snapshot, std::string_view text) {
    const Expression condition(text, GrainVocabulary(snapshot));
    if (condition.type().kind != ValueType::Kind::truth)
        throw UserError("this is a value and no condition; compare it with another, as in \"height > 2 cm\"");
    std::vector<std::vector<double>> columns;
    for (const int column : condition.columns()) columns.push_back(values_of(snapshot, column));
    std::vector<double> row(columns.size());
    std::vector<std::size_t> found;
    for (std::size_t i = 0; i < snapshot.frame.size(); ++i) {
        for (std::size_t k = 0; k < columns.size(); ++k) row[k] = columns[k][i];
        if (condition.of(row) != 0) found.push_back(i);
    }
    return found;
}

}  // namespace grainreel
