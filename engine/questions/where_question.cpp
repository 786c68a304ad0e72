#include <algorithm>

#include <fmt/format.h>

#include "engine/questions/columns/grain_columns.hpp"
#include "engine/questions/grain_list.hpp"
#include "engine/questions/questions.hpp"
#include "engine/questions/statistics.hpp"

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
    for (const std::size_t i : found) ++own[static_cast<std::size_t>(s.frame.species[i])];
    for (const std::int32_t k : s.frame.species) ++all[static_cast<std::size_t>(k)];
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

// What is costly only where it is asked for.
AnswerTable statistics_table(const Snapshot& s, const std::vector<std::size_t>& found,
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
        if (columns[k].costly && std::find(asked.begin(), asked.end(), number) == asked.end()) continue;
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
    if (!found.empty()) answer.tables.push_back(statistics_table(s, found, wanted.columns()));
    add_grain_list(
        answer, s, found, found.empty() ? 0 : most,
        {{{"height", Dimension::length, ""}, [&](std::size_t i) { return s.height(i); }},
         {{"speed", Dimension::speed, ""}, [&](std::size_t i) { return s.frame.velocity[i].norm(); }},
         {{"vz", Dimension::speed, ""}, [&](std::size_t i) { return s.frame.velocity[i].z(); }}});
    return answer;
}

}  // namespace grainreel
