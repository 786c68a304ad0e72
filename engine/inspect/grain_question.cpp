#include <fmt/format.h>

#include "engine/base/error.hpp"
#include "engine/inspect/grain_columns.hpp"
#include "engine/inspect/questions.hpp"

namespace grainreel {
namespace {

AnswerTable columns_table(const Snapshot& s, std::size_t grain) {
    AnswerTable table{"grain",
                      fmt::format("Grain {}, {}", s.frame.id[grain], name_of_body(s, s.frame.id[grain])),
                      {},
                      {{}}};
    const auto& columns = grain_columns();
    for (std::size_t k = 0; k < columns.size(); ++k) {
        if (columns[k].needs_contacts && !s.contacts) continue;
        table.columns.push_back({columns[k].name, columns[k].dimension, columns[k].about});
        if (columns[k].is_species) {
            table.rows[0].emplace_back(name_of_body(s, s.frame.id[grain]));
        } else if (columns[k].name == "id") {
            table.rows[0].emplace_back(static_cast<std::int64_t>(s.frame.id[grain]));
        } else {
            table.rows[0].emplace_back(values_of(s, static_cast<int>(k))[grain]);
        }
    }
    return table;
}

AnswerTable contacts_table(const Snapshot& s, std::size_t grain) {
    const std::int32_t id = s.frame.id[grain];
    AnswerTable table{"contacts",
                      "What it touches",
                      {{"partner", Dimension::number, "id; empty of a wall"},
                       {"what", Dimension::number, "species or wall"},
                       {"normal_force", Dimension::force, ""},
                       {"partner_height", Dimension::length, "above the floor"}},
                      {}};
    for (const Touch& touch : s.frame.touches) {
        if (touch.first != id && touch.second != id) continue;
        const std::int32_t partner = touch.first == id ? touch.second : touch.first;
        AnswerCell number, height;
        if (partner >= 0) {
            number = static_cast<std::int64_t>(partner);
            if (const auto place = s.place_of(partner)) height = s.height(*place);
        }
        table.rows.push_back({number, name_of_body(s, partner), touch.force, height});
    }
    return table;
}

}  // namespace

Answer grain_answer(const Snapshot& s, std::int64_t id) {
    const std::optional<std::size_t> grain = s.place_of(id);
    if (!grain)
        throw UserError(s.frame.id.empty()
                            ? "there are no grains at this moment"
                            : fmt::format("no grain has the id {} at this moment; ids go from {} to {}", id,
                                          s.frame.id.front(), s.frame.id.back()));
    Answer answer{{columns_table(s, *grain)}, {}};
    if (s.contacts) answer.tables.push_back(contacts_table(s, *grain));
    return answer;
}

}  // namespace grainreel
