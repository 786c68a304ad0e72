// The looks and colours of a scene's meshes, their outermost points, and the patches that throw their
// shadows.
#include "render/picture/mesh/scene_meshes.hpp"
#include "engine/state/body.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>

#include "engine/measure/walls/mesh_wear.hpp"
#include "engine/mesh/room.hpp"
#include "engine/mesh/surface.hpp"

namespace grainreel {

namespace {

bool names(const std::vector<std::string>& list, const std::string& name) {
    return std::find(list.begin(), list.end(), name) != list.end();
}

std::array<float, 3> bytes(const Colour& colour) {
    return {static_cast<float>(255 * colour.red), static_cast<float>(255 * colour.green),
            static_cast<float>(255 * colour.blue)};
}

}  // namespace

MeshLook look_of(const FilmedScene& scene, const SceneMesh& mesh) {
    if (names(scene.film.look.walls.solid, mesh.name)) return MeshLook::solid;
    if (scene.film.look.walls.clear) return MeshLook::glass;
    if (names(scene.film.look.walls.glass, mesh.name)) return MeshLook::vessel;
    if (scene.container.shape == Container::Shape::mesh && mesh.name == scene.container.mesh)
        return MeshLook::vessel;
    if (!scene.start.region || scene.container.shape == Container::Shape::mesh) return MeshLook::automatic;
    const Vec3 middle = 0.5 * (scene.start.region->low + scene.start.region->high);
    const EnclosedRoom room(mesh.surface.of);
    return room.encloses_anything() && room.holds(middle) ? MeshLook::vessel : MeshLook::automatic;
}

namespace {

double area_of(const MeshShape& shape, std::size_t t) {
    const auto at = [&](int k) -> const Vec3& {
        return shape.vertices[static_cast<std::size_t>(shape.triangles[t][static_cast<std::size_t>(k)])];
    };
    return 0.5 * (at(1) - at(0)).cross(at(2) - at(0)).norm();
}

// Whether a triangle is more than twice as long as it is high.
bool is_thin(const MeshShape& shape, std::size_t t) {
    constexpr double kThin = 2.5;  // a square's half has 2
    double longest = 0;
    for (std::size_t k = 0; k < 3; ++k)
        longest =
            std::max(longest, (shape.vertices[static_cast<std::size_t>(shape.triangles[t][(k + 1) % 3])] -
                               shape.vertices[static_cast<std::size_t>(shape.triangles[t][k])])
                                  .norm());
    return longest * longest > kThin * 2 * area_of(shape, t);
}

constexpr std::size_t kMostAround = 64;  // around the hub of a disc there may be thousands

std::vector<std::vector<std::uint32_t>> triangles_at_vertices(const MeshShape& shape) {
    std::vector<std::vector<std::uint32_t>> at(shape.vertices.size());
    for (std::size_t t = 0; t < shape.triangles.size(); ++t)
        for (const auto v : shape.triangles[t])
            at[static_cast<std::size_t>(v)].push_back(static_cast<std::uint32_t>(t));
    return at;
}

// For each long thin triangle, itself and those that share a corner with it and turn less than edge_angle
// (rad); for all others only themselves.
std::vector<std::vector<std::uint32_t>> smooth_neighbours(const MeshShape& shape, double edge_angle) {
    const auto at_vertex = triangles_at_vertices(shape);
    std::vector<std::vector<std::uint32_t>> all(shape.triangles.size());
    for (std::size_t t = 0; t < all.size(); ++t) {
        all[t].push_back(static_cast<std::uint32_t>(t));
        if (!is_thin(shape, t)) continue;
        for (const auto v : shape.triangles[t])
            for (const std::uint32_t u : at_vertex[static_cast<std::size_t>(v)])
                if (u != t && all[t].size() < kMostAround &&
                    shape.normals[t].dot(shape.normals[u]) >= std::cos(edge_angle))
                    all[t].push_back(u);
    }
    return all;
}

std::vector<double> areas_of(const MeshShape& shape) {
    std::vector<double> areas;
    for (std::size_t t = 0; t < shape.triangles.size(); ++t) areas.push_back(area_of(shape, t));
    return areas;
}

}  // namespace

// Files cut discs and tubes into long thin triangles. What grains do to a small part of one is spread over
// its whole length, which would show as spikes. So thin triangles share their values with their neighbours.
std::vector<double> SceneMeshes::shared(std::size_t mesh, std::vector<double> values) const {
    constexpr int kTimes = 8;
    const auto& neighbours = neighbours_[mesh];
    const std::vector<double>& areas = areas_[mesh];
    for (int time = 0; time < kTimes; ++time) {
        const std::vector<double> before = values;
        for (std::size_t t = 0; t < values.size(); ++t) {
            double sum = 0, area = 0;
            for (const std::uint32_t u : neighbours[t])
                if (!std::isnan(before[u])) sum += areas[u] * before[u], area += areas[u];
            if (area > 0 && !std::isnan(before[t])) values[t] = sum / area;
        }
    }
    return values;
}

// patch: of each triangle (smooth_patches()).
std::vector<SceneMeshes::Corners> SceneMeshes::around_corners(const MeshShape& shape,
                                                              const std::vector<std::int32_t>& patch) {
    const auto at_vertex = triangles_at_vertices(shape);
    std::set<std::int32_t> with_thin;
    for (std::size_t t = 0; t < patch.size(); ++t)
        if (is_thin(shape, t)) with_thin.insert(patch[t]);
    std::vector<Corners> all(shape.triangles.size());
    for (std::size_t t = 0; t < all.size(); ++t)
        for (std::size_t k = 0; k < 3 && with_thin.count(patch[t]) > 0; ++k)
            for (const std::uint32_t u : at_vertex[static_cast<std::size_t>(shape.triangles[t][k])])
                if (all[t][k].size() < kMostAround && patch[u] == patch[t]) all[t][k].push_back(u);
    return all;
}

// On a smooth patch that has thin triangles the colour goes from corner to corner of each triangle. At a
// corner it is that of the mean value of the triangles around it, so that neighbours meet in one colour.
void SceneMeshes::blend(std::size_t m, const std::vector<double>& values) {
    constexpr DrawnMesh::CornerColours one_colour{{{-1, -1, -1}, {-1, -1, -1}, {-1, -1, -1}}};
    std::vector<DrawnMesh::CornerColours>& corners = corner_colours_[m];
    corners.assign(values.size(), one_colour);
    for (std::size_t t = 0; t < values.size(); ++t)
        for (std::size_t k = 0; k < 3 && !std::isnan(values[t]); ++k) {
            double sum = 0, area = 0;
            for (const std::uint32_t u : around_[m][t][k])
                if (!std::isnan(values[u])) sum += areas_[m][u] * values[u], area += areas_[m][u];
            if (area > 0) corners[t][k] = bytes(scale_->at(sum / area));
        }
    drawn_[m].corners = &corners;
}

SceneMeshes::SceneMeshes(const FilmedScene& scene)
    : by_pressure_(scene.film.look.walls.colour == FilmWalls::Colour::pressure) {
    if (shows_wear(scene)) scale_.emplace(scene.film.look.walls);
    const double edge_angle = scene.film.look.walls.edge_angle * std::numbers::pi / 180;
    for (std::size_t m = 0; m < scene.meshes.size(); ++m) {
        const SceneMesh& mesh = scene.meshes[m];
        if (!mesh.surface) continue;
        drawn_.push_back({mesh_shape(*mesh.surface, edge_angle, look_of(scene, mesh)), {}, nullptr});
        body_.push_back(static_cast<std::size_t>(first_mesh_body(scene)) + m);
        mesh_.push_back(m);
        if (!scale_) continue;
        neighbours_.push_back(smooth_neighbours(*drawn_.back().shape, edge_angle));
        areas_.push_back(areas_of(*drawn_.back().shape));
        around_.push_back(around_corners(*drawn_.back().shape, smooth_patches(*mesh.surface, edge_angle)));
    }
    colours_.resize(drawn_.size());
    corner_colours_.resize(drawn_.size());
}

void SceneMeshes::colour_by(const Shot& frame) {
    constexpr std::array<float, 3> as_walls_look{-1, -1, -1};
    if (!scale_) return;
    for (std::size_t m = 0; m < drawn_.size(); ++m) {
        drawn_[m].colours = nullptr, drawn_[m].corners = nullptr;
        if (!frame.worn || mesh_[m] >= frame.worn->size()) continue;
        const MeshWear& worn = (*frame.worn)[mesh_[m]];
        const std::vector<double>& values = by_pressure_ ? worn.pressure : worn.wear;
        if (values.size() != drawn_[m].shape->triangles.size()) continue;
        colours_[m].clear();
        const std::vector<double> smooth = shared(m, values);
        for (const double value : smooth) {
            colours_[m].push_back(std::isnan(value) ? as_walls_look : bytes(scale_->at(value)));
            clipped_.take(value, {scale_->low(), scale_->high()});
        }
        drawn_[m].colours = &colours_[m];
        blend(m, smooth);
    }
}

const std::vector<DrawnMesh>& SceneMeshes::at(const State& frame) {
    for (std::size_t m = 0; m < drawn_.size(); ++m) drawn_[m].pose = frame.body(body_[m]);
    return drawn_;
}

// Walls are light on a light background. On a dark one they are lighter than the background.
MeshPaints mesh_paints(const Palette& palette, const Vec3& up, int picture_height) {
    const bool dark = luminance(palette.background) <= 0.18;
    const auto between = [&](double share) { return bytes(mix(palette.background, palette.solid, share)); };
    return {between(dark ? 0.25 : 0.85), between(dark ? 0.85 : 0.18), bytes(palette.solid), up,
            static_cast<float>(std::max(1.0, picture_height / 600.0))};
}

MeshPainter::Inks mesh_inks(const Palette& palette) {
    return {bytes(palette.solid), bytes(palette.ink)};
}

namespace {

constexpr int kDirections = 256;  // 0.2 rad apart, so 0.5 % of a round body's radius is cut off
constexpr int kTurns = 48, kPathPlaces = 64;

std::vector<Vec3> outermost(const std::vector<Vec3>& points) {
    std::vector<Vec3> kept;
    const double golden = std::numbers::pi * (3 - std::sqrt(5.0));
    for (int i = 0; i < kDirections + 6 && !points.empty(); ++i) {
        const double z = 1 - (2 * i + 1.0) / kDirections, out = std::sqrt(std::max(0.0, 1 - z * z));
        Vec3 along(out * std::cos(golden * i), out * std::sin(golden * i), z);
        if (i >= kDirections) along = (i % 2 ? -1 : 1) * Vec3::Unit((i - kDirections) / 2);
        const auto farther = [&](const Vec3& a, const Vec3& b) { return a.dot(along) < b.dot(along); };
        kept.push_back(*std::max_element(points.begin(), points.end(), farther));
    }
    return kept;
}

std::vector<Vec3> reach_of(const SceneMesh& mesh) {
    const std::vector<Vec3> rest = outermost(mesh.surface->mesh().vertices);
    std::vector<Vec3> reached;
    if (mesh.turn) {
        for (int k = 0; k < kTurns; ++k) {
            const Eigen::AngleAxisd turn(2 * std::numbers::pi * k / kTurns, mesh.turn->axis);
            for (const Vec3& p : rest)
                reached.push_back(mesh.turn->through + turn * (p - mesh.turn->through));
        }
    } else if (mesh.path) {
        for (int k = 0; k <= kPathPlaces; ++k) {
            const double share = static_cast<double>(k) / kPathPlaces;
            const PathPose pose =
                mesh.path->at(mesh.path->first() + share * (mesh.path->last() - mesh.path->first()));
            for (const Vec3& p : rest) reached.push_back(pose.place + pose.rotation * p);
        }
    } else {
        return rest;
    }
    return outermost(reached);
}

}  // namespace

std::vector<Vec3> mesh_reach(const FilmedScene& scene) {
    std::vector<Vec3> all;
    for (const SceneMesh& mesh : scene.meshes)
        if (mesh.surface)
            for (const Vec3& point : reach_of(mesh)) all.push_back(point);
    return all;
}

namespace {

constexpr double kPatches = 6000;        // a mesh has about this many patches
constexpr double kVesselOpacity = 0.12;  // share of the light that each wall takes
constexpr int kMostAlong = 64;           // patches along the side of one triangle

}  // namespace

MeshShadows::MeshShadows(const FilmedScene& scene) {
    for (std::size_t m = 0; m < scene.meshes.size(); ++m) {
        const SceneMesh& mesh = scene.meshes[m];
        if (!mesh.surface) continue;
        const Surface& surface = *mesh.surface;
        const MeshLook look = look_of(scene, mesh);
        const bool thin = look == MeshLook::vessel || look == MeshLook::glass;
        const double opacity = thin ? kVesselOpacity : 1;
        const std::int32_t apart = surface.size() / static_cast<std::int32_t>(4 * kPatches) + 1;
        double all = 0;
        for (std::int32_t t = 0; t < surface.size(); t += apart) all += surface.area(t);
        // A closed body takes light on its way in, and not once more on its way out.
        const double share = (opacity == 1 && surface.facts().closed() ? 0.5 : 1) * opacity * apart;
        for (std::int32_t t = 0; t < surface.size(); t += apart)
            add(surface, t, std::sqrt(kPatches * surface.area(t) / std::max(all, 1e-300)), share,
                static_cast<std::size_t>(first_mesh_body(scene)) + m);
    }
    const std::vector<Vec3> reach = mesh_reach(scene);
    if (!reach.empty()) lowest_ = reach.front().z();
    for (const Vec3& point : reach) lowest_ = std::min(lowest_, point.z());
}

// Cuts a triangle into `along` x `along` equal ones, half of them upside down.
void MeshShadows::add(const Surface& surface, std::int32_t t, double wanted, double share, std::size_t body) {
    const int along = std::clamp(static_cast<int>(std::lround(wanted)), 1, kMostAlong);
    const Vec3 &a = surface.corner(t, 0), u = surface.corner(t, 1) - a, v = surface.corner(t, 2) - a;
    const Vec3 area = share * surface.area(t) / (along * along) * surface.normal(t);
    for (int i = 0; i < along; ++i)
        for (int j = 0; j < along; ++j) {
            const bool upright = i + j < along;
            const double x = (i + 1.0 / 3) / along, y = (j + 1.0 / 3) / along;
            patches_.push_back({a + (upright ? x : 1 - x) * u + (upright ? y : 1 - y) * v, area, body});
        }
}

}  // namespace grainreel
