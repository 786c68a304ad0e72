// Tests of the film maker, which draws and encodes frames while the engine runs.
#include "render/film/production/film_maker.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <gmock/gmock.h>
#include <sys/wait.h>
#include <unistd.h>

#include <thread>

#include "engine/base/error.hpp"
#include "render/film/codec/spooled_films.hpp"
#include "render/scene/filmed_scene.hpp"
#include "tests/film/film_fixture.hpp"
#include "tests/film/film_reading.hpp"

namespace grainreel::test {
namespace {

using ::testing::HasSubstr;
using ::testing::SizeIs;

class FilmMakerTest : public FilmTest {
  protected:
    FilmOptions options(bool film = true, bool frames = false) const {
        FilmOptions o;
        o.folder = folder.path();
        o.film = film;
        o.frames = frames;
        return o;
    }
    FilmFile film() const { return read_film(folder / "movie.mp4"); }
    int poster_grey() const { return read_png(folder / "poster.png").picture.pixel(10, 10)[0]; }

    static DrawerMaker greys() {
        return painting([](const State& frame) {
            const int grey = grey_of(frame.step);
            return flat(96, 64, grey, grey, grey);
        });
    }
    // Expects that the film's frames have the greys of the steps that they should show.
    static void expect_steps_in_order(const FilmFile& film) {
        for (std::size_t i = 0; i < film.frames.size(); ++i) {
            const int grey = grey_of(static_cast<std::int64_t>(i));
            EXPECT_NEAR(film.frames[i].y[32 * 96 + 48], bt709_code(grey, grey, grey)[0], 2) << i;
        }
    }
};

TEST_F(FilmMakerTest, EveryFrameIsInTheFilmInOrderFirstAndLastAsDrawn) {
    constexpr int count = 150;
    FilmMaker maker(small_scene(160, 96), options(),
                    painting([](const State& frame) { return ball(160, 96, static_cast<int>(frame.step)); }));
    for (int i = 0; i < count; ++i) maker.take(shot_at(i), "real time");
    const FilmResult result = maker.finish();
    EXPECT_EQ(result.frames, count);
    EXPECT_EQ(maker.frames_done(), count);
    EXPECT_EQ(result.gl, "painted");
    EXPECT_THAT(result.encoder, HasSubstr("libx264"));
    EXPECT_THAT(result.encoder, HasSubstr("1 thread"));
    EXPECT_GT(result.draw_seconds, 0);
    EXPECT_GT(result.encode_seconds, 0);
    const FilmFile played = film();
    ASSERT_THAT(played.frames, SizeIs(count));
    EXPECT_GT(psnr(to_rgb(played.frames.front()), ball(160, 96, 0)), 35);
    EXPECT_GT(psnr(to_rgb(played.frames.back()), ball(160, 96, count - 1)), 35);
    EXPECT_EQ(played.metadata.at("title"), "Γ = 3, big and small");
    EXPECT_EQ(played.metadata.at("comment"), "grainreel, scene teaching, seed 1");
}

// The first picture with a caption is held for 0.2 s of film: 6 more frames at 30 a second.
TEST_F(FilmMakerTest, StandsStillWhereACaptionBegins) {
    FilmedScene scene = small_scene(96, 64);
    const double early = 0.5 * (shot_at(2)->time + shot_at(3)->time), late = shot_at(6)->time;
    scene.film.captions = {{early, late, "look", 0.2}, {late, 1e9, "again", 0}};
    FilmMaker maker(scene, options(), greys());
    for (int i = 0; i < 8; ++i) maker.take(shot_at(i), "");
    EXPECT_EQ(maker.finish().frames, 8 + 6);
    const FilmFile played = film();
    ASSERT_THAT(played.frames, SizeIs(14));
    for (std::size_t i = 0; i < played.frames.size(); ++i) {
        const std::int64_t step = i <= 3 ? static_cast<std::int64_t>(i)
                                         : std::max<std::int64_t>(3, static_cast<std::int64_t>(i) - 6);
        const int grey = grey_of(step);
        EXPECT_NEAR(played.frames[i].y[32 * 96 + 48], bt709_code(grey, grey, grey)[0], 2) << i;
    }
}

TEST_F(FilmMakerTest, AFilmThatFlashesSaysSo) {
    for (const int every : {3, 8}) {  // frames, at 25 a second: 4.2 and 1.6 flashes
        FilmMaker maker(small_scene(96, 64), options(), painting([every](const State& frame) {
                            const int grey = frame.step / every % 2 ? 60 : 200;
                            return flat(96, 64, grey, grey, grey);
                        }));
        for (int i = 0; i < 60; ++i) maker.take(shot_at(i), "");
        const std::string notes = fmt::format("{}", fmt::join(maker.finish().notes, "\n"));
        EXPECT_EQ(notes.find("flashes more than three times a second") != std::string::npos, every == 3)
            << notes;
    }
}

TEST_F(FilmMakerTest, ASlowDrawerMakesTheEngineWaitAndLosesNothing) {
    constexpr int count = 60;
    std::atomic<int> alive = 0;
    FilmMaker maker(small_scene(), options(), painting([](const State& frame) {
                        std::this_thread::sleep_for(std::chrono::milliseconds(2));
                        const int grey = grey_of(frame.step);
                        return flat(96, 64, grey, grey, grey);
                    }));
    int most = 0;
    for (int i = 0; i < count; ++i) {
        ++alive;
        auto counted = std::shared_ptr<Shot>(new Shot(*shot_at(i)), [&](Shot* shot) {
            --alive;
            delete shot;
        });
        maker.take(std::move(counted), "");
        most = std::max(most, alive.load());
    }
    EXPECT_GT(maker.finish().waited_seconds, 0);
    // 4 pictures wait to be drawn, 1 is drawn, 2 wait to be encoded, 1 is encoded, and 1 is kept for the
    // poster.
    EXPECT_LE(most, 9);
    ASSERT_THAT(film().frames, SizeIs(count));
    expect_steps_in_order(film());
}

TEST_F(FilmMakerTest, FramesAloneAreNumberedExactPicturesWithTimeAndScene) {
    FilmMaker maker(small_scene(), options(false, true), greys());
    for (int i = 0; i < 12; ++i) maker.take(shot_at(i, 0.25), "slow motion, 1/10 speed");
    EXPECT_EQ(maker.finish().frames, 12);
    EXPECT_FALSE(std::filesystem::exists(folder / "movie.mp4"));
    EXPECT_FALSE(std::filesystem::exists(folder / "poster.png"));
    const auto files = std::filesystem::directory_iterator(folder / "frames");
    EXPECT_EQ(std::distance(begin(files), end(files)), 12);
    for (int i = 0; i < 12; ++i) {
        const PngFile png = read_png(folder / "frames" / fmt::format("{:06}.png", i));
        EXPECT_EQ(png.picture.pixel(50, 50)[1], grey_of(i));
        EXPECT_EQ(std::stod(png.texts.at("Time")), 0.25 * i);
        EXPECT_EQ(png.texts.at("Step"), std::to_string(i));
        EXPECT_EQ(png.texts.at("Scene"), "teaching");
        EXPECT_EQ(png.texts.at("Title"), "Γ = 3, big and small");
        EXPECT_EQ(png.texts.at("Playback"), "slow motion, 1/10 speed");
    }
}

TEST_F(FilmMakerTest, FilmAndFramesTogether) {
    FilmMaker maker(small_scene(), options(true, true), greys());
    for (int i = 0; i < 5; ++i) maker.take(shot_at(i), "");
    maker.finish();
    EXPECT_THAT(film().frames, SizeIs(5));
    EXPECT_TRUE(std::filesystem::exists(folder / "frames" / "000004.png"));
}

TEST_F(FilmMakerTest, ThePosterIsTheLastFrameOfTheLastLockedSegment) {
    FilmedScene scene = small_scene();
    FilmSegment open, locked, close;
    open.duration = 2;
    locked.kind = FilmSegment::Kind::locked;
    close.duration = 3;
    scene.film.segments = {open, locked, close};  // the locked one ends after 7 s
    FilmMaker maker(scene, options(), greys());
    for (int i = 0; i < 50; ++i) maker.take(shot_at(i, 0.2), "");
    maker.finish();
    EXPECT_EQ(poster_grey(), grey_of(35));  // 35 * 0.2 s = 7 s
}

TEST_F(FilmMakerTest, AFilmThatEndsEarlyHasItsLastFrameAsPoster) {
    FilmMaker maker(small_scene(), options(), greys());
    for (int i = 0; i < 20; ++i) maker.take(shot_at(i), "");  // 2 s of 10 s
    maker.finish();
    EXPECT_EQ(poster_grey(), grey_of(19));
}

TEST_F(FilmMakerTest, WithoutFinishTheFilmPlaysAndHasAPoster) {
    std::int64_t done = 0;
    {
        FilmMaker maker(small_scene(), options(), greys());
        for (int i = 0; i < 40; ++i) maker.take(shot_at(i), "");
        done = maker.frames_done();
    }
    const FilmFile played = film();
    EXPECT_GE(static_cast<std::int64_t>(played.frames.size()), done);
    expect_steps_in_order(played);
    EXPECT_EQ(poster_grey(), grey_of(static_cast<std::int64_t>(played.frames.size()) - 1));
}

// The film maker is closed while pictures wait: the film has the pictures encoded by then, and the result
// counts them.
TEST_F(FilmMakerTest, WhoIsInAHurryLeavesAFilmOfTheLengthThatIsTold) {
    for (const FilmFormat format : {FilmFormat::mp4, FilmFormat::gif, FilmFormat::png}) {
        FilmedScene scene = small_scene();
        scene.film.format = format;
        std::atomic<bool> hurry = false;
        FilmMaker maker(scene, options(), painting([&](const State& frame) {
                            // The last picture is being drawn when it is no longer wanted.
                            if (frame.step == 39) {
                                hurry = true;
                                std::this_thread::sleep_for(std::chrono::milliseconds(300));
                            }
                            const int grey = grey_of(frame.step);
                            return flat(96, 64, grey, grey, grey);
                        }));
        for (int i = 0; i < 40; ++i) maker.take(shot_at(i), "");
        const FilmResult result = maker.finish([&] { return hurry.load(); });
        EXPECT_FALSE(result.complete);
        EXPECT_GE(result.frames, 1);
        EXPECT_LT(result.frames, 40);
        EXPECT_TRUE(result.poster);
        EXPECT_FALSE(result.sheet);
        EXPECT_EQ(result.file, format == FilmFormat::mp4   ? "movie.mp4"
                               : format == FilmFormat::gif ? "movie.work/spool.mkv"
                                                           : "");
        if (format == FilmFormat::png) {
            const auto files = std::filesystem::directory_iterator(folder / "frames");
            EXPECT_EQ(std::distance(begin(files), end(files)), result.frames);
            continue;
        }
        EXPECT_THAT(result.encoder, HasSubstr(format == FilmFormat::mp4 ? "libx264" : "ffv1"));
        const FilmFile left = read_film(folder / result.file);
        EXPECT_EQ(static_cast<std::int64_t>(left.frames.size() + left.pictures.size()), result.frames);
    }
}

TEST_F(FilmMakerTest, WhoIsInNoHurryGetsAWholeFilm) {
    FilmMaker maker(small_scene(), options(), greys());
    for (int i = 0; i < 20; ++i) maker.take(shot_at(i), "");
    const FilmResult result = maker.finish([] { return false; });
    EXPECT_TRUE(result.complete);
    EXPECT_TRUE(result.poster);
    EXPECT_THAT(film().frames, SizeIs(20));
}

// The folder belongs to somebody else now: no file is made or replaced there.
TEST_F(FilmMakerTest, AFolderThatIsNoLongerOursGetsNoFiles) {
    FilmOptions o = options(true, true);
    std::atomic<bool> lost = false;
    o.check_folder = [&] {
        if (lost) throw RunError("the folder was renamed");
    };
    FilmMaker maker(small_scene(), o, greys());
    for (int i = 0; i < 5; ++i) maker.take(shot_at(i), "");
    while (maker.frames_done() < 5) std::this_thread::sleep_for(std::chrono::milliseconds(1));
    lost = true;
    maker.take(shot_at(5), "");
    try {
        maker.finish();
        ADD_FAILURE() << "no error";
    } catch (const RunError& error) {
        EXPECT_STREQ(error.what(), "the folder was renamed");
    }
    EXPECT_TRUE(std::filesystem::exists(folder / "frames" / "000004.png"));
    EXPECT_FALSE(std::filesystem::exists(folder / "frames" / "000005.png"));
}

TEST_F(FilmMakerTest, AWorkFolderOfAnotherFilmIsLeftAlone) {
    {
        const WorkFolder work(folder / "movie.mp4");
        std::filesystem::rename(folder / "movie.work", folder / "renamed");
        std::filesystem::create_directory(folder / "movie.work");
    }
    EXPECT_TRUE(std::filesystem::exists(folder / "movie.work"));
    { const WorkFolder work(folder / "movie.mp4"); }
    EXPECT_FALSE(std::filesystem::exists(folder / "movie.work"));
}

TEST_F(FilmMakerTest, NothingTakenIsNoReasonToHang) {
    { FilmMaker maker(small_scene(), options(), greys()); }
    FilmMaker maker(small_scene(), options(), greys());
    EXPECT_EQ(maker.finish().frames, 0);
}

// Takes frames as an engine would until that fails. Returns what() of the error, also of finish().
std::string failure_of(FilmMaker& maker, int most = 10'000) {
    std::string words = "no error";
    try {
        for (int i = 0; i < most; ++i) maker.take(shot_at(i), "");
        maker.finish();
    } catch (const RunError& error) {
        words = error.what();
    }
    EXPECT_THROW(maker.finish(), RunError);
    return words;
}

TEST_F(FilmMakerTest, AFailureOfDrawingReachesTheEngineInItsWords) {
    FilmMaker maker(small_scene(), options(), painting([](const State& frame) {
                        if (frame.step == 70) throw std::runtime_error("the lamp broke");
                        return flat(96, 64, 9, 9, 9);
                    }));
    EXPECT_EQ(failure_of(maker), "the lamp broke");
}

TEST_F(FilmMakerTest, AFailureAfterTheLastFrameReachesFinish) {
    FilmMaker maker(small_scene(), options(), painting([](const State& frame) {
                        if (frame.step == 2) throw std::runtime_error("the lamp broke");
                        return flat(96, 64, 9, 9, 9);
                    }));
    EXPECT_EQ(failure_of(maker, 3), "the lamp broke");
}

TEST_F(FilmMakerTest, NoContextReachesTheEngine) {
    FilmMaker maker(small_scene(), options(),
                    []() -> std::unique_ptr<Drawer> { throw RunError("no OpenGL context is to be had"); });
    EXPECT_EQ(failure_of(maker), "no OpenGL context is to be had");
}

TEST_F(FilmMakerTest, AFullDiskReachesTheEngineAndTheFilmSoFarPlays) {
    const FilmedScene scene = small_scene(160, 96);
    {
        const FileSizeLimit limit(512 * 1024);
        FilmMaker maker(scene, options(), painting([](const State& frame) {
                            return noise(160, 96, static_cast<int>(frame.step));
                        }));
        EXPECT_THAT(failure_of(maker),
                    HasSubstr((folder / "movie.mp4").string() + ": cannot write the film: File too large"));
    }
    EXPECT_THAT(film().frames, SizeIs(::testing::Ge(15)));
    EXPECT_TRUE(std::filesystem::exists(folder / "poster.png"));
}

TEST_F(FilmMakerTest, AFolderThatIsAFileIsARunError) {
    FilmOptions o = options(true, true);
    o.folder = "/dev/null";
    EXPECT_THROW(FilmMaker(small_scene(), o, greys()), RunError);
}

TEST_F(FilmMakerTest, KilledItPlaysUpToTheLastTwoSecondsAndHasAPoster) {
    int pipe_ends[2];
    ASSERT_EQ(pipe(pipe_ends), 0);
    const pid_t child = fork();
    if (child == 0) {
        FilmedScene scene = small_scene();
        scene.run.duration = 1000;
        FilmMaker maker(scene, options(), greys());
        for (int i = 0; i < 200; ++i) maker.take(shot_at(i), "");
        const std::int64_t done = maker.frames_done();
        if (write(pipe_ends[1], &done, sizeof done) != sizeof done) _exit(1);
        kill(getpid(), SIGKILL);
    }
    std::int64_t done = 0;
    ASSERT_EQ(read(pipe_ends[0], &done, sizeof done), static_cast<ssize_t>(sizeof done));
    int status = 0;
    waitpid(child, &status, 0);
    close(pipe_ends[0]);
    close(pipe_ends[1]);
    ASSERT_TRUE(WIFSIGNALED(status) && WTERMSIG(status) == SIGKILL);
    EXPECT_GE(done, 200 - 9);
    const FilmFile played = film();
    EXPECT_GE(static_cast<std::int64_t>(played.frames.size()), done - 60);
    expect_steps_in_order(played);
    EXPECT_EQ(poster_grey(),
              grey_of(127));  // drawn on the way, at the 128th frame: the film is far from its end
}

}  // namespace
}  // namespace grainreel::test
