// Draws wedge and box: a cross-section in (y, z) that is extended along x.
#include <cmath>
#include <tuple>
#include <utility>

#include "render/picture/container/drawing_kit.hpp"

namespace grainreel {
namespace {

using Flat = Eigen::Vector2d;  // y, z in m

Vec3 at(double x, const Flat& p) {
    return {x, p.x(), p.y()};
}

// Floor or lid: a plate between two heights.
struct Plate {
    double left, right, low, high;  // m; left and right along y
};

Plate floor_plate(const Container& container) {
    const double t = drawn_thickness(container), half = outer_floor_half_width(container);
    return {-half, half, -1.4 * t, 0};
}

// The floor's plate, or the two plates that an open slot leaves of it.
std::vector<Plate> floor_plates(const Container& container) {
    const Plate whole = floor_plate(container);
    if (!container.outlet || container.outlet->shape != Outlet::Shape::slot) return {whole};
    const double half = container.outlet->half_width;
    return {{whole.left, -half, whole.low, whole.high}, {half, whole.right, whole.low, whole.high}};
}

Plate lid_plate(const Container& container) {
    const double t = drawn_thickness(container);
    const double half = std::abs(wall_profile(container, 1).outer.back().x());
    return {-half, half, container.height, container.height + t};
}

// The cross-section at one end of the prism, and how strongly it is drawn. It has its full weight, except
// while near and far change places for a camera that moves.
struct End {
    double x, weight;
};

// The ends nearest to the eye, and those opposite to them.
std::pair<std::vector<End>, std::vector<End>> ends(const Container& container, const Sketch& sketch) {
    std::vector<End> near, far;
    const double positive = sketch.positive_end_is_near();
    for (const auto& [side, weight] : {std::pair{1.0, positive}, {-1.0, 1 - positive}}) {
        if (weight <= 0) continue;
        near.push_back({side * 0.5 * container.depth, weight});
        far.push_back({-side * 0.5 * container.depth, weight});
    }
    return {near, far};
}

class Prism {
  public:
    Prism(const Container& container, const Sketches& sketches, ContainerShapes& shapes)
        : container_(container), sketches_(sketches), shapes_(shapes) {
        std::tie(near_, far_) = ends(container, sketches.walls);
    }

    void draw() {
        const WallProfile left = wall_profile(container_, -1), right = wall_profile(container_, 1);
        panes(left, right);
        if (container_.lid) plate(sketches_.walls, lid_plate(container_), container_.height, 1);
        for (const Plate& part : floor_plates(container_)) plate(sketches_.floor, part, 0, -1);
        wall(left);
        wall(right);
    }

  private:
    // Draws the back pane, tinted, and the outlines of both panes. A periodic depth has no panes.
    void panes(const WallProfile& left, const WallProfile& right) {
        if (container_.periodic_depth) return;
        // A lid has edges of its own, so the outlines are open at the top. Without a lid they are closed, and
        // show the bare rims of the panes.
        std::vector<Flat> outline(left.inner.rbegin(), left.inner.rend());
        outline.insert(outline.end(), right.inner.begin(), right.inner.end());
        const Sketch& walls = sketches_.walls;
        const auto at_end = [&](const End& end) {
            std::vector<Vec3> points;
            for (const Flat& p : outline) points.push_back(at(end.x, p));
            return points;
        };
        for (const End& end : far_) {
            walls.inner_polygon(shapes_.behind, at_end(end), faded(walls.pane(), end.weight),
                                {end.x < 0 ? 1.0 : -1.0, 0, 0}, end.weight,
                                end.x < 0 ? InnerWall::pane : InnerWall::other_pane);
            walls.line(shapes_.behind, at_end(end), !container_.lid, 0.7 * walls.pen,
                       faded(walls.far_edge(), end.weight));
        }
        for (const End& end : near_)
            walls.line(shapes_.before, at_end(end), !container_.lid, 0.6 * walls.pen,
                       faded(walls.glass_edge(), end.weight));
    }

    void wall(const WallProfile& profile) {
        const Sketch& walls = sketches_.walls;
        for (std::size_t i = 0; i + 1 < profile.inner.size(); ++i) segment(profile, i);
        const Vec3 foot = at(0, profile.inner.front()), normal = outward(profile, 0);
        WallSide& on = walls.faces(foot, normal) ? shapes_.before : shapes_.behind;
        const Paint paint = blend(walls.glass_edge(), walls.edge(), walls.solid(foot, normal));
        for (const End& end : near_)
            for (const std::size_t i : {profile.inner.size() - 1, std::size_t{0}})
                walls.line(on, {at(end.x, profile.inner[i]), at(end.x, profile.outer[i])}, false, walls.pen,
                           faded(paint, end.weight));
    }

    static Vec3 outward(const WallProfile& profile, std::size_t i) {
        const Flat along = profile.inner[i + 1] - profile.inner[i];
        const double side = profile.outer[i].x() > profile.inner[i].x() ? 1 : -1;
        return Vec3(0, side * along.y(), -side * along.x()).normalized();
    }

    static InnerWall inner_wall(const WallProfile& profile, std::size_t i) {
        const bool upper = i > 0;
        if (profile.inner.front().x() < 0) return upper ? InnerWall::upper_side : InnerWall::side;
        return upper ? InnerWall::other_upper_side : InnerWall::other_side;
    }

    // Draws one flat part of a wall, between two points of its profile.
    void segment(const WallProfile& profile, std::size_t i) {
        const Sketch& walls = sketches_.walls;
        const Flat a = profile.inner[i], b = profile.inner[i + 1];
        const Flat c = profile.outer[i], d = profile.outer[i + 1];
        const double x = 0.5 * container_.depth;
        const std::vector<Vec3> inner = {at(x, a), at(x, b), at(-x, b), at(-x, a)};
        const double solid = walls.solid(at(0, a), outward(profile, i));
        const bool behind = !walls.faces(at(0, a), outward(profile, i));
        WallSide& on = behind ? shapes_.behind : shapes_.before;
        walls.inner_polygon(on, inner, blend(walls.glass_face(), walls.inner_face(), behind ? solid : 0),
                            -outward(profile, i), behind ? solid : 0, inner_wall(profile, i));
        const Paint thin = blend(walls.glass_edge(), walls.far_edge(), solid);
        for (const Flat& p : {a, b}) walls.line(on, {at(x, p), at(-x, p)}, false, 0.6 * walls.pen, thin);
        if (solid > 0 && behind)
            for (const End& end : far_)
                walls.line(on, {at(end.x, a), at(end.x, b)}, false, 0.7 * walls.pen,
                           faded(walls.far_edge(), solid * end.weight));
        const Paint edge = blend(walls.glass_edge(), walls.edge(), solid);
        for (const End& end : near_) {
            walls.polygon(on, {at(end.x, a), at(end.x, b), at(end.x, d), at(end.x, c)},
                          faded(blend(walls.glass_cut(), walls.cut(), solid), end.weight));
            walls.line(on, {at(end.x, a), at(end.x, b)}, false, walls.pen, faded(edge, end.weight));
            walls.line(on, {at(end.x, c), at(end.x, d)}, false, walls.pen, faded(edge, end.weight));
        }
    }

    // up: +1 for the lid, -1 for the floor, whose outward normal points down.
    void plate(const Sketch& sketch, const Plate& plate, double inner_height, double up) {
        const double solid = sketch.solid({0, 0, inner_height}, {0, 0, up});
        const bool behind = !sketch.faces({0, 0, inner_height}, {0, 0, up});
        WallSide& on = behind ? shapes_.behind : shapes_.before;
        const double left = plate.left, right = plate.right, x = 0.5 * container_.depth;
        const auto level = [&](double z) {
            return std::vector<Vec3>{{x, left, z}, {x, right, z}, {-x, right, z}, {-x, left, z}};
        };
        const bool with_hole = up < 0 && container_.outlet && container_.outlet->shape == Outlet::Shape::hole;
        const auto fill = [&](double z, const Paint& paint, double taken = 0) {
            const Pieces pieces =
                with_hole ? rectangle_around_hole(*container_.outlet, x, right, z) : Pieces{level(z)};
            const InnerWall wall = up > 0 ? InnerWall::lid : InnerWall::floor;
            for (const std::vector<Vec3>& piece : pieces)
                taken > 0 ? sketch.inner_polygon(on, piece, paint, {0, 0, -up}, taken, wall)
                          : sketch.polygon(on, piece, paint);
            if (with_hole)
                sketch.line(on, rim_of_hole(*container_.outlet, z), true, 0.6 * sketch.pen,
                            faded(sketch.far_edge(), paint.alpha));
        };
        const double outer_height = up > 0 ? plate.high : plate.low;
        const Paint edge = blend(sketch.glass_edge(), sketch.edge(), solid);
        const Paint face = blend(sketch.glass_face(), sketch.outer_face(), solid);
        if (sketch.faces({0, 0, outer_height}, {0, 0, up})) fill(outer_height, face);
        if (solid > 0 && behind) {
            fill(inner_height, faded(sketch.inner_face(), solid), solid);
            sketch.line(on, level(inner_height), true, 0.6 * sketch.pen, faded(sketch.far_edge(), solid));
        }
        for (const double y : {left, right}) {
            if (!sketch.faces({0, y, plate.low}, {0, y == left ? -1.0 : 1.0, 0})) continue;
            const std::vector<Vec3> side = {
                {x, y, plate.low}, {-x, y, plate.low}, {-x, y, plate.high}, {x, y, plate.high}};
            sketch.polygon(on, side, face);
            sketch.line(on, side, true, 0.7 * sketch.pen, edge);
        }
        for (const End& end : near_) {
            const std::vector<Vec3> section = {{end.x, left, plate.low},
                                               {end.x, right, plate.low},
                                               {end.x, right, plate.high},
                                               {end.x, left, plate.high}};
            sketch.polygon(on, section, faded(blend(sketch.glass_cut(), sketch.cut(), solid), end.weight));
            sketch.line(on, section, true, sketch.pen, faded(edge, end.weight));
        }
    }

    const Container& container_;
    const Sketches& sketches_;
    ContainerShapes& shapes_;
    std::vector<End> near_, far_;
};

}  // namespace

double outer_floor_half_width(const Container& container) {
    if (container.shape == Container::Shape::cylinder)
        return container.half_width + drawn_thickness(container);
    return wall_profile(container, 1).outer.front().x();
}

namespace {

// The points of a rising line up to `top`, and the one at `top`.
std::vector<Flat> below(const std::vector<Flat>& line, double top) {
    std::vector<Flat> points;
    for (const Flat& p : line) {
        if (p.y() > top) {
            const Flat& last = points.back();
            points.emplace_back(last + (top - last.y()) / (p.y() - last.y()) * (p - last));
            break;
        }
        points.push_back(p);
    }
    return points;
}

}  // namespace

std::vector<Vec3> prism_corners(const Container& container, double top) {
    std::vector<Vec3> corners;
    const Plate floor = floor_plate(container), lid = lid_plate(container);
    for (const double x : {-0.5 * container.depth, 0.5 * container.depth})
        for (const double side : {-1.0, 1.0}) {
            for (const Flat& p : below(wall_profile(container, side).outer, top)) corners.push_back(at(x, p));
            corners.emplace_back(x, side * floor.right, floor.low);
            if (container.lid && lid.high <= top) corners.emplace_back(x, side * lid.right, lid.high);
        }
    return corners;
}

void draw_prism_ghost(const Container& container, bool floor_only, const Sketch& lab, Shapes& on) {
    const Plate floor = floor_plate(container);
    std::vector<Flat> outline = {{floor.right, floor.low}, {floor.left, floor.low}};
    if (floor_only) {
        outline.emplace_back(floor.left, floor.high);
        outline.emplace_back(floor.right, floor.high);
    } else {
        const WallProfile left = wall_profile(container, -1), right = wall_profile(container, 1);
        outline.insert(outline.end(), left.outer.begin(), left.outer.end());
        if (container.lid) {
            const Plate lid = lid_plate(container);
            outline.emplace_back(lid.left, lid.high);
            outline.emplace_back(lid.right, lid.high);
        }
        outline.insert(outline.end(), right.outer.rbegin(), right.outer.rend());
    }
    for (const End& end : ends(container, lab).first) {
        std::vector<Vec3> points;
        for (const Flat& p : outline) points.push_back(at(end.x, p));
        lab.dashed(on, points, true, 0.8 * lab.pen, faded(lab.ghost(), end.weight));
    }
}

void draw_prism(const Container& container, const Sketches& sketches, ContainerShapes& shapes) {
    Prism(container, sketches, shapes).draw();
}

}  // namespace grainreel
