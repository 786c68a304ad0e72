// Tests of a drive that changes: place and velocity where stages meet, accelerations, the count of periods,
// taps, rest, and a ball that meets the plate during a change.
#include <gtest/gtest.h>

#include "engine/plan/times.hpp"
#include "engine/scene/drive_schedule.hpp"
#include "engine/state/drive_motion.hpp"
#include "tests/physics/world.hpp"

namespace grainreel {
namespace {

using std::numbers::pi;
using Kind = DriveStage::Kind;

constexpr double kGravity = 9.81;

double amplitude_of(double g_level, double frequency) {
    return g_level * kGravity / std::pow(2 * pi * frequency, 2);
}

DriveStage stage(Kind kind, double from, double frequency, double g_level, double interval = 0) {
    return {kind, from, 3, frequency, kind == Kind::rest ? 0 : amplitude_of(g_level, frequency), interval};
}

Drive drive_of(std::vector<DriveStage> stages, double frequency = 20, double g_level = 3) {
    Drive drive;
    drive.present = true;
    drive.frequency = frequency;
    drive.amplitude = amplitude_of(g_level, frequency);
    drive.stages = std::move(stages);
    return drive;
}

// 31 Hz has no whole number of steps where 20 Hz has 8000.
Drive changing_drive() {
    return drive_of({stage(Kind::vibrate, 0.5, 31, 2), stage(Kind::rest, 1.02, 0, 0),
                     stage(Kind::taps, 1.4, 30, 4, 0.2), stage(Kind::vibrate, 2.13, 12, 1.5)});
}

Clock clock_of(const Drive& drive, std::int64_t steps_per_period = 8000) {
    return drive_clock(drive, 1 / (drive.frequency * static_cast<double>(steps_per_period)),
                       steps_per_period);
}

TEST(DriveStages, PlaceAndVelocityAreContinuous) {
    for (const double ramp : {3.0, 0.0}) {
        Drive drive = changing_drive();
        drive.ramp = ramp;
        drive.phase = 0.1;
        const Clock clock = clock_of(drive);
        const DriveMotion motion(drive, clock);
        ASSERT_EQ(clock.changes.stretches().size(),
                  8u);  // 5 stages and 3 changes; there is no change from rest to taps
        for (std::size_t i = 1; i < 8; ++i) {
            const double start = clock.changes.stretches()[i].start;
            const auto after = static_cast<std::int64_t>(std::ceil(start));
            const double before = std::min(start - static_cast<double>(after - 1), std::nextafter(1.0, 0.0));
            const DrivePose left = motion.at(after - 1, before);
            const DrivePose right = motion.at(after, start - static_cast<double>(after));
            EXPECT_NEAR(left.offset.z(), right.offset.z(), 1e-12 * drive.amplitude) << i;
            EXPECT_NEAR(left.velocity.z(), right.velocity.z(), 1e-12 * drive.top_speed()) << i;
        }
    }
}

TEST(DriveStages, VelocityIsTheRateOfThePlace) {
    const Drive drive = changing_drive();
    const Clock clock = clock_of(drive);
    const DriveMotion motion(drive, clock);
    // A tap begins and ends with its full acceleration, A = (2 pi f)^2 a; there the mean is off by A dt / 4.
    const double at_taps = 0.26 * 4 * kGravity * clock.step;
    for (std::int64_t n = 5; n < 480000; n += 97) {
        const double rate = (motion.at(n + 1).offset.z() - motion.at(n - 1).offset.z()) / (2 * clock.step);
        const bool taps = n > 220000 && n < 360000;
        EXPECT_NEAR(motion.at(n).velocity.z(), rate, taps ? at_taps : 1e-6 * drive.top_speed()) << n;
    }
}

// Largest acceleration in m/s2 between two times, from second differences of the place.
double largest_acceleration(const DriveMotion& motion, const Clock& clock, double from, double to) {
    double largest = 0;
    const auto first = static_cast<std::int64_t>(std::ceil(from / clock.step)) + 1;
    for (std::int64_t n = first; clock.time(n + 1) < to; n += 3) {
        const double second =
            motion.at(n + 1).offset.z() - 2 * motion.at(n).offset.z() + motion.at(n - 1).offset.z();
        largest = std::max(largest, std::abs(second) / (clock.step * clock.step));
    }
    return largest;
}

TEST(DriveStages, PeakAccelerationIsGammaInAStageAndBoundedInAChange) {
    // With 3 periods and up to twice the frequency, no change exceeds the larger acceleration by more than 8
    // %.
    for (const double frequency : {10.0, 14.0, 28.0, 40.0}) {
        for (const double g_level : {1.2, 3.0, 6.0}) {
            const Drive drive = drive_of({stage(Kind::vibrate, 0.5, frequency, g_level)});
            const Clock clock = clock_of(drive, 2000);
            const DriveMotion motion(drive, clock);
            const DriveSchedule schedule(drive);
            const double begins = schedule.begins(1), settled = schedule.settled(1);
            const double in_change = largest_acceleration(motion, clock, begins, settled) / kGravity;
            EXPECT_LE(in_change, 1.08 * std::max(3.0, g_level)) << frequency << " Hz, " << g_level;
            EXPECT_LE(in_change, 1.0001 * peak_acceleration_of_change(schedule, 1) / kGravity);
            // A sine is sampled at steps of 1/1000 of a period, so its largest value is at least cos(pi /
            // 1000).
            EXPECT_NEAR(largest_acceleration(motion, clock, begins - 0.1, begins) / kGravity, 3, 1e-4);
            EXPECT_NEAR(largest_acceleration(motion, clock, settled, settled + 0.2) / kGravity, g_level,
                        1e-4 * g_level);
        }
    }
}

// The expected count is the integral, by Simpson's rule, of the frequency that the documentation promises.
TEST(DriveStages, CountOfPeriodsIsTheIntegralOfTheFrequency) {
    const Drive drive = drive_of({stage(Kind::vibrate, 0.5, 31, 2), stage(Kind::vibrate, 1.2, 12, 1.5)});
    const Clock clock = clock_of(drive);
    const double first = 0.5, first_end = first + 2 * 3 / (20.0 + 31);  // 10 periods of 20 Hz are 0.5 s
    const double second = first_end + std::ceil((1.2 - first_end) * 31) / 31, second_end = second + 6 / 43.0;
    const auto frequency = [&](double t) {
        const auto rise = [](double u) { return u * u * u * (10 - 15 * u + 6 * u * u); };
        if (t < first_end) return 20 + 11 * rise(std::max(0.0, (t - first) / (first_end - first)));
        return 31 - 19 * rise(std::clamp((t - second) / (second_end - second), 0.0, 1.0));
    };
    double integral = 0;
    for (std::int64_t n = 0; n < 320000; n += 2) {
        EXPECT_NEAR(clock.cycles(n), integral, 1e-9) << clock.time(n);
        integral +=
            clock.step / 3 *
            (frequency(clock.time(n)) + 4 * frequency(clock.time(n + 1)) + frequency(clock.time(n + 2)));
    }
    EXPECT_NEAR(clock.cycles(clock.step_at(25)), 25, 0.5 * 12 * clock.step);
}

TEST(DriveStages, StepsAndPeriodsAreEachOthersInverse) {
    const Clock clock = clock_of(changing_drive());
    for (std::int64_t n = 0; n < 500000; n += 501) {
        EXPECT_EQ(clock.step_at(clock.cycles(n)), n);
        const double turns = clock.phase(n) - clock.cycles(n);
        EXPECT_NEAR(turns, std::round(turns), 1e-11);
    }
}

// The phase is computed from a count and not by adding up.
TEST(DriveStages, PhaseOfALateStageLosesNoDigit) {
    const Drive drive = drive_of({stage(Kind::vibrate, 0.5, 32, 2)});  // 5000 steps
    const Clock clock = clock_of(drive);
    const DriveMotion motion(drive, clock);
    const std::int64_t late = 200001, later = late + 5000 * std::int64_t{100000000};
    EXPECT_EQ(clock.phase(late), clock.phase(later));
    EXPECT_EQ(motion.at(late).offset.z(), motion.at(later).offset.z());
}

// A tap goes up by 2a and back in 1 / f, and then everything rests until the next tap.
TEST(DriveStages, TapsAreAsHighAndAsLongAsTheySay) {
    const double a = amplitude_of(4, 30);
    const Drive drive = drive_of({stage(Kind::taps, 0, 30, 4, 0.2)}, 30);
    const Clock clock = clock_of(drive, 9000);
    const DriveMotion motion(drive, clock);
    const std::int64_t interval = 54000;  // 0.2 s
    for (int tap = 0; tap < 4; ++tap) {
        const std::int64_t from = tap * interval;
        EXPECT_EQ(clock.cycles(from), tap);
        EXPECT_EQ(motion.at(from).offset.z(), 0);
        EXPECT_EQ(motion.at(from).velocity.z(), 0);
        EXPECT_NEAR(motion.at(from + 4500).offset.z(), 2 * a, 1e-12 * a);
        EXPECT_NEAR(motion.at(from + 2250).velocity.z(), a * 2 * pi * 30, 1e-12);
        EXPECT_GT(motion.at(from + 8999).offset.z(), 0);
        for (std::int64_t n = from + 9000; n < from + interval; n += 1500) {
            EXPECT_EQ(motion.at(n).offset.z(), 0) << n;
            EXPECT_EQ(motion.at(n).velocity.z(), 0) << n;
        }
    }
    EXPECT_NEAR(largest_acceleration(motion, clock, 0, 1.0 / 30) / kGravity, 4, 1e-4);
}

TEST(DriveStages, RestIsAtRest) {
    const Drive drive = drive_of({stage(Kind::rest, 0.5, 0, 0)});
    const Clock clock = clock_of(drive);
    const DriveMotion motion(drive, clock);
    const std::int64_t settled = (10 + 3) * 8000;
    EXPECT_GT(std::abs(motion.at(settled - 2500).offset.z()), 0);
    for (std::int64_t n = settled; n < settled + 100000; n += 999) {
        EXPECT_EQ(motion.at(n).offset.z(), 0);
        EXPECT_EQ(motion.at(n).velocity.z(), 0);
    }
    EXPECT_EQ(clock.cycles(settled + 8000), 14);  // its periods go on
}

// Balls that come down one after the other rebound from the plate by its velocity at that time: e = -(v' - w)
// / (v - w).
TEST(DriveStages, BallsReboundFromThePlateAsItMoves) {
    const double e = 0.7, speed = 1, stroke = 0.005;
    const Drive drive = drive_of({stage(Kind::vibrate, 0.2, 35, 3), stage(Kind::rest, 0.4, 0, 0)});
    HandMadeBed w = make_world(walton_braun_pair(e, 0), 1e-5, NormalForce::walton_braun, TangentialLaw::none);
    w.plan.clock = clock_of(drive, 12500);
    w.around.faces = {floor_face()};
    w.around.faces[0].body.driven = true;
    w.around.motion = DriveMotion(drive, w.plan.clock);
    constexpr int balls = 20;
    for (int k = 0; k < balls; ++k) {
        w.grains.add(k, 0, Vec3(0, 0.01 * k, kRadius + stroke + speed * 0.0261 * k), kRadius, kDensity);
        w.grains.motion[static_cast<std::size_t>(k)].velocity.z() = -speed;
    }
    w.start();
    std::vector<std::int64_t> touched(balls, -1);
    std::vector<bool> done(balls, false);
    double fastest = 0;
    int left = balls;
    while (left > 0 && w.step < 200000) {
        w.run(1);
        for (std::int32_t k = 0; k < balls; ++k) {
            const auto ball = static_cast<std::size_t>(k);
            const bool touches = w.grains.load[w.index_of(k)].force.z() > 0;
            if (touches && touched[ball] < 0) touched[ball] = w.step;
            if (touches || touched[ball] < 0 || done[ball]) continue;
            const double plate = w.around.motion.at((touched[ball] + w.step) / 2).velocity.z();
            EXPECT_NEAR((w.velocity(k).z() - plate) / (speed + plate), e, 5e-3)
                << "at " << w.plan.clock.time(w.step) << " s";
            fastest = std::max(fastest, std::abs(plate));
            done[ball] = true;
            --left;
        }
    }
    EXPECT_EQ(left, 0);
    EXPECT_GT(fastest, 0.1);
}

}  // namespace
}  // namespace grainreel
