#include "engine/questions/ray.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "engine/mesh/surface.hpp"
#include "engine/state/container_faces.hpp"

namespace grainreel {

namespace {

constexpr double endless = std::numeric_limits<double>::infinity();

// A part of a ray; empty when from > to.
struct Stretch {
    double from = 0, to = endless;

    void keep(double low, double high) {
        from = std::max(from, low);
        to = std::min(to, high);
    }
    bool empty() const { return !(from <= to); }
};

// Keeps the part where |at(t) - centre| <= radius. The distance of the ray's line from the centre is
// computed first, so that grains far from the origin lose no digits.
void keep_sphere(const Ray& ray, const Vec3& centre, double radius, Stretch& stretch) {
    const Vec3 from = ray.origin - centre;
    const double a = ray.direction.squaredNorm(), half = from.dot(ray.direction);
    const Vec3 nearest = from - half / a * ray.direction;
    const double rest = radius * radius - nearest.squaredNorm();
    if (rest < 0) return stretch.keep(endless, -endless);
    const double middle = -half / a, reach = std::sqrt(rest / a);
    stretch.keep(middle - reach, middle + reach);
}

// Keeps the part where value + slope t >= 0.
void keep_where_positive(double value, double slope, Stretch& stretch) {
    if (slope > 0) return stretch.keep(-value / slope, endless);
    if (slope < 0) return stretch.keep(-endless, -value / slope);
    if (value < 0) stretch.keep(endless, -endless);
}

void keep_cylinder(const Ray& ray, const Face& face, const Vec3& offset, Stretch& stretch) {
    Ray flat = ray;
    Vec3 axis = face.point + offset;
    flat.origin.z() = flat.direction.z() = axis.z() = 0;
    if (flat.direction.squaredNorm() > 0) return keep_sphere(flat, axis, face.radius, stretch);
    if ((flat.origin - axis).norm() > face.radius) stretch.keep(endless, -endless);
}

bool is_kept(const Vec3& point, const std::vector<KeptHalf>& kept) {
    return std::all_of(kept.begin(), kept.end(),
                       [&](const KeptHalf& half) { return half.normal.dot(point) >= half.distance; });
}

}  // namespace

std::vector<GrainOnRay> grains_on(const Ray& ray, const State& frame, const std::vector<KeptHalf>& kept) {
    std::vector<GrainOnRay> found;
    for (std::size_t i = 0; i < frame.size(); ++i) {
        Stretch stretch;
        keep_sphere(ray, frame.position[i], frame.radius[i], stretch);
        if (stretch.empty()) continue;
        for (const KeptHalf& half : kept)
            keep_where_positive(half.normal.dot(ray.origin) - half.distance, half.normal.dot(ray.direction),
                                stretch);
        if (!stretch.empty()) found.push_back({i, stretch.from, stretch.to});
    }
    std::sort(found.begin(), found.end(),
              [](const GrainOnRay& a, const GrainOnRay& b) { return a.from < b.from; });
    return found;
}

namespace {

// Finds the wall in the frame of the turning container; lengths along the ray stay the same.
std::optional<WallOnRay> wall_behind_turned(const Ray& ray, const Scene& scene, const State& frame) {
    const BodyPose& pose = frame.container();
    Scene at_rest = scene;
    at_rest.container.turn.reset();
    State still;
    const Ray turned{pose.at_rest(ray.origin), pose.rotation.conjugate() * ray.direction};
    return wall_behind(turned, at_rest, still);
}

}  // namespace

std::optional<WallOnRay> wall_behind(const Ray& ray, const Scene& scene, const State& frame) {
    if (scene.container.shape == Container::Shape::none) return std::nullopt;
    if (scene.container.turn) return wall_behind_turned(ray, scene, frame);
    Stretch inside;
    std::string last;
    for (const Face& face : container_faces(scene.container, scene.drive)) {
        const Vec3 offset = frame.body(static_cast<std::size_t>(face.body.number)).place;
        const double before = inside.to;
        if (face.kind == Face::Kind::cylinder)
            keep_cylinder(ray, face, offset, inside);
        else
            keep_where_positive(face.normal.dot(ray.origin - face.point - offset),
                                face.normal.dot(ray.direction), inside);
        if (inside.to < before) last = face.name;
    }
    if (inside.empty() || inside.to == endless) return std::nullopt;
    const double rim = scene.container.height + frame.container().place.z();
    if (ray.at(inside.to).z() > rim) return std::nullopt;
    return WallOnRay{last, inside.to};
}

std::vector<MeshOnRay> meshes_on(const Ray& ray, const Scene& scene, const State& frame,
                                 const std::vector<KeptHalf>& kept) {
    std::vector<MeshOnRay> found;
    const double length = ray.direction.norm();
    for (std::size_t m = 0; m < scene.meshes.size(); ++m) {
        const BodyPose pose = frame.body(static_cast<std::size_t>(first_mesh_body(scene)) + m);
        std::vector<Surface::Hit> hits;
        scene.meshes[m].surface->all_hits(pose.at_rest(ray.origin),
                                          pose.rotation.conjugate() * ray.direction / length, hits);
        for (const Surface::Hit& hit : hits)
            if (is_kept(ray.at(hit.distance / length), kept))
                found.push_back({m, hit.triangle, hit.distance / length});
    }
    std::stable_sort(found.begin(), found.end(),
                     [](const MeshOnRay& a, const MeshOnRay& b) { return a.at < b.at; });
    return found;
}

namespace {

AnswerTable table_of(const Snapshot& s, const State& shown, const Ray& ray, const AlongRay& along,
                     bool through) {
    AnswerTable table{"pixel",
                      "At that pixel, the nearest first",
                      {{"id", Dimension::number, "empty of a wall"},
                       {"what", Dimension::number, "species or wall"},
                       {"seen", Dimension::number, "no: it lies behind another"},
                       {"distance", Dimension::length, "from the eye"},
                       {"height", Dimension::length, "of the point above the floor"}},
                      {}};
    const double length = ray.direction.norm();
    bool covered = false;
    const auto add = [&](AnswerCell id, const std::string& what, bool seen, double at) {
        table.rows.push_back({std::move(id), what, seen ? "yes" : "no", at * length,
                              (ray.at(at) - floor_offset(s.scene, shown)).z()});
    };
    const std::vector<MeshOnRay> meshes = meshes_on(ray, s.scene, shown, along.kept);
    auto mesh = meshes.begin();
    // Meshes are glass: they hide nothing.
    const auto add_meshes = [&](double before) {
        for (; mesh != meshes.end() && mesh->at < before && (!covered || through); ++mesh)
            add(AnswerCell(), fmt::format("{}, triangle {}", s.scene.meshes[mesh->mesh].name, mesh->triangle),
                !covered, mesh->at);
    };
    for (const GrainOnRay& one : grains_on(ray, shown, along.kept)) {
        add_meshes(one.from);
        if (covered && !through) break;
        const std::int32_t species = shown.species[one.grain];
        const bool ghost = std::count(along.seen_through.begin(), along.seen_through.end(), species) > 0;
        add(static_cast<std::int64_t>(shown.id[one.grain]),
            s.scene.species.at(static_cast<std::size_t>(species)).name + (ghost ? " (ghost)" : ""), !covered,
            one.from);
        covered |= !ghost;
    }
    add_meshes(std::numeric_limits<double>::infinity());
    if (const auto wall = wall_behind(ray, s.scene, shown); wall && (!covered || through))
        add(AnswerCell(), wall->name, !covered, wall->at);
    return table;
}

}  // namespace

Answer along_ray_answer(const Snapshot& snapshot, const State& shown, const Ray& ray, const AlongRay& along,
                        bool through) {
    Answer answer{{table_of(snapshot, shown, ray, along, through)}, {}};
    if (answer.tables[0].rows.empty()) answer.notes.emplace_back("nothing is at that pixel");
    return answer;
}

}  // namespace grainreel
