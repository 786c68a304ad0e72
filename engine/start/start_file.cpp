#include "engine/start/start_file.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <string>
#include <unordered_set>

#include "engine/base/counted.hpp"
#include "engine/base/error.hpp"
#include "engine/grain_table.hpp"
#include "engine/mesh/room.hpp"
#include "engine/mesh/surface.hpp"
#include "engine/step/surroundings.hpp"

namespace grainreel {

namespace {

constexpr double kSameSize = 1e-6;  // relative: a diameter written by hand is not exact to the last bit
[[noreturn]] void fail(const Scene& scene, const std::string& what) {
    if (scene.start.method == Start::Method::grains)
        throw UserError("{}: the list {}", scene.where("grain"), what);
    throw UserError("{}: '{}' {}", scene.where("start.file"), scene.start.file, what);
}

}  // namespace

std::vector<std::int32_t> numbers_without_gaps(const std::vector<std::int32_t>& ids) {
    std::vector<std::int32_t> rising = ids, numbers;
    std::sort(rising.begin(), rising.end());
    for (const std::int32_t id : ids)
        numbers.push_back(
            static_cast<std::int32_t>(std::lower_bound(rising.begin(), rising.end(), id) - rising.begin()));
    return numbers;
}

Grains grains_from_table(const Scene& scene) {
    if (scene.start.keep_clock)
        fail(scene,
             "is a table of grains and knows no clock; give a checkpoint, or set start.keep_clock = false");
    const State frame = read_grain_table(scene.start.file);
    Grains grains;
    grains.reserve(frame.id.size());
    const std::vector<std::int32_t> number = numbers_without_gaps(frame.id);
    for (std::size_t i = 0; i < frame.size(); ++i) {
        // A species that the scene does not have is refused later, so its density does not matter here.
        const std::size_t s = std::min<std::size_t>(frame.species[i], scene.species.size() - 1);
        grains.add(number[i], frame.species[i], frame.position[i], frame.radius[i], scene.species[s].density);
        grains.motion.back().velocity = frame.velocity[i];
        grains.motion.back().spin = frame.spin[i];
    }
    if (!frame.orientation.empty()) grains.orientation = frame.orientation;
    return grains;
}

Grains listed_grains(const Scene& scene) {
    Grains grains;
    for (const ListedGrain& g : scene.start.grains) {
        grains.add(static_cast<std::int32_t>(grains.size()), static_cast<std::int32_t>(g.species), g.position,
                   0.5 * g.diameter, scene.species[g.species].density);
        grains.motion.back().velocity = g.velocity;
        grains.motion.back().spin = g.spin;
    }
    return grains;
}

namespace {

bool is_finite(const Load& load) {
    return load.force.allFinite() && load.torque.allFinite() && load.zero == 0 && load.zero_too == 0;
}

bool is_finite(const Derivatives& d) {
    return d.acceleration.allFinite() && d.jerk.allFinite() && d.spin_acceleration.allFinite() &&
           d.spin_jerk.allFinite();
}

}  // namespace

void check_grains_possible(const Scene& scene, const Grains& grains) {
    constexpr double kFarthest = 1e9;  // radii: farther out a double is too coarse for overlaps
    constexpr double kUnit = 1e-3;     // how far a quaternion may be from unit length
    std::unordered_set<std::int32_t> seen;
    for (std::size_t i = 0; i < grains.size(); ++i) {
        const std::int32_t id = grains.id[i];
        const auto reject = [&](const char* what) {
            fail(scene, fmt::format("has grain {}, which {}; take the file of another run", id, what));
        };
        if (id < 0) reject("has a number below 0");
        if (!seen.insert(id).second) reject("is there twice");
        const std::int32_t species = grains.species[i];
        if (species < 0 || species >= std::ssize(scene.species))
            fail(scene, fmt::format("has grains of species {}, but the scene lists only {}; list them all",
                                    std::int64_t{species} + 1, scene.species.size()));
        const auto& [position, radius] = grains.place[i];
        const Motion& motion = grains.motion[i];
        if (!std::isfinite(radius) || radius <= 0) reject("has no radius");
        if (!position.allFinite() || !motion.velocity.allFinite() || !motion.spin.allFinite())
            reject("is nowhere, or infinitely fast");
        if (position.cwiseAbs().maxCoeff() > kFarthest * radius)
            reject("is so far out that its place is not exact any more");
        if (!is_finite(grains.load[i]) || !std::isfinite(grains.wall_work[i]) ||
            (!grains.derivatives.empty() && !is_finite(grains.derivatives[i])))
            reject("has a force or a work that is no number");
        if (!grains.orientation.empty() && !(std::abs(grains.orientation[i].norm() - 1) < kUnit))
            reject("has an orientation that is no unit quaternion");
    }
}

void check_grains_numbered(const Scene& scene, const Grains& grains) {
    for (const std::int32_t id : grains.id) {
        if (id >= 0 && id < std::ssize(grains.id)) continue;
        fail(scene, fmt::format("has a grain of number {}, but its {} grains must have the numbers from 0 to "
                                "{}; number them so",
                                id, grains.size(), grains.size() - 1));
    }
}

// Compares up to rounding, because the same density may have been read in another unit.
void check_masses(const Scene& scene, const Grains& grains) {
    const auto differ = [](double a, double b) { return !(std::abs(a - b) <= 1e-12 * a); };
    Grains one;
    one.add(0, 0, Vec3::Zero(), 1, 1);
    for (std::size_t i = 0; i < grains.size(); ++i) {
        one.set_radius(0, grains.place[i].radius, scene.species[grains.species[i]].density);
        if (differ(one.motion[0].inverse_mass, grains.motion[i].inverse_mass) ||
            differ(one.motion[0].inverse_inertia, grains.motion[i].inverse_inertia))
            fail(scene,
                 fmt::format("has grain {} with another mass than its species; take another checkpoint",
                             grains.id[i]));
    }
}

void check_sizes_match(const Scene& scene, const Grains& grains) {
    for (std::size_t i = 0; i < grains.size(); ++i) {
        const Species& species = scene.species[grains.species[i]];
        const double diameter = 2 * grains.place[i].radius;
        if (diameter < species.diameter.smallest * (1 - kSameSize) ||
            diameter > species.diameter.largest * (1 + kSameSize))
            fail(scene,
                 fmt::format("has grain {} of \"{}\" with a diameter of {:.6g} m, which the scene does not "
                             "allow; give the diameters of the run the file comes from",
                             grains.id[i], species.name, diameter));
    }
}

void check_grains_match(const Scene& scene, const Grains& grains) {
    check_sizes_match(scene, grains);
    std::vector<std::int64_t> count(scene.species.size());
    for (const std::int32_t species : grains.species) ++count[species];
    for (std::size_t s = 0; s < count.size(); ++s) {
        if (count[s] != scene.species[s].count)
            fail(scene, fmt::format("has {} of \"{}\", but the scene says {}; write count = {}",
                                    counted(count[s], "grain"), scene.species[s].name, scene.species[s].count,
                                    count[s]));
    }
}

// Checks that the grains of a file or a list lie where grains can be: inside the container, clear of its
// walls and of each other.

namespace {

constexpr double kTooDeep = 1.0 / 3;
// The end of the message when grains do not fit. It names the container as a likely cause, because a table
// does not say where the walls were.
constexpr const char* kOtherContainer =
    "give the container of the run the file comes from, and the checkpoint of a run that did not end with a "
    "period";

bool is_listed(const Scene& scene) {
    return scene.start.method == Start::Method::grains;
}

// Throws at the grain in the scene's list, or at the start file.
[[noreturn]] void fail(const Scene& scene, std::int32_t id, const std::string& what) {
    if (is_listed(scene))
        throw UserError("{}: the grain {}; move one of the two", scene.where(fmt::format("grain[{}]", id)),
                        what);
    throw UserError("{}: grain {} of '{}' {}; {}", scene.where("start.file"), id, scene.start.file, what,
                    kOtherContainer);
}

void check_faces(const Scene& scene, const std::vector<Face>& faces, const Grains& grains, std::size_t i) {
    for (const Face& face : faces) {
        if (distance_to(face, Vec3::Zero(), grains.place[i].position).distance > 0) continue;
        const std::string beyond = fmt::format("beyond the {}", face.name);
        fail(scene, grains.id[i],
             is_listed(scene) ? "lies " + beyond : "lies outside the container, " + beyond);
    }
}

// Whether a place is within a closed surface: a ray from there crosses it an odd number of times. Hardly any
// mesh has edges along the direction of the ray.
bool is_within(const Surface& surface, const Vec3& place) {
    std::vector<Surface::Hit> hits;
    surface.all_hits(place, Vec3(0.3713906763541037, 0.5570860145311556, 0.7427813527082074), hits);
    return hits.size() % 2 == 1;
}

}  // namespace

std::string why_no_grain_at(const Scene& scene, const MeshWall& mesh, const Vec3& place) {
    if (!mesh.surface->facts().closed()) return "";
    const bool vessel = scene.vessel() != nullptr && scene.vessel()->name == mesh.name;
    if (vessel && scene.container.room->holds(place)) return "";
    if (is_within(*mesh.surface, place)) return fmt::format("lies inside the mesh \"{}\"", mesh.name);
    if (!vessel || scene.container.room->open_above()) return "";
    return fmt::format("lies outside the vessel \"{}\"", mesh.name);
}

namespace {

void check_meshes(const Scene& scene, const std::vector<MeshWall>& meshes, const Grains& grains,
                  std::size_t i) {
    const Place& grain = grains.place[i];
    for (const MeshWall& mesh : meshes) {
        const Vec3 place = mesh.body.at(DrivePose()).at_rest(grain.position);
        if (const std::string why = why_no_grain_at(scene, mesh, place); !why.empty())
            fail(scene, grains.id[i], why);
        const auto nearest = mesh.surface->nearest(place, (1 - kTooDeep) * grain.radius);
        if (!nearest) continue;
        const double overlap = 1 - std::sqrt(nearest->point.squared) / grain.radius;
        fail(scene, grains.id[i],
             fmt::format("overlaps the mesh \"{}\" by {:.2f} of its radius", mesh.name, overlap));
    }
}

}  // namespace

void check_grains_fit(const Scene& scene, const Surroundings& around, const Grains& grains) {
    for (std::size_t i = 0; i < grains.size(); ++i) {
        check_faces(scene, around.faces, grains, i);
        check_meshes(scene, around.meshes, grains, i);
    }
}

void check_grains_clear(const Scene& scene, const Surroundings& around, const Grains& grains,
                        const StepLoop& loop) {
    const bool listed = is_listed(scene);
    const auto reject = [&](const std::string& what) {
        if (listed) throw UserError("{}: the list {}", scene.where("grain"), what);
        throw UserError("{}: '{}' {}", scene.where("start.file"), scene.start.file, what);
    };
    loop.visit_contacts(-1, [&](const ContactView& c) {
        if (c.overlap <= kTooDeep * c.smaller_radius) return;
        const double share = c.overlap / c.smaller_radius;
        if (c.second < 0)
            reject(fmt::format("has grain {} overlapping {} by {:.2f} of its radius; {}", grains.id[c.first],
                               wall_name(around, -1 - c.second), share,
                               listed ? "move one of the two" : kOtherContainer));
        reject(fmt::format("has grains {} and {} overlapping by {:.2f} of the smaller radius; {}",
                           std::min(grains.id[c.first], grains.id[c.second]),
                           std::max(grains.id[c.first], grains.id[c.second]), share,
                           listed ? "move one of them" : "take the file of another run"));
    });
}

}  // namespace grainreel
