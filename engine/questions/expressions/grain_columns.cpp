#include "engine/questions/expressions/grain_columns.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <cctype>
#include <cmath>
#include <numeric>

#include "engine/base/error.hpp"
#include "engine/base/lists.hpp"
#include "engine/base/mathematics.hpp"
#include "engine/base/numbers.hpp"
#include "engine/base/text.hpp"
#include "engine/questions/expressions/expression.hpp"
#include "engine/state/container_faces.hpp"

namespace grainreel {

namespace {

std::vector<GrainColumn> make_columns() {
    std::vector<GrainColumn> all;
    for (const auto& group : {motion_columns(), bed_columns(), contact_columns()})
        all.insert(all.end(), group.begin(), group.end());
    return all;
}

// The number of the column with this name; none when there is none.
std::optional<std::size_t> column_named(std::string_view name) {
    const auto& columns = grain_columns();
    for (std::size_t k = 0; k < columns.size(); ++k)
        if (columns[k].name == name || (!columns[k].also.empty() && columns[k].also == name)) return k;
    return std::nullopt;
}

std::string why_lacking(std::string_view name, Needs needs) {
    switch (needs) {
        case Needs::contacts:
            return fmt::format(
                "'{}' needs contacts, and none were kept; run the scene with output.contacts = true, or name "
                "another program's files of contacts by --contacts",
                name);
        case Needs::forces:
            return fmt::format("'{}' is known only of a moment that is brought back, and this one was not",
                               name);
        case Needs::period:
            return fmt::format(
                "'{}' needs the moment one period of the drive earlier, which is not to be had here", name);
        case Needs::velocities:
            return fmt::format("'{}' needs velocities, which these files do not have", name);
        case Needs::spins:
            return fmt::format("'{}' needs spins, which these files do not have", name);
        case Needs::nothing:
            break;
    }
    return "";
}

}  // namespace

const std::vector<GrainColumn>& grain_columns() {
    static const std::vector<GrainColumn> all = make_columns();
    return all;
}

std::vector<double> values_of(const Snapshot& snapshot, int number, const GrainList& grains) {
    if (is_touches_column(number)) return values_of_touches(snapshot, number, grains);
    return grain_columns().at(static_cast<std::size_t>(number)).of(snapshot, grains);
}

std::vector<double> values_of(const Snapshot& snapshot, int number) {
    GrainList all(snapshot.frame.size());
    std::iota(all.begin(), all.end(), std::size_t{0});
    return values_of(snapshot, number, all);
}

int column_called(const Snapshot& snapshot, const std::string& name) {
    const GrainVocabulary words(snapshot);
    const auto word = words.find(name);
    if (word && word->column >= 0) return word->column;
    std::vector<std::string> names;
    for (const GrainColumn& column : grain_columns()) names.push_back(column.name);
    const std::optional<std::string> meant = nearest_name(name, names);
    throw UserError("'{}' is no quantity of a grain{}", name,
                    meant ? fmt::format("; did you mean '{}'?", *meant) : "");
}

std::vector<Needs> needs_of(std::string_view text) {
    const auto is_of_name = [](char c) { return std::isalnum(static_cast<unsigned char>(c)) || c == '_'; };
    std::vector<Needs> needs;
    for (std::size_t at = 0; at < text.size();) {
        std::size_t end = at;
        while (end < text.size() && is_of_name(text[end])) ++end;
        const std::string_view name = text.substr(at, end - at);
        const auto column = column_named(name);
        std::optional<Needs> what;
        if (column) what = grain_columns()[*column].needs;
        if (name == "touches") what = Needs::contacts;
        if (what && !contains(needs, *what)) needs.push_back(*what);
        at = std::max(end, at + 1);
    }
    return needs;
}

bool masses_known(const Snapshot& snapshot) {
    const std::size_t grains = snapshot.frame.size();
    for (std::size_t i = 0; i < grains; ++i)
        if (std::isfinite(snapshot.mass(i))) return true;
    return grains == 0;
}

std::optional<Vocabulary::Word> GrainVocabulary::find(std::string_view name) const {
    if (const auto k = column_named(name)) {
        const GrainColumn& column = grain_columns()[*k];
        const bool weighs = column.dimension == Dimension::mass || column.dimension == Dimension::energy;
        if (weighs && !masses_known(snapshot_))
            throw UserError(
                "'{}' needs masses, and these files say no density; give it by --density, in kg/m3 (glass: "
                "2500)",
                name);
        if (!snapshot_.has(column.needs)) throw UserError(why_lacking(name, column.needs));
        const ValueType::Kind kind = column.is_species ? ValueType::Kind::species : ValueType::Kind::number;
        return Word{{kind, powers_of(column.dimension)}, std::nullopt, static_cast<int>(*k)};
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

std::optional<Vocabulary::Word> GrainVocabulary::touching(std::string_view who) const {
    return Word{{ValueType::Kind::truth, {}}, std::nullopt, touches_column(snapshot_, who)};
}

GrainList grains_where(const Snapshot& snapshot, const Expression& condition) {
    if (condition.type().kind != ValueType::Kind::truth)
        throw UserError("this is a value and no condition; compare it with another, as in \"height > 2 cm\"");
    std::vector<std::vector<double>> columns;
    for (const int column : condition.columns()) columns.push_back(values_of(snapshot, column));
    std::vector<double> row(columns.size());
    GrainList found;
    for (std::size_t i = 0; i < snapshot.frame.size(); ++i) {
        for (std::size_t k = 0; k < columns.size(); ++k) row[k] = columns[k][i];
        const double truth = condition.of(row);
        if (truth != 0 && !std::isnan(truth)) found.push_back(i);
    }
    return found;
}

// Columns about where a grain is, how it moves, what it is, and how far it came.

namespace {

double id(const Snapshot& s, std::size_t i) {
    return static_cast<double>(s.frame.id[i]);
}

double species(const Snapshot& s, std::size_t i) {
    return static_cast<double>(s.frame.species[i]);
}

template <int axis>
double place(const Snapshot& s, std::size_t i) {
    return s.frame.position[i][axis];
}

double height(const Snapshot& s, std::size_t i) {
    return s.height(i);
}

double from_axis(const Snapshot& s, std::size_t i) {
    const Vec3 from = s.frame.position[i] - container_offset(s.scene, s.frame);
    return math::hypot(from.x(), from.y());
}

template <int axis>
double velocity(const Snapshot& s, std::size_t i) {
    return s.frame.velocity[i][axis];
}

double speed(const Snapshot& s, std::size_t i) {
    return s.frame.velocity[i].norm();
}

template <int axis>
double spin_about(const Snapshot& s, std::size_t i) {
    return s.frame.spin[i][axis];
}

double spin(const Snapshot& s, std::size_t i) {
    return s.frame.spin[i].norm();
}

double radius(const Snapshot& s, std::size_t i) {
    return s.frame.radius[i];
}

double diameter(const Snapshot& s, std::size_t i) {
    return 2 * s.frame.radius[i];
}

double mass(const Snapshot& s, std::size_t i) {
    return s.mass(i);
}

// Rotational energy (J) of a solid sphere.
double rotational_energy(const Snapshot& s, std::size_t i) {
    const double r = s.frame.radius[i];
    return 0.5 * s.mass(i) * 0.4 * r * r * s.frame.spin[i].squaredNorm();
}

double kinetic_energy(const Snapshot& s, std::size_t i) {
    const double translation = 0.5 * s.mass(i) * s.frame.velocity[i].squaredNorm();
    return s.spins ? translation + rotational_energy(s, i) : translation;
}

double potential_energy(const Snapshot& s, std::size_t i) {
    return -s.mass(i) * s.scene.gravity.dot(s.frame.position[i]);
}

double start_height(const Snapshot& s, std::size_t i) {
    const auto start = s.start.row_of(s.frame.id[i]);
    return start ? (s.start.position[*start] - floor_offset(s.scene, s.start)).z() : kUnknown;
}

// How far the grain has risen in the container, which moves itself.
double rise(const Snapshot& s, std::size_t i) {
    return s.height(i) - start_height(s, i);
}

double moved(const Snapshot& s, std::size_t i) {
    const auto start = s.start.row_of(s.frame.id[i]);
    if (!start) return kUnknown;
    return ((s.frame.position[i] - container_offset(s.scene, s.frame)) -
            (s.start.position[*start] - container_offset(s.scene, s.start)))
        .norm();
}

double period_displacement(const Snapshot& s, std::size_t i) {
    return s.displacement.empty() ? kUnknown : s.displacement[i].norm();
}

double period_rise(const Snapshot& s, std::size_t i) {
    return s.displacement.empty() ? kUnknown : s.displacement[i].z();
}

}  // namespace

std::vector<GrainColumn> motion_columns() {
    using enum Dimension;
    return {
        {"id", number, "number of the grain", of_each<id>},
        {.name = "species",
         .dimension = number,
         .about = "its species",
         .of = of_each<species>,
         .is_species = true,
         .coloured_as = "species"},
        {"x", length, "along the depth", of_each<place<0>>},
        {"y", length, "across", of_each<place<1>>},
        {"z", length, "upwards, from the floor's place at rest", of_each<place<2>>},
        {"height", length, "of the centre above the floor where that is now", of_each<height>},
        {"r", length, "of the centre from the container's upright axis", of_each<from_axis>},
        {"vx", Dimension::speed, "velocity along the depth", of_each<velocity<0>>, Needs::velocities},
        {"vy", Dimension::speed, "velocity across", of_each<velocity<1>>, Needs::velocities},
        {.name = "vz",
         .dimension = Dimension::speed,
         .about = "velocity upwards",
         .of = of_each<velocity<2>>,
         .needs = Needs::velocities,
         .coloured_as = "vertical-velocity",
         .also = "vertical_velocity"},
        {.name = "speed",
         .dimension = Dimension::speed,
         .about = "magnitude of the velocity",
         .of = of_each<grainreel::speed>,
         .needs = Needs::velocities,
         .coloured_as = "speed"},
        {"wx", Dimension::spin, "spin about x", of_each<spin_about<0>>, Needs::spins},
        {"wy", Dimension::spin, "spin about y", of_each<spin_about<1>>, Needs::spins},
        {"wz", Dimension::spin, "spin about z", of_each<spin_about<2>>, Needs::spins},
        {.name = "spin",
         .dimension = Dimension::spin,
         .about = "magnitude of the spin",
         .of = of_each<grainreel::spin>,
         .needs = Needs::spins,
         .coloured_as = "spin"},
        {"radius", length, "radius", of_each<radius>},
        {"diameter", length, "diameter", of_each<diameter>},
        {"mass", Dimension::mass, "mass", of_each<grainreel::mass>},
        {.name = "kinetic_energy",
         .dimension = energy,
         .about = "of translation and rotation",
         .of = of_each<kinetic_energy>,
         .needs = Needs::velocities,
         .coloured_as = "kinetic-energy"},
        {"rotational_energy", energy, "the part of rotation in it", of_each<rotational_energy>, Needs::spins},
        {"potential_energy", energy, "0 at the floor's place at rest", of_each<potential_energy>},
        {.name = "start_height",
         .dimension = length,
         .about = "height at the run's first moment",
         .of = of_each<start_height>,
         .coloured_as = "start-height"},
        {"rise", length, "height gained since then", of_each<rise>},
        {"moved", length, "distance from its place in the container then", of_each<moved>},
        {.name = "period_displacement",
         .dimension = length,
         .about = "how far it moved in the last period of the drive",
         .of = of_each<period_displacement>,
         .needs = Needs::period,
         .coloured_as = "displacement",
         .also = "displacement"},
        {.name = "period_rise",
         .dimension = length,
         .about = "the upward part of that",
         .of = of_each<period_rise>,
         .needs = Needs::period,
         .coloured_as = "rise"},
    };
}

}  // namespace grainreel
