#include "engine/questions/answer_forces.hpp"

#include <fmt/format.h>
#include <algorithm>

#include "engine/scene/text/units.hpp"

namespace grainreel {

namespace {

std::string text_of_force(double force) {
    const std::string unit = fitting_unit(force, Dimension::force);
    return fmt::format("{:.3g}\u00a0{}", force / unit_size(unit, Dimension::force), unit);
}

// m, where the grain's surface meets its partner's.
Vec3 point_on(const Snapshot& s, std::size_t grain, const ContactForce& contact, bool is_first) {
    const double reach = s.frame.radius[grain] - 0.5 * contact.overlap;
    return s.frame.position[grain] + (is_first ? reach : -reach) * contact.normal;
}

std::string words_about(const std::string& what, const std::vector<PointForce>& forces) {
    double strongest = 0;
    for (const PointForce& one : forces) strongest = std::max(strongest, one.force.norm());
    return fmt::format("forces on {}\n{} contact{}\nlongest arrow {}", what, forces.size(),
                       forces.size() == 1 ? "" : "s", text_of_force(strongest));
}

}  // namespace

AnswerForces forces_on_grain(const Snapshot& s, std::int64_t id) {
    AnswerForces answer;
    const std::optional<std::size_t> grain = s.place_of(id);
    if (!grain) return answer;
    answer.grains = {s.frame.id[*grain]};
    const std::string name = fmt::format("grain {}", id);
    if (!s.forces) {
        answer.words = fmt::format(
            "forces on {} are not known"
            "\nnot brought back",
            name);
        return answer;
    }
    for (const ContactForce& one : s.forces->contacts) {
        if ((one.first != id && one.second != id) || !one.pushes()) continue;
        const bool is_first = one.first == id;
        const Vec3 force = is_first ? one.on_first() : one.on_second();
        answer.forces.push_back(
            {point_on(s, *grain, one, is_first), force, one.normal_force < 0, s.frame.position[*grain]});
    }
    answer.words =
        answer.forces.empty() ? fmt::format("nothing touches {}", name) : words_about(name, answer.forces);
    const double weight = s.mass(*grain) * s.scene.gravity.norm();
    if (weight > 0) answer.words += fmt::format("\nits weight {}", text_of_force(weight));
    return answer;
}

AnswerForces forces_on_wall(const Snapshot& s, const std::string& name) {
    AnswerForces answer;
    const std::int32_t wall = wall_number(s, name);
    for (const ContactForce* one : pushes_on_wall(s, wall)) {
        const std::optional<std::size_t> grain = s.place_of(one->first);
        if (!grain) continue;
        answer.grains.push_back(one->first);
        answer.forces.push_back({point_on(s, *grain, *one, true), one->on_second(), one->normal_force < 0,
                                 s.frame.position[*grain]});
    }
    std::sort(answer.grains.begin(), answer.grains.end());
    answer.grains.erase(std::unique(answer.grains.begin(), answer.grains.end()), answer.grains.end());
    const std::string what = name_of_body(s, wall);
    answer.words =
        answer.forces.empty() ? fmt::format("no grain touches {}", what) : words_about(what, answer.forces);
    return answer;
}

}  // namespace grainreel
