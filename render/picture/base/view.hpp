// The camera at one moment, which projects metres to pixels of the port (the part of the picture that shows
// the container), and how far it must stand away so that everything is in the picture.
#pragma once

#include <vector>

#include "engine/base/vector.hpp"
#include "engine/state/state.hpp"
#include "render/picture/base/picture.hpp"
#include "render/scene/filmed_scene.hpp"

namespace grainreel {

// View coordinates: x right, y up, z away from the eye.
struct View {
    Vec3 eye{0, 0, 0};
    Vec3 right{0, 1, 0}, up{0, 0, 1}, forward{-1, 0, 0};  // orthonormal
    bool orthographic = false;
    double focal = 1;                  // pixels a unit of x/z (perspective), or pixels a metre (orthographic)
    double nearest = 0, farthest = 1;  // m: view depths stored as 0 and 1
    Rectangle port;

    Vec3 to_view(const Vec3& point) const {
        const Vec3 from = point - eye;
        return {from.dot(right), from.dot(up), from.dot(forward)};
    }
    // Pixels from the top left of the port. The point must lie in front of the eye.
    Eigen::Vector2d project(const Vec3& point) const {
        const Vec3 v = to_view(point);
        const double scale = orthographic ? focal : focal / v.z();
        return {0.5 * port.width + scale * v.x(), 0.5 * port.height - scale * v.y()};
    }
    double pixels_per_metre(const Vec3& at) const { return orthographic ? focal : focal / to_view(at).z(); }
    // Whether the eye lies on the side of the plane that the normal points to.
    bool faces(const Vec3& point, const Vec3& normal) const {
        return orthographic ? normal.dot(forward) < 0 : normal.dot(eye - point) > 0;
    }
    View moved_by(const Vec3& offset) const {
        View view = *this;
        view.eye += offset;
        return view;
    }
};

// A view with directions only. azimuth and elevation (degrees) and up (unit) are those of Camera.
View looking(double azimuth, double elevation, const Vec3& up = Vec3(0, 0, 1));

// The direction towards the eye at azimuth and elevation 0. It is the component perpendicular to `up` of z
// where `up` is nearly level, and of x elsewhere.
Vec3 front_of(const Vec3& up);

// Pixels for one unit of x/z at the camera's field of view, without its zoom; 1 for an orthographic camera.
double focal_length(const Camera& camera, int picture_height);

// The distance of a camera that turns about one point. Framing takes views and points, and finds how far from
// that point the eye has to stand so that everything is inside the port, `margin` pixels from its border. The
// point stays in the middle of the port sideways, or turning would look like swaying. All views have the same
// shift upwards.
class Framing {
  public:
    Framing(const Camera& camera, const Rectangle& port, double margin, int picture_height);
    void take(const View& directions, const Vec3& from_middle);
    double distance() const;  // m
    double shift() const;     // m, of the eye along the picture's upward direction
    double focal() const;     // View::focal without the zoom

  private:
    const bool orthographic_;
    const double half_width_, half_height_, focal_;
    double farthest_aside_ = 0, back_aside_ = 0, reach_ = 0;  // m
    // m: the extremes of y; in perspective those of y - k z and y + k z, with k the slope of the frustum's
    // side.
    double highest_ = -1e300, lowest_ = 1e300;
};

// The view with the nearest eye in the camera's direction from which all `points` lie inside the port,
// `margin` pixels from its border; the zoom then magnifies it. picture_height: pixels that the field of view
// spans.
View fit_view(const Camera& camera, const std::vector<Vec3>& points, const Rectangle& port, double margin,
              int picture_height);

// m: how far the container has come from its place at rest, for things that go with its shaking but not with
// its turning. In a container that turns it is the displacement of a point on the axis.
inline Vec3 way_of_container(const FilmedScene& scene, const State& frame) {
    const std::optional<BodyTurn>& turn = scene.container.turn;
    return turn ? Vec3(frame.container().moved(turn->through) - turn->through) : frame.container().place;
}

}  // namespace grainreel
