#include "engine/questions/contact_questions.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <optional>

#include "engine/base/error.hpp"
#include "engine/base/rotation.hpp"
#include "engine/measure/health.hpp"
#include "engine/measure/walls/wall_bodies.hpp"
#include "engine/measure/walls/wall_faces.hpp"
#include "engine/questions/questions.hpp"
#include "engine/scene/text/units.hpp"
#include "engine/state/container_faces.hpp"

namespace grainreel {

namespace {

std::string text_of_force(double force) {
    const std::string unit = fitting_unit(force, Dimension::force);
    return fmt::format("{:.3g}\u00a0{}", force / unit_size(unit, Dimension::force), unit);
}

// The point (m) where the grain's surface meets its partner's.
Vec3 point_on(const Snapshot& s, std::size_t grain, const DetailedContact& contact, bool is_first) {
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
    for (const DetailedContact& one : s.forces->contacts) {
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
    for (const DetailedContact* one : pushes_on_wall(s, wall)) {
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

// Questions about the contacts of a moment that was brought back.

namespace {

using Forces = std::vector<const DetailedContact*>;

// The present place (m) of the point about which the moment of force on a wall is taken.
Vec3 point_of_moment(const Snapshot& s, std::int32_t wall) {
    const std::optional<std::size_t> mesh = mesh_of_wall(s.scene, wall);
    if (!mesh) return container_offset(s.scene, s.frame);
    const std::size_t body = static_cast<std::size_t>(first_mesh_body(s.scene)) + *mesh;
    return s.frame.body(body).moved(moment_point(s.scene.meshes[*mesh]));
}

AnswerTable sum_table(const Snapshot& s, std::int32_t wall, const Forces& on_wall) {
    Vec3 force(0, 0, 0), moment(0, 0, 0);
    double normal = 0;
    const Vec3 point = point_of_moment(s, wall);
    for (const DetailedContact* one : on_wall) {
        force += one->on_second();
        moment += (one->point - point).cross(one->on_second());
        normal += one->normal_force;
    }
    double weight = 0;
    for (std::size_t i = 0; i < s.frame.size(); ++i) weight += s.mass(i) * s.scene.gravity.norm();
    const Vec3 down = s.scene.gravity.norm() > 0 ? s.scene.gravity.normalized() : Vec3(0, 0, -1);
    AnswerCell share;
    if (weight > 0) share = force.dot(down) / weight;
    return {
        "wall",
        "What the grains do to it",
        {{"contacts", Dimension::number, "that push"},
         {"force_x", Dimension::force, ""},
         {"force_y", Dimension::force, ""},
         {"force_z", Dimension::force, ""},
         {"normal_force", Dimension::force, "sum of all normal forces"},
         {"moment_x", Dimension::moment,
          mesh_of_wall(s.scene, wall) ? "about a point of its axis, or its position"
                                      : "about the container's origin"},
         {"moment_y", Dimension::moment, ""},
         {"moment_z", Dimension::moment, ""},
         {"weight_share", Dimension::number, "its force along gravity, divided by the weight of all grains"},
         {"force", Dimension::force, "magnitude of the force; with --average the mean of magnitudes"}},
        {{static_cast<std::int64_t>(on_wall.size()), force.x(), force.y(), force.z(), normal, moment.x(),
          moment.y(), moment.z(), share, force.norm()}},
        true};
}

// The pose of a wall's body, if that body can turn or move by itself. Containers that only shake are left
// out: there is a column for the work of all walls.
std::optional<BodyPose> turning_pose(const Snapshot& s, std::int32_t wall) {
    if (const std::optional<std::size_t> mesh = mesh_of_wall(s.scene, wall)) {
        if (!s.scene.meshes[*mesh].moves()) return std::nullopt;
        return s.frame.body(static_cast<std::size_t>(first_mesh_body(s.scene)) + *mesh);
    }
    const std::vector<Face> faces = faces_of(s.scene);
    const auto face = static_cast<std::size_t>(-1 - wall);
    if (!s.scene.container.turn || face >= faces.size() || faces[face].body.number < 0) return std::nullopt;
    if (faces[face].body.number >= kFirstPlaneBody) return std::nullopt;
    return s.frame.body(static_cast<std::size_t>(faces[face].body.number));
}

// A point (m) on the axis about which a body turns now. The body may also move along this axis.
Vec3 centre_of_turn(const BodyPose& pose) {
    const double square = pose.spin.squaredNorm();
    return square > 0 ? Vec3(pose.place + pose.spin.cross(pose.velocity) / square) : pose.place;
}

AnswerTable power_table(const BodyPose& pose, const Forces& on_wall) {
    double power = 0;
    for (const DetailedContact* one : on_wall) power -= one->on_second().dot(pose.velocity_at(one->point));
    const Vec3 axis = pose.spin.norm() > 0 ? Vec3(pose.spin.normalized()) : Vec3(0, 0, 0);
    double torque = 0;
    for (const DetailedContact* one : on_wall)
        torque += axis.dot((one->point - centre_of_turn(pose)).cross(one->on_second()));
    return {
        "motion",
        "It moves",
        {{"torque", Dimension::moment, "of the grains on it, about the axis that it turns about now"},
         {"power", Dimension::power, "that it gives the grains"},
         {"spin", Dimension::spin, "magnitude"},
         {"turned", Dimension::degrees, "from rest, up to half a turn"}},
        {{torque, power, pose.spin.norm(), rotation_vector(pose.rotation).norm() * 180 / std::numbers::pi}},
        true};
}

// Forces on a wall by height, in bins as high as the mean diameter of the grains.
AnswerTable height_table(const Snapshot& s, std::int32_t wall, const Forces& on_wall) {
    AnswerTable table{"by_height",
                      "Its normal force by height above the floor",
                      {{"from", Dimension::length, "", AnswerColumn::kKey},
                       {"to", Dimension::length, "", AnswerColumn::kKey},
                       {"contacts", Dimension::number, ""},
                       {"normal_force", Dimension::force, "sum"},
                       {"pressure", Dimension::pressure, "of a wall that stands"}},
                      {},
                      true};
    const double width = s.bin();
    const bool stands = !mesh_of_wall(s.scene, wall) && !s.scene.container.turn;
    std::map<std::int64_t, std::pair<std::int64_t, double>> bins;
    for (const DetailedContact* one : on_wall) {
        auto& [count, force] =
            bins[std::llround(std::floor((one->point - floor_offset(s.scene, s.frame)).z() / width))];
        ++count;
        force += one->normal_force;
    }
    for (const auto& [bin, sums] : bins) {
        const double low = static_cast<double>(bin) * width, high = static_cast<double>(bin + 1) * width;
        const double area = stands ? area_between(s.scene.container, name_of_body(s, wall), low, high) : 0;
        AnswerCell pressure;
        if (area > 0) pressure = sums.second / area;
        table.rows.push_back({low, high, sums.first, sums.second, pressure});
    }
    return table;
}

AnswerTable touching_table(const Snapshot& s, std::int32_t wall, Forces on_wall, std::size_t most) {
    std::sort(on_wall.begin(), on_wall.end(), [](const auto* a, const auto* b) {
        return a->normal_force != b->normal_force ? a->normal_force > b->normal_force : a->first < b->first;
    });
    AnswerTable table{"touching",
                      on_wall.size() > most
                          ? fmt::format("The {} of {} grains that press most", most, on_wall.size())
                          : "The grains that touch it",
                      {{"id", Dimension::number, ""},
                       {"species", Dimension::number, ""},
                       {"height", Dimension::length, "of the contact above the floor"},
                       {"overlap", Dimension::length, ""},
                       {"normal_force", Dimension::force, ""},
                       {"tangential_force", Dimension::force, "magnitude"},
                       {"slides", Dimension::number, ""}},
                      {}};
    const bool mesh = mesh_of_wall(s.scene, wall).has_value();
    if (mesh)
        table.columns.push_back({"triangle", Dimension::number, "of the mesh, as trajectory.nc has them"});
    on_wall.resize(std::min(on_wall.size(), most));
    for (const DetailedContact* one : on_wall) {
        table.rows.push_back({static_cast<std::int64_t>(one->first), name_of_body(s, one->first),
                              (one->point - floor_offset(s.scene, s.frame)).z(), one->overlap,
                              one->normal_force, one->tangential.norm(), one->slides() ? "yes" : "no"});
        if (mesh) table.rows.back().emplace_back(static_cast<std::int64_t>(one->triangle));
    }
    return table;
}

AnswerTable species_table(const Snapshot& s, const Forces& on_wall) {
    AnswerTable table{"species",
                      "Contacts by species",
                      {{"species", Dimension::number, "", AnswerColumn::kKey},
                       {"contacts", Dimension::number, ""},
                       {"normal_force", Dimension::force, "sum"}},
                      {},
                      true};
    for (std::size_t k = 0; k < s.scene.species.size(); ++k) {
        std::int64_t count = 0;
        double force = 0;
        for (const DetailedContact* one : on_wall) {
            const auto place = s.place_of(one->first);
            if (!place || static_cast<std::size_t>(s.frame.species[*place]) != k) continue;
            ++count;
            force += one->normal_force;
        }
        table.rows.push_back({s.scene.species[k].name, count, force});
    }
    return table;
}

}  // namespace

std::int32_t wall_number(const Snapshot& s, std::string name) {
    std::replace(name.begin(), name.end(), '_', ' ');
    const std::vector<std::string> names = wall_names(s.scene);
    for (std::size_t k = 0; k < names.size(); ++k) {
        std::string known = names[k];
        std::replace(known.begin(), known.end(), '_', ' ');
        if (known == name) return -1 - static_cast<std::int32_t>(k);
    }
    throw UserError(names.empty() ? "the scene has no walls"
                                  : fmt::format("'{}' is no wall of this scene; it has {}", name,
                                                fmt::join(names, ", ")));
}

double overlap_limit(const Scene& scene) {
    return 2 * scene.run.overlap;
}

std::string overlap_limit_words(const Snapshot& s) {
    return fmt::format("run.overlap allows {:.4g} of the smaller radius", overlap_limit(s.scene));
}

std::vector<const DetailedContact*> pushes_on_wall(const Snapshot& s, std::int32_t wall) {
    std::vector<const DetailedContact*> on_wall;
    for (const DetailedContact& one : s.forces->contacts)
        if (one.second == wall && one.pushes()) on_wall.push_back(&one);
    return on_wall;
}

Answer wall_answer(const Snapshot& s, const std::string& name, std::size_t most) {
    const std::int32_t wall = wall_number(s, name);
    const Forces on_wall = pushes_on_wall(s, wall);
    Answer answer{{sum_table(s, wall, on_wall)}, {}};
    if (const std::optional<BodyPose> pose = turning_pose(s, wall))
        answer.tables.push_back(power_table(*pose, on_wall));
    if (on_wall.empty()) {
        answer.notes.emplace_back("no grain touches it");
        return answer;
    }
    answer.tables.push_back(species_table(s, on_wall));
    answer.tables.push_back(height_table(s, wall, on_wall));
    if (most > 0) answer.tables.push_back(touching_table(s, wall, on_wall, most));
    return answer;
}

}  // namespace grainreel
