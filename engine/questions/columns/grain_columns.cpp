#include "engine/questions/columns/grain_columns.hpp"

#include <algorithm>
#include <cctype>
#include <numeric>

#include <fmt/format.h>

#include "engine/base/error.hpp"
#include "engine/base/text.hpp"
#include "engine/questions/columns/touches.hpp"
#include "engine/questions/expression.hpp"

namespace grainreel {
namespace {

std::vector<GrainColumn> make_columns() {
    std::vector<GrainColumn> all;
    for (const auto& group : {motion_columns(), bed_columns(), contact_columns()})
        all.insert(all.end(), group.begin(), group.end());
    return all;
}

// Its number; none when there is no such column.
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
                "'{}' needs contacts, and the run kept none; run it with output.contacts = true", name);
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
    throw UserError(fmt::format("'{}' is no quantity of a grain{}", name,
                                meant ? fmt::format("; did you mean '{}'?", *meant) : ""));
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
        if (what && std::find(needs.begin(), needs.end(), *what) == needs.end()) needs.push_back(*what);
        at = std::max(end, at + 1);
    }
    return needs;
}

std::optional<Vocabulary::Word> GrainVocabulary::find(std::string_view name) const {
    if (const auto k = column_named(name)) {
        const GrainColumn& column = grain_columns()[*k];
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
        if (condition.of(row) != 0) found.push_back(i);
    }
    return found;
}

GrainList grains_where(const Snapshot& snapshot, std::string_view text) {
    return grains_where(snapshot, Expression(text, GrainVocabulary(snapshot)));
}

}  // namespace grainreel
