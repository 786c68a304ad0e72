// Checks before a run whether a mesh moves into another wall: check_mesh_paths() of mesh_checks.hpp.

#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "engine/base/error.hpp"
#include "engine/mesh/surface.hpp"
#include "engine/start/mesh_checks.hpp"
#include "engine/step/surroundings.hpp"

namespace grainreel {

namespace {

constexpr double kDeep = 0.01;  // least depth of a crossing that counts, as a share of the smallest extent
constexpr double kElsewhere =
    0.1;  // distance from the crossings at rest, as a share of the smaller mesh's largest extent
constexpr std::int64_t kMostTriangles = 200'000;  // triangles of both meshes; more would take too long
constexpr std::int64_t kMostLooks =
    400'000;  // edges that are looked at in all moments together; if there are more, some are left out
constexpr std::size_t kMostKept = 2'000;  // places where edges cross at rest

// The smallest extent (m) that is not just rounding of a flat mesh.
double smallest_extent(const Surface& surface) {
    const Vec3 size = surface.facts().high - surface.facts().low;
    double smallest = size.maxCoeff();
    for (int k = 0; k < 3; ++k)
        if (size[k] > 1e-6 * size.maxCoeff()) smallest = std::min(smallest, size[k]);
    return smallest;
}

double largest_extent(const Surface& surface) {
    return (surface.facts().high - surface.facts().low).maxCoeff();
}

struct Paths {
    const Scene& scene;
    const Plan& plan;
    const Surroundings around;
    const bool drive_moves;

    std::vector<std::int64_t> moments(const Body& one, const Body& other) const {
        std::vector<std::int64_t> all = moments_of(one, scene, plan);
        const std::vector<std::int64_t> more = moments_of(other, scene, plan);
        all.insert(all.end(), more.begin(), more.end());
        std::sort(all.begin(), all.end());
        all.erase(std::unique(all.begin(), all.end()), all.end());
        return all;
    }

    // The scene's key that makes this mesh move, for messages.
    std::string motion_key(std::size_t mesh) const {
        const SceneMesh& m = scene.meshes[mesh];
        return fmt::format("mesh[{}]{}", mesh, m.turn ? ".turn" : m.path ? ".path" : "");
    }
};

std::string moment_text(const Paths& paths, const Body& body, std::int64_t step) {
    const double time = paths.plan.clock.time(step);
    std::string text = fmt::format("at {:.4g} s", time);
    if (body.turn)
        text += fmt::format(", turned by {:.0f} deg", body.turn->angle_at(time) * 180 / std::numbers::pi);
    return text;
}

// Checks corners against faces. A corner counts if at rest it is in front of all faces of the container (or
// in front of the plane).
class BeforeFaces {
  public:
    BeforeFaces(const Paths& paths, std::size_t mesh)
        : paths_(paths), number_(mesh), mesh_(paths.around.meshes[mesh]) {
        for (const Face& face : paths.around.faces) {
            if (face.ends || face.body.number == kTrayBody || is_open(face)) continue;
            if (!move_alike(face.body, mesh_.body, paths.drive_moves)) faces_.push_back(&face);
        }
        if (faces_.empty()) return;
        for (const Vec3& corner : mesh_.surface->mesh().vertices)
            if (is_inside(corner)) inside_.push_back(corner);
    }

    void check() const {
        for (const Face* face : faces_)
            for (const std::int64_t step : paths_.moments(mesh_.body, face->body)) check_at(*face, step);
    }

  private:
    // Whether the outlet opens this face: grains leave through it, and so may a mesh.
    bool is_open(const Face& face) const {
        return paths_.scene.container.outlet && face.body.number == kFloorBody;
    }

    bool is_inside(const Vec3& corner) const {
        return std::all_of(paths_.around.faces.begin(), paths_.around.faces.end(), [&](const Face& face) {
            const bool of_container = face.body.number == kContainerBody || face.body.number == kFloorBody;
            return !of_container || face.ends || distance_to(face, Vec3::Zero(), corner).distance >= 0;
        });
    }

    void check_at(const Face& face, std::int64_t step) const {
        const DrivePose drive = paths_.around.motion.at(step);
        const BodyPose pose = mesh_.body.at(drive);
        double deepest = 0;
        for (const Vec3& corner : inside_) {
            if (distance_to(face, Vec3::Zero(), corner).distance < 0) continue;  // behind this plane at rest
            deepest = std::max(deepest, -distance_at(face, drive, pose.moved(corner)).distance);
        }
        if (deepest <= kDeep * smallest_extent(*mesh_.surface)) return;
        const bool own = paths_.scene.meshes[number_].moves();
        throw UserError(
            "{}: the mesh \"{}\" {} the {}: {} it is {:.3g} m behind it; make it smaller, move "
            "it, or let both "
            "move alike",
            paths_.scene.where(own ? paths_.motion_key(number_) : "container.turn"), mesh_.name,
            own ? "moves into" : "is in the way of", face.name,
            moment_text(paths_, own ? mesh_.body : face.body, step), deepest);
    }

    const Paths& paths_;
    const std::size_t number_;
    const MeshWall& mesh_;
    std::vector<const Face*> faces_;
    std::vector<Vec3> inside_;
};

using Edge = std::array<std::int32_t, 2>;

// All edges of a surface, each once.
std::vector<Edge> edges_of(const Surface& surface) {
    std::vector<Edge> edges;
    for (std::int32_t t = 0; t < surface.size(); ++t) {
        const auto& corners = surface.mesh().triangles[t];
        for (std::size_t e = 0; e < 3; ++e)
            if (const std::int32_t other = surface.neighbour(t, static_cast<int>(e)).triangle; other < t)
                edges.push_back({corners[e], corners[(e + 1) % 3]});
    }
    return edges;
}

double distance_to_segment(const Vec3& point, const Vec3& a, const Vec3& b) {
    const Vec3 along = b - a;
    const double share = std::clamp(along.dot(point - a) / along.squaredNorm(), 0.0, 1.0);
    return (point - a - share * along).norm();
}

// Checks edges of one mesh against the triangles of another.
class Crossings {
  public:
    Crossings(const Paths& paths, std::size_t one, std::size_t other)
        : paths_(paths),
          one_(paths.around.meshes[one]),
          other_(paths.around.meshes[other]),
          deep_(kDeep * std::min(smallest_extent(*one_.surface), smallest_extent(*other_.surface))),
          elsewhere_(kElsewhere * std::min(largest_extent(*one_.surface), largest_extent(*other_.surface))),
          edges_(edges_of(*one_.surface)),
          moments_(paths.moments(one_.body, other_.body)) {
        const auto looks = static_cast<std::int64_t>(edges_.size() * moments_.size());
        stride_ = static_cast<std::size_t>(1 + looks / kMostLooks);
    }

    struct Found {
        std::int64_t step;
        Vec3 place;
    };
    std::optional<Found> first() const {
        std::vector<Vec3> at_rest;
        each_at(-1, [&](const Vec3& place) {
            if (at_rest.size() < kMostKept) at_rest.push_back(place);
        });
        std::optional<Found> found;
        for (std::size_t k = 0; k < moments_.size() && !found; ++k)
            each_at(moments_[k], [&](const Vec3& place) {
                const auto near = [&](const Vec3& before) { return (place - before).norm() < elsewhere_; };
                if (found || std::any_of(at_rest.begin(), at_rest.end(), near)) return;
                found = Found{moments_[k], place};
            });
        return found;
    }

  private:
    template <class See>
    void each_at(std::int64_t step, const See& see) const {
        const DrivePose drive = paths_.around.motion.at(step);
        const BodyPose pose = one_.body.at(drive), its = other_.body.at(drive);
        const std::vector<Vec3>& vertices = one_.surface->mesh().vertices;
        const Eigen::AlignedBox3d box(other_.surface->facts().low, other_.surface->facts().high);
        const auto seen_from_other = [&](std::int32_t vertex) {
            return its.at_rest(pose.moved(vertices[vertex]));
        };
        for (std::size_t e = 0; e < edges_.size(); e += stride_) {
            const Vec3 a = seen_from_other(edges_[e][0]), b = seen_from_other(edges_[e][1]);
            if (!box.intersects(Eigen::AlignedBox3d(a.cwiseMin(b), a.cwiseMax(b)))) continue;
            if (const std::optional<Vec3> place = crossing(a, b)) see(its.moved(*place));
        }
    }

    std::optional<Vec3> crossing(const Vec3& a, const Vec3& b) const {
        constexpr int kMostTouches = 4;  // touches that are passed over along one edge
        const double length = (b - a).norm();
        if (length <= 2 * deep_) return {};
        const Vec3 along = (b - a) / length;
        double from = deep_;
        for (int k = 0; k < kMostTouches; ++k) {
            const auto hit = other_.surface->first_hit(a + from * along, along);
            if (!hit || from + hit->distance > length - deep_) return {};
            from += hit->distance;
            const Vec3 place = a + from * along;
            if (!is_at_rim(hit->triangle, place)) return place;
            from += deep_;
        }
        return {};
    }

    bool is_at_rim(std::int32_t triangle, const Vec3& place) const {
        const Surface& surface = *other_.surface;
        for (int e = 0; e < 3; ++e) {
            if (surface.neighbour(triangle, e).triangle >= 0) continue;
            if (distance_to_segment(place, surface.corner(triangle, e),
                                    surface.corner(triangle, (e + 1) % 3)) < deep_)
                return true;
        }
        return false;
    }

    const Paths& paths_;
    const MeshWall &one_, &other_;
    const double deep_, elsewhere_;  // m
    const std::vector<Edge> edges_;
    const std::vector<std::int64_t> moments_;
    std::size_t stride_ = 1;  // every how many edges one is checked
};

void check_pair(const Paths& paths, std::size_t one, std::size_t other, Plan& plan) {
    const MeshWall &a = paths.around.meshes[one], &b = paths.around.meshes[other];
    if (move_alike(a.body, b.body, paths.drive_moves)) return;
    const bool first_moves = paths.scene.meshes[one].moves();
    const std::size_t mover = first_moves ? one : other;
    const std::string place = paths.scene.where(paths.motion_key(mover));
    if (a.surface->size() + std::int64_t{b.surface->size()} > kMostTriangles) {
        plan.warnings.push_back(
            fmt::format("{}: whether \"{}\" and \"{}\" move into each other was not looked at, for they have "
                        "more than {} "
                        "triangles; look at the film",
                        place, a.name, b.name, kMostTriangles));
        return;
    }
    for (const auto& [from, to] : {std::pair{one, other}, std::pair{other, one}}) {
        const auto found = Crossings(paths, from, to).first();
        if (!found) continue;
        throw UserError(
            "{}: the mesh \"{}\" moves into \"{}\": {} they cross at ({:.4g}, {:.4g}, {:.4g}) m; "
            "make one of them "
            "smaller, move it, or let both move alike",
            place, first_moves ? a.name : b.name, first_moves ? b.name : a.name,
            moment_text(paths, paths.around.meshes[mover].body, found->step), found->place.x(),
            found->place.y(), found->place.z());
    }
}

}  // namespace

void check_mesh_paths(const Scene& scene, Plan& plan) {
    const bool drive_moves = scene.drive.present && scene.drive.largest_amplitude() > 0;
    const Paths paths{scene, plan, make_surroundings(scene, plan), drive_moves};
    for (std::size_t m = 0; m < scene.meshes.size(); ++m) BeforeFaces(paths, m).check();
    for (std::size_t m = 0; m < scene.meshes.size(); ++m)
        for (std::size_t other = m + 1; other < scene.meshes.size(); ++other)
            check_pair(paths, m, other, plan);
}

namespace {

// The time (s) when the body has turned by this angle (rad), or `end` if that is earlier.
double time_of_angle(const BodyTurn& turn, double angle, double end) {
    if (std::abs(turn.angle_at(end)) <= angle) return end;
    double low = 0, high = end;
    for (int halving = 0; halving < 60; ++halving) {
        const double middle = 0.5 * (low + high);
        (std::abs(turn.angle_at(middle)) < angle ? low : high) = middle;
    }
    return high;
}

}  // namespace

bool move_alike(const Body& one, const Body& other, bool drive_moves) {
    return (!drive_moves || one.driven == other.driven) && one.velocity == other.velocity &&
           one.turn == other.turn && one.path == other.path;
}

std::vector<std::int64_t> moments_of(const Body& body, const Scene& scene, const Plan& plan) {
    std::vector<double> times{0};
    const double end = scene.run.duration;
    for (int k = 1; k <= kMomentsOfMotion; ++k) {
        const double share = static_cast<double>(k) / kMomentsOfMotion;
        if (body.turn) times.push_back(time_of_angle(*body.turn, 2 * std::numbers::pi * share, end));
        if (body.path) times.push_back(share * std::min(end, body.path->last()));
        if (!body.velocity.isZero(0)) times.push_back(share * end);
    }
    if (body.driven && plan.moving_walls && scene.drive.present)
        for (int k = 0; k < 8; ++k)
            times.push_back(std::min(end, (scene.drive.ramp + k / 8.0) / scene.drive.frequency));
    std::vector<std::int64_t> steps;
    for (const double time : times) steps.push_back(std::llround(time / plan.clock.step));
    std::sort(steps.begin(), steps.end());
    steps.erase(std::unique(steps.begin(), steps.end()), steps.end());
    return steps;
}

}  // namespace grainreel
