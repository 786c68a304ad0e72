// Answers the questions without conditions: what there is at one moment, and what changed between two.

#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <numeric>
#include <optional>
#include <string>

#include "engine/base/counted.hpp"
#include "engine/base/error.hpp"
#include "engine/base/mathematics.hpp"
#include "engine/base/numbers.hpp"
#include "engine/base/rotation.hpp"
#include "engine/measure/columns.hpp"
#include "engine/measure/walls/wall_bodies.hpp"
#include "engine/mesh/room.hpp"
#include "engine/mesh/surface.hpp"
#include "engine/questions/contact_questions.hpp"
#include "engine/questions/expressions/grain_columns.hpp"
#include "engine/questions/questions.hpp"
#include "engine/questions/statistics.hpp"
#include "engine/state/container_faces.hpp"

namespace grainreel {

namespace {

AnswerTable moment_table(const Snapshot& s) {
    AnswerTable table{
        "moment",
        "The moment",
        {{"time", Dimension::time, "since the drive started"},
         {"step", Dimension::number, ""},
         {"cycles", Dimension::number, "periods of the drive"},
         {"floor", Dimension::length, "the floor's height against its place at rest"},
         {"grains", Dimension::number, ""},
         {"contacts", Dimension::number, "that push, at walls too; empty where the run kept none"},
         {"touching", Dimension::number, "without a force too; empty of a kept moment"}},
        {}};
    AnswerCell contacts, touching;
    if (s.contacts) contacts = static_cast<std::int64_t>(s.touches.size());
    if (s.forces) touching = static_cast<std::int64_t>(s.forces->contacts.size());
    table.rows.push_back({s.frame.time, s.frame.step, s.frame.cycles, floor_offset(s.scene, s.frame).z(),
                          static_cast<std::int64_t>(s.frame.size()), contacts, touching});
    return table;
}

AnswerTable species_table(const Snapshot& s) {
    AnswerTable table{"species",
                      "By species (kinetic energy with that of rotation: kinetic_J and rotational_J below)",
                      {{"species", Dimension::number, "", AnswerColumn::kKey},
                       {"grains", Dimension::number, ""},
                       {"mass", Dimension::mass, "of all"},
                       {"mean_height", Dimension::length, "above the floor", "grains"},
                       {"lowest", Dimension::length, "", AnswerColumn::kThere},
                       {"highest", Dimension::length, "", AnswerColumn::kThere},
                       {"mean_rise", Dimension::length, "since the run's first moment", "grains"},
                       {"mean_speed", Dimension::speed, "", "grains"},
                       {"kinetic_energy", Dimension::energy, "of all"}},
                      {},
                      true};
    const GrainVocabulary words(s);
    const auto column = [&](const char* name) { return values_of(s, words.find(name)->column); };
    const auto if_known = [&](bool known, const char* name) {
        return known ? column(name) : std::vector<double>(s.frame.size(), kUnknown);
    };
    const bool weighed = masses_known(s);
    const std::vector<double> height = column("height"), rise = column("rise"),
                              speed = if_known(s.velocities, "speed"), mass = if_known(weighed, "mass"),
                              energy = if_known(s.velocities && weighed, "kinetic_energy");
    for (std::size_t k = 0; k < s.scene.species.size(); ++k) {
        const auto of_species = [&](const std::vector<double>& all) {
            std::vector<double> own;
            for (std::size_t i = 0; i < all.size(); ++i)
                if (static_cast<std::size_t>(s.frame.species[i]) == k) own.push_back(all[i]);
            return own;
        };
        // The sum of some is not that of all, so that it is unknown if one of them is.
        const auto sum = [](const std::vector<double>& own) {
            const Statistics of = statistics_of(own);
            return of.count == own.size() ? of.mean * double(of.count) : kUnknown;
        };
        const Statistics heights = statistics_of(of_species(height));
        table.rows.push_back({s.scene.species[k].name, static_cast<std::int64_t>(heights.count),
                              sum(of_species(mass)), heights.mean, heights.least, heights.most,
                              statistics_of(of_species(rise)).mean, statistics_of(of_species(speed)).mean,
                              sum(of_species(energy))});
    }
    return table;
}

// The highest grain that has another one within a tenth of its radius. The highest of all may be in flight.
std::optional<std::size_t> tip_of_bed(const Snapshot& s) {
    std::vector<std::size_t> order(s.frame.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::sort(order.begin(), order.end(), [&](auto a, auto b) { return s.height(a) > s.height(b); });
    for (const std::size_t i : order)
        for (const std::size_t k : order) {
            const double gap =
                (s.frame.position[i] - s.frame.position[k]).norm() - s.frame.radius[i] - s.frame.radius[k];
            if (i != k && gap < 0.1 * s.frame.radius[i]) return i;
        }
    return std::nullopt;
}

AnswerTable extremes_table(const Snapshot& s) {
    AnswerTable table{"extremes",
                      "Who stands out (tip of the bed: the highest grain that has another one beside it)",
                      {{"what", Dimension::number, ""},
                       {"id", Dimension::number, ""},
                       {"species", Dimension::number, ""},
                       {"height", Dimension::length, ""},
                       {"speed", Dimension::speed, ""}},
                      {}};
    const GrainVocabulary words(s);
    const auto add = [&](const char* what, const char* column, bool most) {
        const Statistics of = statistics_of(values_of(s, words.find(column)->column));
        if (of.count == 0) return;
        const std::size_t i = most ? of.where_most : of.where_least;
        table.rows.push_back({what, static_cast<std::int64_t>(s.frame.id[i]), name_of_body(s, s.frame.id[i]),
                              s.height(i), s.frame.velocity[i].norm()});
    };
    add("highest", "height", true);
    if (const auto tip = tip_of_bed(s))
        table.rows.push_back({"tip of the bed", static_cast<std::int64_t>(s.frame.id[*tip]),
                              name_of_body(s, s.frame.id[*tip]), s.height(*tip),
                              s.frame.velocity[*tip].norm()});
    add("lowest", "height", false);
    if (s.velocities) add("fastest", "speed", true);
    if (s.spins) add("fastest spin", "spin", true);
    add("moved most", "moved", true);
    if (s.contacts) add("pressed most", "contact_force", true);
    return table;
}

// The row of a wall at a kept moment, of whose contacts only the normal forces are known here.
std::vector<AnswerCell> kept_wall_row(const Snapshot& s, std::int32_t wall) {
    std::int64_t count = 0;
    double normal = 0;
    for (const Link& touch : s.touches)
        if (touch.second == wall) ++count, normal += touch.force;
    return {name_of_body(s, wall), count, {}, {}, {}, normal};
}

// The table of walls: with forces at a moment that was brought back, else with what the run kept, else
// names alone.
AnswerTable walls_table(const Snapshot& s) {
    AnswerTable table{"walls",
                      "Walls, and the force of the grains on them",
                      {{"wall", Dimension::number, "as --wall has it", AnswerColumn::kKey},
                       {"contacts", Dimension::number, "that push"},
                       {"force_x", Dimension::force, ""},
                       {"force_y", Dimension::force, ""},
                       {"force_z", Dimension::force, ""},
                       {"normal_force", Dimension::force, "sum"}},
                      {},
                      true};
    const std::size_t count = wall_names(s.scene).size();
    for (std::size_t k = 0; k < count; ++k) {
        const auto wall = static_cast<std::int32_t>(-1 - static_cast<std::int64_t>(k));
        if (!s.forces) {
            table.rows.push_back(s.contacts
                                     ? kept_wall_row(s, wall)
                                     : std::vector<AnswerCell>{name_of_body(s, wall), {}, {}, {}, {}, {}});
            continue;
        }
        Vec3 force(0, 0, 0);
        double normal = 0;
        const std::vector<const DetailedContact*> pushes = pushes_on_wall(s, wall);
        for (const DetailedContact* one : pushes) force += one->on_second(), normal += one->normal_force;
        table.rows.push_back({name_of_body(s, wall), static_cast<std::int64_t>(pushes.size()), force.x(),
                              force.y(), force.z(), normal});
    }
    return table;
}

// The table of where the meshes are, and the container if it turns.
AnswerTable bodies_table(const Snapshot& s) {
    AnswerTable table{
        "bodies",
        "Bodies that have a shape of their own, or turn",
        {{"body", Dimension::number, "", AnswerColumn::kKey},
         {"triangles", Dimension::number, "empty of a container of faces", AnswerColumn::kThere},
         {"moved_x", Dimension::length, "of its origin, from rest", AnswerColumn::kThere},
         {"moved_y", Dimension::length, "", AnswerColumn::kThere},
         {"moved_z", Dimension::length, "", AnswerColumn::kThere},
         {"turned", Dimension::degrees, "from rest, up to half a turn", AnswerColumn::kThere},
         {"speed", Dimension::speed, "of its origin", AnswerColumn::kThere},
         {"spin", Dimension::spin, "magnitude", AnswerColumn::kThere}},
        {},
        true};
    const auto add = [&](const std::string& name, AnswerCell triangles, const BodyPose& pose) {
        table.rows.push_back({name, std::move(triangles), pose.place.x(), pose.place.y(), pose.place.z(),
                              rotation_vector(pose.rotation).norm() * 180 / std::numbers::pi,
                              pose.velocity.norm(), pose.spin.norm()});
    };
    if (s.scene.container.turn) add("container", {}, s.frame.container());
    for (std::size_t m = 0; m < s.scene.meshes.size(); ++m) {
        const SceneMesh& mesh = s.scene.meshes[m];
        add(mesh.name, static_cast<std::int64_t>(mesh.surface->size()),
            s.frame.body(static_cast<std::size_t>(first_mesh_body(s.scene)) + m));
    }
    return table;
}

// The first clause of a column's text in the documentation, without links to other places.
std::string in_short(std::string about) {
    about.erase(std::min(about.size(), about.find(';')));
    if (const std::size_t link = about.find(" (see ["); link != std::string::npos) about.erase(link);
    std::erase(about, '`');
    return about;
}

// What the run's observers measured: energies, segregation, how the bed stands. What has no value is left
// out.
AnswerTable measured_table(const Snapshot& s, const MeasuredRow& row) {
    AnswerTable table{"measured",
                      fmt::format("Measured at {:.6g} s", row.time),
                      {{"quantity", Dimension::number, "a column of measures.csv", AnswerColumn::kKey},
                       {"value", Dimension::number, "in the column's unit, or SI", AnswerColumn::kThere},
                       {"about", Dimension::number, "", AnswerColumn::kKey},
                       {"more", Dimension::number, "", AnswerColumn::kKey}},
                      {},
                      true};
    table.mean_title = "Measured";
    // The table of the species has the centres already, and this table's title has the time of the row.
    const auto said_already = [](const std::string& name) {
        return name == "step" || name == "time_s" || name == "cycles" || name.starts_with("phase") ||
               name.find("centre_") != std::string::npos;
    };
    std::map<std::string, std::string> labels, abouts;
    for (const ObserverColumns& entry : observer_columns())
        for (const ColumnGroup& group : entry.groups(s.scene))
            for (const MeasureColumn& column : group.columns) {
                labels[column.name] = column.label;
                abouts[column.name] = in_short(group.about);
            }
    for (std::size_t k = 0; k < row.columns.size(); ++k) {
        const std::string& name = row.columns[k];
        if (said_already(name) || !std::isfinite(row.values[k])) continue;
        if (name == "largest_overlap") abouts[name] += "; " + overlap_limit_words(s);
        table.rows.push_back({name, row.values[k], labels[name], abouts[name]});
    }
    return table;
}

// Whether the grain's centre is outside the room that the vessel encloses, by more than its radius from the
// surface. Above the rim a grain may be anywhere.
bool outside_mesh(const Snapshot& s, std::size_t i) {
    const std::optional<std::size_t> vessel = vessel_of(s.scene);
    if (!vessel) return false;
    const Container& c = s.scene.container;
    const std::size_t body = static_cast<std::size_t>(first_mesh_body(s.scene)) + *vessel;
    const Vec3 at = s.frame.body(body).at_rest(s.frame.position[i]);
    if (at.z() > c.room->top()) return false;
    return !c.room->holds(at) && !s.scene.meshes[*vessel].surface->any_within(at, s.frame.radius[i]);
}

// Whether a grain is behind a face of a container that turns.
bool outside_turned(const Snapshot& s, std::size_t i) {
    const Vec3 at = s.frame.container().at_rest(s.frame.position[i]);
    for (const Face& face : container_faces(s.scene.container, s.scene.drive))
        if (distance_to(face, Vec3(0, 0, 0), at).distance < -s.frame.radius[i]) return true;
    return false;
}

// Whether a grain is outside the container.
bool outside(const Snapshot& s, std::size_t i) {
    const Container& c = s.scene.container;
    if (c.shape == Container::Shape::none) return false;
    const double r = s.frame.radius[i];
    if (c.shape == Container::Shape::mesh) return outside_mesh(s, i);
    if (c.turn) return outside_turned(s, i);
    const Vec3 at = s.frame.position[i] - container_offset(s.scene, s.frame);
    if (s.height(i) < -r) return true;
    if (c.shape == Container::Shape::cylinder) return math::hypot(at.x(), at.y()) > c.half_width + r;
    return std::abs(at.y()) > c.half_width + r;
}

}  // namespace

Answer overview_of(const Snapshot& s) {
    Answer answer{{moment_table(s), species_table(s), extremes_table(s)}, {}};
    if (!s.scene.meshes.empty() || s.scene.container.turn) answer.tables.push_back(bodies_table(s));
    if (AnswerTable walls = walls_table(s); !walls.rows.empty()) answer.tables.push_back(std::move(walls));
    if (s.measured) answer.tables.push_back(measured_table(s, *s.measured));
    std::size_t out = 0, no_velocity = 0, no_spin = 0;
    for (std::size_t i = 0; i < s.frame.size(); ++i) {
        out += outside(s, i);
        no_velocity += s.velocities && !s.frame.velocity[i].allFinite();
        no_spin += s.spins && !s.frame.spin[i].allFinite();
    }
    if (out > 0) answer.notes.push_back(fmt::format("outside the container: {}", counted(out, "grain")));
    for (const auto& [what, count] : {std::pair("velocity", no_velocity), {"spin", no_spin}})
        if (count > 0)
            answer.notes.push_back(fmt::format("with a {} that is not known: {}; they are in no mean", what,
                                               counted(count, "grain")));
    if (!s.contacts)
        answer.notes.emplace_back(
            "contacts of a kept moment are not known; --grain, --wall and --largest-overlap bring it back");
    else if (!s.forces)
        answer.notes.emplace_back(
            "contacts are those that the run kept, which have no directions; --wall brings the moment back "
            "with "
            "them");
    return answer;
}

namespace {

struct Way {
    std::size_t grain = 0;  // place in the later frame
    Vec3 moved{0, 0, 0};    // m, in the container's frame
};

std::vector<Way> ways_between(const Snapshot& before, const Snapshot& after) {
    const double period = period_of_depth(after.scene.container);
    const Vec3 carried =
        container_offset(after.scene, after.frame) - container_offset(before.scene, before.frame);
    std::vector<Way> ways;
    for (std::size_t i = 0; i < after.frame.size(); ++i) {
        const auto then = before.place_of(after.frame.id[i]);
        if (!then) continue;
        Vec3 moved = after.frame.position[i] - before.frame.position[*then] - carried;
        if (std::abs(moved.x()) < 1.5 * period) moved.x() = nearest_image(moved.x(), period);
        ways.push_back({i, moved});
    }
    return ways;
}

AnswerTable statistics_table(const Snapshot& after, const std::vector<Way>& ways) {
    AnswerTable table{"ways",
                      "Ways of the grains in the container's frame",
                      {{"species", Dimension::number},
                       {"grains", Dimension::number, "that are there at both moments"},
                       {"mean", Dimension::length},
                       {"most", Dimension::length},
                       {"mean_up", Dimension::length},
                       {"deviation_up", Dimension::length, "standard deviation of the sample"}},
                      {}};
    for (std::size_t k = 0; k < after.scene.species.size(); ++k) {
        std::vector<double> length, up;
        for (const Way& way : ways) {
            if (static_cast<std::size_t>(after.frame.species[way.grain]) != k) continue;
            length.push_back(way.moved.norm());
            up.push_back(way.moved.z());
        }
        const Statistics lengths = statistics_of(length), ups = statistics_of(up);
        table.rows.push_back({after.scene.species[k].name, static_cast<std::int64_t>(lengths.count),
                              lengths.mean, lengths.most, ups.mean, ups.deviation});
    }
    return table;
}

}  // namespace

Answer compare_answer(const Snapshot& before, const Snapshot& after, std::size_t most) {
    std::vector<Way> ways = ways_between(before, after);
    if (ways.empty()) throw UserError("no grain is there at both moments");
    Answer answer{{statistics_table(after, ways)}, {}};
    std::stable_sort(ways.begin(), ways.end(),
                     [](const Way& a, const Way& b) { return a.moved.norm() > b.moved.norm(); });
    AnswerTable list{"moved_most",
                     fmt::format("The {} that moved most", std::min(most, ways.size())),
                     {{"id", Dimension::number},
                      {"species", Dimension::number},
                      {"way", Dimension::length},
                      {"up", Dimension::length},
                      {"height", Dimension::length, "at the later moment"}},
                     {}};
    for (std::size_t k = 0; k < std::min(most, ways.size()); ++k) {
        const std::size_t i = ways[k].grain;
        list.rows.push_back({static_cast<std::int64_t>(after.frame.id[i]),
                             name_of_body(after, after.frame.id[i]), ways[k].moved.norm(), ways[k].moved.z(),
                             after.height(i)});
    }
    if (!list.rows.empty()) answer.tables.push_back(std::move(list));
    return answer;
}

}  // namespace grainreel
