// The layer of a field, streamlines, and arrows of the mean velocity.
#include "render/picture/marks/field_marks.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "engine/scene/bed.hpp"
#include "render/picture/base/view.hpp"
#include "render/picture/marks/force_marks.hpp"
#include "render/scene/filmed_scene.hpp"

namespace grainreel {

namespace {

constexpr double strength = 0.8;   // alpha of the layer; the grains are seen through it
constexpr double full_from = 0.3;  // solid fraction at and above which the layer has its full strength

// The kernel is wider than the kernel of fields in files, since this field shows a single moment. The cells
// are finer, for the eye.
FieldOutput resolution(const FilmedScene& scene) {
    const double diameter = mean_diameter(scene);
    return picture_fields(scene, 0.75 * diameter, 0.25 * diameter);
}

}  // namespace

FieldLayer::FieldLayer(const FilmedScene& scene)
    : scene_(scene),
      grid_(make_field_grid(scene, resolution(scene))),
      shares_(inside_shares(grid_, scene)),
      footprint_(grid_, FieldKernel(FieldOutput::Kernel::gaussian, resolution(scene).width, 2)),
      quantities_(scene, scene.film.shows.colour.by),
      scale_(scene.film.shows.colour) {}

void FieldLayer::gather(const Shot& frame) {
    for (std::vector<double>* const sums : {&solid_, &mass_, &sum_}) sums->assign(shares_.size(), 0);
    const std::vector<double>& values = quantities_.of(frame);
    const Vec3 way = way_of_container(scene_, frame);
    for (std::size_t i = 0; i < frame.size(); ++i) {
        if (std::isnan(values[i])) continue;
        const double volume = 4.0 / 3 * std::numbers::pi * std::pow(frame.radius[i], 3);
        const double mass =
            frame.mass.empty() ? volume * scene_.species[frame.species[i]].density : frame.mass[i];
        for (const CellWeight& cell : footprint_.of_point(frame.position[i] - way)) {
            const auto c = static_cast<std::size_t>(cell.cell);
            solid_[c] += cell.weight * volume;
            mass_[c] += cell.weight * mass;
            sum_[c] += cell.weight * mass * values[i];
        }
    }
}

void FieldLayer::draw(const View& view, const Shot& frame, Shapes& on) {
    gather(frame);
    const GridAxis &x = grid_.axes[0], &y = grid_.axes[1], &z = grid_.axes[2];
    const Vec3 way = way_of_container(scene_, frame);
    const auto corner = [&](std::int64_t j, std::int64_t k) {
        const Vec3 at(x.low + x.cell, y.low + static_cast<double>(j) * y.cell,
                      z.low + static_cast<double>(k) * z.cell);
        return view.project(at + way);
    };
    for (std::int64_t k = 0; k < z.count; ++k)
        for (std::int64_t j = 0; j < y.count; ++j) {
            const auto c = static_cast<std::size_t>(grid_.index(0, j, k));
            if (mass_[c] <= 0 || shares_[c] < 0.5) continue;
            const double mean = sum_[c] / mass_[c];
            clipped_.take(mean, {scale_.low(), scale_.high()});
            const double alpha = strength * std::min(1.0, solid_[c] / full_from);
            on.polygon({corner(j, k), corner(j + 1, k), corner(j + 1, k + 1), corner(j, k + 1)},
                       {scale_.at(mean), alpha});
        }
}

namespace {

using PlanePoint = Eigen::Vector2d;

// The unit vector of the flow; none where it stands still.
std::optional<PlanePoint> direction(const PlaneVelocity& velocity, const PlanePoint& at) {
    const std::optional<PlanePoint> here = velocity(at);
    if (!here || here->norm() == 0) return std::nullopt;
    return *here / here->norm();
}

// The place after a step along the flow; a negative step goes against it.
std::optional<PlanePoint> next(const PlaneVelocity& velocity, const PlanePoint& at, double step) {
    const auto a = direction(velocity, at);
    if (!a) return std::nullopt;
    const auto b = direction(velocity, at + 0.5 * step * *a);
    if (!b) return std::nullopt;
    const auto c = direction(velocity, at + 0.5 * step * *b);
    if (!c) return std::nullopt;
    const auto d = direction(velocity, at + step * *c);
    if (!d) return std::nullopt;
    return at + step / 6 * (*a + 2 * *b + 2 * *c + *d);
}

}  // namespace

std::vector<StreamPoint> streamline(const PlaneVelocity& velocity, const PlanePoint& seed, double reach,
                                    double step) {
    std::vector<StreamPoint> line;
    const auto first = velocity(seed);
    if (!first || first->norm() == 0) return line;
    const auto walk = [&](double along) {
        PlanePoint at = seed;
        const auto steps = static_cast<int>(std::lround(reach / step));
        for (int k = 0; k < steps; ++k) {
            const std::optional<PlanePoint> ahead = next(velocity, at, along);
            const std::optional<PlanePoint> there = ahead ? velocity(*ahead) : std::nullopt;
            if (!there) return;
            at = *ahead;
            line.push_back({at, there->norm()});
        }
    };
    walk(-step);
    std::reverse(line.begin(), line.end());
    line.push_back({seed, first->norm()});
    walk(step);
    return line;
}

namespace {

constexpr double longest_arrow = 1.5;     // cells
constexpr double streamline_reach = 1.5;  // distances between seeds, to either side of the seed
constexpr double slow = 0.1;  // share of the speed at which lines have full width; slower lines fade out
constexpr double thin = 0.6, thick = 2;  // widths of lines, in pens (mark_pen())
// The side of a square divided by the standard deviation of its points along that side.
const double side_over_width = std::sqrt(12.0);

// m: the kernel is as wide as an arrow's cell, and no narrower than half a grain.
double arrow_kernel(const FilmedScene& scene) {
    return std::max(0.5 * mean_diameter(scene), arrow_cell(scene) / side_over_width);
}

double seed_distance(const FilmedScene& scene) {
    return extent_of(scene).size().y() / scene.film.shows.streamlines.across;
}

double streamline_kernel(const FilmedScene& scene) {
    return std::max(0.75 * mean_diameter(scene), 0.5 * seed_distance(scene));
}

}  // namespace

double arrow_cell(const FilmedScene& scene) {
    return extent_of(scene).size().y() / scene.film.shows.arrows.across;
}

double arrow_scale(const FilmedScene& scene) {
    return arrow_cell(scene) / scene.film.shows.arrows.speed;
}

double widest_streamline(int picture_height) {
    return (thin + thick) * mark_pen(picture_height);
}

FlowMarks::FlowMarks(const FilmedScene& scene, const Palette& palette)
    : scene_(scene), palette_(palette), pen_(mark_pen(scene.film.height)) {
    const FilmShows& shows = scene.film.shows;
    if (shows.arrows.across > 0) arrows_.emplace(scene_, arrow_kernel(scene), shows.arrows.period);
    if (shows.streamlines.across > 0)
        streamlines_.emplace(scene_, streamline_kernel(scene), shows.streamlines.period);
}

void FlowMarks::draw(const View& view, const Shot& frame, Shapes& on) {
    if (streamlines_) {
        streamlines_->take(frame);
        draw_streamlines(view, frame, on);
    }
    if (arrows_) {
        arrows_->take(frame);
        draw_arrows(view, frame, on);
    }
}

void FlowMarks::draw_arrows(const View& view, const State& frame, Shapes& on) const {
    const double side = arrow_cell(scene_), scale = arrow_scale(scene_);
    const Extent extent = extent_of(scene_);
    const Vec3 way = way_of_container(scene_, frame);
    const auto upward = static_cast<int>(std::ceil(extent.size().z() / side));
    for (int row = 0; row < upward; ++row)
        for (int column = 0; column < scene_.film.shows.arrows.across; ++column) {
            const double y = extent.low.y() + (column + 0.5) * side, z = extent.low.z() + (row + 0.5) * side;
            const std::optional<Vec3> velocity = arrows_->at(y, z);
            if (!velocity) continue;
            Vec3 along = scale * Vec3(0, velocity->y(), velocity->z());
            if (along.norm() > longest_arrow * side) along *= longest_arrow * side / along.norm();
            const Vec3 middle = way + Vec3(extent.middle().x(), y, z);
            draw_arrow(on, view.project(middle - 0.5 * along), view.project(middle + 0.5 * along),
                       {palette_.ink, palette_.background, 1.4 * pen_, pen_});
        }
}

// The seeds stay at the places of a staggered grid, so that the lines change as gently as the flow.
void FlowMarks::draw_streamlines(const View& view, const State& frame, Shapes& on) const {
    const double side = seed_distance(scene_);
    const Extent extent = extent_of(scene_);
    const auto upward = static_cast<int>(std::ceil(extent.size().z() / side));
    for (int row = 0; row < upward; ++row)
        for (int column = 0; column < scene_.film.shows.streamlines.across; ++column)
            draw_streamline(view, frame,
                            {extent.low.y() + (column + (row % 2 == 0 ? 0.25 : 0.75)) * side,
                             extent.low.z() + (row + 0.5) * side},
                            on);
}

// A streamline is thin where it begins, has a head where it ends, and is wide where the flow is fast.
void FlowMarks::draw_streamline(const View& view, const State& frame, const Eigen::Vector2d& seed,
                                Shapes& on) const {
    const double side = seed_distance(scene_), full = scene_.film.shows.streamlines.speed;
    const PlaneVelocity velocity = [&](const Eigen::Vector2d& at) -> std::optional<Eigen::Vector2d> {
        const std::optional<Vec3> here = streamlines_->at(at.x(), at.y());
        if (!here) return std::nullopt;
        return Eigen::Vector2d(here->y(), here->z());
    };
    const std::vector<StreamPoint> line = streamline(velocity, seed, streamline_reach * side, 0.1 * side);
    if (line.size() < 3) return;
    const double x = extent_of(scene_).middle().x();
    const Vec3 way = way_of_container(scene_, frame);
    std::vector<Pixel> points;
    for (const StreamPoint& point : line)
        points.push_back(view.project(way + Vec3(x, point.at.x(), point.at.y())));
    const auto width = [&](std::size_t k) {
        const double speed = std::min(1.0, line[k].speed / full);
        const double along = static_cast<double>(k + 1) / static_cast<double>(line.size());
        return pen_ * (thin + thick * speed * along) * std::min(1.0, speed / slow);
    };
    const double end = width(line.size() - 1);
    if (end < 0.1 * pen_) return;
    for (const bool border : {true, false}) {
        const Paint paint{border ? palette_.background : palette_.ink, 1};
        for (std::size_t k = 1; k < points.size(); ++k)
            on.line({points[k - 1], points[k]}, false,
                    width(k) + (border ? std::min(1.2 * pen_, width(k)) : 0), paint);
    }
    draw_arrow(on, points[points.size() - 2],
               points.back() + 2.2 * end * (points.back() - points[points.size() - 2]).normalized(),
               {palette_.ink, palette_.background, end, 0.3 * pen_});
}

}  // namespace grainreel
