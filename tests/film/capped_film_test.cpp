#include "render/film/capped_film.hpp"

#include <gmock/gmock.h>

#include "engine/base/error.hpp"
#include "engine/scene/words.hpp"
#include "tests/film/film_fixture.hpp"
#include "tests/film/film_reading.hpp"

namespace grainreel::test {
namespace {

using ::testing::HasSubstr;
using ::testing::SizeIs;

constexpr int frames = 50, wide = 256, high = 144;

class CappedFilmTest : public FilmTest, public ::testing::WithParamInterface<FilmFormat> {
  protected:
    std::filesystem::path path() const { return folder / film_file_name(GetParam()); }
    std::int64_t size() const { return static_cast<std::int64_t>(std::filesystem::file_size(path())); }
    std::string make(std::int64_t cap, int width = wide, int height = high) const {
        Scene scene = small_scene(width, height);
        scene.film.format = GetParam();
        scene.film.rate = 25;
        scene.film.quality = 18;
        scene.film.max_size = cap;
        const auto writer = make_film_writer(scene, {folder, false, 2});
        for (int i = 0; i < frames; ++i) writer->add(discs(width, height, i));
        writer->finish();
        return writer->description();
    }
};

INSTANTIATE_TEST_SUITE_P(Formats, CappedFilmTest, ::testing::Values(FilmFormat::mp4, FilmFormat::webm),
                         [](const auto& format) { return word_of(format.param, film_format_words); });

TEST_P(CappedFilmTest, FillsItsCapFromBelowAndStillPlays) {
    make(1'000'000'000);
    const std::int64_t full = size();
    for (const double share : {0.6, 0.15}) {
        const auto cap = static_cast<std::int64_t>(share * static_cast<double>(full));
        EXPECT_THAT(make(cap), HasSubstr("in two passes"));
        EXPECT_LE(size(), cap) << share;
        EXPECT_GE(static_cast<double>(size()), 0.9 * static_cast<double>(cap)) << share;
        const FilmFile film = read_film(path());
        ASSERT_THAT(film.frames, SizeIs(frames));
        for (const int i : {0, frames / 2, frames - 1})
            EXPECT_GT(psnr(to_rgb(film.frames[i]), discs(wide, high, i)), 17) << share;
        EXPECT_FALSE(std::filesystem::exists(folder / "movie.work"));
    }
}

TEST_P(CappedFilmTest, AFilmThatFitsIsLeftAtItsQuality) {
    EXPECT_THAT(make(1'000'000'000), HasSubstr("at this quality, below the cap of 1 GB"));
    const std::int64_t full = size();
    make(full);
    EXPECT_EQ(size(), full);
    EXPECT_FALSE(std::filesystem::exists(folder / "movie.work"));
}

TEST_P(CappedFilmTest, ACapThatNoFilmFitsInIsAClearErrorAndKeepsTheFilm) {
    try {
        make(4000);
        FAIL() << "no error";
    } catch (const RunError& error) {
        EXPECT_THAT(error.what(), HasSubstr("a cap of 4 kB is too small for this film"));
        EXPECT_THAT(error.what(), HasSubstr("raise --max-size"));
    }
    EXPECT_THAT(read_film(path()).frames, SizeIs(frames));
    EXPECT_FALSE(std::filesystem::exists(folder / "movie.work"));
}

TEST_P(CappedFilmTest, OddSizesFitToo) {
    EXPECT_THAT(make(40'000, 161, 97), HasSubstr("in two passes"));
    EXPECT_LE(size(), 40'000);
    EXPECT_THAT(read_film(path()).frames, SizeIs(frames));
}

TEST_P(CappedFilmTest, TheSamePicturesGiveTheSameBytes) {
    const auto bytes = [&] {
        EXPECT_THAT(make(40'000, 160, 96), HasSubstr("in two passes"));
        return std::filesystem::file_size(path());
    };
    const auto first = bytes();
    EXPECT_EQ(first, bytes());
}

}  // namespace
}  // namespace grainreel::test
