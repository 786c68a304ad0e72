// Fills the map of the light that does not arrive on the ground.
#include "render/picture/container/shadow_map.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "engine/state/body.hpp"
#include "render/picture/container/container_drawing.hpp"
#include "render/picture/container/drawing_kit.hpp"

namespace grainreel {

namespace {

constexpr double kLeastRise = 0.25;  // sine of the key light's least elevation
constexpr double kEdgeOn = 0.01;  // sine of the angle between light and plate below which there is no shadow
constexpr double kSolidWall = 0.8, kPane = 0.12;  // optical depth of walls that are drawn solid, and of glass
constexpr double kFootHeight = 0.3;  // height of a vessel for the light from all around, of its width

Eigen::Matrix3d level_axes(const Vec3& up) {
    if (up == Vec3(0, 0, 1)) return Eigen::Matrix3d::Identity();
    return Quaternion::FromTwoVectors(up, Vec3(0, 0, 1)).toRotationMatrix();
}

// The lowest height that a point reaches in a turn.
double lowest_in_turn(const Vec3& point, const BodyTurn& turn, const Eigen::Matrix3d& level) {
    const Vec3 arm = point - turn.through, along = arm.dot(turn.axis) * turn.axis, out = arm - along;
    const auto height = [&](const Vec3& v) { return level.row(2).dot(v); };
    return height(turn.through) + height(along) - std::hypot(height(out), height(turn.axis.cross(out)));
}

// The means of five rows of kSide numbers. The rows are added one after the other.
void mean_of_five(const std::array<const float*, 5>& of, float* out) {
    const auto [a, b, c, d, e] = of;
    for (int i = 0; i < ShadowMap::kSide; ++i) out[i] = (a[i] + b[i] + c[i] + d[i] + e[i]) / 5;
}

std::vector<Vec3> corners_of(const Container& container, double top) {
    if (container.shape == Container::Shape::cylinder) return cylinder_corners(container, top);
    return is_prism(container) ? prism_corners(container, top) : std::vector<Vec3>();
}

}  // namespace

ShadowMap::ShadowMap(const FilmedScene& scene)
    : container_(scene.container),
      meshes_(scene),
      extent_(extent_of(scene)),
      foot_(scene.container.tray ? tray_container(scene) : scene.container),
      level_(level_axes(scene.film.camera.up)),
      low_plate_(-1.4 * drawn_thickness(foot_)),
      cells_(kSide * kSide),
      closed_(kSide * kSide) {
    const Vec3 stroke = on_level(drawn_stroke(scene));
    aside_ = stroke.head<2>().norm();
    height_ = lowest(scene) - std::abs(stroke.z());
    if (container_.tray) height_ = low_plate_ - container_.tray->depth;
    for (const Vec3& corner : corners_of(container_, extent_.high.z())) reach_.push_back(on_level(corner));
    for (const Vec3& corner : extent_corners(extent_)) reach_.push_back(on_level(corner));
    for (const Vec3& point : mesh_reach(scene)) reach_.push_back(on_level(point));
    if (is_prism(foot_) || foot_.shape == Container::Shape::cylinder)
        foot_half_ = outer_floor_half_width(foot_);
    size_ = extent_.size().norm() / std::numbers::sqrt3;
    add_walls();
}

double ShadowMap::lowest(const FilmedScene& scene) const {
    double lowest = 1e300;
    const bool turns = container_.turn && is_prism(container_);
    for (const Vec3& corner : corners_of(foot_, std::max(extent_.high.z(), 0.0)))
        lowest =
            std::min(lowest, turns ? lowest_in_turn(corner, *container_.turn, level_) : on_level(corner).z());
    for (const Vec3& point : mesh_reach(scene)) lowest = std::min(lowest, on_level(point).z());
    if (const std::optional<double> level = exit_level(scene)) lowest = std::min(lowest, *level);
    if (container_.outlet && !container_.tray) lowest = std::min(lowest, -container_.outlet->exit_depth);
    return lowest < 1e299 ? lowest : on_level(extent_.low).z();
}

// Cuts the walls into patches. Those of a cylinder and the panes of a prism are glass.
void ShadowMap::add_walls() {
    constexpr int kAlong = 24;
    const double top = std::min(container_.height, extent_.high.z());
    const auto add = [&](const Vec3& a, const Vec3& u, const Vec3& v, double depth) {
        const Vec3 area = depth / (kAlong * kAlong) * u.cross(v);
        for (int i = 0; i < kAlong; ++i)
            for (int j = 0; j < kAlong; ++j)
                walls_.push_back({a + (i + 0.5) / kAlong * u + (j + 0.5) / kAlong * v, area});
    };
    if (container_.shape == Container::Shape::cylinder) {
        constexpr int kFacets = 24;
        for (int k = 0; k < kFacets; ++k) {
            const double a = 2 * std::numbers::pi * k / kFacets, b = a + 2 * std::numbers::pi / kFacets;
            const Vec3 from = container_.half_width * Vec3(std::cos(a), std::sin(a), 0),
                       to = container_.half_width * Vec3(std::cos(b), std::sin(b), 0);
            add(from, to - from, {0, 0, top}, kPane);
        }
    } else if (is_prism(container_)) {
        const double x = 0.5 * container_.depth;
        for (const double side : {-1.0, 1.0}) {
            const WallProfile profile = wall_profile(container_, side);
            for (std::size_t k = 0; k + 1 < profile.outer.size(); ++k) {
                const Eigen::Vector2d &p = profile.outer[k], &q = profile.outer[k + 1];
                if (p.y() >= top) break;
                const double share = std::min(1.0, (top - p.y()) / std::max(q.y() - p.y(), 1e-12));
                add({-x, p.x(), p.y()}, {2 * x, 0, 0}, share * Vec3(0, q.x() - p.x(), q.y() - p.y()),
                    kSolidWall);
            }
        }
        for (const double end : {-x, x})
            if (!container_.periodic_depth)
                add({end, -container_.half_width, 0}, {0, 2 * container_.half_width, 0}, {0, 0, top}, kPane);
    }
}

Eigen::Vector2d ShadowMap::fall(const Vec3& point, const Vec3& to_key) const {
    const Vec3 level = on_level(point), key = on_level(to_key);
    const Eigen::Vector2d along = key.head<2>() / std::max(key.z(), kLeastRise);
    const Eigen::Vector2d at = level.head<2>() - (level.z() - height_) * along;
    return (at - low_) * (kSide / side_);
}

// The map lies around the foot and reaches as far as the shadow of everything, wherever the drive carries it.
void ShadowMap::place(const Vec3& to_key) {
    low_ = {0, 0};
    side_ = kSide;  // one cell a metre: fall() then is in metres
    Eigen::Vector2d low(1e300, 1e300), high(-1e300, -1e300);
    const auto take = [&](const Eigen::Vector2d& at) { low = low.cwiseMin(at), high = high.cwiseMax(at); };
    for (const Vec3& point : reach_) {
        take(point.head<2>());
        take(fall(in_lab(point), to_key));
    }
    side_ = (high - low).maxCoeff() + 1.2 * size_ + 2.8 * aside_;
    low_ = 0.5 * (low + high).array() - 0.5 * side_;
}

BodyPose ShadowMap::pose_of_foot(const State& frame) const {
    BodyPose pose = frame.floor();
    if (container_.tray) pose.place = Vec3(0, 0, -container_.tray->depth), pose.rotation.setIdentity();
    return pose;
}

// m: how far a point in the frame of the plate lies beside it; negative over it.
double ShadowMap::beside_foot(const Vec3& at, double room) const {
    const double half = foot_half_;
    if (foot_.shape == Container::Shape::cylinder) return std::sqrt(at.x() * at.x() + at.y() * at.y()) - half;
    const double x = std::abs(at.x()) - 0.5 * foot_.depth, y = std::abs(at.y()) - half;
    return room > 0 && x > 0 && y > 0 ? std::hypot(x, y) : std::max(x, y);
}

template <class Visit>
void ShadowMap::from_cells(const State& frame, const Vec3& to_light, const Visit& visit) {
    const BodyPose pose = pose_of_foot(frame);
    const Quaternion back = pose.rotation.conjugate();
    const double cell = side_ / kSide;
    const Vec3 up = back * in_lab(to_light), step_x = back * in_lab(Vec3(cell, 0, 0)),
               step_y = back * in_lab(Vec3(0, cell, 0));
    const Vec3 first = pose.at_rest(in_lab({low_.x() + 0.5 * cell, low_.y() + 0.5 * cell, height_}));
    if (std::abs(up.z()) < kEdgeOn * up.norm()) return;
    for (int j = 0; j < kSide; ++j)
        for (int i = 0; i < kSide; ++i)
            visit(static_cast<std::size_t>(j) * kSide + static_cast<std::size_t>(i),
                  Vec3(first + i * step_x + j * step_y), up);
}

// Adds the floor's plate, or the tray's plate where there is a tray. Its shadow is nearly complete (optical
// depth 4). From each cell the light is followed back to the plate, in the frame of the plate's body.
void ShadowMap::add_plate(const State& frame, const Vec3& to_key) {
    const double cell = side_ / kSide;
    const Vec3 key = on_level(to_key);
    Vec3 to_light(0, 0, 1);
    to_light.head<2>() = key.head<2>() / std::max(key.z(), kLeastRise);
    from_cells(frame, to_light, [&](std::size_t c, const Vec3& from, const Vec3& up) {
        for (const double z : {low_plate_, 0.5 * low_plate_, 0.0}) {
            const Vec3 at = from + (z - from.z()) / up.z() * up;
            const double cover = std::clamp(0.5 - beside_foot(at, 0) / cell, 0.0, 1.0);
            cells_[c] = std::max(cells_[c], static_cast<float>(4 * cover));
        }
    });
}

// What the vessel takes of the light from all around: beside a long wall of height h, at the distance d, it
// is (1 - d / root(d^2 + h^2)) / 2. Under the plate, where the gap is g, it is (1 + d / root(d^2 + g^2)) / 2.
void ShadowMap::add_foot(const State& frame) {
    const double high = kFootHeight * size_, room = side_ / kSide;
    from_cells(frame, {0, 0, 1}, [&](std::size_t c, const Vec3& from, const Vec3& up) {
        const double way = std::max((low_plate_ - from.z()) / up.z(), 0.0);  // m, as `up` is a unit vector
        const double d = beside_foot(from + way * up, room);
        const double near = high / (high + way), gap = d > 0 ? high : way + 1e-12;
        const double share = std::abs(d) / std::sqrt(d * d + gap * gap);
        const double taken = d > 0 ? 0.5 * near * (1 - share) : 0.5 * (near + share);
        closed_[c] = static_cast<float>(std::min(taken, 1.0));
    });
}

// Adds what grains, walls and meshes take from the key light. Optical depths add up. Meshes near the ground
// take light from all around too.
void ShadowMap::add_bodies(const State& frame, const Vec3& to_key) {
    const double per_area = std::pow(kSide / side_, 2), rise = std::max(on_level(to_key).z(), kLeastRise);
    for (std::size_t g = 0; g < frame.size(); ++g)
        add_depth(cells_, fall(frame.position[g], to_key),
                  std::numbers::pi * frame.radius[g] * frame.radius[g] * per_area);
    const BodyPose pose = frame.container();
    for (const Patch& patch : walls_)
        add_depth(cells_, fall(pose.moved(patch.at), to_key),
                  std::abs(to_key.dot(pose.rotation * patch.area)) * per_area / rise);
    meshes_.visit(frame, to_key, [&](const Vec3& at, double area) {
        add_depth(cells_, fall(at, to_key), area * per_area / rise);
    });
    const Vec3 up = in_lab({0, 0, 1});
    const double high = 0.25 * size_;
    meshes_.visit(frame, up, [&](const Vec3& at, double area) {
        const double left = 1 - (up.dot(at) - height_) / high;
        if (left > 0) add_depth(closed_, fall(at, up), 4 * left * left * area * per_area);
    });
}

// Adds a depth that is shared between four cells.
void ShadowMap::add_depth(std::vector<float>& map, const Eigen::Vector2d& place, double depth) const {
    const Eigen::Vector2d at = place.array() - 0.5, base = at.array().floor();
    if ((base.array() < 0).any() || (base.array() >= kSide - 1).any()) return;
    const Eigen::Vector2d share = at - base;
    float* cell = &map[static_cast<std::size_t>(base.y()) * kSide + static_cast<std::size_t>(base.x())];
    cell[0] += static_cast<float>(depth * (1 - share.x()) * (1 - share.y()));
    cell[1] += static_cast<float>(depth * share.x() * (1 - share.y()));
    cell[kSide] += static_cast<float>(depth * (1 - share.x()) * share.y());
    cell[kSide + 1] += static_cast<float>(depth * share.x() * share.y());
}

// Softens a map by three box filters one after the other, along both axes. Beyond the map nothing is taken.
void ShadowMap::soften(std::vector<float>& map) {
    constexpr int kTimes = 3;
    constexpr auto side = static_cast<std::size_t>(kSide);
    std::array<float, side + 4> row{};
    for (std::size_t j = 0; j < side; ++j)
        for (int time = 0; time < kTimes; ++time) {
            float* cells = &map[j * side];
            std::copy_n(cells, side, &row[2]);
            mean_of_five({&row[0], &row[1], &row[2], &row[3], &row[4]}, cells);
        }
    const std::array<float, side> none{};
    for (int time = 0; time < kTimes; ++time) {
        before_ = map;
        const auto at = [&](std::size_t j) { return j < side ? &before_[j * side] : none.data(); };
        for (std::size_t j = 0; j < side; ++j)
            mean_of_five({at(j - 2), at(j - 1), at(j), at(j + 1), at(j + 2)}, &map[j * side]);
    }
}

void ShadowMap::cast(const State& frame, const Vec3& to_key) {
    place(to_key);
    std::fill(cells_.begin(), cells_.end(), 0.0f);
    std::fill(closed_.begin(), closed_.end(), 0.0f);
    const bool stands = is_prism(container_) || container_.shape == Container::Shape::cylinder;
    add_bodies(frame, to_key);
    if (meshes_.any()) {
        for (float& cell : closed_) cell = 0.5f * (1 - std::exp(-cell));
        soften(closed_);
    }
    if (stands) add_plate(frame, to_key);
    for (float& cell : cells_) cell = 1 - std::exp(-cell);
    soften(cells_);
    if (stands && !meshes_.any() && !(container_.turn && is_prism(container_))) add_foot(frame);
}

}  // namespace grainreel
