// Tests of the encoder of MP4 films: order, colours, tags, and what a killed program leaves.
#include "render/film/codec/encoder.hpp"

#include <gmock/gmock.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "engine/base/error.hpp"
#include "tests/film/film_fixture.hpp"
#include "tests/film/film_reading.hpp"
#include "tests/support/tells.hpp"

namespace grainreel::test {
namespace {

using ::testing::Contains;
using ::testing::Each;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;
using ::testing::SizeIs;

class EncoderTest : public FilmTest {
  protected:
    EncoderSettings settings(int width = 160, int height = 96) const {
        EncoderSettings s;
        s.path = folder / "movie.mp4";
        s.width = width;
        s.height = height;
        return s;
    }
    std::filesystem::path path() const { return folder / "movie.mp4"; }
};

TEST_F(EncoderTest, EveryPictureComesBackInOrderAndLooksTheSame) {
    constexpr int count = 100;
    Encoder encoder(settings());
    for (int i = 0; i < count; ++i) encoder.add(ball(160, 96, i));
    encoder.finish();
    const FilmFile film = read_film(path());
    ASSERT_THAT(film.frames, SizeIs(count));
    for (int i = 0; i < count; ++i) {
        EXPECT_GT(psnr(to_rgb(film.frames[i]), ball(160, 96, i)), 35) << i;
        EXPECT_LT(psnr(to_rgb(film.frames[i]), ball(160, 96, i + 1)), 35) << i;
        EXPECT_NEAR(film.frames[i].time, i / 30.0, 1e-4);
    }
}

TEST_F(EncoderTest, ColoursAreBt709InLimitedRange) {
    const std::vector<std::array<int, 3>> colours{{255, 0, 0},     {0, 255, 0},   {0, 0, 255},
                                                  {128, 128, 128}, {0, 0, 0},     {230, 159, 0},
                                                  {255, 255, 255}, {86, 180, 233}};
    EncoderSettings s = settings(64, 64);
    s.quality = 10;
    Encoder encoder(s);
    for (const auto& c : colours) encoder.add(flat(64, 64, c[0], c[1], c[2]));
    encoder.finish();
    const FilmFile film = read_film(path());
    ASSERT_THAT(film.frames, SizeIs(colours.size()));
    for (std::size_t i = 0; i < colours.size(); ++i) {
        const Code code = bt709_code(colours[i][0], colours[i][1], colours[i][2]);
        EXPECT_NEAR(film.frames[i].y[32 * 64 + 32], code[0], 1) << i;
        EXPECT_NEAR(film.frames[i].u[16 * 32 + 16], code[1], 1) << i;
        EXPECT_NEAR(film.frames[i].v[16 * 32 + 16], code[2], 1) << i;
    }
}

AvFramePtr yuv_frame(int width, int height) {
    AvFramePtr frame(av_frame_alloc());
    frame->format = AV_PIX_FMT_YUV420P;
    frame->width = width;
    frame->height = height;
    EXPECT_GE(av_frame_get_buffer(frame.get(), 0), 0);
    return frame;
}

TEST(ColourConversion, PureColoursAreTheirCodesRounded) {
    ColourConversion conversion(64, 64);
    const AvFramePtr frame = yuv_frame(64, 64);
    for (const std::array<int, 3>& c :
         std::vector<std::array<int, 3>>{{255, 0, 0}, {0, 255, 0}, {0, 0, 255}}) {
        conversion.convert(flat(64, 64, c[0], c[1], c[2]), *frame);
        const Code code = bt709_code(c[0], c[1], c[2]);
        for (int plane = 0; plane < 3; ++plane) {
            // Half a code is for the rounding of the sum, and half for swscale's fixed point.
            EXPECT_NEAR(frame->data[plane][10 * frame->linesize[plane] + 10],
                        code[static_cast<std::size_t>(plane)], 1);
        }
    }
    conversion.convert(flat(64, 64, 255, 0, 0), *frame);
    EXPECT_EQ(frame->data[0][0], 63);
    EXPECT_EQ(frame->data[1][0], 102);
    EXPECT_EQ(frame->data[2][0], 240);
}

// Chroma is at the place that the film's tags give: on the left one of two columns, which counts for half of
// the sample.
TEST(ColourConversion, ChromaSitsOnTheLeftColumn) {
    Picture picture = flat(64, 64, 255, 0, 0);
    for (int y = 0; y < 64; ++y)
        for (int x = 32; x < 64; ++x) std::copy_n(std::array{0, 0, 255}.begin(), 3, picture.pixel(x, y));
    ColourConversion conversion(64, 64);
    const AvFramePtr frame = yuv_frame(64, 64);
    conversion.convert(picture, *frame);
    const Code red = bt709_code(255, 0, 0), blue = bt709_code(0, 0, 255);
    for (std::size_t plane = 1; plane < 3; ++plane) {
        const std::uint8_t* row = frame->data[plane] + 10 * frame->linesize[plane];
        EXPECT_NEAR(row[15], red[plane], 1);
        EXPECT_NEAR(row[16], 0.25 * red[plane] + 0.75 * blue[plane], 1);
        EXPECT_NEAR(row[17], blue[plane], 1);
    }
}

TEST(ColourConversion, APaddedRowOrColumnRepeatsTheLastOne) {
    ColourConversion conversion(65, 35);
    EXPECT_EQ(conversion.coded_width(), 66);
    EXPECT_EQ(conversion.coded_height(), 36);
    const AvFramePtr frame = yuv_frame(66, 36);
    const Picture picture = noise(65, 35, 1);
    conversion.convert(picture, *frame);
    for (int y = 0; y < 36; ++y) {
        for (int x = 0; x < 66; ++x) {
            const std::uint8_t* p = picture.pixel(std::min(x, 64), std::min(y, 34));
            ASSERT_NEAR(frame->data[0][y * frame->linesize[0] + x], bt709_code(p[0], p[1], p[2])[0], 1);
        }
    }
}

TEST_F(EncoderTest, TagsMetadataAndPixelFormatAreThere) {
    EncoderSettings s = settings();
    s.title = "Γ = 3, big and small";
    s.comment = "scene teaching";
    s.rate = 25;
    Encoder encoder(s);
    for (int i = 0; i < 30; ++i) encoder.add(ball(160, 96, i));
    encoder.finish();
    const FilmFile film = read_film(path());
    EXPECT_EQ(film.primaries, AVCOL_PRI_BT709);
    EXPECT_EQ(film.transfer, AVCOL_TRC_BT709);
    EXPECT_EQ(film.matrix, AVCOL_SPC_BT709);
    EXPECT_EQ(film.range, AVCOL_RANGE_MPEG);
    EXPECT_EQ(film.pixel_format, AV_PIX_FMT_YUV420P);
    EXPECT_DOUBLE_EQ(film.rate, 25);
    EXPECT_EQ(film.metadata.at("title"), "Γ = 3, big and small");
    EXPECT_EQ(film.metadata.at("comment"), "scene teaching");
}

TEST_F(EncoderTest, FinishedFilmsHaveTheirIndexInFrontUnfinishedOnesAreFragmented) {
    const auto film = [&](bool finish) {
        Encoder encoder(settings());
        for (int i = 0; i < 90; ++i) encoder.add(ball(160, 96, i));
        if (finish) encoder.finish();
    };
    film(false);
    EXPECT_THAT(mp4_boxes(path()), Contains("moof").Times(::testing::Ge(6)));  // 3 s in fragments of 0.5 s
    EXPECT_THAT(read_film(path()).frames, SizeIs(90));
    film(true);
    const std::vector<std::string> boxes = mp4_boxes(path());
    EXPECT_THAT(boxes, Not(Contains("moof")));
    EXPECT_LT(std::find(boxes.begin(), boxes.end(), "moov"), std::find(boxes.begin(), boxes.end(), "mdat"));
    EXPECT_FALSE(std::filesystem::exists(path().string() + ".part"));
}

TEST_F(EncoderTest, KeyFramesAreHalfASecondApartAtMost) {
    Encoder encoder(settings());
    for (int i = 0; i < 90; ++i) encoder.add(flat(160, 96, 200, 200, 200));  // nothing else needs a key frame
    encoder.finish();
    EXPECT_EQ(read_film(path()).key_frames, 6);  // 3 s of film
}

TEST_F(EncoderTest, OddSizesArePaddedWithTheirLastRowAndColumn) {
    Encoder encoder(settings(65, 35));
    EXPECT_THAT(encoder.notes(), ElementsAre(HasSubstr("65x35 padded to 66x36")));
    // The lower right corner is blue and the rest yellow, so the padding must be blue there and yellow
    // elsewhere.
    Picture picture = flat(65, 35, 255, 255, 0);
    for (int y = 17; y < 35; ++y)
        for (int x = 33; x < 65; ++x)
            picture.pixel(x, y)[0] = picture.pixel(x, y)[1] = 0, picture.pixel(x, y)[2] = 255;
    for (int i = 0; i < 5; ++i) encoder.add(picture);
    encoder.finish();
    const FilmFile film = read_film(path());
    ASSERT_THAT(film.frames, SizeIs(5));
    EXPECT_EQ(film.frames[0].width, 66);
    EXPECT_EQ(film.frames[0].height, 36);
    const Code blue = bt709_code(0, 0, 255), yellow = bt709_code(255, 255, 0);
    EXPECT_NEAR(film.frames[4].y[35 * 66 + 65], blue[0], 4);
    EXPECT_NEAR(film.frames[4].y[35 * 66 + 2], yellow[0], 4);
    EXPECT_NEAR(film.frames[4].y[2 * 66 + 65], yellow[0], 4);
}

TEST_F(EncoderTest, EvenSizesNeedNoNoteAndFewFramesAreAFilm) {
    for (const int count : {0, 1, 2}) {
        Encoder encoder(settings());
        EXPECT_THAT(encoder.notes(), IsEmpty());
        for (int i = 0; i < count; ++i) encoder.add(ball(160, 96, i));
        encoder.finish();
        EXPECT_THAT(read_film(path()).frames, SizeIs(static_cast<std::size_t>(count)));
    }
}

struct KillCase {
    double rate;
    const char* preset;
    int threads;
};

class KilledEncoderTest : public EncoderTest, public ::testing::WithParamInterface<KillCase> {};

TEST_P(KilledEncoderTest, TheFilmPlaysUpToItsLastTwoSeconds) {
    const KillCase& k = GetParam();
    const int count = static_cast<int>(6 * k.rate) + 1;
    EncoderSettings s = settings();
    s.rate = k.rate;
    s.preset = k.preset;
    s.threads = k.threads;
    const pid_t child = fork();
    if (child == 0) {
        Encoder encoder(s);
        for (int i = 0; i < count; ++i) encoder.add(ball(160, 96, i));
        kill(getpid(), SIGKILL);
    }
    int status = 0;
    waitpid(child, &status, 0);
    ASSERT_TRUE(WIFSIGNALED(status) && WTERMSIG(status) == SIGKILL);
    const FilmFile film = read_film(path());
    EXPECT_GE(static_cast<double>(film.frames.size()), count - 2 * k.rate);
    EXPECT_LT(static_cast<int>(film.frames.size()), count);  // otherwise the child was not killed half-way
    for (const YuvFrame& frame : film.frames) {
        // The last pictures on disk may have gaps: B-frames are coded after the picture that follows them.
        const auto number = static_cast<int>(std::lround((frame.time - film.frames[0].time) * k.rate));
        EXPECT_GT(psnr(to_rgb(frame), ball(160, 96, number)), 35) << number;
    }
}

INSTANTIATE_TEST_SUITE_P(Rates, KilledEncoderTest,
                         ::testing::Values(KillCase{30, "veryfast", 2}, KillCase{30, "slow", 1},
                                           KillCase{60, "veryfast", 2}, KillCase{12, "medium", 2},
                                           KillCase{15, "veryslow", 2}, KillCase{5, "veryfast", 2},
                                           KillCase{2, "veryfast", 1}));

std::string message_of(const std::function<void()>& action) {
    try {
        action();
    } catch (const RunError& error) {
        return error.what();
    }
    return "no error";
}

TEST_F(EncoderTest, AFullDiskNamesFileAndReasonAndLeavesWhatWasWritten) {
    Encoder encoder(settings());
    std::string message;
    {
        const FileSizeLimit limit(512 * 1024);
        message = message_of([&] {
            for (int i = 0; i < 300; ++i) encoder.add(noise(160, 96, i));
        });
    }
    EXPECT_THAT(message, HasSubstr(path().string() + ": cannot write the film: File too large"));
    EXPECT_THAT(message_of([&] { encoder.add(noise(160, 96, 0)); }), HasSubstr("closed after an error"));
    EXPECT_THAT(message_of([&] { encoder.finish(); }), HasSubstr("closed after an error"));
    EXPECT_THAT(read_film(path()).frames, SizeIs(::testing::Ge(15)));
}

TEST_F(EncoderTest, AFailedRemuxLeavesTheFragmentedFilm) {
    Encoder encoder(settings());
    for (int i = 0; i < 60; ++i) encoder.add(ball(160, 96, i));
    std::filesystem::create_directory(path().string() + ".part");
    EXPECT_THAT(message_of([&] { encoder.finish(); }),
                HasSubstr(path().string() + ": cannot put the index in front: Is a directory"));
    EXPECT_THAT(read_film(path()).frames, SizeIs(60));
}

TEST_F(EncoderTest, AFileThatCannotBeWrittenIsARunError) {
    EncoderSettings s = settings();
    s.path = folder / "nowhere" / "movie.mp4";
    EXPECT_THAT(message_of([&] { Encoder encoder(s); }),
                HasSubstr(s.path.string() + ": cannot write the film: No such file or directory"));
    s.path = "/dev/full";
    EXPECT_THAT(message_of([&] { Encoder encoder(s); }),
                tells({"/dev/full", "cannot write", "No space left"}));
}

TEST_F(EncoderTest, AColonInARelativePathIsNoProtocol) {
    const std::filesystem::path before = std::filesystem::current_path();
    std::filesystem::current_path(folder.path());
    EncoderSettings s = settings();
    s.path = "run:1%.mp4";
    Encoder encoder(s);
    encoder.add(ball(160, 96, 0));
    encoder.finish();
    std::filesystem::current_path(before);
    EXPECT_THAT(read_film(folder / s.path).frames, SizeIs(1));
}

TEST_F(EncoderTest, ARefusedPresetIsARunError) {
    EncoderSettings s = settings();
    s.preset = "hasty";
    EXPECT_THAT(message_of([&] { Encoder encoder(s); }),
                tells({"x264", "no preset", "\"hasty\"", "ultrafast, superfast"}));
}

TEST_F(EncoderTest, WithoutAnEncoderTheMessageSaysWhatToInstall) {
    Codec codec = codec_of(FilmFormat::mp4);
    codec.encoders.resize(1);
    codec.encoders[0].name = "libnothing";
    CodecSettings s;
    s.width = s.height = 64;
    EXPECT_EQ(
        message_of([&] { open_codec(codec, s); }),
        "film: this machine's FFmpeg has no H.264 encoder (libnothing); install FFmpeg libraries built with "
        "libnothing (Debian: libavcodec59), choose another --format, or ask for --no-film --frames");
}

}  // namespace
}  // namespace grainreel::test
