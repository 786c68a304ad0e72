#include "engine/questions/grain_list.hpp"

#include <algorithm>

#include <fmt/format.h>

namespace grainreel {

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

}  // namespace grainreel
