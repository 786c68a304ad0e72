// Tests of every format that has a file of its own, read back by its decoder.
#include <gmock/gmock.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cmath>
#include <fstream>

#include "engine/base/error.hpp"
#include "render/film/codec/encoder.hpp"
#include "render/scene/film.hpp"
#include "render/scene/shown_values.hpp"
#include "tests/film/film_fixture.hpp"
#include "tests/film/film_reading.hpp"

namespace grainreel::test {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::SizeIs;

constexpr auto all_formats = {FilmFormat::mp4,  FilmFormat::webm, FilmFormat::av1,
                              FilmFormat::ffv1, FilmFormat::gif,  FilmFormat::y4m};

std::string bytes_of(const std::filesystem::path& path) {
    std::ifstream in(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
}

class FormatTest : public FilmTest, public ::testing::WithParamInterface<FilmFormat> {
  protected:
    // 25 frames a second suit every format: 4 hundredths for a GIF.
    FilmedScene scene(int width = 160, int height = 96) const {
        FilmedScene s = small_scene(width, height);
        s.film.format = GetParam();
        s.film.rate = 25;
        return s;
    }
    bool is_rgb() const { return GetParam() == FilmFormat::ffv1 || GetParam() == FilmFormat::gif; }
    std::unique_ptr<FilmWriter> writer(const FilmedScene& s) const {
        return make_film_writer(s, {folder.path(), false, 2});
    }
    std::filesystem::path path() const { return folder / film_file_name(GetParam()); }
    FilmFile film() const { return read_film(path()); }
    static std::vector<Picture> pictures_of(const FilmFile& film) {
        if (!film.pictures.empty()) return film.pictures;
        std::vector<Picture> pictures;
        for (const YuvFrame& frame : film.frames) pictures.push_back(to_rgb(frame));
        return pictures;
    }
    // The file that plays when the film was cut off: the film itself, or the exact copy from which a GIF is
    // made.
    std::filesystem::path cut_off() const {
        return GetParam() == FilmFormat::gif ? folder / "movie.work" / "spool.mkv" : path();
    }
};

std::string name_of(const ::testing::TestParamInfo<FilmFormat>& format) {
    return word_of(format.param, film_format_words);
}
INSTANTIATE_TEST_SUITE_P(All, FormatTest, ::testing::ValuesIn(all_formats), name_of);

TEST_P(FormatTest, EveryPictureComesBackInOrderAndOnTime) {
    constexpr int count = 60;
    const auto film_writer = writer(scene());
    for (int i = 0; i < count; ++i) film_writer->add(ball(160, 96, i));
    film_writer->finish();
    const FilmFile played = film();
    const std::vector<Picture> pictures = pictures_of(played);
    ASSERT_THAT(pictures, SizeIs(count));
    EXPECT_NEAR(played.rate, 25, 1e-9);
    for (int i = 0; i < count; ++i) {
        const double likeness = psnr(pictures[i], ball(160, 96, i));
        EXPECT_GT(likeness, 34) << i;
        EXPECT_LT(psnr(pictures[i], ball(160, 96, i + 1)), likeness - 0.5) << i;
        EXPECT_NEAR(played.times[i], i / 25.0, 1.1e-3);  // Matroska counts milliseconds
    }
    if (GetParam() != FilmFormat::y4m) {
        EXPECT_NEAR(played.duration, count / 25.0, 0.041);
    }
    EXPECT_FALSE(std::filesystem::exists(folder / "movie.work"));
    EXPECT_FALSE(std::filesystem::exists(path().string() + ".part"));
}

// Y'CbCr is within one code. RGB is within three levels, because the step of limited range is 1.16 and
// chroma's matrix doubles it. Lossless RGB is exact. A GIF with so few colours is within its palette's 5
// bits, 255 / 31 / 2 + rounding.
TEST_P(FormatTest, FlatColoursKeepTheirCodes) {
    const std::vector<std::array<int, 3>> colours{{255, 0, 0},     {0, 255, 0},   {0, 0, 255},
                                                  {128, 128, 128}, {0, 0, 0},     {230, 159, 0},
                                                  {255, 255, 255}, {86, 180, 233}};
    FilmedScene s = scene(64, 64);
    s.film.quality = 8;
    const auto film_writer = writer(s);
    for (const auto& c : colours) film_writer->add(flat(64, 64, c[0], c[1], c[2]));
    film_writer->finish();
    const FilmFile played = film();
    const std::vector<Picture> pictures = pictures_of(played);
    ASSERT_THAT(pictures, SizeIs(colours.size()));
    const double bound = GetParam() == FilmFormat::ffv1 ? 0 : GetParam() == FilmFormat::gif ? 5 : 3;
    for (std::size_t i = 0; i < colours.size(); ++i) {
        for (int c = 0; c < 3; ++c) EXPECT_NEAR(pictures[i].pixel(32, 32)[c], colours[i][c], bound) << i;
        if (is_rgb()) continue;
        const Code code = bt709_code(colours[i][0], colours[i][1], colours[i][2]);
        EXPECT_NEAR(played.frames[i].y[32 * 64 + 32], code[0], 1) << i;
        EXPECT_NEAR(played.frames[i].u[16 * 32 + 16], code[1], 1) << i;
        EXPECT_NEAR(played.frames[i].v[16 * 32 + 16], code[2], 1) << i;
    }
}

TEST_P(FormatTest, YuvIsTaggedBt709AndLimited) {
    const auto film_writer = writer(scene());
    for (int i = 0; i < 5; ++i) film_writer->add(ball(160, 96, i));
    film_writer->finish();
    const FilmFile played = film();
    if (is_rgb()) return;
    EXPECT_EQ(played.pixel_format, AV_PIX_FMT_YUV420P);
    EXPECT_EQ(played.range, AVCOL_RANGE_MPEG);
    if (GetParam() == FilmFormat::y4m) return;  // the format has no tags for the rest
    EXPECT_EQ(played.primaries, AVCOL_PRI_BT709);
    EXPECT_EQ(played.transfer, AVCOL_TRC_BT709);
    EXPECT_EQ(played.matrix, AVCOL_SPC_BT709);
    EXPECT_EQ(played.metadata.at("title"), "Γ = 3, big and small");
}

TEST_P(FormatTest, OddSizesArePaddedWhereChromaIsHalved) {
    const auto film_writer = writer(scene(65, 67));
    const Picture picture = ball(65, 67, 16);
    for (int i = 0; i < 3; ++i) film_writer->add(picture);
    film_writer->finish();
    const std::vector<Picture> pictures = pictures_of(film());
    ASSERT_THAT(pictures, SizeIs(3));
    EXPECT_EQ(pictures[0].width, is_rgb() ? 65 : 66);
    EXPECT_EQ(pictures[0].height, is_rgb() ? 67 : 68);
    EXPECT_GT(psnr(pictures[2], picture), 33);
    if (is_rgb()) {
        EXPECT_THAT(film_writer->notes(), IsEmpty());
    } else {
        EXPECT_THAT(film_writer->notes(), ElementsAre(HasSubstr("65x67 padded to 66x68")));
    }
}

TEST_P(FormatTest, TheSamePicturesGiveTheSameBytes) {
    const auto made = [&](int number) {
        const std::filesystem::path other = folder / std::to_string(number);
        std::filesystem::create_directory(other);
        const auto film_writer = make_film_writer(scene(), {other, false, 2});
        for (int i = 0; i < 30; ++i) film_writer->add(discs(160, 96, i));
        film_writer->finish();
        return bytes_of(other / film_file_name(GetParam()));
    };
    const std::string first = made(1);
    EXPECT_GT(first.size(), 1000u);
    EXPECT_TRUE(first == made(2));
}

TEST_P(FormatTest, WithoutFinishEverythingTakenPlays) {
    {
        const auto film_writer = writer(scene());
        for (int i = 0; i < 40; ++i) film_writer->add(ball(160, 96, i));
    }
    EXPECT_THAT(pictures_of(read_film(cut_off())), SizeIs(40));
}

TEST_P(FormatTest, KilledItPlaysUpToItsLastTwoSeconds) {
    constexpr int count = 150;
    const pid_t child = fork();
    if (child == 0) {
        const auto film_writer = writer(scene());
        for (int i = 0; i < count; ++i) film_writer->add(ball(160, 96, i));
        kill(getpid(), SIGKILL);
    }
    int status = 0;
    waitpid(child, &status, 0);
    ASSERT_TRUE(WIFSIGNALED(status) && WTERMSIG(status) == SIGKILL);
    const FilmFile played = read_film(cut_off());
    const std::vector<Picture> pictures = pictures_of(played);
    EXPECT_GE(static_cast<int>(pictures.size()), count - 2 * 25);
    for (std::size_t i = 0; i < pictures.size(); ++i) {
        const auto number = static_cast<int>(std::lround((played.times[i] - played.times[0]) * 25));
        EXPECT_GT(psnr(pictures[i], ball(160, 96, number)), 33) << number;
    }
}

TEST_P(FormatTest, NoPicturesAreNoReasonToFail) {
    const auto film_writer = writer(scene());
    film_writer->finish();
    EXPECT_THAT(pictures_of(film()), IsEmpty());
}

TEST_P(FormatTest, TheDescriptionNamesEncoderAndThreads) {
    const auto film_writer = writer(scene());
    film_writer->add(ball(160, 96, 0));
    film_writer->finish();
    EXPECT_THAT(film_writer->description(), HasSubstr(codec_of(GetParam()).words));
    EXPECT_THAT(film_writer->description(), HasSubstr("2 threads"));
}

class LosslessFilm : public FilmTest {};

TEST_F(LosslessFilm, Ffv1KeepsEveryByteAndAlphaWhenAsked) {
    for (const bool alpha : {false, true}) {
        FilmedScene scene = small_scene(70, 66);
        scene.film.format = FilmFormat::ffv1;
        scene.film.transparent = alpha;
        const auto writer = make_film_writer(scene, {folder.path(), false, 1});
        for (int i = 0; i < 4; ++i) writer->add(noise(70, 66, i));
        writer->finish();
        const FilmFile film = read_film(folder / "movie.mkv");
        ASSERT_THAT(film.pictures, SizeIs(4));
        for (int i = 0; i < 4; ++i) {
            Picture expected = noise(70, 66, i);
            if (!alpha)
                for (std::size_t k = 3; k < expected.rgba.size(); k += 4) expected.rgba[k] = 255;
            EXPECT_TRUE(film.pictures[i].rgba == expected.rgba) << i;
        }
    }
}

// The ball has many shades, the GIF has 256 colours, and the amplitude of Bayer's pattern is bounded.
TEST_F(LosslessFilm, AGifStaysNearItsPictures) {
    FilmedScene scene = small_scene(160, 96);
    scene.film.format = FilmFormat::gif;
    scene.film.rate = 50;
    const auto writer = make_film_writer(scene, {folder.path(), false, 1});
    for (int i = 0; i < 20; ++i) writer->add(discs(160, 96, i));
    writer->finish();
    const FilmFile film = read_film(folder / "movie.gif");
    ASSERT_THAT(film.pictures, SizeIs(20));
    EXPECT_NEAR(film.times[1] - film.times[0], 0.02, 1e-9);
    int worst = 0;
    for (int i = 0; i < 20; ++i) {
        const Picture expected = discs(160, 96, i);
        for (std::size_t k = 0; k < expected.rgba.size(); ++k)
            if (k % 4 != 3) worst = std::max(worst, std::abs(film.pictures[i].rgba[k] - expected.rgba[k]));
        EXPECT_GT(psnr(film.pictures[i], expected), 30) << i;
    }
    EXPECT_LE(worst, 48);
}

}  // namespace
}  // namespace grainreel::test
