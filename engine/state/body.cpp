#include "engine/state/body.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "engine/base/mathematics.hpp"
#include "engine/base/numbers.hpp"
#include "engine/base/rotation.hpp"

namespace grainreel {

std::vector<Body> bodies_of(const Drive& drive, const std::vector<FreeWall>& planes) {
    std::vector<Body> bodies{
        {kContainerBody, drive.present && drive.moves == Drive::Moves::container, Vec3(0, 0, 0)},
        {kFloorBody, drive.present, Vec3(0, 0, 0)}};
    for (const FreeWall& plane : planes)
        bodies.push_back({static_cast<std::int32_t>(bodies.size()), plane.moves, plane.velocity});
    return bodies;
}

std::vector<Body> bodies_of(const Scene& scene) {
    std::vector<Body> bodies = bodies_of(scene.drive, scene.walls);
    bodies[kContainerBody].turn = bodies[kFloorBody].turn = scene.container.turn;
    for (const SceneMesh& mesh : scene.meshes) {
        const auto number = static_cast<std::int32_t>(bodies.size());
        bodies.push_back({number, mesh.driven, mesh.velocity, mesh.turn, mesh.path.of});
    }
    return bodies;
}

// Before the motion starts (time 0) nothing has moved. The body is turned first, then displaced.
BodyPose Body::at(const Pose& drive) const {
    BodyPose pose{place_at(drive), Quaternion::Identity(), velocity_at(drive), Vec3(0, 0, 0)};
    if (turn) {
        pose.rotation = rotation_about(turn->axis, turn->angle_at(drive.time));
        pose.spin = turn->rate_at(drive.time) * turn->axis;
        const Vec3 arm =
            pose.rotation * turn->through;  // vector from the body's origin to the point of the axis
        pose.place += turn->through - arm;
        pose.velocity -= pose.spin.cross(arm);
    }
    if (path) {
        const PathPose on_path = path->at(drive.time);
        pose.place += on_path.place;
        pose.rotation = on_path.rotation;
        pose.velocity += on_path.velocity;
        pose.spin = on_path.spin;
    }
    return pose;
}

std::vector<BodyPose> poses_of(const std::vector<Body>& bodies, const Pose& drive) {
    std::vector<BodyPose> poses;
    for (const Body& body : bodies) poses.push_back(body.at(drive));
    return poses;
}

// The floor follows every drive. Before the drive starts all bodies are at rest.
void add_planes(const std::vector<FreeWall>& planes, double time, std::vector<BodyPose>& poses) {
    Pose drive;
    if (time >= 0) drive = {poses.at(kFloorBody).place, poses.at(kFloorBody).velocity, time};
    const std::vector<Body> bodies = bodies_of({}, planes);
    for (std::size_t b = poses.size(); b < bodies.size(); ++b) poses.push_back(bodies[b].at(drive));
}

WallMotion::WallMotion(const Drive& drive, const Clock& clock)
    : moving_(drive.present && drive.largest_amplitude() > 0),
      amplitude_(drive.present ? drive.amplitude : 0),
      angular_frequency_(2 * std::numbers::pi * drive.frequency),
      ramp_(drive.ramp),
      start_phase_(2 * std::numbers::pi * drive.phase),
      start_sine_(math::sin(start_phase_)),
      direction_(drive.direction),
      clock_(clock) {
    if (drive.present && drive.changes()) pieces_ = DriveSchedule(drive).pieces();
}

Pose WallMotion::at(std::int64_t step, double share_of_step) const {
    if (share_of_step == 1) return at(step + 1, 0);
    if (step < 0) return {};
    const double time = clock_.time(step) + share_of_step * clock_.step;
    if (!moving()) return {Vec3::Zero(), Vec3::Zero(), time};
    const std::size_t stretch = stretch_at(step);
    const Motion motion =
        stretch > 0 ? in_stretch(stretch, step, share_of_step) : before_stages(step, share_of_step);
    return {motion.offset * direction_, motion.velocity * direction_, time};
}

std::size_t WallMotion::stretch_at(std::int64_t step) const {
    return pieces_.empty() ? 0 : clock_.changes.index_at(static_cast<double>(step));
}

WallMotion::Motion WallMotion::before_stages(std::int64_t step, double share_of_step) const {
    const double more =
        clock_.steps_per_period > 0 ? share_of_step / static_cast<double>(clock_.steps_per_period) : 0;
    const double angle = 2 * std::numbers::pi * (clock_.phase(step) + more);
    const auto [sine, cosine] = math::sin_cos(angle);
    double share = 1, share_rate = 0, start = 0;
    if (ramp_ > 0) {
        const double u = (clock_.cycles(step) + more) / ramp_;
        if (u < 1) {
            share = smooth_step::value(u);
            share_rate = smooth_step::slope(u) * angular_frequency_ / (2 * std::numbers::pi * ramp_);
        }
    } else {
        start = start_sine_;
    }
    return {amplitude_ * (share * sine - start),
            amplitude_ * (share * angular_frequency_ * cosine + share_rate * sine)};
}

// A step that begins in one stretch and ends in the next follows the first of them. Where two stretches meet,
// they agree in place, velocity and acceleration.
WallMotion::Motion WallMotion::in_stretch(std::size_t index, std::int64_t step, double share_of_step) const {
    const DriveSchedule::Piece& piece = pieces_[index];
    const PeriodStretch& stretch = clock_.changes.stretches()[index];
    const double begins = std::floor(stretch.start), whole = static_cast<double>(step) - begins,
                 part = begins - stretch.start + share_of_step;
    if (piece.kind == DriveStage::Kind::rest) return {};
    if (piece.kind == DriveStage::Kind::taps)
        return tap(piece, stretch.into_period(whole, part) * clock_.step);
    const bool changes = stretch.changes();
    const DriveChange change{piece.frequency_before, piece.frequency, piece.acceleration_before,
                             piece.acceleration, changes ? stretch.length * clock_.step : 1};
    const DriveChange::Values now = change.at(changes ? std::min(1.0, (whole + part) / stretch.length) : 1);
    const double angle = start_phase_ + 2 * std::numbers::pi * stretch.turns_after(whole, part);
    const auto [sine, cosine] = math::sin_cos(angle);
    const double start = ramp_ > 0 ? 0 : start_sine_;
    return {now.amplitude * (sine - start),
            now.amplitude_rate * (sine - start) + now.amplitude * now.omega * cosine};
}

WallMotion::Motion WallMotion::tap(const DriveSchedule::Piece& piece, double since) {
    const double omega = 2 * std::numbers::pi * piece.frequency;
    if (since * piece.frequency >= 1) return {};
    const double amplitude = piece.acceleration / (omega * omega);
    const auto [sine, cosine] = math::sin_cos(omega * since);
    return {amplitude * (1 - cosine), amplitude * omega * sine};
}

}  // namespace grainreel
