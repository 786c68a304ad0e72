#include "render/draw/camera_path.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "engine/scene/bed.hpp"
#include "render/draw/container_drawing.hpp"

namespace grainreel {
namespace {

constexpr double degrees = std::numbers::pi / 180;

// Half a degree apart the outline of what turns differs by less than 1e-5 of its size from its largest.
constexpr double sample_angle = 0.5;
constexpr int key_samples = 720;

}  // namespace

void settle_orbit(Camera& camera, double film_seconds) {
    if (camera.orbit != 0 && !camera.orbit_time && film_seconds > 0) camera.orbit_time = film_seconds;
}

CameraPath::CameraPath(const Scene& scene, const PictureLayout& layout)
    : camera_(scene.film.camera),
      port_(layout.port),
      picture_height_(scene.film.height),
      target_(camera_.target.value_or(extent_of(scene).middle())) {
    make_tracks();
    const double margin = type_scale(scene.film).margin;
    if (camera_.position)
        look_from_position();
    else if (camera_.target || moves())
        keep_distance(scene, margin);
    else
        still_ = fit_view(camera_, framing_points(scene), port_, margin, picture_height_);
    for (const Vec3& point : framing_points(scene)) radius_ = std::max(radius_, (point - target_).norm());
}

// Through those keys that say something, from `at_first` where the first one does not; none says: no track.
template <class Value>
CameraPath::Track CameraPath::track(double at_first, Value value) const {
    std::vector<double> times, values;
    for (const CameraKey& key : camera_.keys)
        if (const std::optional<double> here = value(key)) {
            times.push_back(key.time);
            values.push_back(*here);
        }
    if (times.empty()) return {};
    if (times.front() > camera_.keys.front().time) {
        times.insert(times.begin(), camera_.keys.front().time);
        values.insert(values.begin(), at_first);
    }
    return MonotoneCurve(std::move(times), std::move(values));
}

void CameraPath::make_tracks() {
    azimuth_ = track(camera_.azimuth, [](const CameraKey& key) { return key.azimuth; });
    elevation_ = track(camera_.elevation, [](const CameraKey& key) { return key.elevation; });
    zoom_ = track(std::log(camera_.zoom), [](const CameraKey& key) {
        return key.zoom ? std::optional(std::log(*key.zoom)) : std::nullopt;
    });
    for (int axis = 0; axis < 3; ++axis) {
        const Track along = track(target_[axis], [axis](const CameraKey& key) {
            return key.target ? std::optional((*key.target)[axis]) : std::nullopt;
        });
        if (along) place_.push_back(*along);
    }
}

CameraPath::Pose CameraPath::pose(double film_time) const {
    const double turned =
        camera_.orbit_time ? camera_.orbit * std::max(0.0, film_time) / *camera_.orbit_time : 0;
    Pose pose{camera_.azimuth + std::fmod(turned, 360), camera_.elevation, camera_.zoom, target_};
    if (azimuth_) pose.azimuth = azimuth_->at(film_time);
    if (elevation_) pose.elevation = elevation_->at(film_time);
    if (zoom_) pose.zoom = std::exp(zoom_->at(film_time));
    if (!place_.empty())
        pose.target = {place_[0].at(film_time), place_[1].at(film_time), place_[2].at(film_time)};
    return pose;
}

void CameraPath::look_from_position() {
    const Vec3 back = *camera_.position - target_;
    distance_ = back.norm();
    if (std::hypot(back.x(), back.y()) > 1e-9 * distance_)
        camera_.azimuth = std::atan2(back.y(), back.x()) / degrees;
    camera_.elevation = std::asin(std::clamp(back.z() / distance_, -1.0, 1.0)) / degrees;
    focal_ = focal_length(camera_, picture_height_);
}

// Where the camera points in the course of the film, close enough for its framing.
std::vector<CameraPath::Pose> CameraPath::samples() const {
    std::vector<Pose> poses;
    const double turn = std::min(std::abs(camera_.orbit), 360.0);
    const double start = camera_.keys.empty() ? 0 : camera_.keys.front().time;
    const double end = camera_.keys.empty() ? 0 : camera_.keys.back().time;
    const int count = camera_.keys.empty() ? static_cast<int>(std::ceil(turn / sample_angle)) : key_samples;
    for (int i = 0; i <= count; ++i) {
        const double share = count > 0 ? static_cast<double>(i) / count : 0;
        Pose here = pose(start + share * (end - start));
        if (camera_.keys.empty()) here.azimuth = camera_.azimuth + std::copysign(share * turn, camera_.orbit);
        poses.push_back(here);
    }
    return poses;
}

void CameraPath::keep_distance(const Scene& scene, double margin) {
    Framing framing(camera_, port_, margin, picture_height_);
    const Vec3 middle = extent_of(scene).middle();
    for (const Pose& here : samples()) {
        const View view = looking(here.azimuth, here.elevation);
        for (const Vec3& point : framing_points(scene, here.azimuth)) framing.take(view, point - middle);
    }
    focal_ = framing.focal();
    distance_ = framing.distance();
    // With a target of its own the camera looks right at it.
    shift_ = camera_.target || !place_.empty() ? 0 : framing.shift();
}

View CameraPath::at(double film_time) const {
    if (still_) return *still_;
    const Pose here = pose(film_time);
    View view = looking(here.azimuth, here.elevation);
    view.port = port_;
    view.orthographic = camera_.field_of_view <= 0;
    view.focal = focal_ * here.zoom;
    view.eye = here.target + shift_ * view.up - distance_ * view.forward;
    const double reach = radius_ + (here.target - target_).norm();
    view.nearest = std::max(0.01 * distance_, distance_ - 2 * reach);
    view.farthest = distance_ + 4 * reach;
    return view;
}

}  // namespace grainreel
