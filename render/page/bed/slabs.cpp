#include "render/page/bed/slabs.hpp"

#include <cmath>
#include <numbers>

#include "engine/state/pose.hpp"
#include "render/picture/container/drawing_kit.hpp"
#include "render/scene/filmed_scene.hpp"

namespace grainreel {
namespace {

constexpr int round_steps = 48;          // pieces of a round wall
constexpr double floor_thickness = 1.4;  // relative to that of walls, as in the film

std::vector<Vec3> lifted(std::vector<Vec3> corners, double by) {
    for (Vec3& corner : corners) corner.z() += by;
    return corners;
}

// Adds the floor. If it has an outlet, the whole floor gives way to a floor with a hole when the outlet
// opens. opened: the pieces of the floor around that hole.
void add_floor(std::vector<Slab>& slabs, const Container& container, const std::vector<Vec3>& whole,
               const Pieces& opened) {
    const double thickness = floor_thickness * drawn_thickness(container);
    Slab closed{kFloorBody, whole, lifted(whole, -thickness), {}, {}, {}};
    if (container.outlet) closed.until = container.outlet->opens;
    slabs.push_back(closed);
    for (const std::vector<Vec3>& piece : opened) {
        Slab part{kFloorBody, piece, lifted(piece, -thickness), {}, container.outlet->opens, {}};
        if (container.outlet->shape == Outlet::Shape::hole) part.seams = {1, 3};
        slabs.push_back(part);
    }
}

std::vector<Vec3> level(double half_depth, double left, double right, double z) {
    return {{half_depth, left, z}, {half_depth, right, z}, {-half_depth, right, z}, {-half_depth, left, z}};
}

Pieces floor_around_outlet(const Container& container, double half_depth, double half_width) {
    if (!container.outlet) return {};
    if (container.outlet->shape == Outlet::Shape::hole)
        return rectangle_around_hole(*container.outlet, half_depth, half_width, 0);
    const double half = container.outlet->half_width;
    return {level(half_depth, -half_width, -half, 0), level(half_depth, half, half_width, 0)};
}

void add_prism(std::vector<Slab>& slabs, const Container& container) {
    const double x = 0.5 * container.depth;
    const auto at = [](double depth, const Eigen::Vector2d& p) { return Vec3(depth, p.x(), p.y()); };
    std::vector<Eigen::Vector2d> section;  // corners of the room inside
    for (const double side : {-1.0, 1.0}) {
        const WallProfile wall = wall_profile(container, side);
        const auto strip = [&](const std::vector<Eigen::Vector2d>& line, std::size_t i) {
            return std::vector<Vec3>{at(x, line[i]), at(x, line[i + 1]), at(-x, line[i + 1]),
                                     at(-x, line[i])};
        };
        for (std::size_t i = 0; i + 1 < wall.inner.size(); ++i)
            slabs.push_back({kContainerBody, strip(wall.inner, i), strip(wall.outer, i), {}, {}, {}});
        if (side < 0)
            section.assign(wall.inner.rbegin(), wall.inner.rend());
        else
            section.insert(section.end(), wall.inner.begin(), wall.inner.end());
    }
    const double floor = outer_floor_half_width(container);
    add_floor(slabs, container, level(x, -floor, floor, 0), floor_around_outlet(container, x, floor));
    const double top = container.height, wide = std::abs(wall_profile(container, 1).outer.back().x());
    const std::vector<Vec3> lid = level(x, -wide, wide, top);
    if (container.lid)
        slabs.push_back({kContainerBody, lid, lifted(lid, drawn_thickness(container)), {}, {}, {}});
    if (container.periodic_depth) return;
    for (const double depth : {-x, x}) {
        Slab pane{kContainerBody, {}, {}, {}, {}, {}};
        for (const Eigen::Vector2d& p : section) pane.inner.push_back(at(depth, p));
        slabs.push_back(pane);
    }
}

void add_cylinder(std::vector<Slab>& slabs, const Container& container) {
    const double thickness = drawn_thickness(container), radius = container.half_width;
    const auto corner = [](double r, int step, double z) {
        const double angle = 2 * std::numbers::pi * step / round_steps;
        return Vec3(r * std::cos(angle), r * std::sin(angle), z);
    };
    const auto strip = [&](double r, int step) {
        return std::vector<Vec3>{corner(r, step, 0), corner(r, step, container.height),
                                 corner(r, step + 1, container.height), corner(r, step + 1, 0)};
    };
    for (int step = 0; step < round_steps; ++step)
        slabs.push_back(
            {kContainerBody, strip(radius, step), strip(radius + thickness, step), {0, 2}, {}, {}});
    const auto disc = [&](double z) {
        std::vector<Vec3> rim;
        for (int step = 0; step < round_steps; ++step) rim.push_back(corner(radius + thickness, step, z));
        return rim;
    };
    add_floor(slabs, container, disc(0),
              container.outlet ? disc_around_hole(*container.outlet, radius + thickness, 0) : Pieces());
    const std::vector<Vec3> lid = disc(container.height);
    if (container.lid) slabs.push_back({kContainerBody, lid, lifted(lid, thickness), {}, {}, {}});
}

void add_container(std::vector<Slab>& slabs, const Container& container) {
    if (container.shape == Container::Shape::cylinder)
        add_cylinder(slabs, container);
    else if (container.shape == Container::Shape::wedge || container.shape == Container::Shape::box)
        add_prism(slabs, container);
}

void add_tray(std::vector<Slab>& slabs, const FilmedScene& scene) {
    std::vector<Slab> tray;
    add_container(tray, tray_container(scene));
    for (Slab& slab : tray) {
        slab.body = kTrayBody;
        slab.inner = lifted(slab.inner, -scene.container.tray->depth);
        slab.outer = lifted(slab.outer, -scene.container.tray->depth);
        slabs.push_back(std::move(slab));
    }
}

}  // namespace

std::vector<Slab> slabs_of(const FilmedScene& scene) {
    std::vector<Slab> slabs;
    add_container(slabs, scene.container);
    if (scene.container.tray) add_tray(slabs, scene);
    for (std::size_t k = 0; k < scene.walls.size(); ++k) {
        std::vector<Vec3> piece = piece_of_plane(scene.walls[k], scene, Vec3(0, 0, 0));
        if (!piece.empty())
            slabs.push_back(
                {kFirstPlaneBody + static_cast<std::int32_t>(k), std::move(piece), {}, {}, {}, {}});
    }
    return slabs;
}

Extent box_of(const std::vector<Slab>& slabs, const FilmedScene& scene) {
    Extent box = extent_of(scene);
    for (const Slab& slab : slabs)
        for (const std::vector<Vec3>& corners : {slab.inner, slab.outer})
            for (const Vec3& corner : corners) box.take(corner);
    return box;
}

void take_turned(Extent& box, const std::vector<Slab>& slabs, const std::vector<State>& moments) {
    constexpr std::size_t most_moments = 60;
    for (std::size_t k = 0; k < moments.size(); k += 1 + moments.size() / most_moments)
        for (const Slab& slab : slabs) {
            if (slab.body == kTrayBody) continue;
            const BodyPose pose = moments[k].body(static_cast<std::size_t>(slab.body));
            if (pose.rotation.vec().isZero(0)) continue;
            for (const std::vector<Vec3>* corners : {&slab.inner, &slab.outer})
                for (const Vec3& corner : *corners) box.take(pose.moved(corner));
        }
}

}  // namespace grainreel
