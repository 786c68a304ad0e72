#include "engine/start/bed_in_file.hpp"

#include <algorithm>
#include <cmath>

#include "engine/base/error.hpp"
#include "engine/base/mathematics.hpp"
#include "engine/measure/columns.hpp"
#include "engine/measure/energy.hpp"
#include "engine/mesh/surface.hpp"
#include "engine/scene/bed.hpp"
#include "engine/scene/scene_file.hpp"
#include "engine/start/held_histories.hpp"
#include "engine/start/restart.hpp"
#include "engine/start/start_file.hpp"
#include "engine/step/step_loop.hpp"
#include "engine/step/surroundings.hpp"

namespace grainreel {

namespace {

constexpr double kRestsBelow = 1e-4;     // in m g d: mean kinetic energy of a grain
constexpr double kNobodyAbove = 0.05;    // in m g d: kinetic energy of a single grain
constexpr double kFewestTouching = 0.5;  // share of the grains

// A plan in which contacts are mere springs. It serves a loop that only finds contacts and makes no step.
Plan plan_to_look(const Scene& scene) {
    PairPlan spring;
    spring.model.normal = NormalForce::spring_dashpot;
    spring.model.tangential = TangentialLaw::none;
    spring.loading_stiffness = spring.unloading_stiffness = 1;
    const std::size_t count = scene.species.size();
    Plan plan;
    plan.grain.assign(count * count, spring);
    plan.wall.assign(count, spring);
    if (scene.container.wall_grains) plan.glued.assign(count, spring);
    plan.mesh.assign(scene.meshes.size() * count, spring);
    plan.clock.step = 1;
    return plan;
}

double effective_radius(const BedInFile& bed, const Surroundings& around, const ContactView& c) {
    const double first = bed.grains.place[c.first].radius;
    if (c.second < 0 && c.glued < 0) return first;
    const double second =
        c.second >= 0 ? bed.grains.place[c.second].radius : around.glued.place[c.glued].radius;
    return first * second / (first + second);
}

// Finds all overlaps of the bed. The grains are in another order afterwards.
void find_overlaps(const Scene& scene, BedInFile& bed) {
    const Plan plan = plan_to_look(scene);
    Surroundings around = make_surroundings(scene, plan);
    Team alone(1);
    StepLoop loop(plan, around, bed.grains, alone);
    loop.restart();
    const WeightSums moments(scene.gravity, bed.grains);
    bed.moment_of_weights = moments.of_weights();
    loop.visit_contacts(-1, [&](const ContactView& c) {
        bed.overlaps.push_back({static_cast<std::size_t>(c.first), c.second, c.glued >= 0, c.overlap,
                                effective_radius(bed, around, c), moments.carried(c)});
    });
}

// The share of grains that touch something. The grains may be in any order.
double share_touching(const BedInFile& bed) {
    std::vector<bool> touches(bed.grains.size(), false);
    for (const BedInFile::Overlap& overlap : bed.overlaps) {
        touches[overlap.first] = true;
        if (overlap.second >= 0) touches[overlap.second] = true;
    }
    const auto count = std::count(touches.begin(), touches.end(), true);
    return static_cast<double>(count) / static_cast<double>(touches.size());
}

bool same_face(const Face& one, const Face& other) {
    return one.kind == other.kind && one.point == other.point && one.normal == other.normal &&
           one.radius == other.radius;
}

// Whether the faces that grains touched in the file's run are still there.
bool faces_stay(const std::vector<Face>& before, const std::vector<Face>& now, const Grains& grains) {
    return std::all_of(before.begin(), before.end(), [&](const Face& face) {
        const auto touches = [&](const Place& p) {
            return distance_to(face, Vec3::Zero(), p.position).distance < p.radius;
        };
        if (std::none_of(grains.place.begin(), grains.place.end(), touches)) return true;
        return std::any_of(now.begin(), now.end(), [&](const Face& other) { return same_face(face, other); });
    });
}

// Whether the meshes that grains touched are still there: files with the same content, in the same place.
bool meshes_stay(const std::vector<MeshWall>& before, const std::vector<MeshWall>& now,
                 const Grains& grains) {
    return std::all_of(before.begin(), before.end(), [&](const MeshWall& mesh) {
        const auto touches = [&](const Place& p) { return mesh.surface->any_within(p.position, p.radius); };
        if (std::none_of(grains.place.begin(), grains.place.end(), touches)) return true;
        return std::any_of(now.begin(), now.end(), [&](const MeshWall& other) {
            return mesh.surface->hash() == other.surface->hash();
        });
    });
}

std::string what_moves(const Scene& scene, const BedInFile& bed) {
    const Grains& grains = bed.grains;
    const double gravity = scene.gravity.norm();
    if (gravity == 0) return "without gravity no bed rests";
    double energy = 0, unit = 0, most = 0;
    for (std::size_t i = 0; i < grains.size(); ++i) {
        const Motion& motion = grains.motion[i];
        const double own = 0.5 * grains.mass(i) * motion.velocity.squaredNorm() +
                           0.5 * grains.inertia(i) * motion.spin.squaredNorm();
        const double its_unit = grains.mass(i) * gravity * 2 * grains.place[i].radius;
        energy += own, unit += its_unit;
        most = std::max(most, own / its_unit);
    }
    if (energy > kRestsBelow * unit || most > kNobodyAbove) return "the bed in the file moves";
    if (share_touching(bed) < kFewestTouching) return "most grains in the file touch nothing";
    if (!bed.origin) return "";
    const StartOrigin& origin = *bed.origin;
    if (origin.walls_moved()) return "the container had moved when the file was written";
    if (origin.scene.gravity != scene.gravity) return "gravity is not that of the file's run";
    const Surroundings here = make_surroundings(scene, plan_to_look(scene));
    if (here.period != origin.around.period || !same_glued_grains(here.glued, origin.around.glued) ||
        !faces_stay(origin.around.faces, here.faces, grains) ||
        !meshes_stay(origin.around.meshes, here.meshes, grains))
        return "the walls are not those of the file's run";
    return "";
}

void look_at_speeds(const Scene& scene, BedInFile& bed) {
    const WeightSums moments(scene.gravity, bed.grains);
    const double gravity = scene.gravity.norm();
    for (std::size_t i = 0; i < bed.grains.size(); ++i) {
        const Place& place = bed.grains.place[i];
        const double speed = bed.grains.motion[i].velocity.norm();
        const double height = moments.height(place.position) - place.radius;
        bed.fastest = std::max(bed.fastest, speed);
        bed.falls = std::max(bed.falls, std::sqrt(speed * speed + 2 * gravity * height));
    }
}

}  // namespace

BedInFile bed_in_file(const Scene& scene) {
    BedInFile bed;
    bed.of_checkpoint = is_checkpoint(scene.start.file);
    bed.grains = bed.of_checkpoint ? grains_from_checkpoint(scene) : grains_from_table(scene);
    check_grains_possible(scene, bed.grains);
    bed.origin = bed.of_checkpoint ? origin_of(scene.start.file) : origin_beside(scene, bed.grains);
    if (bed.grains.size() == 0) {
        bed.moves_because = "the file has no grains";
        return bed;
    }
    find_overlaps(scene, bed);
    look_at_speeds(scene, bed);
    bed.moves_because = what_moves(scene, bed);
    return bed;
}

void stiffness_of_overlaps(const Scene& scene, const BedInFile& bed, StartFacts& facts) {
    double wanted = bed.moment_of_weights;
    const std::size_t faces = faces_of(scene).size(), count_of_species = scene.species.size();
    const auto at_wall = [&](int second, std::size_t first) -> const PairContact& {
        const auto wall = static_cast<std::size_t>(-1 - second);
        return wall < faces ? scene.contact.wall[first]
                            : scene.contact.mesh[(wall - faces) * count_of_species + first];
    };
    // Moments of the forces at a stiffness of 1: of linear contacts, of Hertz' contacts, and of Hertz'
    // contacts as if they were linear.
    double linear = 0, hertz = 0, hertz_as_linear = 0, depths = 0, radii = 0, count = 0;
    for (const BedInFile::Overlap& o : bed.overlaps) {
        const auto first = static_cast<std::size_t>(bed.grains.species[o.first]);
        const PairContact contact =
            o.second >= 0 ? scene.between(first, static_cast<std::size_t>(bed.grains.species[o.second]))
            : o.glued     ? glued_contact(scene, first)
                          : at_wall(o.second, first);
        const bool of_hertz = contact.normal == NormalLaw::hertz;
        const double as_hertz = 4.0 / 3 * std::sqrt(o.radius * o.depth) * o.depth;
        if (contact.stiffness) {
            wanted -= *contact.stiffness * (of_hertz ? as_hertz : o.depth) * o.carries;
            continue;
        }
        (of_hertz ? hertz_as_linear : linear) += o.depth * o.carries;
        if (of_hertz) hertz += as_hertz * o.carries;
        depths += o.depth, radii += o.radius, count += 1;
    }
    const double stiffness = wanted / (linear + hertz_as_linear);
    if (count == 0 || !(stiffness > 0) || !std::isfinite(stiffness)) return;
    facts.linear = stiffness;
    facts.modulus = hertz > 0 ? stiffness * hertz_as_linear / hertz
                              : stiffness / (4.0 / 3 * std::sqrt(radii * depths) / count);
}

namespace {

namespace fs = std::filesystem;

// Whether two grains are the same, up to rounding, where the container of the other run is displaced by
// `offset`.
bool same_grain(const Grains& one, std::size_t i, const Grains& other, std::size_t j, const Vec3& offset) {
    constexpr double kRounding = 1e-9;  // as a share of the radius
    const Place &here = one.place[i], &there = other.place[j];
    // x is not compared, because a periodic depth may have wrapped it.
    const Vec3 apart = here.position - there.position - offset;
    return here.radius == there.radius && math::hypot(apart.y(), apart.z()) < kRounding * here.radius &&
           one.species[i] == other.species[j];
}

bool same_grains(const Grains& one, const Grains& other, const Vec3& offset) {
    if (one.size() != other.size()) return false;
    std::vector<std::size_t> index(other.size());
    for (std::size_t j = 0; j < other.size(); ++j) index[other.id[j]] = j;
    for (std::size_t i = 0; i < one.size(); ++i)
        if (!same_grain(one, i, other, index[one.id[i]], offset)) return false;
    return true;
}

}  // namespace

bool StartOrigin::walls_moved() const {
    const DrivePose pose = around.motion.at(step);
    const auto moved = [&](const Body& body) {
        return body.has_own_motion() && !(body.at(pose) == BodyPose{});
    };
    const std::vector<Body> bodies = bodies_of(scene);
    return !pose.offset.isZero(0) || !pose.velocity.isZero(0) ||
           std::any_of(bodies.begin(), bodies.end(), moved) ||
           std::any_of(bodies.begin(), bodies.end(),
                       [](const Body& body) { return !body.velocity.isZero(0); });
}

std::optional<StartOrigin> origin_of(const fs::path& checkpoint) {
    const std::optional<CheckpointLabel> label = label_of_checkpoint(checkpoint);
    if (!label) return std::nullopt;
    try {
        const std::string name = checkpoint.string();
        const Assignments sets{{"start.method=file", name},
                               {"start.file=" + fs::absolute(checkpoint).string(), name},
                               {"start.keep_clock=true", name}};
        StartOrigin origin;
        origin.scene = read_scene_text(label->scene, checkpoint, sets, measurable_in);
        // The file does not say how its grains came to be. In a container the plan assumes that they fell.
        if (origin.scene.container.shape != Container::Shape::none) origin.scene.start = {};
        origin.plan = make_plan(origin.scene, StartFacts());
        origin.around = make_surroundings(origin.scene, origin.plan);
        origin.step = label->step;
        return origin;
    } catch (const UserError&) {
        return std::nullopt;
    }
}

std::optional<StartOrigin> origin_beside(const Scene& scene, const Grains& grains) {
    const fs::path checkpoint = fs::path(scene.start.file).parent_path() / "checkpoint.grs";
    const std::optional<CheckpointLabel> label = label_of_checkpoint(checkpoint);
    if (!label) return std::nullopt;
    try {
        Scene there = scene;
        there.start.file = checkpoint.string();
        // The table has places in the laboratory, the checkpoint in the container at rest.
        if (!same_grains(grains, grains_from_checkpoint(there), label->wall_offset)) return std::nullopt;
    } catch (const UserError&) {
        return std::nullopt;
    }
    return origin_of(checkpoint);
}

bool act_alike(const PairPlan& one, const PairPlan& other) {
    const ContactModel &a = one.model, &b = other.model;
    if (a.normal != b.normal || a.tangential != b.tangential || a.own != b.own) return false;
    if (a.normal == NormalForce::hertz)
        return one.modulus == other.modulus && one.tangential_ratio == other.tangential_ratio;
    // Where the restitution depends on speed, the plan's unloading stiffness holds at one speed only.
    const bool by_speed = one.hardening > 0 || !one.restitution_table.empty();
    return one.loading_stiffness == other.loading_stiffness &&
           (by_speed || one.unloading_stiffness == other.unloading_stiffness) &&
           one.hardening == other.hardening && one.restitution_table == other.restitution_table &&
           one.tangential_stiffness == other.tangential_stiffness;
}

bool same_glued_grains(const GluedGrains& one, const GluedGrains& other) {
    if (one.size() != other.size() || one.face != other.face) return false;
    for (std::size_t g = 0; g < one.size(); ++g)
        if (one.place[g].position != other.place[g].position || one.place[g].radius != other.place[g].radius)
            return false;
    return true;
}

}  // namespace grainreel
