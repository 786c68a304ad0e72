#include "engine/questions/where_question.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>

#include "engine/base/counted.hpp"
#include "engine/base/error.hpp"
#include "engine/base/lists.hpp"
#include "engine/base/mathematics.hpp"
#include "engine/files/damage.hpp"
#include "engine/questions/expressions/expression.hpp"
#include "engine/questions/expressions/grain_columns.hpp"
#include "engine/questions/questions.hpp"
#include "engine/questions/statistics.hpp"
#include "engine/scene/text/units.hpp"

namespace grainreel {

namespace {

AnswerTable counts_table(const Snapshot& s, const std::vector<std::size_t>& found) {
    AnswerTable table{"count",
                      "How many",
                      {{"species", Dimension::number, "", AnswerColumn::kKey},
                       {"grains", Dimension::number, "for which it holds"},
                       {"of", Dimension::number, "all of the species"},
                       {"share", Dimension::number, "", "of"}},
                      {},
                      true};
    std::vector<std::int64_t> own(s.scene.species.size(), 0), all(s.scene.species.size(), 0);
    for (const std::size_t i : found) ++own[s.frame.species[i]];
    for (const std::int32_t k : s.frame.species) ++all[k];
    const auto add = [&](const std::string& name, std::int64_t some, std::int64_t of) {
        AnswerCell share;
        if (of > 0) share = static_cast<double>(some) / static_cast<double>(of);
        table.rows.push_back({name, some, of, share});
    };
    for (std::size_t k = 0; k < own.size(); ++k) add(s.scene.species[k].name, own[k], all[k]);
    if (own.size() != 1)
        add("all", static_cast<std::int64_t>(found.size()), static_cast<std::int64_t>(s.frame.size()));
    return table;
}

// Statistics of all columns; costly ones only where they are asked for.
AnswerTable series_table(const Snapshot& s, const std::vector<std::size_t>& found,
                         const std::vector<int>& asked) {
    AnswerTable table{"statistics",
                      "Of these grains",
                      {{"column", Dimension::number, ""},
                       {"mean", Dimension::number, ""},
                       {"deviation", Dimension::number, "standard deviation of the sample"},
                       {"least", Dimension::number, ""},
                       {"most", Dimension::number, ""}},
                      {}};
    const auto& columns = grain_columns();
    for (std::size_t k = 0; k < columns.size(); ++k) {
        const int number = static_cast<int>(k);
        if (columns[k].is_species || columns[k].name == "id" || !s.has(columns[k].needs)) continue;
        if (columns[k].costly && !contains(asked, number)) continue;
        const Statistics of = statistics_of(values_of(s, number, found));
        if (of.count == 0) continue;
        table.rows.push_back({columns[k].name, of.mean, of.deviation, of.least, of.most});
        table.row_dimensions.push_back(columns[k].dimension);
    }
    return table;
}

}  // namespace

Answer where_answer(const Snapshot& s, const std::string& condition, std::size_t most) {
    const Expression wanted(condition, GrainVocabulary(s));
    const std::vector<std::size_t> found = grains_where(s, wanted);
    Answer answer{{counts_table(s, found)}, {}};
    if (!found.empty()) answer.tables.push_back(series_table(s, found, wanted.columns()));
    add_grain_list(
        answer, s, found, found.empty() ? 0 : most,
        {{{"height", Dimension::length, ""}, [&](std::size_t i) { return s.height(i); }},
         {{"speed", Dimension::speed, ""}, [&](std::size_t i) { return s.frame.velocity[i].norm(); }},
         {{"vz", Dimension::speed, ""}, [&](std::size_t i) { return s.frame.velocity[i].z(); }}});
    return answer;
}

namespace {

struct Plane {
    int axis = 0;      // 0 to 2
    double place = 0;  // m
};

// Reads a plane: "y=0", "z = 2 cm".
Plane plane_of(const std::string& text) {
    const std::size_t equal = text.find('=');
    const std::size_t letter = text.find_first_not_of(' ');
    const bool named =
        equal != text.npos && letter < equal && text.find_first_not_of(' ', letter + 1) == equal;
    const std::size_t axis = named ? std::string("xyz").find(text[letter]) : std::string::npos;
    if (axis == std::string::npos)
        throw UserError("'{}' is no plane; write for example y=0 or \"z = 2 cm\"", text);
    const std::string value = text.substr(equal + 1);
    const bool bare_zero = value.find_first_not_of(" 0.") == std::string::npos && !value.empty();
    return {static_cast<int>(axis), bare_zero ? 0 : parse_quantity(value, Dimension::length, "y = 2 mm")};
}

}  // namespace

Answer slice_answer(const Snapshot& s, const std::string& plane, std::size_t most) {
    const Plane cut = plane_of(plane);
    std::vector<std::size_t> found;
    const auto off = [&](std::size_t i) { return std::abs(s.frame.position[i][cut.axis] - cut.place); };
    for (std::size_t i = 0; i < s.frame.size(); ++i)
        if (off(i) < s.frame.radius[i]) found.push_back(i);
    const auto circle = [&](std::size_t i) {
        return std::sqrt(math::square(s.frame.radius[i]) - math::square(off(i)));
    };
    AnswerTable areas{
        "areas",
        fmt::format("Grains that the plane {} cuts", plane),
        {{"species", Dimension::number, "", AnswerColumn::kKey},
         {"grains", Dimension::number, ""},
         {"area_share", Dimension::number, "of the area of all cut circles", AnswerColumn::kThere}},
        {},
        true};
    std::vector<double> area(s.scene.species.size(), 0);
    std::vector<std::int64_t> count(area.size(), 0);
    double all = 0;
    for (const std::size_t i : found) {
        const double own = math::square(circle(i));
        const auto species = static_cast<std::size_t>(s.frame.species[i]);
        ++count[species], area[species] += own, all += own;
    }
    for (std::size_t k = 0; k < area.size(); ++k) {
        AnswerCell share;
        if (all > 0) share = area[k] / all;
        areas.rows.push_back({s.scene.species[k].name, count[k], share});
    }
    Answer answer{{std::move(areas)}, {}};
    add_grain_list(answer, s, found, most,
                   {{{"circle_radius", Dimension::length, "of its circle in the plane"}, circle}});
    return answer;
}

void add_grain_list(Answer& answer, const Snapshot& s, const std::vector<std::size_t>& found,
                    std::size_t most, const std::vector<ListedColumn>& more) {
    answer.grains.emplace();
    for (const std::size_t i : found) answer.grains->push_back(s.frame.id[i]);
    if (most == 0) return;
    AnswerTable table{"grains",
                      found.size() > most ? fmt::format("The first {} of them", most) : "All of them",
                      {{"id", Dimension::number, ""},
                       {"species", Dimension::number, ""},
                       {"x", Dimension::length, ""},
                       {"y", Dimension::length, ""},
                       {"z", Dimension::length, ""},
                       {"radius", Dimension::length, ""}},
                      {}};
    for (const ListedColumn& one : more) table.columns.push_back(one.column);
    for (std::size_t k = 0; k < std::min(most, found.size()); ++k) {
        const std::size_t i = found[k];
        const Vec3& at = s.frame.position[i];
        auto& row = table.rows.emplace_back();
        row = {static_cast<std::int64_t>(s.frame.id[i]),
               name_of_body(s, s.frame.id[i]),
               at.x(),
               at.y(),
               at.z(),
               s.frame.radius[i]};
        for (const ListedColumn& one : more) row.push_back(one.of(i));
    }
    answer.tables.push_back(std::move(table));
}

namespace {

std::vector<AnswerCell> moment_row(const Snapshot& s, const SeriesRequest& request) {
    const std::vector<std::size_t> found = grains_where(s, Expression(request.condition, GrainVocabulary(s)));
    std::vector<std::int64_t> own(s.scene.species.size(), 0);
    for (const std::size_t i : found) ++own[s.frame.species[i]];
    std::vector<AnswerCell> row{s.frame.time, s.frame.cycles};
    row.insert(row.end(), own.begin(), own.end());
    row.emplace_back(static_cast<std::int64_t>(found.size()));
    if (request.mean_of.empty()) return row;
    const Statistics of = statistics_of(values_of(s, column_called(s, request.mean_of), found));
    row.push_back(of.count > 0 ? AnswerCell(of.mean) : AnswerCell());
    return row;
}

AnswerTable empty_table(const StoredRun& run, const SeriesRequest& request) {
    AnswerTable table{"over_time",
                      fmt::format("Grains with {}", request.condition),
                      {{"time", Dimension::time, "since the drive started"},
                       {"cycles", Dimension::number, "periods of the drive"}},
                      {}};
    for (const Species& species : run.known_scene().species)
        table.columns.push_back({"grains_" + species.name, Dimension::number, "of this species"});
    table.columns.push_back({"grains", Dimension::number, "of all"});
    if (request.mean_of.empty()) return table;
    for (const GrainColumn& column : grain_columns())
        if (column.name == request.mean_of || (!column.also.empty() && column.also == request.mean_of)) {
            if (column.is_species) throw UserError("--mean: species have no mean; name another quantity");
            table.columns.push_back({"mean_" + column.name, column.dimension,
                                     column.dimension == Dimension::energy
                                         ? fmt::format("over these grains, {}", column.about)
                                         : "over these grains"});
            return table;
        }
    throw UserError("--mean: '{}' is no quantity of a grain; --help lists them", request.mean_of);
}

// The kept moments that are nearest to the multiples of a time, each once.
std::vector<std::size_t> kept_nearest(const StoredRun& run, double every) {
    const std::vector<State>& moments = run.moments();
    std::vector<std::size_t> all;
    std::size_t at = 0;
    const double room = room_in(run, every);
    for (double k = std::ceil(run.from() / every - room); k <= run.to() / every + room; ++k) {
        const auto distance = [&](std::size_t i) { return std::abs(moments[i].time - k * every); };
        while (at + 1 < moments.size() && distance(at + 1) <= distance(at)) ++at;
        if (all.empty() || all.back() != at) all.push_back(at);
    }
    return all;
}

std::vector<std::size_t> kept_ones(const StoredRun& run, const std::optional<double>& every) {
    if (every) return kept_nearest(run, *every);
    std::vector<std::size_t> all(run.moments().size());
    for (std::size_t k = 0; k < all.size(); ++k) all[k] = k;
    return all;
}

}  // namespace

Answer series_of(StoredRun& run, const SeriesRequest& request, const ReplayWatcher& watcher) {
    Answer answer{{empty_table(run, request)}, {}};
    AnswerTable& table = answer.tables.front();
    if (request.every && request.replay) {
        see_every(run, *request.every, watcher,
                  [&](const Snapshot& snapshot) { table.rows.push_back(moment_row(snapshot, request)); });
        return answer;
    }
    const std::vector<Needs> needs = needs_of(request.condition + " " + request.mean_of);
    const bool with_ways = contains(needs, Needs::period);
    std::size_t damaged = 0;
    for (const std::size_t k : kept_ones(run, request.every)) {
        try {
            table.rows.push_back(moment_row(kept_snapshot(run, k, with_ways), request));
        } catch (const DamagedFrame&) {
            ++damaged;
        }
    }
    if (request.every)
        answer.notes.emplace_back("of each time the kept moment that is nearest; nothing was brought back");
    if (damaged > 0)
        answer.notes.push_back(fmt::format("damaged and left out: {}", counted(damaged, "moment")));
    return answer;
}

}  // namespace grainreel
