// Tests of the film and its picture in a form that a page can hold.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

#include "render/film/codec/encoder.hpp"
#include "render/film/codec/film_file.hpp"
#include "render/film/codec/png.hpp"
#include "render/page/page_film.hpp"
#include "render/scene/filmed_scene.hpp"
#include "tests/support/tells.hpp"
#include "tests/support/temporary_folder.hpp"

namespace grainreel {
namespace {

using test::tells;
using test::TemporaryFolder;
using testing::HasSubstr;

Picture grey(int width, int height, int level) {
    Picture picture(width, height);
    for (std::size_t i = 0; i < picture.rgba.size(); ++i)
        picture.rgba[i] = static_cast<std::uint8_t>(i % 4 == 3 ? 255 : level);
    return picture;
}

class PageFilmTest : public testing::Test {
  protected:
    void make_film(FilmFormat format, int width, int height) {
        scene.film.format = format;
        scene.film.rate = 30;
        EncoderSettings settings;
        settings.codec = &codec_of(format);
        settings.path = here / (std::string("movie.") + codec_of(format).extension);
        settings.width = width;
        settings.height = height;
        Encoder encoder(settings);
        for (int level = 40; level < 100; level += 10) encoder.add(grey(width, height, level));
        encoder.finish();
    }

    TemporaryFolder here;
    FilmedScene scene;
};

// The note on a German page.
std::string german(const PageNote& note) {
    return PageWords({Language::de, {}})(note);
}

TEST_F(PageFilmTest, ASmallFilmThatBrowsersPlayIsTakenAsItIs) {
    make_film(FilmFormat::mp4, 64, 48);
    const PageFilm film = page_film(scene, here.path());
    const std::string bytes = test::text_of(here / "movie.mp4");
    EXPECT_TRUE(std::string(film.bytes.begin(), film.bytes.end()) == bytes);
    EXPECT_EQ(film.type, "video/mp4");
    EXPECT_EQ(film.note.in_english(), "");
}

// A film of another format with 800 lines gets a copy of 720 lines, frame by frame.
TEST_F(PageFilmTest, AnotherFormatIsCopied) {
    make_film(FilmFormat::ffv1, 96, 800);
    const PageFilm film = page_film(scene, here.path());
    EXPECT_EQ(film.type, "video/mp4");
    EXPECT_THAT(film.note.in_english(), HasSubstr("browsers do not play"));
    EXPECT_THAT(german(film.note), tells({"Kopie mit höchstens", "Browser spielen", "Ordner des Laufs"}));
    std::ofstream(here / "copy.mp4", std::ios::binary)
        .write(reinterpret_cast<const char*>(film.bytes.data()),
               static_cast<std::streamsize>(film.bytes.size()));
    FilmReader reader(here / "copy.mp4");
    EXPECT_EQ(reader.codec().height, 720);
    EXPECT_EQ(reader.codec().width, 86);  // 96 x 720 / 800 = 86.4, even
    // A grey of level g has the luma 16 + 219 g / 255.
    int frames = 0;
    while (const AVFrame* frame = reader.next()) {
        const double luma = 16 + 219 * (40 + 10 * frames++) / 255.0;
        EXPECT_NEAR(frame->data[0][frame->linesize[0] * 300 + 40], luma, 2);
    }
    EXPECT_EQ(frames, 6);
}

class PageCopyTest : public PageFilmTest {
  protected:
    void copy(FilmFormat format, int width, int height, bool finish = true) {
        make_film(format, width, height);
        scene.film.width = width;
        scene.film.height = height;
        PageCopy copy(scene, here.path(), 1);
        for (int level = 40; level < 100; level += 10) copy.add(grey(width, height, level));
        if (finish) copy.finish(here / (std::string("movie.") + codec_of(format).extension));
    }
    bool is_there(const char* file) const { return std::filesystem::exists(here / file); }
};

// The picture is that of the film, and the page takes it unchanged.
TEST_F(PageCopyTest, TheRunsCopyIsTaken) {
    copy(FilmFormat::ffv1, 96, 800);
    ASSERT_TRUE(is_there(kPageCopy));
    EXPECT_FALSE(is_there("movie_720.mp4.part"));
    FilmReader reader(here / kPageCopy);
    EXPECT_EQ(reader.codec().height, 720);
    EXPECT_EQ(reader.codec().width, 86);
    int frames = 0;
    while (const AVFrame* frame = reader.next()) {
        const double luma = 16 + 219 * (40 + 10 * frames++) / 255.0;
        EXPECT_NEAR(frame->data[0][frame->linesize[0] * 300 + 40], luma, 2);
        EXPECT_NEAR(frame->data[1][frame->linesize[1] * 100 + 20], 128, 1);
    }
    EXPECT_EQ(frames, 6);
    const PageFilm film = page_film(scene, here.path());
    EXPECT_EQ(std::string(film.bytes.begin(), film.bytes.end()), test::text_of(here / kPageCopy));
    EXPECT_THAT(film.note.in_english(), tells({"copy", "at most 720 lines"}));
}

TEST_F(PageCopyTest, ACopyThatIsTooLargeIsNotTaken) {
    copy(FilmFormat::ffv1, 96, 800);
    const PageFilm film = page_film(scene, here.path(), {}, kNoPageProgress, 100);
    EXPECT_TRUE(film.bytes.empty());
    EXPECT_THAT(film.note.in_english(), tells({"smaller copy", "too large"}));
    EXPECT_THAT(german(film.note), tells({"Browser spielen", "kleinere Kopie"}));
}

TEST_F(PageCopyTest, WhereTheFilmWillDoThereIsNone) {
    copy(FilmFormat::mp4, 64, 48);
    EXPECT_FALSE(is_there(kPageCopy));
    EXPECT_FALSE(is_there("movie_720.mp4.part"));
}

TEST_F(PageCopyTest, NothingIsLeftOfOneThatWasNotFinished) {
    const bool finish = false;
    copy(FilmFormat::ffv1, 64, 48, finish);
    EXPECT_FALSE(is_there(kPageCopy));
    EXPECT_FALSE(is_there("movie_720.mp4.part"));
}

TEST_F(PageCopyTest, FilmsThatMayBeTooLargeNeedOne) {
    Film film;
    film.format = FilmFormat::mp4;
    film.width = 1920;
    film.height = 1080;
    EXPECT_TRUE(may_need_copy(film, 270));  // the default film has 11.6 MB
    EXPECT_FALSE(may_need_copy(film, 20));
    film.format = FilmFormat::ffv1;
    EXPECT_TRUE(may_need_copy(film, 1));
    film.format = FilmFormat::png;
    EXPECT_FALSE(may_need_copy(film, 270));
}

TEST_F(PageFilmTest, WithoutAFilmThereIsNone) {
    scene.film.format = FilmFormat::mp4;
    EXPECT_TRUE(page_film(scene, here.path()).bytes.empty());
    EXPECT_EQ(page_film(scene, here.path()).file, "");
}

TEST_F(PageFilmTest, ADamagedFilmIsLinkedAndSaidSo) {
    scene.film.format = FilmFormat::ffv1;
    test::write_text(here / "movie.mkv", "no film");
    const PageFilm film = page_film(scene, here.path());
    EXPECT_TRUE(film.bytes.empty());
    EXPECT_EQ(film.file, "movie.mkv");
    EXPECT_THAT(film.note.in_english(), HasSubstr("movie.mkv is damaged"));
    EXPECT_THAT(german(film.note), HasSubstr("movie.mkv ist beschädigt"));
}

TEST_F(PageFilmTest, AFilmThatWasCutOffIsNotTaken) {
    make_film(FilmFormat::mp4, 64, 48);
    EXPECT_EQ(pictures_in(here / "movie.mp4"), 6);
    EXPECT_EQ(page_film(scene, here.path(), 6).note.in_english(), "");
    const PageFilm film = page_film(scene, here.path(), 7);
    EXPECT_TRUE(film.bytes.empty());
    EXPECT_THAT(film.note.in_english(), HasSubstr("6 of the 7 pictures"));
    std::filesystem::remove(here / "movie.mp4");
    EXPECT_THAT(page_film(scene, here.path(), 6).note.in_english(),
                tells({"movie.mp4", "not in", "run's folder"}));
}

TEST_F(PageFilmTest, ThePosterIsAJpegOfAtMost960Pixels) {
    EXPECT_TRUE(page_poster(here.path()).empty());
    write_png(here / "poster.png", grey(1920, 1080, 128), {});
    const std::vector<std::uint8_t> jpeg = page_poster(here.path());
    ASSERT_GT(jpeg.size(), 100u);
    std::ofstream(here / "poster.jpg", std::ios::binary)
        .write(reinterpret_cast<const char*>(jpeg.data()), static_cast<std::streamsize>(jpeg.size()));
    FilmReader reader(here / "poster.jpg");
    const AVFrame* frame = reader.next();
    ASSERT_NE(frame, nullptr);
    EXPECT_EQ(frame->width, 960);
    EXPECT_EQ(frame->height, 540);
    EXPECT_NEAR(frame->data[0][frame->linesize[0] * 100 + 100], 128, 2);  // full range: luma is the level
}

}  // namespace
}  // namespace grainreel
