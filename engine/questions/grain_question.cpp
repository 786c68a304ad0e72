// Answers questions about one grain: its columns, its contacts and its balance of forces.
#include <fmt/format.h>

#include "engine/base/error.hpp"
#include "engine/measure/segregation/unlike_neighbours.hpp"
#include "engine/questions/contact_questions.hpp"
#include "engine/questions/expressions/grain_columns.hpp"
#include "engine/questions/questions.hpp"
#include "engine/state/container_faces.hpp"

namespace grainreel {
namespace {

AnswerTable columns_table(const Snapshot& s, std::size_t grain) {
    AnswerTable table{"grain",
                      fmt::format("Grain {}, {}", s.frame.id[grain], name_of_body(s, s.frame.id[grain])),
                      {},
                      {{}}};
    const auto& columns = grain_columns();
    table.has_mean = true;
    for (std::size_t k = 0; k < columns.size(); ++k) {
        if (!s.has(columns[k].needs)) continue;
        const bool says_who = columns[k].is_species || columns[k].name == "id";
        table.columns.push_back({columns[k].name, columns[k].dimension, columns[k].about,
                                 says_who ? AnswerColumn::kKey : AnswerColumn::kThere});
        if (columns[k].is_species) {
            table.rows[0].emplace_back(name_of_body(s, s.frame.id[grain]));
        } else if (columns[k].name == "id") {
            table.rows[0].emplace_back(static_cast<std::int64_t>(s.frame.id[grain]));
        } else {
            table.rows[0].emplace_back(values_of(s, static_cast<int>(k), {grain}).front());
        }
    }
    return table;
}

AnswerTable contacts_table(const Snapshot& s, std::size_t grain) {
    const std::int32_t id = s.frame.id[grain];
    AnswerTable table{"contacts",
                      "What pushes it",
                      {{"partner", Dimension::number, "id; empty of a wall"},
                       {"what", Dimension::number, "species or wall"},
                       {"normal_force", Dimension::force, ""},
                       {"partner_height", Dimension::length, "above the floor"}},
                      {}};
    for (const Link& touch : s.touches) {
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

// The table of contacts with what only a moment that was brought back tells.
AnswerTable pushes_table(const Snapshot& s, std::size_t grain) {
    const std::int32_t id = s.frame.id[grain];
    AnswerTable table{"contacts",
                      fmt::format("What pushes or pulls it (overlaps: {})", overlap_limit_words(s)),
                      {{"partner", Dimension::number, "id; empty of a wall"},
                       {"what", Dimension::number, "species or wall"},
                       {"overlap", Dimension::length, ""},
                       {"overlap_share", Dimension::number, "of the smaller radius"},
                       {"normal_force", Dimension::force, "below 0 where it attracts"},
                       {"tangential_force", Dimension::force, "magnitude"},
                       {"slides", Dimension::number, "whether friction is all used up"},
                       {"torque", Dimension::moment, "magnitude, on this grain"},
                       {"partner_height", Dimension::length, "above the floor"}},
                      {}};
    for (const DetailedContact& one : s.forces->contacts) {
        if ((one.first != id && one.second != id) || !one.pushes()) continue;
        const bool is_first = one.first == id;
        const std::int32_t partner = is_first ? one.second : one.first;
        AnswerCell number, height;
        if (partner >= 0) {
            number = static_cast<std::int64_t>(partner);
            if (const auto place = s.place_of(partner)) height = s.height(*place);
        }
        std::string what = name_of_body(s, partner);
        if (one.triangle >= 0) what += fmt::format(", triangle {}", one.triangle);
        table.rows.push_back({number, what, one.overlap, one.overlap / one.smaller_radius, one.normal_force,
                              one.tangential.norm(), one.slides() ? "yes" : "no",
                              (is_first ? one.torque_on_first : one.torque_on_second).norm(), height});
    }
    return table;
}

AnswerTable forces_table(const Snapshot& s, std::size_t grain) {
    AnswerTable table{
        "forces",
        "What pushes it",
        {{"what", Dimension::number, "", AnswerColumn::kKey},
         {"x", Dimension::force, "", AnswerColumn::kThere},
         {"y", Dimension::force, "", AnswerColumn::kThere},
         {"z", Dimension::force, "", AnswerColumn::kThere},
         {"magnitude", Dimension::force, "with --average the mean of magnitudes", AnswerColumn::kThere}},
        {},
        true};
    const auto add = [&](const char* what, const Vec3& force) {
        table.rows.push_back({what, force.x(), force.y(), force.z(), force.norm()});
    };
    const Vec3 contacts = contact_force_on(s, s.frame.id[grain]), weight = s.mass(grain) * s.scene.gravity;
    add("contacts", contacts);
    add("weight", weight);
    add("sum", contacts + weight);
    if (!s.forces->acceleration.empty())
        add("mass times acceleration", s.mass(grain) * s.forces->acceleration[grain]);
    return table;
}

AnswerTable torque_table(const Snapshot& s, std::size_t grain) {
    const Vec3 sum = contact_torque_on(s, s.frame.id[grain]);
    return {"torque",
            "What turns it, about its centre",
            {{"x", Dimension::moment, "", AnswerColumn::kThere},
             {"y", Dimension::moment, "", AnswerColumn::kThere},
             {"z", Dimension::moment, "", AnswerColumn::kThere},
             {"magnitude", Dimension::moment, "with --average the mean of magnitudes", AnswerColumn::kThere}},
            {{sum.x(), sum.y(), sum.z(), sum.norm()}},
            true};
}

AnswerTable neighbours_table(const Snapshot& s, std::size_t grain) {
    AnswerTable table{"neighbours",
                      "Grains closer than a quarter of the smallest species' diameter",
                      {{"species", Dimension::number, "", AnswerColumn::kKey},
                       {"grains", Dimension::number, "", AnswerColumn::kThere}},
                      {},
                      true};
    const double gap = gap_of_neighbours(s.scene), period = period_of_depth(s.scene.container);
    const Place own{s.frame.position[grain], s.frame.radius[grain]};
    std::vector<std::int64_t> count(s.scene.species.size(), 0);
    for (std::size_t i = 0; i < s.frame.size(); ++i)
        if (i != grain && are_neighbours(own, {s.frame.position[i], s.frame.radius[i]}, gap, period))
            ++count[s.frame.species[i]];
    for (std::size_t k = 0; k < count.size(); ++k) table.rows.push_back({s.scene.species[k].name, count[k]});
    return table;
}

}  // namespace

Vec3 contact_force_on(const Snapshot& s, std::int32_t id) {
    Vec3 sum(0, 0, 0);
    for (const DetailedContact& one : s.forces->contacts) {
        if (one.first == id) sum += one.on_first();
        if (one.second == id) sum += one.on_second();
    }
    return sum;
}

Vec3 contact_torque_on(const Snapshot& s, std::int32_t id) {
    Vec3 sum(0, 0, 0);
    for (const DetailedContact& one : s.forces->contacts) {
        if (one.first == id) sum += one.torque_on_first;
        if (one.second == id) sum += one.torque_on_second;
    }
    return sum;
}

Answer grain_answer(const Snapshot& s, std::int64_t id) {
    const std::optional<std::size_t> grain = s.place_of(id);
    if (!grain)
        throw UserError(s.frame.id.empty()
                            ? "there are no grains at this moment"
                            : fmt::format("no grain has the id {} at this moment; ids go from {} to {}", id,
                                          s.frame.id.front(), s.frame.id.back()));
    Answer answer{{columns_table(s, *grain)}, {}};
    if (s.forces) {
        for (const auto& table : {pushes_table, forces_table, torque_table, neighbours_table})
            answer.tables.push_back(table(s, *grain));
    } else if (s.contacts) {
        answer.tables.push_back(contacts_table(s, *grain));
    }
    if (!s.forces)
        answer.notes.emplace_back(
            "overlaps, tangential forces and torques are not known: they were not brought back");
    return answer;
}

}  // namespace grainreel
