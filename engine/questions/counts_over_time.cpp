#include "engine/questions/counts_over_time.hpp"

#include <fmt/format.h>

#include "engine/base/error.hpp"
#include "engine/files/frames/damaged_frame.hpp"
#include "engine/questions/columns/grain_columns.hpp"
#include "engine/questions/expression.hpp"
#include "engine/questions/grain_list.hpp"

namespace grainreel {
namespace {

std::vector<AnswerCell> row_of(const Snapshot& s, const std::string& condition) {
    const std::vector<std::size_t> found = grains_where(s, Expression(condition, GrainVocabulary(s)));
    std::vector<std::int64_t> own(s.scene.species.size(), 0);
    for (const std::size_t i : found) ++own[static_cast<std::size_t>(s.frame.species[i])];
    std::vector<AnswerCell> row{s.frame.time, s.frame.cycles};
    row.insert(row.end(), own.begin(), own.end());
    row.emplace_back(static_cast<std::int64_t>(found.size()));
    return row;
}

}  // namespace

Answer counts_over_time(const MomentFinder& finder, const Record& record, const std::string& condition) {
    AnswerTable table{"over_time",
                      fmt::format("Grains with {}", condition),
                      {{"time", Dimension::time, "since the drive started"},
                       {"cycles", Dimension::number, "periods of the drive"}},
                      {}};
    for (const Species& species : record.scene().species)
        table.columns.push_back({"grains_" + species.name, Dimension::number, "of this species"});
    table.columns.push_back({"grains", Dimension::number, "of all"});
    std::size_t damaged = 0;
    for (std::size_t k = 0; k < record.moments().size(); ++k) {
        try {
            table.rows.push_back(row_of(finder.kept(k), condition));
        } catch (const DamagedFrame&) {
            ++damaged;
        }
    }
    Answer answer{{std::move(table)}, {}};
    if (damaged > 0) answer.notes.push_back(fmt::format("{} moments are damaged and left out", damaged));
    return answer;
}

}  // namespace grainreel
