// The geometry of the camera: where the eye must stand so that all given points are in the picture.
#include "render/picture/base/view.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace grainreel {

namespace {

constexpr double degrees = std::numbers::pi / 180;

struct Spread {
    double low = std::numeric_limits<double>::infinity();
    double high = -std::numeric_limits<double>::infinity();
    void take(double value) {
        low = std::min(low, value);
        high = std::max(high, value);
    }
    double middle() const { return 0.5 * (low + high); }
    double size() const { return high - low; }
};

// Along one axis of the picture a point (u, z) is inside when |u - c| <= k (D + z). D is the eye's distance
// from the origin, c is its shift, and k is the slope of the frustum's side. So c must lie between max(u - k
// z) - k D and min(u + k z) + k D, which gives the least D and then c.
struct ViewAxis {
    Spread rising, falling;  // spreads of u + k z and of u - k z
    double slope;
    void take(double u, double z) {
        rising.take(u + slope * z);
        falling.take(u - slope * z);
    }
    double least_distance() const { return (falling.high - rising.low) / (2 * slope); }
    double shift() const { return 0.5 * (falling.high + rising.low); }
};

}  // namespace

Vec3 front_of(const Vec3& up) {
    const Vec3 front = std::abs(up.z()) < 0.5 ? Vec3::UnitZ() : Vec3::UnitX();
    return (front - front.dot(up) * up).normalized();
}

View looking(double azimuth, double elevation, const Vec3& up) {
    const double a = azimuth * degrees, e = elevation * degrees;
    View view;
    if (up != Vec3(0, 0, 1)) {
        const Vec3 front = front_of(up), aside = up.cross(front);
        view.forward = -(std::cos(e) * (std::cos(a) * front + std::sin(a) * aside) + std::sin(e) * up);
        view.right = -std::sin(a) * front + std::cos(a) * aside;
        view.up = view.right.cross(view.forward);
        return view;
    }
    view.forward = -Vec3(std::cos(e) * std::cos(a), std::cos(e) * std::sin(a), std::sin(e));
    view.right = Vec3(-std::sin(a), std::cos(a), 0);
    view.up = view.right.cross(view.forward);
    return view;
}

double focal_length(const Camera& camera, int picture_height) {
    if (camera.field_of_view <= 0) return 1;
    return 0.5 * picture_height / std::tan(0.5 * camera.field_of_view * degrees);
}

Framing::Framing(const Camera& camera, const Rectangle& port, double margin, int picture_height)
    : orthographic_(camera.field_of_view <= 0),
      half_width_(std::max(1.0, 0.5 * port.width - margin)),
      half_height_(std::max(1.0, 0.5 * port.height - margin)),
      focal_(focal_length(camera, picture_height)) {}

void Framing::take(const View& directions, const Vec3& from_middle) {
    const double x = std::abs(from_middle.dot(directions.right)), y = from_middle.dot(directions.up),
                 z = from_middle.dot(directions.forward);
    const double slope = orthographic_ ? 0 : half_height_ / focal_;
    reach_ = std::max(reach_, from_middle.norm());
    farthest_aside_ = std::max(farthest_aside_, x);
    back_aside_ = std::max(back_aside_, x * focal_ / half_width_ - z);
    highest_ = std::max(highest_, y - slope * z);
    lowest_ = std::min(lowest_, y + slope * z);
}

double Framing::distance() const {
    if (orthographic_) return 2 * reach_;
    return std::max(back_aside_, 0.5 * (highest_ - lowest_) * focal_ / half_height_);
}

double Framing::shift() const {
    return 0.5 * (highest_ + lowest_);
}

double Framing::focal() const {
    if (!orthographic_) return focal_;
    return std::min(half_width_ / farthest_aside_, 2 * half_height_ / (highest_ - lowest_));
}

View fit_view(const Camera& camera, const std::vector<Vec3>& points, const Rectangle& port, double margin,
              int picture_height) {
    View view = looking(camera.azimuth, camera.elevation, camera.up);
    view.port = port;
    view.orthographic = camera.field_of_view <= 0;

    const double half_width = std::max(1.0, 0.5 * port.width - margin);
    const double half_height = std::max(1.0, 0.5 * port.height - margin);
    const double focal = focal_length(camera, picture_height);
    Spread across, upward, away;
    ViewAxis sideways{{}, {}, half_width / focal}, vertical{{}, {}, half_height / focal};
    for (const Vec3& point : points) {
        const double x = point.dot(view.right), y = point.dot(view.up), z = point.dot(view.forward);
        across.take(x);
        upward.take(y);
        away.take(z);
        sideways.take(x, z);
        vertical.take(y, z);
    }

    const double size = std::max({across.size(), upward.size(), away.size()});
    if (view.orthographic) {
        const double back = size - away.low;
        view.eye = across.middle() * view.right + upward.middle() * view.up - back * view.forward;
        view.focal = camera.zoom * std::min(2 * half_width / across.size(), 2 * half_height / upward.size());
    } else {
        const double back = std::max(sideways.least_distance(), vertical.least_distance());
        view.eye = sideways.shift() * view.right + vertical.shift() * view.up - back * view.forward;
        view.focal = focal * camera.zoom;
    }
    const double front = view.forward.dot(-view.eye) + away.low;  // m: view depth of the nearest point
    // This leaves room for grains that have left the container. The depth is linear, so room costs little
    // precision.
    view.nearest = std::max(0.01 * front, front - 2 * size);
    view.farthest = front + 4 * size;
    return view;
}

}  // namespace grainreel
