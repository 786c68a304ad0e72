// Questions about how far grains overlap at a moment that was brought back, and what makes that smaller.
#include <fmt/format.h>
#include <algorithm>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "engine/measure/health.hpp"
#include "engine/questions/contact_questions.hpp"
#include "engine/questions/questions.hpp"

namespace grainreel {

namespace {

// The table of how many pairs touch, how far they overlap, and what is allowed.
AnswerTable touching_pairs_table(const Snapshot& s) {
    const std::vector<DetailedContact>& all = s.forces->contacts;
    double most = 0, sum = 0;
    std::int64_t pushing = 0;
    for (const DetailedContact& one : all) {
        const double share = one.overlap / one.smaller_radius;
        most = std::max(most, share), sum += share;
        pushing += one.normal_force > 0;
    }
    AnswerCell largest, mean;
    if (!all.empty()) largest = most, mean = sum / static_cast<double>(all.size());
    return {
        "touching",
        "All that touch, grains at walls too (shares are of the smaller radius)",
        {{"touching", Dimension::number, "pairs, and grains at walls"},
         {"contacts", Dimension::number, "those of them that push, as in all other answers"},
         {"largest_share", Dimension::number,
          "overlap divided by the smaller radius, as largest_overlap of measures.csv", AnswerColumn::kThere},
         {"mean_share", Dimension::number, "of all that touch", "touching"},
         {"limit_share", Dimension::number, "what run.overlap allows; that is divided by the diameter",
          AnswerColumn::kThere}},
        {{static_cast<std::int64_t>(all.size()), pushing, largest, mean, overlap_limit(s.scene)}},
        true};
}

// The name of a wall that goes its own way, whatever is in its way: it turns, follows a path or has a
// velocity. Empty for all others.
std::string going_its_way(const Scene& scene, const std::string& name) {
    for (const SceneMesh& mesh : scene.meshes)
        if (mesh.name == name && (mesh.turn || !mesh.path_file.empty() || !mesh.velocity.isZero(0)))
            return '"' + name + '"';
    for (const ScenePlane& plane : scene.walls)
        if (plane.name == name && !plane.velocity.isZero(0)) return "the " + name;
    return "";
}

// What makes the largest overlap smaller: a wall that presses on one of its grains is stopped, else contacts
// are made stiffer.
std::string advice_on_overlap(const Snapshot& s, const DetailedContact& largest) {
    for (const DetailedContact& one : s.forces->contacts) {
        if (one.second >= 0 || (one.first != largest.first && one.first != largest.second)) continue;
        const std::string advice = advice_against_press(going_its_way(s.scene, name_of_body(s, one.second)));
        if (!advice.empty()) return advice;
    }
    return "a larger contact.stiffness or a lower run.overlap makes grains stiffer";
}

}  // namespace

std::string overlap_verdict(const Snapshot& s) {
    const double limit = overlap_limit(s.scene);
    const auto share_of = [](const DetailedContact& one) { return one.overlap / one.smaller_radius; };
    const auto beyond = std::count_if(s.forces->contacts.begin(), s.forces->contacts.end(),
                                      [&](const DetailedContact& one) { return share_of(one) > limit; });
    const DetailedContact& largest = *std::max_element(
        s.forces->contacts.begin(), s.forces->contacts.end(),
        [&](const DetailedContact& a, const DetailedContact& b) { return share_of(a) < share_of(b); });
    const double most = share_of(largest);
    if (beyond == 0)
        return fmt::format("within the limit: the largest overlap is {:.3g} of what run.overlap allows",
                           most / limit);
    return fmt::format(
        "beyond the limit: {} of {} that touch overlap more than run.overlap allows, at most {:.3g} times as "
        "much; {}",
        beyond, s.forces->contacts.size(), most / limit, advice_on_overlap(s, largest));
}

Answer largest_overlap_answer(const Snapshot& s, std::size_t most) {
    std::vector<const DetailedContact*> all;
    for (const DetailedContact& one : s.forces->contacts) all.push_back(&one);
    std::sort(all.begin(), all.end(), [](const auto* a, const auto* b) {
        if (a->overlap != b->overlap) return a->overlap > b->overlap;
        return a->first != b->first ? a->first < b->first : a->second < b->second;
    });
    AnswerTable table{
        "overlaps",
        fmt::format("The largest overlaps ({})", overlap_limit_words(s)),
        {{"first", Dimension::number, "id"},
         {"species", Dimension::number, "of the first"},
         {"second", Dimension::number, "id; empty of a wall"},
         {"what", Dimension::number, "species or wall of the second"},
         {"overlap", Dimension::length, ""},
         {"overlap_share", Dimension::number, "of the smaller radius, as largest_overlap of measures.csv"},
         {"normal_force", Dimension::force, ""},
         {"height", Dimension::length, "of the contact above the floor"}},
        {}};
    table.most_of = "overlap";
    all.resize(std::min(all.size(), most));
    for (const DetailedContact* one : all) {
        AnswerCell second;
        if (one->second >= 0) second = static_cast<std::int64_t>(one->second);
        table.rows.push_back({static_cast<std::int64_t>(one->first), name_of_body(s, one->first), second,
                              name_of_body(s, one->second), one->overlap, one->overlap / one->smaller_radius,
                              one->normal_force, (one->point - floor_offset(s.scene, s.frame)).z()});
    }
    Answer answer{{touching_pairs_table(s)}, {}};
    if (most > 0) answer.tables.push_back(std::move(table));
    if (!s.forces->contacts.empty()) answer.notes.push_back(overlap_verdict(s));
    if (s.forces->contacts.empty()) answer.notes.emplace_back("nothing touches");
    return answer;
}

}  // namespace grainreel
