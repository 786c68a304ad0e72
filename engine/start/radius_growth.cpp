#include "engine/start/radius_growth.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "engine/base/error.hpp"
#include "engine/base/lists.hpp"
#include "engine/base/random.hpp"
#include "engine/mesh/surface.hpp"
#include "engine/start/starting_room.hpp"
#include "engine/step/grid/neighbours.hpp"
#include "engine/step/step_loop.hpp"

namespace grainreel {

namespace {

constexpr double kInflation = 1 + 1e-4;  // grains grow a little too large, then shrink clear of each other
constexpr double kFirstShare = 0.5;      // share of the distance to the nearest centre, for the first radii
constexpr double kGrowthPerCycle = 0.02;
constexpr int kStepsPerCycle = 40;
constexpr std::int64_t kMostCycles = 5000;
constexpr std::int64_t kPatience =
    200;                              // cycles after which grains that are stuck at a mesh are put elsewhere
constexpr double kRestitution = 0.3;  // a plastic contact law lets the crowd come to rest

// The scene's laws, plastic and without friction.
Plan growth_plan(const Plan& plan) {
    Plan growth = plan;
    growth.integrator = Integrator::velocity_verlet;
    for (auto* table : {&growth.grain, &growth.wall, &growth.glued, &growth.mesh}) {
        for (PairPlan& pair : *table) {
            pair.model = {NormalForce::walton_braun, TangentialLaw::none, false};
            pair.restitution = kRestitution;
            pair.unloading_stiffness = pair.loading_stiffness / (kRestitution * kRestitution);
        }
    }
    return growth;
}

// A stable step (s) for the stiff, plastic contacts (Verlet, dt < 2/w, with twelve contacts a grain).
double growth_step(const Plan& growth, const Grains& grains) {
    double stiffest = 0;
    for (const auto* table : {&growth.grain, &growth.wall, &growth.glued, &growth.mesh}) {
        for (const PairPlan& pair : *table) stiffest = std::max(stiffest, pair.unloading_stiffness);
    }
    double lightest = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < grains.size(); ++i) lightest = std::min(lightest, grains.mass(i));
    return 0.3 * std::sqrt(lightest / stiffest);
}

struct Growing {
    const Scene& scene;
    const Surroundings& around;
    Grains& grains;
    std::vector<double> wanted;            // m, by id
    std::optional<Random> other_places{};  // for grains that cannot stay where they are

    double wanted_of(std::size_t i) const { return wanted[grains.id[i]]; }
    void set_radius(std::size_t i, double r) {
        grains.set_radius(i, r, scene.species[grains.species[i]].density);
    }
};

// Sets the first radii. A share of the distance to the nearest centre is divided between the two grains in
// proportion to their wanted radii. No radius is larger than the distance to a wall, nor smaller than a tenth
// of the wanted radius.
void first_radii(Growing& g, double reach) {
    Team alone(1);
    Cells cells;
    NeighbourList list;
    std::vector<std::int32_t> new_index;
    put_in_order({alone, 0}, cells, g.grains, reach, g.around.period, new_index);
    list_pairs(cells, g.grains, reach, g.around.period, 0, static_cast<std::int32_t>(g.grains.size()), list);
    std::vector<double> allowed(g.grains.size());
    const GluedSearch glued(g.around.glued, g.around.faces, g.around.period);
    for (std::size_t i = 0; i < allowed.size(); ++i) {
        allowed[i] = g.wanted_of(i) * kInflation;
        for (const Face& face : g.around.faces) {
            const double distance = distance_to(face, Vec3::Zero(), g.grains.place[i].position).distance;
            allowed[i] = std::min(allowed[i], std::max(distance, 0.1 * g.wanted_of(i)));
        }
        for (const MeshWall& mesh : g.around.meshes) {
            const Vec3 place = mesh.body.at(DrivePose()).at_rest(g.grains.place[i].position);
            const auto nearest = mesh.surface->nearest(place, allowed[i]);
            if (!nearest) continue;
            allowed[i] =
                std::min(allowed[i], std::max(std::sqrt(nearest->point.squared), 0.1 * g.wanted_of(i)));
        }
        glued.near(g.grains.place[i].position, allowed[i], DrivePose(), [&](std::int32_t, double gap) {
            allowed[i] = std::min(allowed[i], std::max(gap, 0.1 * g.wanted_of(i)));
        });
    }
    for (std::size_t i = 0; i + 1 < list.start.size(); ++i) {
        for (std::int32_t slot = list.start[i]; slot < list.start[i + 1]; ++slot) {
            const std::size_t j = list.partner[slot];
            Vec3 apart = g.grains.place[j].position - g.grains.place[i].position;
            apart.x() = nearest_image(apart.x(), g.around.period);
            const double share = kFirstShare * apart.norm() / (g.wanted_of(i) + g.wanted_of(j));
            allowed[i] = std::min(allowed[i], std::max(share, 0.1) * g.wanted_of(i));
            allowed[j] = std::min(allowed[j], std::max(share, 0.1) * g.wanted_of(j));
        }
    }
    for (std::size_t i = 0; i < allowed.size(); ++i) g.set_radius(i, allowed[i]);
}

// The largest overlap, divided by the smaller of the two present radii.
double largest_overlap(const StepLoop& loop) {
    double largest = 0;
    loop.visit_contacts(
        -1, [&](const ContactView& c) { largest = std::max(largest, c.overlap / c.smaller_radius); });
    return largest;
}

std::vector<Vec3> places_by_id(const Grains& grains) {
    std::vector<Vec3> places(grains.size());
    for (std::size_t i = 0; i < grains.size(); ++i) places[grains.id[i]] = grains.place[i].position;
    return places;
}

// Gives the grains their wanted radii, at rest.
void come_to_rest(Growing& g) {
    Grains& grains = g.grains;
    for (std::size_t i = 0; i < grains.size(); ++i) {
        g.set_radius(i, g.wanted_of(i));
        grains.motion[i].velocity.setZero();
        grains.motion[i].spin.setZero();
        grains.load[i] = {};
    }
}

// Puts the grains back to where they were before their radii grew.
void begin_again(Growing& g, const std::vector<Vec3>& places) {
    for (std::size_t i = 0; i < places.size(); ++i) g.grains.place[i].position = places[g.grains.id[i]];
    come_to_rest(g);
}

// Whether a grain was thrown so far away that it never comes back, or is nowhere.
bool any_lost(const Grains& grains) {
    constexpr double kFar = 1e6;  // m
    return std::any_of(grains.place.begin(), grains.place.end(),
                       [](const Place& place) { return !(place.position.cwiseAbs().maxCoeff() < kFar); });
}

// Names the grain that overlaps most, and what it touches. A grain between walls does not get out by growth.
RunError still_overlap(const Growing& g, const StepLoop& loop, const GrowthReport& report) {
    std::vector<ContactView> all;
    loop.visit_contacts(-1, [&](const ContactView& c) { all.push_back(c); });
    const auto share = [](const ContactView& c) { return c.overlap / c.smaller_radius; };
    const auto worst = std::max_element(all.begin(), all.end(),
                                        [&](const auto& a, const auto& b) { return share(a) < share(b); });
    if (worst == all.end()) return RunError("{}: the grains do not grow", g.scene.where("species"));
    const auto grain = static_cast<std::size_t>(worst->first);
    std::vector<std::string> walls;
    for (const ContactView& c : all) {
        if (c.first != worst->first || c.second >= 0) continue;
        const std::string name = wall_name(g.around, -1 - c.second);
        if (!contains(walls, name)) walls.push_back(name);
    }
    const std::string cycles = fmt::format("after {} cycles of radius growth", report.cycles);
    if (walls.empty())
        return RunError(
            "{}: the grains still overlap by {:.2g} radii {}; take fewer or smaller grains, "
            "or a larger container",
            g.scene.where("species"), share(*worst), cycles);
    return RunError(
        "{}: grain {} still overlaps {} by {:.2g} radii {}; take start.method = \"rain\", a "
        "wider gap there, or fewer or smaller grains",
        g.scene.where("species"), g.grains.id[grain], fmt::join(walls, " and "), share(*worst), cycles);
}

// The grains that are stuck between a mesh and a wall that faces it, which growth cannot push out; by id.
std::vector<std::size_t> stuck_grains(const Growing& g, const StepLoop& loop) {
    constexpr double kPressed = 0.01, kFacing = -0.85;  // of the radius; cosine
    std::vector<ContactView> at_walls;
    loop.visit_contacts(-1, [&](const ContactView& c) {
        if (c.second < 0 && c.overlap > kPressed * c.smaller_radius) at_walls.push_back(c);
    });
    const auto is_mesh = [&](const ContactView& c) { return -1 - c.second >= std::ssize(g.around.faces); };
    std::vector<std::size_t> stuck;
    for (const ContactView& one : at_walls)
        if (is_mesh(one) && std::any_of(at_walls.begin(), at_walls.end(), [&](const ContactView& other) {
                return other.first == one.first && other.normal.dot(one.normal) < kFacing;
            }))
            stuck.push_back(static_cast<std::size_t>(one.first));
    std::sort(stuck.begin(), stuck.end(),
              [&](std::size_t i, std::size_t j) { return g.grains.id[i] < g.grains.id[j]; });
    stuck.erase(std::unique(stuck.begin(), stuck.end()), stuck.end());
    return stuck;
}

// Puts stuck grains elsewhere in the bed, where they grow again.
void move_stuck_grains(Growing& g, const StepLoop& loop) {
    const std::vector<std::size_t> stuck = stuck_grains(g, loop);
    if (stuck.empty()) return;
    if (!g.other_places) g.other_places.emplace(g.scene.run.seed + 1, Stream::centres);
    const StartingRoom room(g.scene);
    const double bottom = room.space.height_of_share(0), top = room.space.height_of_share(room.filled);
    for (const std::size_t i : stuck) {
        const double radius = g.wanted_of(i), margin = std::min(0.5 * radius, 0.25 * (top - bottom));
        g.grains.place[i].position = room.random_centre(bottom, top, margin, radius, *g.other_places);
        g.grains.motion[i].velocity.setZero();
        g.set_radius(i, 0.1 * radius);
    }
}

// Grows the radii. Small grains are light: with the step of grains of full size they fly apart where they
// overlap. by_mass_now: the step follows the present masses, which takes longer. Returns nothing if grains
// were lost.
std::optional<GrowthReport> grow(Growing& g, const Plan& growth, Team& team, bool by_mass_now,
                                 const std::function<bool(double, std::int64_t)>& watcher) {
    Grains& grains = g.grains;
    double step = growth_step(growth, grains);
    first_radii(g, g.around.skin);
    StepLoop loop(growth, g.around, grains, team);
    GrowthReport report;
    std::int64_t grown = 0;  // cycles since all grains have their size
    for (;; ++report.cycles) {
        double smallest_share = 1;
        for (std::size_t i = 0; i < grains.size(); ++i) {
            const double full = g.wanted_of(i) * kInflation;
            const double radius = std::min(full, grains.place[i].radius * (1 + kGrowthPerCycle));
            smallest_share = std::min(smallest_share, radius / full);
            g.set_radius(i, radius);
        }
        loop.restart();
        if (by_mass_now) step = growth_step(growth, grains);
        const double drag = 0.05 / step;  // overdamped: grains creep apart, they do not fly
        loop.run(0, kStepsPerCycle, step, drag);
        report.steps += kStepsPerCycle;
        if (!watcher(smallest_share, report.steps)) {
            report.finished = false;
            return report;
        }
        if (any_lost(grains)) return std::nullopt;
        if (smallest_share >= 1 && largest_overlap(loop) < 0.5 * (kInflation - 1)) return report;
        grown = smallest_share >= 1 ? grown + 1 : 0;
        if (!g.around.meshes.empty() && grown > kPatience) {
            grown = 0;
            move_stuck_grains(g, loop);
        }
        if (report.cycles > kMostCycles) throw still_overlap(g, loop, report);
    }
}

}  // namespace

GrowthReport grow_radii(const Scene& scene, const Plan& plan, const Surroundings& surroundings,
                        Grains& grains, Team& team,
                        const std::function<bool(double, std::int64_t)>& watcher) {
    const Plan growth = growth_plan(plan);
    Surroundings still = surroundings;
    still.gravity.setZero();
    Growing g{scene, still, grains, std::vector<double>(grains.size())};
    for (std::size_t i = 0; i < grains.size(); ++i) g.wanted[grains.id[i]] = grains.place[i].radius;
    const std::vector<Vec3> placed = places_by_id(grains);
    // A plane mostly pushes back a grain that flew through it, but a sheet of triangles does not. A small
    // grain between glued grains is thrown from one to the other, faster each time.
    std::optional<GrowthReport> report;
    if (still.meshes.empty()) report = grow(g, growth, team, false, watcher);
    if (!report) {
        begin_again(g, placed);
        report = grow(g, growth, team, true, watcher);
    }
    if (!report)
        throw RunError(
            "{}: the grains find no room where they start, and fly apart while their "
            "radii grow; take fewer or smaller grains, or method = \"rain\"",
            scene.where("start"));
    if (!report->finished) return *report;
    come_to_rest(g);
    return *report;
}

}  // namespace grainreel
