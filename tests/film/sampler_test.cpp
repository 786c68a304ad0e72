// Tests of the schedule of a film: which step each frame shows, and its warnings.
#include "render/film/sampling/sampler.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "engine/base/error.hpp"
#include "engine/plan/times.hpp"
#include "render/film/sampling/timeline.hpp"
#include "render/scene/filmed_scene.hpp"
#include "tests/support/tells.hpp"

namespace grainreel {
namespace {

using test::tells;
using test::tells_only;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::SizeIs;

FilmSegment motion(std::optional<double> duration, double playback) {
    FilmSegment s;
    s.duration = duration;
    s.playback = playback;
    return s;
}

FilmSegment locked(std::optional<double> duration, int every, double phase) {
    FilmSegment s;
    s.kind = FilmSegment::Kind::locked;
    s.duration = duration;
    s.every = every;
    s.phase = phase;
    return s;
}

Film film_of(std::vector<FilmSegment> segments, double rate = 30) {
    Film film;
    film.rate = rate;
    film.segments = std::move(segments);
    return film;
}

// Puts the film into a scene that has a place for messages.
FilmedScene scene_with(const Film& film) {
    FilmedScene scene;
    scene.file = "a.toml";
    scene.film = film;
    return scene;
}

std::vector<Due> schedule_of(const Film& film, const Clock& clock, std::int64_t steps) {
    return film_schedule(scene_with(film), clock, steps);
}

Clock clock_of(double frequency, std::int64_t steps_per_period, double initial_phase = 0) {
    return {1 / (frequency * static_cast<double>(steps_per_period)), steps_per_period, initial_phase};
}

Drive drive_of(double frequency) {
    Drive drive;
    drive.present = true;
    drive.frequency = frequency;
    return drive;
}

TEST(FilmSchedule, MotionTakesTheStepNearestToEachFramesTime) {
    const Clock clock{7e-5, 0, 0};  // there is no drive, and the frame interval is no whole number of steps
    const std::int64_t steps = 20'000;
    const double playback = 0.3, rate = 25;
    const std::vector<Due> shots = schedule_of(film_of({motion({}, playback)}, rate), clock, steps);
    const auto count = static_cast<std::size_t>(std::floor(clock.time(steps) * rate / playback)) + 1;
    ASSERT_THAT(shots, SizeIs(count));
    for (std::size_t k = 0; k < count; ++k) {
        const double wanted = static_cast<double>(k) * playback / rate;
        EXPECT_LE(std::abs(clock.time(shots[k].step) - wanted), 0.5 * clock.step * (1 + 1e-9)) << k;
    }
    EXPECT_LE(shots.back().step, steps);
}

// The clock goes from 20 Hz, from 1 s over 3 periods, to a frequency without a whole number of steps.
Clock changing_clock(const Drive& drive) {
    return drive_clock(drive, 1 / (drive.frequency * 2000), 2000);
}
Drive changing_drive() {
    Drive drive = drive_of(20);
    drive.amplitude = 0.001;
    drive.stages = {{DriveStage::Kind::vibrate, 1, 3, 33, 0.001}};
    return drive;
}

TEST(FilmSchedule, LockedFollowsTheStageThatIsOn) {
    const Clock clock = changing_clock(changing_drive());
    const Film film = film_of({locked(0.5, 1, 0.25), locked({}, 2, 0.75)});
    const std::vector<Due> shots = schedule_of(film, clock, 80'000);  // 2 s
    ASSERT_GT(shots.size(), 10u);
    for (std::size_t k = 0; k < shots.size(); ++k) {
        const bool first = shots[k].segment == 0;
        // A step is 1/2000 of a period at first, and 1/1212 at the end.
        EXPECT_NEAR(clock.phase(shots[k].step), first ? 0.25 : 0.75, 0.5 / 1212) << k;
        if (k == 0 || shots[k].segment != shots[k - 1].segment) continue;
        EXPECT_NEAR(clock.cycles(shots[k].step) - clock.cycles(shots[k - 1].step), first ? 1 : 2, 1.0 / 1212);
    }
    const std::vector<SegmentCount> counts = count_film(scene_with(film), clock, 80'000);
    EXPECT_EQ(static_cast<std::size_t>(counts[0].shots + counts[1].shots), shots.size());
    EXPECT_EQ(counts[0].shots, 10);
}

TEST(AveragedSteps, GoBackByPeriodsOfTheStagesThatWereOn) {
    const Clock clock = changing_clock(changing_drive());
    FilmSegment mean = locked({}, 1, 0);
    mean.average = 4;
    const std::int64_t shot = clock.step_at(24);  // one period after the change
    const std::vector<std::int64_t> steps = averaged_steps({shot, 0}, mean, clock);
    ASSERT_EQ(steps.size(), 65u);
    for (std::size_t k = 0; k < steps.size(); ++k)
        EXPECT_NEAR(clock.cycles(steps[k]), 20 + static_cast<double>(k) / 16, 1.0 / 1212);
}

TEST(FilmSchedule, WithoutSegmentsTheFilmIsInRealTime) {
    const Clock clock{1e-4, 0, 0};
    const std::vector<Due> shots = schedule_of(film_of({}), clock, 20'000);
    ASSERT_THAT(shots, SizeIs(2 * 30 + 1));
    EXPECT_EQ(shots.front().step, 0);
    EXPECT_EQ(shots.back().step, 20'000);
}

TEST(FilmSchedule, LockedShotsHaveTheAskedPhaseOfTheDriveExactly) {
    for (const double initial : {0.0, 0.25, 0.9}) {
        for (const int every : {1, 2, 4}) {
            const Clock clock = clock_of(20, 1600, initial);
            const double phase = 0.375;
            const std::vector<Due> shots =
                schedule_of(film_of({locked({}, every, phase)}), clock, 100 * 1600 - 1);
            ASSERT_THAT(shots, SizeIs(static_cast<std::size_t>(100 / every)));
            EXPECT_LT(shots.front().step, 1600);
            for (std::size_t k = 0; k < shots.size(); ++k) {
                EXPECT_NEAR(clock.phase(shots[k].step), phase, 1e-12);
                EXPECT_EQ(shots[k].step, shots[0].step + static_cast<std::int64_t>(k) * every * 1600);
            }
        }
    }
}

TEST(FilmSchedule, ALockedPhaseIsRoundedToAWholeStep) {
    const Clock clock = clock_of(10, 8);
    EXPECT_EQ(schedule_of(film_of({locked({}, 1, 0.3)}), clock, 80).front().step, std::llround(0.3 * 8));
    // 0.99 of 8 steps rounds to 8, which is the phase 0 of the next period; as step 0 of this period it is
    // the same phase.
    EXPECT_EQ(schedule_of(film_of({locked({}, 1, 0.99)}), clock, 80).front().step, 0);
}

TEST(FilmSchedule, SegmentsFollowEachOtherAndTheOpenOneTakesTheRest) {
    const Clock clock = clock_of(20, 1000);
    const std::int64_t steps = 10 * 20 * 1000;
    const std::vector<Due> shots =
        schedule_of(film_of({motion(0.5, 0.1), locked({}, 2, 0.25), motion(1.0, 0.2)}), clock, steps);
    std::vector<std::vector<double>> times(3);
    for (std::size_t i = 0; i < shots.size(); ++i) {
        if (i > 0) {
            ASSERT_GT(shots[i].step, shots[i - 1].step);
            ASSERT_GE(shots[i].segment, shots[i - 1].segment);
        }
        times[static_cast<std::size_t>(shots[i].segment)].push_back(clock.time(shots[i].step));
    }
    // 0.5 s at 1/10 speed are 5 s of film, whose last instant belongs to the next segment. Then comes every
    // second of the 170 periods between 0.5 s and 9 s. Then comes 1 s at 1/5 speed, with both ends.
    EXPECT_THAT(times[0], SizeIs(5 * 30));
    EXPECT_THAT(times[1], SizeIs(170 / 2));
    EXPECT_THAT(times[2], SizeIs(5 * 30 + 1));
    EXPECT_NEAR(times[1].front(), 0.5 + 0.25 / 20, 1e-9);
    EXPECT_NEAR(times[2].front(), 9.0, 1e-9);
    EXPECT_EQ(shots.back().step, steps);
}

TEST(FilmSchedule, NothingIsTakenBeyondTheRun) {
    const Clock clock = clock_of(20, 1000);
    const std::vector<Due> shots =
        schedule_of(film_of({motion(1.0, 1), locked(5.0, 1, 0), motion({}, 0.1)}), clock, 50'000);
    ASSERT_FALSE(shots.empty());
    EXPECT_LE(shots.back().step, 50'000);
    EXPECT_EQ(shots.back().step, 50'000);  // a whole number of periods: the last locked shot is the last step
}

TEST(FilmSchedule, SlowerThanTheStepsStillRisesStrictly) {
    const Clock clock{1e-3, 0, 0};
    const std::vector<Due> shots = schedule_of(film_of({motion({}, 0.01)}), clock, 10);
    ASSERT_THAT(shots, SizeIs(11));
    for (std::size_t k = 0; k < shots.size(); ++k) EXPECT_EQ(shots[k].step, static_cast<std::int64_t>(k));
}

// Counts have closed forms, so schedules can be counted that nobody could make.
TEST(FilmSchedule, IsCountedAsItIsMade) {
    const Clock clock = clock_of(20, 1000, 0.3);
    for (const double playback : {1e-320, 1e-3, 0.0007, 0.3, 1.0, 2.5, 1e16})
        for (const int every : {1, 4})
            for (const std::int64_t steps : {1, 999, 1000, 54'321}) {
                const FilmedScene scene =
                    scene_with(film_of({motion(0.7, playback), locked(1.0, every, 0.9), motion({}, 1)}));
                std::int64_t made = 0, counted = 0;
                for (const SegmentCount& count : count_film(scene, clock, steps)) counted += count.shots;
                made = static_cast<std::int64_t>(film_schedule(scene, clock, steps).size());
                EXPECT_EQ(made, counted) << playback << ' ' << every << ' ' << steps;
            }
}

TEST(FilmSchedule, AnEndlessPlaybackShowsTheStartAlone) {
    const std::vector<Due> shots = schedule_of(film_of({motion({}, 1e300)}), clock_of(20, 1000), 50'000);
    ASSERT_THAT(shots, SizeIs(1));
    EXPECT_EQ(shots[0].step, 0);
}

std::string complaint_of(const Film& film, const Clock& clock, std::int64_t steps) {
    FilmedScene scene = scene_with(film);
    scene.written["film.segment[0]"] = {"a.toml", 4, 1};
    scene.written["film.segment[0].playback"] = {"a.toml", 5, 2};
    try {
        film_schedule(scene, clock, steps);
    } catch (const UserError& error) {
        return error.what();
    }
    return "no error";
}

// 1e9 s at 1e8 Hz have 1e17 periods; the slowest motion has a frame for each step.
TEST(FilmSchedule, NoMoreIsMadeThanAFilmMayHave) {
    const Clock clock = clock_of(1e8, 8);
    const std::int64_t steps = 800'000'000'000'000;
    EXPECT_THAT(
        complaint_of(film_of({locked({}, 1, 0)}), clock, steps),
        tells_only({"a.toml:4:1", "1e+14 frames", "10000000", "'film.segment[0].every'", "'run.duration'"}));
    EXPECT_THAT(complaint_of(film_of({motion({}, 1e-320)}), clock, steps),
                tells_only({"a.toml:5:2", "8e+14 frames", "10000000", "'film.segment[0].playback'", "1e-320",
                            "'run.duration'"}));
}

TEST(FilmSchedule, NoMoreMomentsAreKeptThanAFilmMayHave) {
    const Clock clock = clock_of(20, 1000);
    FilmSegment means = locked({}, 1, 0);
    means.average = 1000;  // 16 a period and the one before: 16,001 for a picture
    const std::int64_t periods = 20'000'000 / 16'001 + 1;
    EXPECT_EQ(complaint_of(film_of({means}), clock, 1000 * (periods - 2)), "no error");
    EXPECT_THAT(complaint_of(film_of({means}), clock, 1000 * periods),
                tells({"a.toml:4:1", "2.002e+07", "earlier moments"}));
    FilmSegment open = motion({}, 1e-9);
    open.exposure = 1e300;
    open.exposures = 1000;
    EXPECT_THAT(complaint_of(film_of({open}), clock, 100'000),
                HasSubstr("lower 'film.segment[0].exposures'"));
    EXPECT_THAT(exposed_steps({5000, 0}, open, clock), SizeIs(999));
}

TEST(FilmSchedule, ALockWithoutADriveIsTheUsersMistake) {
    try {
        schedule_of(film_of({motion(1.0, 1), locked({}, 1, 0)}), Clock{1e-4, 0, 0}, 100'000);
        FAIL() << "no error";
    } catch (const UserError& error) {
        EXPECT_THAT(error.what(), tells_only({"a.toml:1:1", "segment 2", "phase", "nothing is driven",
                                              "a drive", "motion segment"}));
    }
}

TEST(PosterTime, IsTheEndOfTheLastLockedSegmentOrLateInTheFilm) {
    EXPECT_DOUBLE_EQ(poster_time(film_of({motion(1.0, 0.1), locked({}, 1, 0), motion(2.0, 0.1)}), 10), 8);
    EXPECT_DOUBLE_EQ(poster_time(film_of({motion({}, 1)}), 10), 0.8 * 10);
    EXPECT_DOUBLE_EQ(poster_time(film_of({}), 10), 0.8 * 10);
    auto hopper = film_of({});
    hopper.shows.outflow = true;
    EXPECT_DOUBLE_EQ(poster_time(hopper, 10), 0.4 * 10) << "not when it is empty";
}

TEST(DurationText, HasTheUnitThatSuits) {
    EXPECT_EQ(time_span_text(0.0025), "2.5 ms");
    EXPECT_EQ(time_span_text(0.1), "0.1 s");
    EXPECT_EQ(time_span_text(0.3), "0.3 s");
    EXPECT_EQ(time_span_text(12), "12 s");
    EXPECT_EQ(time_span_text(4e-5), "40 µs");
}

TEST(PlaybackCaption, SaysHowTimeRuns) {
    const Drive drive = drive_of(20);
    EXPECT_EQ(playback_caption(motion({}, 1), drive, 30), "real time");
    EXPECT_EQ(playback_caption(motion({}, 0.1), drive, 30), "slow motion, 1/10 speed");
    EXPECT_EQ(playback_caption(motion({}, 1 / 30.0), drive, 30), "slow motion, 1/30 speed");
    EXPECT_EQ(playback_caption(motion({}, 0.4), drive, 30), "slow motion, 1/2.5 speed");
    EXPECT_EQ(playback_caption(motion({}, 0.35), drive, 30), "slow motion, 0.35 speed");
    EXPECT_EQ(playback_caption(motion({}, 4), drive, 30), "time lapse, 4× speed");
    EXPECT_EQ(playback_caption(locked({}, 1, 0.25), drive, 30),
              "1 frame a period at phase 0.25 (plays 1.5×)");
    EXPECT_EQ(playback_caption(locked({}, 4, 0), drive, 30), "1 frame every 4 periods at phase 0 (plays 6×)");
}

// At 0.1 ms a step and 30 frames a second, one frame a step plays at 0.003 of real time.
TEST(PlaybackCaption, SaysWhatIsPlayedWhereStepsAreCoarser) {
    const Clock clock = clock_of(20, 500);
    const double every_step = 30 * clock.step;
    for (const double playback : {1e-300, 1e-5, 0.7 * every_step}) {
        EXPECT_DOUBLE_EQ(played(motion({}, playback), 30, clock).playback, every_step);
        const std::size_t frames = schedule_of(film_of({motion({}, playback)}), clock, 1000).size();
        EXPECT_NEAR(0.1 / (static_cast<double>(frames) / 30), every_step, 0.0011 * every_step) << playback;
        EXPECT_THAT(pace_warnings(scene_with(film_of({motion({}, playback)})), clock),
                    ElementsAre(tells({"0.003 speed", "film.segment[0].playback = 0.003"})));
    }
    for (const double playback : {every_step, 0.01, 4.0}) {
        EXPECT_EQ(played(motion({}, playback), 30, clock).playback, playback);
        EXPECT_THAT(pace_warnings(scene_with(film_of({motion({}, playback)})), clock), IsEmpty());
    }
    EXPECT_THAT(pace_warnings(scene_with(film_of({locked({}, 1, 0)})), clock), IsEmpty());
    // The number that the warning advises, to three digits, is not below the real one: 30 / 9001 is 0.003333.
    Clock odd = clock;
    odd.step = 1.0 / 9001;
    EXPECT_THAT(pace_warnings(scene_with(film_of({motion({}, 1e-5)})), odd),
                ElementsAre(HasSubstr("= 0.00334,")));
    EXPECT_THAT(pace_warnings(scene_with(film_of({motion({}, 0.00334)})), odd), IsEmpty());
    EXPECT_EQ(playback_caption(motion({}, 1 / 20'000.33), drive_of(20), 30), "slow motion, 1/20000 speed");
}

TEST(Timeline, LockedInstantsFindThePhaseOfTheStageThatIsOn) {
    const Clock clock = changing_clock(changing_drive());
    const std::vector<Due> shots = shots_at({{0.41, 0}, {1.507, 0}}, {locked({}, 1, 0.25)}, clock, 80'000);
    for (const Due& shot : shots) EXPECT_NEAR(clock.phase(shot.step), 0.25, 0.5 / 1212);
    EXPECT_LE(std::abs(clock.time(shots[1].step) - 1.507), 0.5 / 33 + clock.step);
}

TEST(StrobeWarnings, GiveTheApparentMotion) {
    // F = 30 frames per simulated second against f = 31 Hz: k = 1, a slow beat of 1 Hz.
    EXPECT_THAT(
        strobe_warnings(film_of({motion({}, 1)}), drive_of(31), 10),
        ElementsAre("film segment 1 shows 0.968 frames a period: the 31 Hz drive will seem to move at 1 Hz; "
                    "lock it to a phase, or set its playback to 0.121 or less"));
    // Just below F, k is still 1 and not the whole number below.
    EXPECT_THAT(strobe_warnings(film_of({motion({}, 1)}), drive_of(28), 10),
                ElementsAre(tells({"28 Hz", "seem to move", "2 Hz"})));
    // For F = 15, f = 20 is nearest to 1 F, and |20 - 15| = 5. For F = 60 the nearest multiple is 0 F, which
    // leaves 20 itself.
    EXPECT_THAT(
        strobe_warnings(film_of({motion(1.0, 2), locked(1.0, 1, 0), motion({}, 0.5)}), drive_of(20), 10),
        ElementsAre(tells({"segment 1", "0.75 frames a period", "20 Hz", "seem to move", "5 Hz"}),
                    tells({"segment 3", "3 frames a period", "20 Hz", "seem to move", "20 Hz"})));
}

TEST(StrobeWarnings, AreSilentFromEightFramesAPeriodAndWithoutADrive) {
    EXPECT_THAT(strobe_warnings(film_of({motion({}, 30 / (8 * 20.0))}), drive_of(20), 10), IsEmpty());
    EXPECT_THAT(strobe_warnings(film_of({motion({}, 30 / (7.9 * 20.0))}), drive_of(20), 10), SizeIs(1));
    EXPECT_THAT(strobe_warnings(film_of({locked({}, 1, 0)}), drive_of(20), 10), IsEmpty());
    EXPECT_THAT(strobe_warnings(film_of({motion({}, 1)}), Drive{}, 10), IsEmpty());
}

// 33 Hz comes only in the second segment: 8 frames a period of 20 Hz are 160 a second, and of 33 Hz 264.
TEST(StrobeWarnings, GoByTheStagesOfEachSegment) {
    const Film film = film_of({motion(1.0, 30.0 / 200), motion({}, 30.0 / 200)});
    EXPECT_THAT(strobe_warnings(film, changing_drive(), 2),
                ElementsAre(tells({"segment 2", "6.06 frames a period", "33 Hz"})));
}

TEST(ExposedSteps, AreEvenInMotionAndWholePeriodsApartWhenLocked) {
    const Clock clock = clock_of(10, 1000);
    FilmSegment rule = motion({}, 0.1);
    EXPECT_THAT(exposed_steps({5000, 0}, rule, clock), IsEmpty());
    rule.exposure = 0.05;  // half a period, 500 steps
    rule.exposures = 5;
    EXPECT_THAT(exposed_steps({5000, 0}, rule, clock), ElementsAre(4600, 4700, 4800, 4900));
    FilmSegment still = locked({}, 1, 0.25);
    still.exposure = 0.6;  // six periods
    still.exposures = 4;   // 4.5 and 1.5 periods back are rounded away from the picture
    EXPECT_THAT(exposed_steps({10250, 0}, still, clock), ElementsAre(5250, 7250, 8250));
    still.exposures = 100;
    EXPECT_THAT(exposed_steps({10250, 0}, still, clock), ElementsAre(5250, 6250, 7250, 8250, 9250));
    EXPECT_THAT(playback_caption(still, drive_of(10), 30), HasSubstr(", exposed for 0.6 s"));
}

TEST(AveragedSteps, DivideWholePeriodsEvenly) {
    const Clock clock = clock_of(10, 1000);
    FilmSegment rule = locked({}, 1, 0);
    EXPECT_THAT(averaged_steps({5000, 0}, rule, clock), IsEmpty());
    rule.average = 2;
    const std::vector<std::int64_t> steps = averaged_steps({5000, 0}, rule, clock);
    ASSERT_THAT(steps, SizeIs(33));
    for (std::size_t k = 0; k < steps.size(); ++k)
        EXPECT_NEAR(static_cast<double>(steps[k]), 3000 + 62.5 * static_cast<double>(k), 0.51);
    EXPECT_THAT(playback_caption(rule, drive_of(10), 30), HasSubstr(", mean of 2 periods"));
}

// One locked moment a period of 1,000 steps; two pictures stand between two of them, the last steps before
// the later.
TEST(PicturesBetween, AreTakenJustBeforeTheLaterLockedMoment) {
    const Clock clock = clock_of(10, 1000);
    FilmSegment rule = locked({}, 1, 0.25);
    rule.between = 2;
    const Film film = film_of({rule});
    const std::vector<Due> shots = schedule_of(film, clock, 3000);
    std::vector<std::int64_t> steps;
    for (const Due& shot : shots) steps.push_back(shot.step);
    EXPECT_THAT(steps, ElementsAre(250, 1248, 1249, 1250, 2248, 2249, 2250));
    EXPECT_EQ(count_film(scene_with(film), clock, 3000).at(0).shots, 7);
    EXPECT_FALSE(way_between({1250, 0}, rule, clock));
    EXPECT_FALSE(way_between({1247, 0}, rule, clock));
    const Way first = way_between({1248, 0}, rule, clock).value(),
              second = way_between({1249, 0}, rule, clock).value();
    EXPECT_EQ(first.from, 250);
    EXPECT_DOUBLE_EQ(first.share, 1.0 / 3);
    EXPECT_EQ(second.from, 250);
    EXPECT_DOUBLE_EQ(second.share, 2.0 / 3);
    EXPECT_EQ(way_between({4248, 0}, rule, clock, 2)->from, 2250)
        << "a bed that repeats itself every second period";
    EXPECT_EQ(playback_caption(rule, drive_of(10), 30), "1 moment a period at phase 0.25 (plays 1×)");
}

TEST(PicturesBetween, StandBeforeTheMomentsOfADriveThatChanges) {
    FilmSegment rule = locked({}, 1, 0);
    rule.between = 1;
    const Film film = film_of({rule});
    FilmedScene scene = scene_with(film);
    scene.drive = changing_drive();
    const Clock clock = changing_clock(scene.drive);
    const std::vector<Due> shots = film_schedule(scene, clock, 40000);
    ASSERT_GT(shots.size(), 10u);
    for (std::size_t i = 2; i < shots.size(); i += 2) {
        EXPECT_EQ(shots[i - 1].step, shots[i].step - 1);
        const std::optional<Way> way = way_between(shots[i - 1], rule, clock);
        ASSERT_TRUE(way);
        EXPECT_EQ(way->from, shots[i - 2].step);
        EXPECT_EQ(way->share, 0.5);
    }
}

}  // namespace
}  // namespace grainreel
