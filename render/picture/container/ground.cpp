// Fills the map of the shadow on the ground, and darkens the rows of the picture by it.
#include "render/picture/container/ground.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "render/picture/container/container_drawing.hpp"
#include "render/picture/container/drawing_kit.hpp"
#include "render/picture/spheres/light/lamp.hpp"
#include "render/scene/filmed_scene.hpp"

namespace grainreel {

namespace {

constexpr double kLeastRise = 0.25;  // sine of the key light's least elevation
constexpr double kEdgeOn = 0.01;  // sine of the angle between light and plate below which there is no shadow

double floor_reach(const Container& container) {
    const double half_depth =
        container.shape == Container::Shape::cylinder ? container.half_width : 0.5 * container.depth;
    return std::hypot(outer_floor_half_width(container), half_depth) + drawn_thickness(container);
}

// The lowest height that a point reaches in a turn.
double lowest_in_turn(const Vec3& point, const BodyTurn& turn) {
    const Vec3 arm = point - turn.through, along = arm.dot(turn.axis) * turn.axis, out = arm - along;
    return turn.through.z() + along.z() - std::hypot(out.z(), turn.axis.cross(out).z());
}

// The lowest height that the drawn container reaches without the drive. A cylinder turns about its own axis,
// so it stays where it is.
double lowest_of(const Container& container) {
    double lowest = -1.4 * drawn_thickness(container);
    if (!container.turn || !is_prism(container)) return lowest;
    for (const Vec3& corner : prism_corners(container, 1e300))
        lowest = std::min(lowest, lowest_in_turn(corner, *container.turn));
    return lowest;
}

// The means of five rows of kSide numbers. The rows are added one after the other.
void mean_of_five(const std::array<const float*, 5>& of, float* out) {
    const auto [a, b, c, d, e] = of;
    for (int i = 0; i < ShadowMap::kSide; ++i) out[i] = (a[i] + b[i] + c[i] + d[i] + e[i]) / 5;
}

}  // namespace

ShadowMap::ShadowMap(const FilmedScene& scene)
    : container_(scene.container),
      meshes_(scene),
      extent_(extent_of(scene)),
      foot_(scene.container.tray ? tray_container(scene) : scene.container),
      low_plate_(-1.4 * drawn_thickness(foot_)),
      cells_(kSide * kSide) {
    const Vec3 stroke = drawn_stroke(scene);
    aside_ = stroke.head<2>().norm();
    const auto below = [&](double lowest) {
        return lowest - std::abs(stroke.z()) - 0.15 * drawn_thickness(container_);
    };
    height_ = below(lowest_of(foot_));
    if (meshes_.any()) height_ = std::min(height_, below(meshes_.lowest()));
    if (container_.shape == Container::Shape::mesh) height_ = below(meshes_.lowest());
    if (container_.tray) height_ = low_plate_ - container_.tray->depth - 0.15 * drawn_thickness(foot_);
}

Eigen::Vector2d ShadowMap::fall(const Vec3& point, const Vec3& to_key) const {
    const Eigen::Vector2d along = to_key.head<2>() / std::max(to_key.z(), kLeastRise);
    const Eigen::Vector2d at = point.head<2>() - (point.z() - height_) * along;
    return (at - low_) * (kSide / side_);
}

// The map lies around the foot and reaches as far as the shadow of the container's whole height, wherever the
// drive carries it.
void ShadowMap::place(const Vec3& to_key) {
    low_ = {0, 0};
    side_ = kSide;  // one cell a metre: fall() then is in metres
    if (container_.shape == Container::Shape::mesh || (container_.turn && is_prism(container_)))
        return place_around_extent(to_key);
    const double reach =
        std::max(floor_reach(foot_), std::hypot(container_.half_width, 0.5 * container_.depth)) + aside_;
    const Eigen::Vector2d tip = fall({0, 0, container_.height}, to_key);
    const Eigen::Vector2d low = tip.cwiseMin(Eigen::Vector2d::Zero()),
                          high = tip.cwiseMax(Eigen::Vector2d::Zero());
    const Eigen::Vector2d middle = 0.5 * (low + high);
    side_ = (high - low).maxCoeff() + 2.8 * reach;
    low_ = middle.array() - 0.5 * side_;
}

// Places the map for a vessel, which may stand anywhere and whose grains throw their shadow from its height,
// and for a container that turns.
void ShadowMap::place_around_extent(const Vec3& to_key) {
    Eigen::Vector2d low(1e300, 1e300), high(-1e300, -1e300);
    for (const Vec3& corner : extent_corners(extent_)) {
        low = low.cwiseMin(fall(corner, to_key));
        high = high.cwiseMax(fall(corner, to_key));
    }
    const Eigen::Vector2d middle = 0.5 * (low + high);
    side_ = 1.4 * (high - low).maxCoeff() + 2.8 * aside_;
    low_ = middle.array() - 0.5 * side_;
}

// Adds the floor's plate, or the tray's plate where there is a tray. Its shadow is nearly complete (optical
// depth 4). From each cell the light is followed back to the plate, in the frame of the plate's body.
void ShadowMap::add_plate(const State& frame, const Vec3& to_key) {
    const double half = outer_floor_half_width(foot_), cell = side_ / kSide;
    const bool round = foot_.shape == Container::Shape::cylinder;
    const double half_depth = round ? half : 0.5 * foot_.depth;
    BodyPose pose = frame.floor();
    if (container_.tray) pose.place = Vec3(0, 0, -container_.tray->depth), pose.rotation.setIdentity();
    const Quaternion back = pose.rotation.conjugate();
    Vec3 to_light(0, 0, 1);
    to_light.head<2>() = to_key.head<2>() / std::max(to_key.z(), kLeastRise);
    const Vec3 up = back * to_light, step_x = back * Vec3(cell, 0, 0), step_y = back * Vec3(0, cell, 0);
    const Vec3 first = pose.at_rest({low_.x() + 0.5 * cell, low_.y() + 0.5 * cell, height_});
    if (std::abs(up.z()) < kEdgeOn * up.norm()) return;
    for (const double z : {low_plate_, 0.5 * low_plate_, 0.0}) {
        for (int j = 0; j < kSide; ++j)
            for (int i = 0; i < kSide; ++i) {
                const Vec3 from = first + i * step_x + j * step_y;
                const Vec3 at = from + (z - from.z()) / up.z() * up;
                const double out = round ? std::hypot(at.x(), at.y()) - half
                                         : std::max(std::abs(at.x()) - half_depth, std::abs(at.y()) - half);
                const double cover = std::clamp(0.5 - out / cell, 0.0, 1.0);
                float& taken = cells_[static_cast<std::size_t>(j) * kSide + i];
                taken = std::max(taken, static_cast<float>(4 * cover));
            }
    }
}

// Adds what the disc of each grain covers, shared between four cells. Optical depths add up.
void ShadowMap::add_grains(const State& frame, const Vec3& to_key) {
    const double per_area = std::pow(kSide / side_, 2);
    for (std::size_t g = 0; g < frame.size(); ++g)
        add_depth(fall(frame.position[g], to_key).array() - 0.5,
                  std::numbers::pi * frame.radius[g] * frame.radius[g] * per_area);
}

// Adds the light that each patch of a mesh takes.
void ShadowMap::add_meshes(const State& frame, const Vec3& to_key) {
    const double per_area = std::pow(kSide / side_, 2) / std::max(to_key.z(), kLeastRise);
    meshes_.visit(frame, to_key, [&](const Vec3& at, double area) {
        add_depth(fall(at, to_key).array() - 0.5, area * per_area);
    });
}

void ShadowMap::add_depth(const Eigen::Vector2d& at, double depth) {
    const Eigen::Vector2d base = at.array().floor();
    if ((base.array() < 0).any() || (base.array() >= kSide - 1).any()) return;
    const Eigen::Vector2d share = at - base;
    float* cell = &cells_[static_cast<std::size_t>(base.y()) * kSide + static_cast<std::size_t>(base.x())];
    cell[0] += static_cast<float>(depth * (1 - share.x()) * (1 - share.y()));
    cell[1] += static_cast<float>(depth * share.x() * (1 - share.y()));
    cell[kSide] += static_cast<float>(depth * (1 - share.x()) * share.y());
    cell[kSide + 1] += static_cast<float>(depth * share.x() * share.y());
}

// Softens the shadow by three box filters one after the other, along both axes. Beyond the map there is no
// shadow.
void ShadowMap::soften() {
    constexpr int kTimes = 3;
    constexpr auto side = static_cast<std::size_t>(kSide);
    std::array<float, side + 4> row{};
    for (std::size_t j = 0; j < side; ++j)
        for (int time = 0; time < kTimes; ++time) {
            float* cells = &cells_[j * side];
            std::copy_n(cells, side, &row[2]);
            mean_of_five({&row[0], &row[1], &row[2], &row[3], &row[4]}, cells);
        }
    const std::array<float, side> none{};
    for (int time = 0; time < kTimes; ++time) {
        before_ = cells_;
        const auto at = [&](std::size_t j) { return j < side ? &before_[j * side] : none.data(); };
        for (std::size_t j = 0; j < side; ++j)
            mean_of_five({at(j - 2), at(j - 1), at(j), at(j + 1), at(j + 2)}, &cells_[j * side]);
    }
}

void ShadowMap::cast(const State& frame, const Vec3& to_key) {
    place(to_key);
    std::fill(cells_.begin(), cells_.end(), 0.0f);
    add_grains(frame, to_key);
    add_meshes(frame, to_key);
    if (container_.shape != Container::Shape::mesh) add_plate(frame, to_key);
    for (float& cell : cells_) cell = 1 - std::exp(-cell);
    soften();
}

namespace {

constexpr int kSide = ShadowMap::kSide;

float rim(int cell) {
    const int inside = std::min(2 * cell + 1, 2 * (kSide - cell) - 1);  // half cells
    const float t = std::min(5 * static_cast<float>(inside) / kSide, 1.0f);
    return t * t * (3 - 2 * t);
}

// The share of the shadow that is left near the picture's rim. It is 1 from a twelfth of the height inside
// the rim on, so that no line shows where the picture ends.
float margin(int pixel, int size, int height) {
    const float inside = std::min(static_cast<float>(pixel) + 0.5f, static_cast<float>(size - pixel) - 0.5f);
    return std::min(12 * inside / static_cast<float>(height), 1.0f);
}

}  // namespace

Ground::Ground(const FilmedScene& scene, const Rectangle& port)
    : map_(scene),
      strength_(scene.film.look.style == FilmLook::Style::dark ? 0.75f : 0.30f),
      width_(port.width),
      height_(port.height),
      dark_(kStride * kStride) {
    for (int cell = 0; cell < kSide; ++cell) rim_.push_back(rim(cell));
    for (int x = 0; x < width_; ++x) across_.push_back(margin(x, width_, height_));
}

void Ground::update(const State& frame, const View& view) {
    const Lamp lamp;
    view_ = view;
    map_.cast(frame, lamp.to_key[0] * view.right + lamp.to_key[1] * view.up + lamp.to_key[2] * view.forward);
    darken();
    part_ = where();
}

void Ground::darken() {
    constexpr float kSeen = 0.5f;  // in levels of 255; weaker shadows are not seen
    int left = kSide, right = 0, low = kSide, high = 0;
    for (int j = 0; j < kSide; ++j)
        for (int i = 0; i < kSide; ++i) {
            const float dark = 255 * strength_ * rim_[i] * rim_[j] * map_.cells()[j * kSide + i];
            dark_[(j + 1) * kStride + i + 1] = dark;
            if (dark < kSeen) continue;
            left = std::min(left, i), right = std::max(right, i + 1);
            low = std::min(low, j), high = std::max(high, j + 1);
        }
    dark_cells_ = {left, low, std::max(0, right - left), std::max(0, high - low)};
}

Vec3 Ground::on_ground(double u, double v) const {
    return {map_.low().x() + u * map_.side(), map_.low().y() + v * map_.side(), map_.height()};
}

// The ground is not seen from below, nor where a corner of the map lies behind the eye.
bool Ground::is_seen() const {
    if (view_.eye.z() < map_.height()) return false;
    for (int corner = 0; corner < 4 && !view_.orthographic; ++corner)
        if (view_.to_view(on_ground(corner & 1, corner >> 1)).z() <= 0) return false;
    return true;
}

Rectangle Ground::where() const {
    if (dark_cells_.width == 0 || !is_seen()) return {};
    constexpr int kMargin = 1;  // cells, as far as the filter reaches
    constexpr double side = kSide;
    const auto ends = [](int first, int count) {
        return std::array{std::max(0, first - kMargin), std::min(kSide, first + count + kMargin)};
    };
    Eigen::Array2d low(width_, height_), high(0, 0);
    for (const int i : ends(dark_cells_.x, dark_cells_.width))
        for (const int j : ends(dark_cells_.y, dark_cells_.height)) {
            const Eigen::Array2d pixel = view_.project(on_ground(i / side, j / side));
            low = low.min(pixel);
            high = high.max(pixel);
        }
    const Eigen::Array2i from = low.max(0).floor().cast<int>(),
                         to = high.min(Eigen::Array2d(width_, height_)).ceil().cast<int>();
    return {from.x(), from.y(), std::max(0, to.x() - from.x()), std::max(0, to.y() - from.y())};
}

// Where a pixel's line of sight meets the ground: the cell (u/w, v/w) of the map. The result (u, v, w) is
// linear in x and y.
Vec3 Ground::seen_at(double x, double y) const {
    const Vec3 beside = ((x - 0.5 * width_) * view_.right + (0.5 * height_ - y) * view_.up) / view_.focal;
    const Vec3 from = view_.orthographic ? Vec3(view_.eye + beside) : view_.eye;
    const Vec3 along = view_.orthographic ? view_.forward : Vec3(view_.forward + beside);
    const Eigen::Vector2d at =
        (from.head<2>() - map_.low()) * along.z() + (map_.height() - from.z()) * along.head<2>();
    return {at.x() * kSide / map_.side(), at.y() * kSide / map_.side(), along.z()};
}

void Ground::shade(int y, std::uint32_t* pixels) const {
    if (y < part_.y || y >= part_.y + part_.height) return;
    const Vec3 first = seen_at(part_.x + 0.5, y + 0.5), step = seen_at(part_.x + 1.5, y + 0.5) - first;
    // The middle of the first cell lies half a cell from the corner of the map, and one and a half cells from
    // the corner of `dark_`.
    const Vec3 shifted = first + 0.5 * first.z() * Vec3(1, 1, 0),
               shifted_step = step + 0.5 * step.z() * Vec3(1, 1, 0);
    shade_row({dark_.data(), kStride}, {shifted.cast<float>(), shifted_step.cast<float>()},
              across_.data() + part_.x, margin(y, height_, height_), pixels + part_.x, part_.width);
}

}  // namespace grainreel
