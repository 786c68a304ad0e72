#include "engine/scene/drive_schedule.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "engine/base/mathematics.hpp"
#include "engine/base/numbers.hpp"

namespace grainreel {

namespace {

using Kind = DriveStage::Kind;

// In periods. If a stage's `from` is later than the start of a period by less than this, the stage still
// begins with that period.
constexpr double hair = 1e-6;
constexpr int looks_at_change = 256;

double acceleration_of(double amplitude, double frequency) {
    const double omega = 2 * std::numbers::pi * frequency;
    return amplitude * omega * omega;
}

double amplitude_of(double acceleration, double frequency) {
    const double omega = 2 * std::numbers::pi * frequency;
    return acceleration > 0 ? acceleration / (omega * omega) : 0;  // at rest there is no frequency either
}

// The piece of a stage that vibrates, taps or rests without a change.
DriveSchedule::Piece piece_of(std::size_t stage, Kind kind, double frequency, double amplitude,
                              double interval) {
    const double acceleration = acceleration_of(amplitude, frequency);
    return {stage, kind, frequency, frequency, acceleration, acceleration, interval};
}

}  // namespace

DriveSchedule::DriveSchedule(const Drive& drive) {
    // If the first stage holds from the start, there is no time for the drive before it.
    const bool at_once = drive.changes() && drive.stages.front().from <= 0;
    add({0, 0, 1 / drive.frequency, 1 / drive.frequency},
        piece_of(0, at_once ? Kind::rest : Kind::vibrate, drive.frequency, at_once ? 0 : drive.amplitude, 0));
    for (std::size_t k = 0; k < drive.stages.size(); ++k) begin(k + 1, drive.stages[k]);
}

void DriveSchedule::add(const PeriodStretch& stretch, const Piece& piece) {
    times_.add(stretch);
    pieces_.push_back(piece);
}

void DriveSchedule::begin(std::size_t stage, const DriveStage& next) {
    const Piece before = pieces_.back();
    const PeriodStretch last = times_.stretches().back();
    const double cycles =
        std::max(last.cycles, std::ceil(last.cycles + last.cycles_after(next.from - last.start) - hair));
    PeriodStretch stretch{last.start + last.time_after(cycles - last.cycles), cycles, last.period,
                          last.period};
    const bool vibrated = before.kind == Kind::vibrate, vibrates = next.kind == Kind::vibrate;
    const Piece after = piece_of(stage, next.kind, next.frequency, next.amplitude, next.interval);
    const bool same = vibrated && vibrates && before.frequency == after.frequency &&
                      before.acceleration == after.acceleration;
    if ((vibrated || vibrates) && !same) {
        Piece change = after;
        change.kind = Kind::vibrate;
        if (vibrated)
            change.frequency_before = before.frequency;
        else
            stretch.period = 1 / after.frequency;  // nothing moves before, so the new period holds at once
        if (!vibrates) change.frequency = before.frequency;
        change.acceleration_before = vibrated ? before.acceleration : 0;
        change.acceleration = vibrates ? after.acceleration : 0;
        change.interval = 0;
        stretch.period_after = 1 / change.frequency;
        stretch.length = length_of_change(next.over, stretch.period, stretch.period_after);
        add(stretch, change);
        stretch = {stretch.start + stretch.length, cycles + next.over, stretch.period_after};
    }
    if (vibrates) stretch.period = 1 / after.frequency;
    if (next.kind == Kind::taps) stretch.period = next.interval;
    stretch.period_after = stretch.period;
    add(stretch, after);
}

DriveChange DriveSchedule::change(std::size_t piece) const {
    const Piece& p = pieces_[piece];
    return {p.frequency_before, p.frequency, p.acceleration_before, p.acceleration,
            times_.stretches()[piece].length};
}

double DriveSchedule::begins(std::size_t stage) const {
    const auto first = std::find_if(pieces_.begin(), pieces_.end(),
                                    [&](const Piece& piece) { return piece.stage == stage; });
    return times_.stretches()[first - pieces_.begin()].start;
}

double DriveSchedule::settled(std::size_t stage) const {
    const auto last = std::find_if(pieces_.rbegin(), pieces_.rend(),
                                   [&](const Piece& piece) { return piece.stage == stage; });
    return times_.stretches()[static_cast<std::size_t>(pieces_.rend() - last) - 1].start;
}

DriveSchedule::Now DriveSchedule::now(double cycles) const {
    const std::size_t index = times_.index_at_cycles(cycles + hair);
    const Piece& piece = pieces_[index];
    const PeriodStretch& stretch = times_.stretches()[index];
    Now now{piece.stage,
            piece.kind,
            stretch.changes(),
            piece.frequency,
            amplitude_of(piece.acceleration, piece.frequency),
            piece.interval};
    if (!now.changing) return now;
    const double u = std::clamp(stretch.time_after(cycles - stretch.cycles) / stretch.length, 0.0, 1.0);
    const DriveChange::Values values = change(index).at(u);
    now.frequency = values.omega / (2 * std::numbers::pi);
    now.amplitude = values.amplitude;
    return now;
}

DriveSchedule::Now drive_now(const Drive& drive, double cycles) {
    if (drive.changes()) return DriveSchedule(drive).now(cycles);
    DriveSchedule::Now now;
    now.frequency = drive.frequency;
    now.amplitude = drive.amplitude;
    return now;
}

DrivePeaks drive_peaks(const Drive& drive) {
    const double omega = 2 * std::numbers::pi * drive.frequency;
    // Without a ramp the sine may begin at any phase. The offset counts from where the container is then, so
    // it can be larger than the amplitude.
    const double farthest =
        1 + (drive.ramp > 0 ? 0 : std::abs(math::sin(2 * std::numbers::pi * drive.phase)));
    DrivePeaks peaks{drive.frequency, farthest * drive.amplitude, drive.speed(),
                     drive.amplitude * omega * omega};
    if (!drive.changes()) return peaks;
    const DriveSchedule schedule(drive);
    peaks = {};
    const auto take = [&](double frequency, const Envelope& most, double from_rest) {
        peaks.frequency = std::max(peaks.frequency, frequency);
        peaks.offset = std::max(peaks.offset, from_rest * most.offset);
        peaks.speed = std::max(peaks.speed, most.speed);
        peaks.acceleration = std::max(peaks.acceleration, most.acceleration);
    };
    for (std::size_t i = 0; i < schedule.pieces().size(); ++i) {
        const DriveSchedule::Piece& piece = schedule.pieces()[i];
        const bool changes = schedule.times().stretches()[i].changes();
        for (int k = 0; changes && k <= looks_at_change; ++k)
            take(0, envelope_of(schedule.change(i).at(static_cast<double>(k) / looks_at_change)), farthest);
        if (changes || piece.kind == Kind::rest) continue;
        const double amplitude = amplitude_of(piece.acceleration, piece.frequency);
        take(piece.frequency,
             {amplitude, amplitude * 2 * std::numbers::pi * piece.frequency, piece.acceleration},
             piece.kind == Kind::taps ? 2 : farthest);
    }
    return peaks;
}

double peak_acceleration_of_change(const DriveSchedule& schedule, std::size_t stage) {
    double peak = 0;
    for (std::size_t i = 0; i < schedule.pieces().size(); ++i)
        for (int k = 0; schedule.pieces()[i].stage == stage && schedule.times().stretches()[i].changes() &&
                        k <= looks_at_change;
             ++k)
            peak = std::max(
                peak,
                envelope_of(schedule.change(i).at(static_cast<double>(k) / looks_at_change)).acceleration);
    return peak;
}

DriveChange::Values DriveChange::at(double u) const {
    const double s = smooth_step::value(u), rate = smooth_step::slope(u) / duration,
                 rate2 = smooth_step::curvature(u) / (duration * duration);
    const double more_omega = 2 * std::numbers::pi * (frequency - frequency_before);
    const double more_acceleration = acceleration - acceleration_before;
    Values v{};
    v.omega = 2 * std::numbers::pi * frequency_before + more_omega * s;
    v.omega_rate = more_omega * rate;
    // a = A / w^2, and its derivatives by the chain rule.
    const double level = acceleration_before + more_acceleration * s, w2 = v.omega * v.omega;
    const double level_rate = more_acceleration * rate, level_rate2 = more_acceleration * rate2;
    const double growth = v.omega_rate / v.omega, omega_rate2 = more_omega * rate2;
    v.amplitude = level / w2;
    v.amplitude_rate = (level_rate - 2 * level * growth) / w2;
    v.amplitude_rate2 =
        (level_rate2 - 4 * level_rate * growth + level * (6 * growth * growth - 2 * omega_rate2 / v.omega)) /
        w2;
    return v;
}

// z = a sin p with p' = w: z' = a' sin p + a w cos p, z'' = (a'' - a w^2) sin p + (2 a' w + a w') cos p.
Envelope envelope_of(const DriveChange::Values& v) {
    return {v.amplitude, math::hypot(v.amplitude_rate, v.amplitude * v.omega),
            math::hypot(v.amplitude_rate2 - v.amplitude * v.omega * v.omega,
                        2 * v.amplitude_rate * v.omega + v.amplitude * v.omega_rate)};
}

}  // namespace grainreel
