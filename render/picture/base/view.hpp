// The camera: from metres to pixels of the part of the picture that shows the container.
#pragma once

#include <vector>

#include "engine/base/vector.hpp"
#include "engine/frame.hpp"
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
    // Pixels from the top left of the port; meaningful in front of the eye only.
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

// Directions only: azimuth and elevation in degrees and the upward direction (unit), as in Camera.
View looking(double azimuth, double elevation, const Vec3& up = Vec3(0, 0, 1));

// The direction towards the eye at azimuth and elevation 0: along x, or z where up is across that.
Vec3 front_of(const Vec3& up);

// Pixels a unit of x/z that the camera's field of view means, zoom left out; 1 for an orthographic camera.
double focal_length(const Camera& camera, int picture_height);

// What a camera that turns about one point must be able to do: over all views and points taken, how far back
// from there the eye has to stand so that everything is inside the port, `margin` pixels from its border.
// Sideways the point stays in the port's middle, or turning would look like swaying; upwards one shift serves
// all.
class Framing {
  public:
    Framing(const Camera& camera, const Rectangle& port, double margin, int picture_height);
    void take(const View& directions, const Vec3& from_middle);
    double distance() const;  // m
    double shift() const;     // m, of the eye along the picture's upward direction
    double focal() const;     // as View's, zoom left out

  private:
    const bool orthographic_;
    const double half_width_, half_height_, focal_;
    double farthest_aside_ = 0, back_aside_ = 0, reach_ = 0;  // m
    double highest_ = -1e300, lowest_ = 1e300;  // m, of y; of y - k z and y + k z in perspective
};

// The nearest eye in the camera's direction from which all `points` lie inside the port, `margin` pixels from
// its border; then magnified by the zoom. picture_height: pixels, what the field of view spans.
View fit_view(const Camera& camera, const std::vector<Vec3>& points, const Rectangle& port, double margin,
              int picture_height);

// How far the container has come, for what goes with its shaking and not with its turning.

// m, from its place at rest; of one that turns, of a point on its axis.
inline Vec3 way_of_container(const FilmedScene& scene, const Frame& frame) {
    const std::optional<BodyTurn>& turn = scene.container.turn;
    return turn ? Vec3(frame.container().moved(turn->through) - turn->through) : frame.container().place;
}

}  // namespace grainreel
