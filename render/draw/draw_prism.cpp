// Wedge and box: a cross-section in (y, z), drawn out along x.
#include <algorithm>
#include <cmath>

#include "render/draw/drawing_kit.hpp"

namespace grainreel {
namespace {

using Flat = Eigen::Vector2d;  // y, z in m

Vec3 at(double x, const Flat& p) {
    return {x, p.x(), p.y()};
}

// One side wall from the floor up: its inner line, and the outer one a wall's thickness away.
struct Profile {
    std::vector<Flat> inner, outer;  // as many points each
};

// side: +1 for the wall at y > 0, -1 for the other.
Profile wall_profile(const Container& container, double side) {
    const double t = drawn_thickness(container), top = container.height;
    Profile profile;
    const auto add = [&](double inner, double z, double outer, double outer_z) {
        profile.inner.emplace_back(side * inner, z);
        profile.outer.emplace_back(side * outer, outer_z);
    };
    const double angle = container.shape == Container::Shape::wedge ? container.half_angle : 0;
    const double bend = angle > 0 ? std::min(container.slant_height, top) : 0;
    if (bend > 0) add(container.half_width_at(0), 0, container.half_width_at(0) + t / std::cos(angle), 0);
    if (bend > 0 && bend < top)
        add(container.half_width, bend, container.half_width + t, bend - t * std::tan(0.5 * angle));
    if (bend <= 0) add(container.half_width, 0, container.half_width + t, 0);
    const double slant = bend >= top ? t / std::cos(angle) : t;
    add(container.half_width_at(top), top, container.half_width_at(top) + slant, top);
    return profile;
}

// Floor or lid: a plate between two heights.
struct Plate {
    double half_width, low, high;
};

Plate floor_plate(const Container& container) {
    const double t = drawn_thickness(container);
    return {outer_floor_half_width(container), -1.4 * t, 0};
}

Plate lid_plate(const Container& container) {
    const double t = drawn_thickness(container);
    return {std::abs(wall_profile(container, 1).outer.back().x()), container.height, container.height + t};
}

class Prism {
  public:
    Prism(const Container& container, const Sketches& sketches, ContainerShapes& shapes)
        : container_(container), sketches_(sketches), shapes_(shapes) {
        const double eye_side = -sketches.walls.view().forward.x() >= 0 ? 1 : -1;
        near_ = eye_side * 0.5 * container.depth;
        far_ = -near_;
    }

    void draw() {
        const Profile left = wall_profile(container_, -1), right = wall_profile(container_, 1);
        panes(left, right);
        if (container_.lid) plate(sketches_.walls, lid_plate(container_), container_.height, 1);
        plate(sketches_.floor, floor_plate(container_), 0, -1);
        wall(left);
        wall(right);
    }

  private:
    // The back pane, tinted, and the outlines of both; none where the depth is periodic.
    void panes(const Profile& left, const Profile& right) {
        if (container_.periodic_depth) return;
        std::vector<Vec3> back, front;
        for (const Flat& p : left.inner) back.push_back(at(far_, p));
        for (auto p = right.inner.rbegin(); p != right.inner.rend(); ++p) back.push_back(at(far_, *p));
        for (const Vec3& p : back) front.emplace_back(near_, p.y(), p.z());
        const Sketch& walls = sketches_.walls;
        walls.polygon(shapes_.behind, back, walls.pane());
        // Open lines: a lid has edges of its own there, an open top gets the panes' bare rims.
        std::rotate(back.begin(), back.begin() + left.inner.size(), back.end());
        std::rotate(front.begin(), front.begin() + left.inner.size(), front.end());
        walls.line(shapes_.behind, back, !container_.lid, 0.7 * walls.pen, walls.far_edge());
        walls.line(shapes_.before, front, !container_.lid, 0.6 * walls.pen, walls.glass_edge());
    }

    void wall(const Profile& profile) {
        const Sketch& walls = sketches_.walls;
        for (std::size_t i = 0; i + 1 < profile.inner.size(); ++i) segment(profile, i);
        const Vec3 foot = at(0, profile.inner.front()), normal = outward(profile, 0);
        Shapes& on = walls.faces(foot, normal) ? shapes_.before : shapes_.behind;
        const Paint paint = walls.faces_at_rest(foot, normal) ? walls.glass_edge() : walls.edge();
        walls.line(on, {at(near_, profile.inner.back()), at(near_, profile.outer.back())}, false, walls.pen,
                   paint);
        walls.line(on, {at(near_, profile.inner.front()), at(near_, profile.outer.front())}, false, walls.pen,
                   paint);
    }

    static Vec3 outward(const Profile& profile, std::size_t i) {
        const Flat along = profile.inner[i + 1] - profile.inner[i];
        const double side = profile.outer[i].x() > profile.inner[i].x() ? 1 : -1;
        return Vec3(0, side * along.y(), -side * along.x()).normalized();
    }

    // One flat part of a wall, between two points of its profile.
    void segment(const Profile& profile, std::size_t i) {
        const Sketch& walls = sketches_.walls;
        const Flat a = profile.inner[i], b = profile.inner[i + 1];
        const Flat c = profile.outer[i], d = profile.outer[i + 1];
        const std::vector<Vec3> inner = {at(near_, a), at(near_, b), at(far_, b), at(far_, a)};
        const std::vector<Vec3> section = {at(near_, a), at(near_, b), at(near_, d), at(near_, c)};
        const bool solid = !walls.faces_at_rest(at(0, a), outward(profile, i));
        const bool behind = !walls.faces(at(0, a), outward(profile, i));
        Shapes& on = behind ? shapes_.behind : shapes_.before;
        walls.polygon(on, inner, solid && behind ? walls.inner_face() : walls.glass_face());
        const Paint thin = solid ? walls.far_edge() : walls.glass_edge();
        for (const Flat& p : {a, b})
            walls.line(on, {at(near_, p), at(far_, p)}, false, 0.6 * walls.pen, thin);
        if (solid && behind) walls.line(on, {at(far_, a), at(far_, b)}, false, 0.7 * walls.pen, thin);
        walls.polygon(on, section, solid ? walls.cut() : walls.glass_cut());
        const Paint edge = solid ? walls.edge() : walls.glass_edge();
        walls.line(on, {at(near_, a), at(near_, b)}, false, walls.pen, edge);
        walls.line(on, {at(near_, c), at(near_, d)}, false, walls.pen, edge);
    }

    // up: +1 for the lid, -1 for the floor, whose outward normal points down.
    void plate(const Sketch& sketch, const Plate& plate, double inner_height, double up) {
        const bool solid = !sketch.faces_at_rest({0, 0, inner_height}, {0, 0, up});
        const bool behind = !sketch.faces({0, 0, inner_height}, {0, 0, up});
        Shapes& on = behind ? shapes_.behind : shapes_.before;
        const double w = plate.half_width;
        const auto level = [&](double z) {
            return std::vector<Vec3>{{near_, -w, z}, {near_, w, z}, {far_, w, z}, {far_, -w, z}};
        };
        const double outer_height = up > 0 ? plate.high : plate.low;
        if (sketch.faces({0, 0, outer_height}, {0, 0, up}))
            sketch.polygon(on, level(outer_height), solid ? sketch.outer_face() : sketch.glass_face());
        if (solid && behind) {
            sketch.polygon(on, level(inner_height), sketch.inner_face());
            sketch.line(on, level(inner_height), true, 0.6 * sketch.pen, sketch.far_edge());
        }
        for (const double side : {-1.0, 1.0}) plate_side(sketch, on, solid, plate, side);
        const std::vector<Vec3> section = {
            {near_, -w, plate.low}, {near_, w, plate.low}, {near_, w, plate.high}, {near_, -w, plate.high}};
        sketch.polygon(on, section, solid ? sketch.cut() : sketch.glass_cut());
        sketch.line(on, section, true, sketch.pen, solid ? sketch.edge() : sketch.glass_edge());
    }

    void plate_side(const Sketch& sketch, Shapes& on, bool solid, const Plate& plate, double side) {
        const double y = side * plate.half_width;
        if (!sketch.faces({0, y, plate.low}, {0, side, 0})) return;
        const std::vector<Vec3> face = {
            {near_, y, plate.low}, {far_, y, plate.low}, {far_, y, plate.high}, {near_, y, plate.high}};
        sketch.polygon(on, face, solid ? sketch.outer_face() : sketch.glass_face());
        sketch.line(on, face, true, 0.7 * sketch.pen, solid ? sketch.edge() : sketch.glass_edge());
    }

    const Container& container_;
    const Sketches& sketches_;
    ContainerShapes& shapes_;
    double near_ = 0, far_ = 0;  // m, x of the cross-section nearest to the eye, and of the other end
};

}  // namespace

double outer_floor_half_width(const Container& container) {
    if (container.shape == Container::Shape::cylinder)
        return container.half_width + drawn_thickness(container);
    return wall_profile(container, 1).outer.front().x();
}

std::vector<Vec3> prism_corners(const Container& container) {
    std::vector<Vec3> corners;
    const Plate floor = floor_plate(container), lid = lid_plate(container);
    for (const double x : {-0.5 * container.depth, 0.5 * container.depth})
        for (const double side : {-1.0, 1.0}) {
            for (const Flat& p : wall_profile(container, side).outer) corners.push_back(at(x, p));
            corners.emplace_back(x, side * floor.half_width, floor.low);
            if (container.lid) corners.emplace_back(x, side * lid.half_width, lid.high);
        }
    return corners;
}

void draw_prism(const Container& container, const Sketches& sketches, ContainerShapes& shapes) {
    Prism(container, sketches, shapes).draw();
}

}  // namespace grainreel
