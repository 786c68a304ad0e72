#include "engine/state/drive_motion.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "engine/base/mathematics.hpp"
#include "engine/base/numbers.hpp"
#include "engine/scene/scene.hpp"

namespace grainreel {

DriveMotion::DriveMotion(const Drive& drive, const Clock& clock)
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

DrivePose DriveMotion::at(std::int64_t step, double share_of_step) const {
    if (share_of_step == 1) return at(step + 1, 0);
    if (step < 0) return {};
    const double time = clock_.time(step) + share_of_step * clock_.step;
    if (!moving()) return {Vec3::Zero(), Vec3::Zero(), time};
    const std::size_t stretch = stretch_at(step);
    const Motion motion =
        stretch > 0 ? in_stretch(stretch, step, share_of_step) : before_stages(step, share_of_step);
    return {motion.offset * direction_, motion.velocity * direction_, time};
}

std::size_t DriveMotion::stretch_at(std::int64_t step) const {
    return pieces_.empty() ? 0 : clock_.changes.index_at(static_cast<double>(step));
}

DriveMotion::Motion DriveMotion::before_stages(std::int64_t step, double share_of_step) const {
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
DriveMotion::Motion DriveMotion::in_stretch(std::size_t index, std::int64_t step,
                                            double share_of_step) const {
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

DriveMotion::Motion DriveMotion::tap(const DriveSchedule::Piece& piece, double since) {
    const double omega = 2 * std::numbers::pi * piece.frequency;
    if (since * piece.frequency >= 1) return {};
    const double amplitude = piece.acceleration / (omega * omega);
    const auto [sine, cosine] = math::sin_cos(omega * since);
    return {amplitude * (1 - cosine), amplitude * omega * sine};
}

}  // namespace grainreel
