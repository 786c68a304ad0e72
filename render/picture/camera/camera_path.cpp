// How the camera stands and moves: its distance, its tracks through keys, and how much of a high container it
// shows.
#include "render/picture/camera/camera_path.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "engine/base/error.hpp"
#include "engine/scene/bed.hpp"
#include "render/picture/container/drawing_kit.hpp"
#include "render/picture/mesh/scene_meshes.hpp"
#include "render/scene/filmed_scene.hpp"

namespace grainreel {

namespace {

constexpr double degrees = std::numbers::pi / 180;

// degrees between the directions of an orbit that are sampled for the framing. Between two samples the
// outline is larger than in these by less than 1e-5 of its size.
constexpr double sample_angle = 0.5;
constexpr int key_samples = 720;

// The container stays at least this share of the camera's distance away from the eye.
constexpr double close_by = 0.1;

}  // namespace

void settle_orbit(Camera& camera, double film_seconds) {
    if (camera.orbit != 0 && !camera.orbit_time && film_seconds > 0) camera.orbit_time = film_seconds;
}

CameraPath::CameraPath(const FilmedScene& scene, const PictureLayout& layout)
    : camera_(scene.film.camera),
      port_(layout.port),
      picture_height_(scene.film.height),
      margin_(type_scale(scene.film).margin),
      meshes_(mesh_reach(scene)),
      stroke_(drawn_stroke(scene)),
      target_(camera_.target.value_or(camera_.position ? extent_of(scene).middle() : framed_middle(scene))) {
    make_tracks();
    if (camera_.position)
        look_from_position();
    else
        frame_by_itself(scene);
    const std::vector<Vec3> all = points_of(scene, whole_container(scene));
    for (const Vec3& point : all) radius_ = std::max(radius_, (point - target_).norm());
    if (still_) still_->nearest = std::min(still_->nearest, 0.5 * least_depth(all));
}

// The points that have to be seen of a part, at the camera's own azimuth.
std::vector<Vec3> CameraPath::points_of(const FilmedScene& scene, const FramedPart& part) const {
    return framing_points(scene, camera_.azimuth, part, meshes_, stroke_);
}

// Frames the part that framed_part() gives. If the container is cut off there, its walls may come too close
// to a camera that looks down. Then more of the container is framed, or all of it.
void CameraPath::frame_by_itself(const FilmedScene& scene) {
    FramedPart part = framed_part(scene);
    double scale = frame_part(scene, part);
    const std::vector<Vec3> all = points_of(scene, whole_container(scene));
    while (part.cut && camera_.field_of_view > 0 && least_depth(all) < close_by * distance_) {
        part.top *= 1.25;
        if (part.top >= scene.container.height) part = whole_container(scene);
        scale = frame_part(scene, part);
    }
    if (!part.cut || !still_) return;
    part = show_more(scene, part, scale);
    if (leaves_aside(scene, part)) return keep_sides(scene, part);
    const View middle = *still_;
    lower(scene, part);
    if (leaves_aside(scene, part)) still_ = middle;
}

// Returns pixels a metre at the middle of the framed part.
double CameraPath::frame_part(const FilmedScene& scene, const FramedPart& part) {
    if (camera_.target || moves()) {
        keep_distance(scene, part);
        return camera_.field_of_view <= 0 ? focal_ : focal_ / distance_;
    }
    still_ = fit_view(camera_, points_of(scene, part), port_, margin_, picture_height_);
    distance_ = still_->to_view(target_).z();
    return still_->pixels_per_metre(target_);
}

// Where the width of the port limits the scale, the height that is left over shows more of the container.
FramedPart CameraPath::show_more(const FilmedScene& scene, FramedPart part, double scale) {
    double most = scene.container.height;
    for (int i = 0; i < 20; ++i) {
        const double middle = 0.5 * (part.top + most);
        const bool as_large = frame_part(scene, {middle, true}) >= (1 - 1e-9) * scale;
        (as_large ? part.top : most) = middle;
    }
    frame_part(scene, part);
    return part;
}

// Moves the picture down until nothing is left below the framed part. In perspective, show_more() leaves some
// height, because walls that reach higher come nearer and would cost scale.
void CameraPath::lower(const FilmedScene& scene, const FramedPart& part) {
    constexpr int kTimes = 4;       // points at other depths move by other ways
    constexpr double kLeast = 0.5;  // pixels
    const std::vector<Vec3> points = points_of(scene, part);
    for (int i = 0; i < kTimes; ++i) {
        const auto lowest = std::max_element(points.begin(), points.end(), [&](const Vec3& a, const Vec3& b) {
            return still_->project(a).y() < still_->project(b).y();
        });
        const double left = port_.height - margin_ - still_->project(*lowest).y();
        if (left < kLeast) return;
        still_->eye += left / still_->pixels_per_metre(*lowest) * still_->up;
    }
}

// Whether walls above the framed part lie within the picture's height but beside its width. Slanted walls may
// do so, because they are wider above.
bool CameraPath::leaves_aside(const FilmedScene& scene, const FramedPart& part) const {
    constexpr int heights = 64;
    for (int i = 0; i <= heights; ++i) {
        const double top = part.top + (scene.container.height - part.top) * i / heights;
        for (const Vec3& point : points_of(scene, {top, true})) {
            const Eigen::Vector2d seen = still_->project(point);
            if (seen.y() >= 0 && (seen.x() < 0 || seen.x() > port_.width)) return true;
        }
    }
    return false;
}

// Frames as much more of the container as is needed to keep all walls within the picture's width. When the
// whole container is framed, no wall lies beside the picture.
void CameraPath::keep_sides(const FilmedScene& scene, FramedPart part) {
    FramedPart most = whole_container(scene);
    most.top = std::min(most.top, scene.container.height);
    for (int i = 0; i < 20; ++i) {
        const FramedPart middle{0.5 * (part.top + most.top), true};
        frame_part(scene, middle);
        (leaves_aside(scene, middle) ? part : most) = middle;
    }
    frame_part(scene, most);
}

// m: the depth of the nearest of these points over the whole way of the camera.
double CameraPath::least_depth(const std::vector<Vec3>& points) const {
    double least = 1e300;
    const auto take = [&](const View& view) {
        for (const Vec3& point : points) least = std::min(least, view.to_view(point).z());
    };
    if (still_) {
        take(*still_);
        return least;
    }
    for (const Pose& here : samples()) {
        View view = looking(here.azimuth, here.elevation, camera_.up);
        view.eye = target_ + shift_ * view.up - distance_ * view.forward;
        take(view);
    }
    return least;
}

// The track of one quantity, through the keys that give a value for it. If the first key gives none, the
// track begins at `at_first`. If no key gives one, there is no track.
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
    const Vec3 from_target = *camera_.position - target_;
    distance_ = from_target.norm();
    Vec3 back = from_target;
    if (camera_.up != Vec3(0, 0, 1)) {
        const Vec3 front = front_of(camera_.up);
        back = {from_target.dot(front), from_target.dot(camera_.up.cross(front)),
                from_target.dot(camera_.up)};
    }
    if (std::hypot(back.x(), back.y()) > 1e-9 * distance_)
        camera_.azimuth = std::atan2(back.y(), back.x()) / degrees;
    camera_.elevation = std::asin(std::clamp(back.z() / distance_, -1.0, 1.0)) / degrees;
    focal_ = focal_length(camera_, picture_height_);
}

// Poses of the camera in the course of the film, near enough to each other for the automatic framing.
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

void CameraPath::keep_distance(const FilmedScene& scene, const FramedPart& part) {
    Framing framing(camera_, port_, margin_, picture_height_);
    const Vec3 middle = framed_middle(scene);
    for (const Pose& here : samples()) {
        const View view = looking(here.azimuth, here.elevation, camera_.up);
        for (const Vec3& point : framing_points(scene, here.azimuth, part, meshes_, stroke_))
            framing.take(view, point - middle);
    }
    focal_ = framing.focal();
    distance_ = framing.distance();
    // A camera with a target of its own looks right at it.
    shift_ = camera_.target || !place_.empty() ? 0 : framing.shift();
}

View CameraPath::at(double film_time) const {
    if (still_) return *still_;
    const Pose here = pose(film_time);
    View view = looking(here.azimuth, here.elevation, camera_.up);
    view.port = port_;
    view.orthographic = camera_.field_of_view <= 0;
    view.focal = focal_ * here.zoom;
    view.eye = here.target + shift_ * view.up - distance_ * view.forward;
    const double reach = radius_ + (here.target - target_).norm();
    view.nearest = std::max(0.01 * distance_, distance_ - 2 * reach);
    view.farthest = distance_ + 4 * reach;
    return view;
}

View frame_container(const FilmedScene& scene, const PictureLayout& layout) {
    return CameraPath(scene, layout).at(0);
}

MonotoneCurve::MonotoneCurve(std::vector<double> times, std::vector<double> values)
    : times_(std::move(times)), values_(std::move(values)), slopes_(times_.size(), 0.0) {
    GRAINREEL_CHECK(!times_.empty() && times_.size() == values_.size());
    const auto secant = [&](std::size_t i) {
        return (values_[i + 1] - values_[i]) / (times_[i + 1] - times_[i]);
    };
    for (std::size_t i = 1; i + 1 < times_.size(); ++i) {
        const double before = secant(i - 1), after = secant(i);
        if (before * after <= 0) continue;
        const double h0 = times_[i] - times_[i - 1], h1 = times_[i + 1] - times_[i];
        const double w0 = 2 * h1 + h0, w1 = h1 + 2 * h0;
        slopes_[i] = (w0 + w1) / (w0 / before + w1 / after);
    }
}

double MonotoneCurve::at(double time) const {
    if (time <= times_.front()) return values_.front();
    if (time >= times_.back()) return values_.back();
    const auto next = std::upper_bound(times_.begin(), times_.end(), time);
    const auto i = static_cast<std::size_t>(next - times_.begin()) - 1;
    const double h = times_[i + 1] - times_[i], s = (time - times_[i]) / h, r = 1 - s;
    return values_[i] * r * r * (1 + 2 * s) + values_[i + 1] * s * s * (3 - 2 * s) +
           h * s * r * (slopes_[i] * r - slopes_[i + 1] * s);
}

double framed_scale(const FilmedScene& scene, const PictureLayout& layout) {
    return frame_container(scene, layout).pixels_per_metre(framed_middle(scene));
}

double framed_height(const FilmedScene& scene, const PictureLayout& layout) {
    const View view = frame_container(scene, layout);
    double top = view.port.height, bottom = 0;
    for (const Vec3& point : framing_points(scene)) {
        const double y = view.project(point).y();
        top = std::min(top, y);
        bottom = std::max(bottom, y);
    }
    return bottom - top;
}

}  // namespace grainreel
