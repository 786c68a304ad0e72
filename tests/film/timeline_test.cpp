// Tests of the common timeline of films side by side.
#include "render/film/sampling/timeline.hpp"
#include "render/scene/filmed_scene.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace grainreel {
namespace {

// A clock with steps of 1/(f n), where n is the number of steps in a period.
Clock clock_of(double frequency, std::int64_t period, double phase = 0) {
    return {1 / (frequency * static_cast<double>(period)), period, phase};
}

FilmedScene driven(double frequency) {
    FilmedScene scene;
    scene.drive.present = frequency > 0;
    scene.drive.frequency = frequency;
    return scene;
}

FilmedScene scene_with(const Film& film) {
    FilmedScene scene;
    scene.film = film;
    return scene;
}

FilmSegment locked(double phase) {
    FilmSegment segment;
    segment.kind = FilmSegment::Kind::locked;
    segment.phase = phase;
    return segment;
}

TEST(Timeline, GoesByTheSlowestDrive) {
    EXPECT_EQ(reference_of({driven(0), driven(20), driven(15), driven(30)}), 2u);
    EXPECT_EQ(reference_of({driven(20), driven(20)}), 0u);
    EXPECT_EQ(reference_of({driven(0), driven(0)}), 0u);
}

TEST(Timeline, OneFrequencyShowsOnePhaseAndCycle) {
    Film film;
    film.segments = {locked(0.25)};
    const Clock a = clock_of(20, 800), b = clock_of(20, 1360);  // each has steps of its own
    const std::vector<Instant> instants = instants_of(scene_with(film), a, 8000);
    ASSERT_EQ(instants.size(), 10u);
    const std::vector<Due> of_a = shots_at(instants, film.segments, a, 8000);
    const std::vector<Due> of_b = shots_at(instants, film.segments, b, 13600);
    for (std::size_t i = 0; i < instants.size(); ++i) {
        EXPECT_NEAR(a.cycles(of_a[i].step), 0.25 + static_cast<double>(i), 1e-12);
        EXPECT_NEAR(b.cycles(of_b[i].step), 0.25 + static_cast<double>(i), 1e-12);
    }
}

// Each clock stands at the phase of its own drive, at most half of its period away.
TEST(Timeline, OtherFrequenciesKeepTheirPhase) {
    Film film;
    film.segments = {locked(0.5)};
    const Clock reference = clock_of(7, 80), other = clock_of(11, 160, 0.125);
    const std::int64_t steps = 160 * 20;
    const std::vector<Instant> instants = instants_of(scene_with(film), reference, 80 * 12);
    const std::vector<Due> shots = shots_at(instants, film.segments, other, steps);
    ASSERT_EQ(shots.size(), instants.size());
    for (std::size_t i = 0; i < shots.size(); ++i) {
        EXPECT_NEAR(other.phase(shots[i].step), 0.5, 1e-12);
        EXPECT_LE(std::abs(other.time(shots[i].step) - instants[i].time), 0.5 / 11 + 1e-12);
        if (i > 0) {
            EXPECT_GT(shots[i].step, shots[i - 1].step);
        }
    }
}

TEST(Timeline, MotionTakesTheNearestStepAndNeverOneBeyondTheEnd) {
    Film film;
    film.rate = 30;
    film.segments = {FilmSegment()};
    const Clock undriven{0.0013, 0, 0};
    const std::vector<Instant> instants = instants_of(scene_with(film), clock_of(20, 80), 160);  // 0.1 s
    ASSERT_EQ(instants.size(), 4u);
    const std::vector<Due> shots = shots_at(instants, film.segments, undriven, 70);
    for (std::size_t i = 0; i + 1 < shots.size(); ++i)
        EXPECT_LE(std::abs(undriven.time(shots[i].step) - instants[i].time), 0.5 * undriven.step + 1e-12);
    EXPECT_EQ(shots.back().step, 70);  // of 77
}

TEST(Timeline, KeepsPicturesBetweenLockedMomentsInStep) {
    Film film;
    film.segments = {locked(0.25)};
    film.segments[0].between = 2;
    const Clock a = clock_of(20, 800), b = clock_of(20, 1360);
    const std::vector<Instant> instants = instants_of(scene_with(film), a, 2400);
    const std::vector<Due> of_b = shots_at(instants, film.segments, b, 4080);
    ASSERT_EQ(of_b.size(), 7u);
    for (std::size_t i = 1; i < of_b.size(); ++i)
        EXPECT_EQ(steps_ahead(of_b[i], film.segments[0], b), static_cast<std::int64_t>((3 - i % 3) % 3)) << i;
}

}  // namespace
}  // namespace grainreel
