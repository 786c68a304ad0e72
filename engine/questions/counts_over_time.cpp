#include "engine/questions/counts_over_time.hpp"

#include <cmath>

#include <fmt/format.h>

#include "engine/base/error.hpp"
#include "engine/files/frame_faults.hpp"
#include "engine/questions/columns/grain_columns.hpp"
#include "engine/questions/expression.hpp"
#include "engine/questions/grain_list.hpp"
#include "engine/questions/statistics.hpp"

namespace grainreel {
namespace {

std::vector<AnswerCell> row_of(const Snapshot& s, const SeriesRequest& request) {
    const std::vector<std::size_t> found = grains_where(s, Expression(request.condition, GrainVocabulary(s)));
    std::vector<std::int64_t> own(s.scene.species.size(), 0);
    for (const std::size_t i : found) ++own[static_cast<std::size_t>(s.frame.species[i])];
    std::vector<AnswerCell> row{s.frame.time, s.frame.cycles};
    row.insert(row.end(), own.begin(), own.end());
    row.emplace_back(static_cast<std::int64_t>(found.size()));
    if (request.mean_of.empty()) return row;
    const Statistics of = statistics_of(values_of(s, column_called(s, request.mean_of), found));
    row.push_back(of.count > 0 ? AnswerCell(of.mean) : AnswerCell());
    return row;
}

AnswerTable empty_table(const Record& record, const SeriesRequest& request) {
    AnswerTable table{"over_time",
                      fmt::format("Grains with {}", request.condition),
                      {{"time", Dimension::time, "since the drive started"},
                       {"cycles", Dimension::number, "periods of the drive"}},
                      {}};
    for (const Species& species : record.scene().species)
        table.columns.push_back({"grains_" + species.name, Dimension::number, "of this species"});
    table.columns.push_back({"grains", Dimension::number, "of all"});
    if (request.mean_of.empty()) return table;
    for (const GrainColumn& column : grain_columns())
        if (column.name == request.mean_of || (!column.also.empty() && column.also == request.mean_of)) {
            if (column.is_species) throw UserError("--mean: species have no mean; name another quantity");
            table.columns.push_back({"mean_" + column.name, column.dimension, "over these grains"});
            return table;
        }
    throw UserError(
        fmt::format("--mean: '{}' is no quantity of a grain; --help lists them", request.mean_of));
}

// The kept moments that are nearest to the multiples of a time, each once.
std::vector<std::size_t> kept_nearest(const Record& record, double every) {
    const std::vector<Frame>& moments = record.moments();
    std::vector<std::size_t> all;
    std::size_t at = 0;
    for (double k = std::ceil(record.from() / every - 1e-9); k * every <= record.to() * (1 + 1e-9); ++k) {
        const auto distance = [&](std::size_t i) { return std::abs(moments[i].time - k * every); };
        while (at + 1 < moments.size() && distance(at + 1) <= distance(at)) ++at;
        if (all.empty() || all.back() != at) all.push_back(at);
    }
    return all;
}

std::vector<std::size_t> kept_ones(const Record& record, const std::optional<double>& every) {
    if (every) return kept_nearest(record, *every);
    std::vector<std::size_t> all(record.moments().size());
    for (std::size_t k = 0; k < all.size(); ++k) all[k] = k;
    return all;
}

}  // namespace

Answer series_of(MomentFinder& finder, const Record& record, const SeriesRequest& request,
                 const ReplayWatcher& watcher) {
    Answer answer{{empty_table(record, request)}, {}};
    AnswerTable& table = answer.tables.front();
    if (request.every && request.replay) {
        finder.at_every(*request.every, watcher,
                        [&](const Snapshot& snapshot) { table.rows.push_back(row_of(snapshot, request)); });
        return answer;
    }
    std::size_t damaged = 0;
    for (const std::size_t k : kept_ones(record, request.every)) {
        try {
            table.rows.push_back(row_of(finder.kept(k), request));
        } catch (const DamagedFrame&) {
            ++damaged;
        }
    }
    if (request.every)
        answer.notes.emplace_back("of each time the kept moment that is nearest; nothing was brought back");
    if (damaged > 0) answer.notes.push_back(fmt::format("{} moments are damaged and left out", damaged));
    return answer;
}

}  // namespace grainreel
