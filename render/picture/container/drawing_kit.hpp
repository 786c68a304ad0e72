// What the drawings of wedge, box, cylinder and free walls share: a sketch that projects points and knows the
// paints, the shapes of walls and floors, and the scale in the lab. Each container has a file draw_*.cpp.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <vector>

#include "engine/base/vector.hpp"
#include "engine/scene/bed.hpp"
#include "render/picture/container/container_drawing.hpp"
#include "render/scene/filmed_scene.hpp"

namespace grainreel {

// Rises smoothly from 0 at -half_width to 1 at half_width.
double smooth_rise(double value, double half_width);

Paint faded(const Paint& paint, double share);
// A mixture of two paints, as it looks over a background.
Paint blend(const Paint& one, const Paint& other, double share_of_other);

// Whether the container is a wedge or a box. Cylinders are drawn in another way, and meshes as their
// triangles.
inline bool is_prism(const Container& container) {
    return container.shape == Container::Shape::wedge || container.shape == Container::Shape::box;
}

// The inner walls of a container.
enum class InnerWall { floor, lid, side, other_side, upper_side, other_upper_side, pane, other_pane, free };

// Draws shapes that are given in metres in the frame of a body that has moved and turned.
class Sketch {
  public:
    Sketch(const Views& views, const Palette& colours, int picture_height, const BodyPose& pose)
        : palette(colours),
          pen(std::max(1.0, picture_height / 600.0)),
          views_(views),
          offset_(pose.place),
          rotation_(pose.rotation),
          turned_(pose.rotation.vec() != Vec3(0, 0, 0)) {}

    bool faces(const Vec3& point, const Vec3& normal) const {
        return views_.now.faces(moved(point), turned(normal));
    }
    // These take a point and a direction from the body's frame into the lab.
    Vec3 moved(const Vec3& point) const { return turned(point) + offset_; }
    Vec3 turned(const Vec3& direction) const { return turned_ ? Vec3(rotation_ * direction) : direction; }
    // The direction from the middle of the body to the eye, in the body's frame.
    Vec3 to_eye() const {
        const View& view = views_.now;
        const Vec3 in_lab = view.orthographic ? Vec3(-view.forward) : Vec3(view.eye - offset_);
        return turned_ ? Vec3(rotation_.conjugate() * in_lab) : in_lab;
    }
    bool is_clear() const { return views_.clear; }
    // How solid a part looks, from 0 for glass to 1. This is decided for the container at rest; otherwise a
    // part whose plane the eye crosses would blink once a period. (A container that turns is taken as it is
    // in the present frame.) The order of painting, however, always depends on the present frame. For a
    // camera that moves and a container that turns, glass becomes solid over some degrees.
    double solid(const Vec3& point, const Vec3& normal) const;
    // How much the end at positive x is the near one: 1, 0, or in between while near and far change places.
    double positive_end_is_near() const;
    const View& view() const { return views_.now; }
    const Vec3& offset() const { return offset_; }

    void polygon(WallSide& on, const std::vector<Vec3>& corners, const Paint& paint) const {
        on.shapes.polygon(project(corners), paint);
        on.faces.push_back({corners, paint.alpha});
        for (Vec3& corner : on.faces.back().corners) corner = moved(corner);
    }
    // A polygon of an inner face, which grains darken. inward: towards them, unit.
    void inner_polygon(WallSide& on, const std::vector<Vec3>& corners, const Paint& paint, const Vec3& inward,
                       double taken, InnerWall wall) const {
        polygon(on, corners, paint);
        WallSide::Face& face = on.faces.back();
        face.inward = turned(inward);
        face.taken = taken;
        face.wall = static_cast<int>(wall);
        face.container = on.container;
    }
    void line(WallSide& on, const std::vector<Vec3>& points, bool closed, double width,
              const Paint& paint) const {
        on.shapes.line(project(points), closed, width, paint);
    }
    void dashed(Shapes& on, std::vector<Vec3> points, bool closed, double width, const Paint& paint) const;

    // Paints of the solid parts behind the grains, and of the glass over the grains, which is so faint that
    // it hides nothing.
    Paint cut() const { return {palette.solid, 1}; }
    Paint inner_face() const {
        return {mix(palette.background, palette.solid, views_.bright ? 0.5 : 0.30), 1};
    }
    Paint outer_face() const { return {mix(palette.solid, palette.background, 0.30), 1}; }
    Paint pane() const { return {palette.solid, views_.bright ? 0.34 : 0.10}; }
    Paint edge() const { return {palette.ink, 1}; }
    Paint far_edge() const { return {mix(palette.solid, palette.ink, 0.35), 1}; }
    Paint glass_cut() const { return {palette.solid, 0.38}; }
    Paint glass_face() const { return {palette.solid, 0.05}; }
    Paint glass_edge() const { return {palette.ink, 0.45}; }
    Paint ghost() const { return {palette.ink, 0.5}; }

    const Palette& palette;
    const double pen;  // pixels, the width of a main line

  private:
    std::vector<Pixel> project(const std::vector<Vec3>& points) const {
        std::vector<Pixel> pixels;
        pixels.reserve(points.size());
        for (const Vec3& point : points) pixels.push_back(views_.now.project(moved(point)));
        return pixels;
    }
    const Views& views_;
    const Vec3 offset_;
    const Quaternion rotation_;
    const bool turned_;
};

// The sketches of the two moving parts (the walls with the lid, and the floor) and of what stands in the lab.
struct Sketches {
    Sketch walls, floor, lab;
};

void draw_prism(const Container& container, const Sketches& sketches, ContainerShapes& shapes);
void draw_cylinder(const Container& container, const Sketches& sketches, ContainerShapes& shapes);

// The piece of a plane, moved by `offset`, that lies in the container; without a container, the piece that
// lies in the box of everything that the camera looks at. These are its corners in order, m; empty if there
// is no such piece.
std::vector<Vec3> piece_of_plane(const ScenePlane& wall, const FilmedScene& scene, const Vec3& offset);
void draw_free_wall(const ScenePlane& wall, const FilmedScene& scene, const Sketch& sketch,
                    ContainerShapes& shapes);

// These draw dashed outlines over the grains, at the rest positions of the container's moving parts or of a
// plane that moves.
void draw_prism_ghost(const Container& container, bool floor_only, const Sketch& lab, Shapes& on);
void draw_cylinder_ghost(const Container& container, bool floor_only, const Sketch& lab, Shapes& on);
void draw_free_wall_ghost(const ScenePlane& wall, const FilmedScene& scene, const Sketch& lab, Shapes& on);

// m: half the width of the drawn container at the height of the floor's top.
double outer_floor_half_width(const Container& container);

// Corners of the drawn container at rest, walls with their thickness; m. A container that is higher than
// `top` is cut off there.
std::vector<Vec3> prism_corners(const Container& container, double top);
std::vector<Vec3> cylinder_corners(const Container& container, double top);
std::vector<Vec3> extent_corners(const Extent& extent);

// The drawn cross-section of the side wall of a wedge or a box, from the floor up: points (y, z) of the inner
// line, and as many of the outer line, a wall's thickness away; m.
struct WallProfile {
    std::vector<Eigen::Vector2d> inner, outer;
};

// side: +1 for the wall at y > 0, -1 for the other.
WallProfile wall_profile(const Container& container, double side);

// The container as it is at a time (s): without its outlet while that is closed.
Container container_at(const Container& container, double time);

// m: points around the floor's hole, at this height.
std::vector<Vec3> rim_of_hole(const Outlet& outlet, double height);

// A floor with a round hole as convex flat pieces: a disc, or a rectangle with corners (+-half_depth,
// +-half_width).
using Pieces = std::vector<std::vector<Vec3>>;
Pieces disc_around_hole(const Outlet& outlet, double radius, double height);
Pieces rectangle_around_hole(const Outlet& outlet, double half_depth, double half_width, double height);

// m: the way from rest to the end of the stroke, as it is drawn.
Vec3 drawn_stroke(const FilmedScene& scene);

// A scale that is fixed in the lab beside the container's floor, and a pointer on it that goes with the
// floor. The scale has a long tick where the floor rests and short ticks at both ends of its stroke.
struct LabMark {
    Vec3 foot;    // m, where the long tick begins, at rest
    Vec3 along;   // m, its direction and length
    Vec3 stroke;  // m, the displacement at the end of the stroke
};
bool has_lab_marks(const FilmedScene& scene);
// azimuth: degrees, of the camera.
std::vector<LabMark> lab_marks(const FilmedScene& scene, double azimuth);

void draw_lab_marks(const FilmedScene& scene, const Sketches& sketches, double azimuth, WallSide& on);

}  // namespace grainreel
