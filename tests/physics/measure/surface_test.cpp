// Tests of surfaces with known shapes.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>

#include "engine/base/random.hpp"
#include "engine/measure/surface/surface.hpp"

namespace grainreel {
namespace {

using std::numbers::pi;

// A bed of grains of diameter 1, in stacks at distances of 1 whose topmost grains end at h(y).
std::vector<Place> bed_of(int width, int depth, const std::function<double(double)>& h) {
    std::vector<Place> grains;
    for (int j = 0; j < width; ++j) {
        for (int i = 0; i < depth; ++i) {
            const double y = j + 0.5 - 0.5 * width, x = i + 0.5 - 0.5 * depth;
            for (double z = h(y) - 0.5; z > 0; z -= 1) grains.push_back({{x, y, z}, 0.5});
        }
    }
    return grains;
}

SurfaceAxes frame_of(double width, double depth) {
    return {-0.5 * width, 0.5 * width, -0.5 * depth, 0.5 * depth, 0, 1};
}

TEST(Surface, FollowsTheTopmostGrains) {
    const auto h = [](double y) { return 10 + 0.1 * y; };
    const BedOutline surface = surface_of(bed_of(40, 6, h), frame_of(40, 6));
    ASSERT_EQ(surface.height.size(), 20u);
    EXPECT_NEAR(surface.bin, 2, 1e-12);
    // The higher one of the two stacks in a bin counts, half a diameter to the right of the bin's middle.
    for (std::size_t j = 0; j < 20; ++j)
        EXPECT_NEAR(surface.height[j], h(surface.place(j) + 0.5), 1e-12) << j;
}

TEST(Surface, LeavesOutGrainsInFlight) {
    std::vector<Place> grains = bed_of(40, 6, [](double) { return 10; });
    const std::vector<double> calm = surface_of(grains, frame_of(40, 6)).height;
    for (int i = 0; i < 20; ++i) grains.push_back({{0, i - 9.5, 12.6 + i}, 0.5});
    EXPECT_EQ(surface_of(grains, frame_of(40, 6)).height, calm);
    // The surface is also found if the whole bed flies.
    for (Place& p : grains) p.position.z() += 100;
    EXPECT_NEAR(surface_of(grains, frame_of(40, 6)).mean(), 110, 1e-9);
}

// A ball of radius 3 lies half in the bed. There are no holes beside its middle, and the surface there is the
// ball's.
TEST(Surface, IsThatOfALargeGrainWhereItLies) {
    std::vector<Place> grains;
    for (const Place& p : bed_of(40, 6, [](double) { return 10; }))
        if ((p.position - Vec3(0, 0, 10)).norm() > 3.5) grains.push_back(p);
    grains.push_back({{0, 0, 10}, 3});
    const BedOutline surface = surface_of(grains, frame_of(40, 6));
    for (std::size_t j = 0; j < 20; ++j) {
        double expected = 0;
        const double y = std::max(0.0, std::abs(surface.place(j)) - 1);  // of the nearest edge of the column
        for (const double x : {1.0, 0.0, 1.0}) {
            const double square = 9 - y * y - x * x;
            expected += square > 0 ? 10 + std::sqrt(square) : 10;
        }
        EXPECT_NEAR(surface.height[j], expected / 3, 1e-12) << j;
    }
}

// A large ball at the bottom leaves no gap in the columns that it reaches into at their edges only.
TEST(Surface, HasNoHolesAboveALargeGrain) {
    std::vector<Place> grains;
    for (const Place& p : bed_of(40, 6, [](double) { return 14; }))
        if ((p.position - Vec3(0, 0.9, 3)).norm() > 3.5) grains.push_back(p);
    grains.push_back({{0, 0.9, 3}, 3});
    for (const double h : surface_of(grains, frame_of(40, 6)).height) EXPECT_NEAR(h, 14, 1e-12);
}

TEST(Surface, FillsBinsWithoutGrainsFromTheNearest) {
    const std::vector<Place> grains{{{0, -9, 3}, 0.5}, {{0, 9, 5}, 0.5}};
    const BedOutline surface = surface_of(grains, frame_of(20, 2));
    ASSERT_EQ(surface.height.size(), 10u);
    EXPECT_EQ(surface.height[0], 3.5);
    EXPECT_EQ(surface.height[4], 4.5);
    EXPECT_EQ(surface.height[9], 5.5);
    EXPECT_TRUE(surface_of({}, frame_of(20, 2)).height.empty());
}

TEST(Surface, FindsGrainsPastAPeriodicEnd) {
    SurfaceAxes frame = frame_of(20, 4);
    frame.period = 4;
    const BedOutline surface = surface_of(std::vector<Place>{{{3, 0, 3}, 0.5}, {{-1, 0, 7}, 0.5}}, frame);
    EXPECT_EQ(surface.height[5],
              3.5);  // the grain lies in one column, and the other grain is too far above it
}

// There are 90 grains of 1, and 10 of 4 come during the run: their mean is 1.3. In the wedge they fill the
// room up to the height h with a solid fraction of 0.6. The slants rise at 45 degrees from a floor of
// half-width 2, so the room is 4 h + h^2 times the depth.
TEST(SurfaceFrame, IsAsWideAsTheContainerWhereTheBedEnds) {
    Scene scene;
    scene.species.resize(2);
    scene.species[0].count = 90, scene.species[1].fed = 10;
    scene.species[0].diameter.mean = 1, scene.species[1].diameter.mean = 4;
    Container& wedge = scene.container;
    wedge.half_width = 22, wedge.depth = 10, wedge.height = 40;
    wedge.half_angle = pi / 4, wedge.slant_height = 20;
    const double area = pi / 6 * (90 + 10 * 64) / 0.6 / 10, h = std::sqrt(4 + area) - 2;
    const SurfaceAxes frame = surface_frame(scene);
    EXPECT_NEAR(frame.diameter, 1.3, 1e-12);
    EXPECT_NEAR(frame.right, 2 + h, 1e-9);
    EXPECT_NEAR(frame.left, -2 - h, 1e-9);
    EXPECT_NEAR(frame.front, 5, 1e-12);
}

// There are 2.5 waves of amplitude 4 and a whole number of waves of amplitude 1. The larger wave is found.
TEST(Spectrum, FindsTheLargestWave) {
    Spectrum spectrum(30);
    std::vector<double> h;
    for (int j = 0; j < 30; ++j)
        h.push_back(2 + std::cos(pi * 8 * (j + 0.5) / 30) - 4 * std::cos(pi * 5 * (j + 0.5) / 30));
    const DominantWave wave = spectrum.dominant(h, 0.15);
    EXPECT_NEAR(wave.wavelength, 2 * 0.15 / 5, 1e-12);
    EXPECT_NEAR(wave.share, 16.0 / (16 + 1), 0.02);  // the other one leaks a little into it
    for (double& x : h) x = -x;                      // a second time, because the plan is used again
    EXPECT_NEAR(spectrum.dominant(h, 0.15).share, wave.share, 1e-12);
}

TEST(Spectrum, OfOneWaveHasAllOfTheVariance) {
    for (const double phase : {0.0, 0.4, 1.1}) {
        Spectrum spectrum(24);
        std::vector<double> h;
        for (int j = 0; j < 24; ++j) h.push_back(7 + 0.1 * std::sin(2 * pi * 3 * (j + 0.5) / 24 + phase));
        const DominantWave wave = spectrum.dominant(h, 1);
        EXPECT_NEAR(wave.wavelength, 1.0 / 3, 1e-12);
        EXPECT_NEAR(wave.share, 1, 1e-9);
        EXPECT_NEAR(variance_of(h), 0.1 * 0.1 / 2, 1e-12);
    }
}

// A bed has a sine on top, at any phase against the walls.
TEST(Spectrum, FindsTheWavelengthOfASineSurface) {
    for (const double waves : {2.0, 3.0, 4.5}) {
        for (const double phase : {0.0, 0.7, 1.5, 2.6}) {
            const auto h = [&](double y) { return 12 + 2 * std::sin(2 * pi * waves * y / 90 + phase); };
            const BedOutline surface = surface_of(bed_of(90, 4, h), frame_of(90, 4));
            Spectrum spectrum(surface.height.size());
            const DominantWave wave = spectrum.dominant(surface.height, surface.width());
            EXPECT_NEAR(wave.wavelength, 90 / waves, 1e-9) << waves << " " << phase;
            EXPECT_GT(wave.share, 0.9) << waves << " " << phase;
        }
    }
}

// The larger wave is three bins long and the other one six; only waves of at least four bins count.
TEST(Spectrum, LeavesOutWavesThatBinsDoNotResolve) {
    Spectrum spectrum(30);
    std::vector<double> h;
    for (int j = 0; j < 30; ++j)
        h.push_back(std::cos(2 * pi * 5 * (j + 0.5) / 30) + 3 * std::cos(2 * pi * 10 * (j + 0.5) / 30));
    const DominantWave wave = spectrum.dominant(h, 30);
    EXPECT_NEAR(wave.wavelength, 6, 1e-12);
    EXPECT_NEAR(wave.share, 1.0 / 10, 1e-9);
}

TEST(Spectrum, OfAFlatSurfaceHasNoWave) {
    Spectrum spectrum(16);
    EXPECT_TRUE(std::isnan(spectrum.dominant(std::vector<double>(16, 0.5), 1).wavelength));
    Spectrum one(1);
    EXPECT_TRUE(std::isnan(one.dominant({0.5}, 1).wavelength));
}

// h(n, j) gives the height in bin j and period n, for eight periods.
Subharmonics shares_of(const std::function<double(int n, int j)>& h) {
    std::vector<std::vector<double>> surfaces(kComparedPeriods);
    std::vector<const std::vector<double>*> pointers;
    for (int n = 0; n < kComparedPeriods; ++n) {
        for (int j = 0; j < 64; ++j) surfaces[static_cast<std::size_t>(n)].push_back(h(n, j));
        pointers.push_back(&surfaces[static_cast<std::size_t>(n)]);
    }
    return subharmonics_of(pointers);
}

double wave(int j) {
    return std::cos(2 * pi * j / 16);
}

TEST(Subharmonics, TellWavesAtHalfAndQuarterFromAHeap) {
    const Subharmonics half = shares_of([](int n, int j) { return 5 + (n % 2 ? -1 : 1) * wave(j); });
    EXPECT_NEAR(half.half, 1, 1e-12);
    EXPECT_NEAR(half.quarter, 0, 1e-12);
    // The wave stands: up, flat, down, flat. In the second series one pattern follows another.
    const Subharmonics standing = shares_of([](int n, int j) { return 5 + std::cos(pi * n / 2) * wave(j); });
    EXPECT_NEAR(standing.quarter, 1, 1e-12);
    EXPECT_NEAR(standing.half, 0, 1e-12);
    const Subharmonics turning =
        shares_of([](int n, int j) { return std::cos(2 * pi * j / 16 + pi * n / 2); });
    EXPECT_NEAR(turning.quarter, 1, 1e-12);
    const Subharmonics heap =
        shares_of([](int n, int j) { return n + wave(j); });  // the mean height does not matter
    EXPECT_NEAR(heap.half, 0, 1e-12);
    EXPECT_NEAR(heap.quarter, 0, 1e-12);
}

// A heap of amplitude 2 carries waves of amplitude 1; shares are in proportion to squares.
TEST(Subharmonics, ShareTheVariance) {
    const Subharmonics mixed =
        shares_of([](int n, int j) { return 2 * wave(j) + (n % 2 ? -1 : 1) * std::sin(2 * pi * j / 8); });
    EXPECT_NEAR(mixed.half, 1.0 / (1 + 4), 1e-12);
}

// There are 64 bins and 8 periods of noise: a share of 1/8 scatters by about sqrt(2 / 64) of itself.
TEST(Subharmonics, OfNoiseAreThoseOfChance) {
    Random random(4, Stream::centres);
    const Subharmonics noise = shares_of([&](int, int) { return random.normal(); });
    EXPECT_NEAR(noise.half, 1.0 / 8, 4.0 / 8 * std::sqrt(2.0 / 64));
    EXPECT_NEAR(noise.quarter, 1.0 / 4, 4.0 / 4 * std::sqrt(1.0 / 64));
}

TEST(Subharmonics, OfFlatSurfacesAreUndefined) {
    EXPECT_TRUE(std::isnan(shares_of([](int, int) { return 0.5; }).half));
}

BedOutline made(std::size_t bins, double width, const std::function<double(double)>& h) {
    BedOutline s{-0.5 * width, width / static_cast<double>(bins), {}};
    for (std::size_t i = 0; i < bins; ++i)
        s.height.push_back(h(-0.5 * width + s.bin * (static_cast<double>(i) + 0.5)));
    return s;
}

TEST(Mound, OfATentHasItsSlope) {
    for (const std::size_t bins : {24u, 25u}) {
        const Mound mound = mound_of(made(bins, 0.12, [](double y) { return 0.05 - 0.3 * std::abs(y); }));
        EXPECT_NEAR(mound.slope, 0.3, 1e-12);
        EXPECT_NEAR(mound.tilt, 0, 1e-12);
        const double slack = bins == 24 ? 1e-12 : 1e-4;  // zones of 24 bins are whole bins
        EXPECT_NEAR(mound.height, 0.3 * 0.12 / 3, slack);
    }
}

// Seven bins rise as 1, 2 and 4 towards the middle one, which belongs to neither half. Slopes are those of
// three bins each, (4 - 1) / 2.
TEST(Mound, LeavesTheMiddleBinOut) {
    BedOutline s{0, 1, {1, 2, 4, 9, 4, 2, 1}};
    EXPECT_NEAR(mound_of(s).slope, 1.5, 1e-12);
}

TEST(Mound, OfAPlaneIsTiltAlone) {
    const Mound mound = mound_of(made(24, 0.12, [](double y) { return 0.05 + 0.2 * y; }));
    EXPECT_NEAR(mound.tilt, 0.2, 1e-12);
    EXPECT_NEAR(mound.slope, 0, 1e-12);
    EXPECT_NEAR(mound.height, 0, 1e-12);
}

TEST(Mound, NeedsSixBins) {
    EXPECT_TRUE(std::isnan(mound_of(made(5, 0.1, [](double) { return 1; })).height));
}

}  // namespace
}  // namespace grainreel
