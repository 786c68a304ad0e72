#include "engine/step/lists/contact_rules.hpp"

#include <algorithm>

namespace grainreel {
namespace {

bool all_kinds_equal(const LawParameters& p) {
    for (std::size_t row = 0; row < p.values.size(); row += p.kinds) {
        const auto begin = p.values.begin() + row;
        if (std::any_of(begin, begin + p.kinds, [&](double v) { return v != *begin; })) return false;
    }
    return true;
}

LawParameters of_first_kind(const LawParameters& p) {
    LawParameters first;
    first.kinds = 1;
    for (std::size_t row = 0; row < p.values.size(); row += p.kinds) first.add(p.values[row]);
    return first;
}

// Merges kinds that do not differ, so that parameters need not be looked up by kind.
void merge_equal_kinds(ContactGroup& group) {
    if (!all_kinds_equal(group.parameters) || !all_kinds_equal(group.rolling_parameters)) return;
    group.parameters = of_first_kind(group.parameters);
    group.rolling_parameters = of_first_kind(group.rolling_parameters);
    std::fill(group.row.begin(), group.row.end(), 0);
}

// Adds the groups of these kinds, which are all kinds of contact between grains, with walls, with glued
// grains or with meshes. Returns the group of each kind.
std::vector<std::int32_t> add_groups(const std::vector<PairPlan>& kinds, bool of_pairs,
                                     std::vector<ContactGroup>& groups) {
    const std::size_t begin = groups.size();
    std::vector<std::int32_t> group_of;
    std::vector<std::vector<PairPlan>> members;
    for (std::size_t kind = 0; kind < kinds.size(); ++kind) {
        const ContactModel& model = kinds[kind].model;
        std::size_t g = begin;
        while (g < groups.size() && !(groups[g].model == model)) ++g;
        if (g == groups.size()) {
            ContactGroup group{};
            group.model = model;
            group.law = &law_kernel(model);
            group.rolling = model.rolls ? &rolling_kernel(model.precision) : nullptr;
            group.of_pairs = of_pairs;
            group.row.assign(kinds.size(), 0);
            groups.push_back(group);
            members.emplace_back();
        }
        groups[g].row[kind] = static_cast<std::int32_t>(members[g - begin].size());
        members[g - begin].push_back(kinds[kind]);
        group_of.push_back(static_cast<std::int32_t>(g));
    }
    for (std::size_t g = begin; g < groups.size(); ++g) {
        ContactGroup& group = groups[g];
        group.parameters = group.law->parameters(members[g - begin]);
        if (group.rolling) group.rolling_parameters = group.rolling->parameters(members[g - begin]);
        merge_equal_kinds(group);
    }
    return group_of;
}

}  // namespace

bool ContactGroup::turns(int number) const {
    if (number >= law_size()) return false;  // a wall never changes places
    return number < law->history_size ? law->turns[number] : rolling->turns[number - law->history_size];
}

ContactRules::ContactRules(const Plan& plan, double period_of_x)
    : species(static_cast<std::int32_t>(plan.wall.size())),
      arms(plan.arms),
      period(period_of_x),
      rubs(plan.rubs()) {
    group_of_pair = add_groups(plan.grain, true, groups);
    const auto any_of_floats = [this] {
        return std::any_of(groups.begin(), groups.end(),
                           [](const ContactGroup& group) { return group.number_size() == sizeof(float); });
    };
    rounds = any_of_floats();
    group_of_wall = add_groups(plan.wall, false, groups);
    const std::size_t before_glued = groups.size();
    group_of_glued = add_groups(plan.glued, false, groups);
    for (std::size_t g = before_glued; g < groups.size(); ++g) groups[g].of_glued = true;
    const std::size_t before_meshes = groups.size();
    group_of_mesh = add_groups(plan.mesh, false, groups);
    for (std::size_t g = before_meshes; g < groups.size(); ++g) groups[g].of_mesh = true;
    has_floats = any_of_floats();
}

}  // namespace grainreel
