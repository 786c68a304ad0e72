// Tests of the bed in the page, read back in the form that page_bed.hpp describes.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <libdeflate.h>

#include <cmath>
#include <cstring>
#include <map>
#include <memory>
#include <random>

#include "engine/state/container_faces.hpp"
#include "render/page/bed/page_bed.hpp"
#include "render/scene/filmed_scene.hpp"

namespace grainreel {
namespace {

constexpr double period = 0.05;  // s, between two moments

// An archive in memory.
class MadeRun final : public StateArchive {
  public:
    explicit MadeRun(std::vector<State> frames) : frames_(std::move(frames)) {
        for (const State& frame : frames_) {
            State moment;
            moment.time = frame.time;
            moment.step = frame.step;
            moments_.push_back(moment);
        }
    }
    const std::filesystem::path& path() const override { return folder_; }
    const StoredWorld& world() const override { return world_; }
    StateSupply supply() const override { return {}; }
    const std::vector<State>& moments() const override { return moments_; }
    State grains(std::size_t index) const override { return frames_[index]; }

  private:
    std::filesystem::path folder_;
    StoredWorld world_;
    std::vector<State> frames_, moments_;
};

// Grains lie anywhere in a box of 0.2 m, with speeds over five decades.
std::vector<State> random_frames(std::size_t moments, std::int32_t grains) {
    std::mt19937 random(7);
    std::uniform_real_distribution<double> place(-0.1, 0.1), decade(-5, 0);
    std::vector<State> frames(moments);
    for (std::size_t k = 0; k < moments; ++k) {
        frames[k].time = period * static_cast<double>(k);
        for (std::int32_t id = 0; id < grains; ++id) {
            frames[k].id.push_back(10 * id);
            frames[k].species.push_back(id % 3);
            frames[k].radius.push_back(1e-3 * (1 + id));
            frames[k].position.emplace_back(place(random), 0.5 * place(random), 0.1 + place(random));
            frames[k].velocity.emplace_back(0, std::pow(10, decade(random)), 0);
        }
    }
    return frames;
}

struct Grain {
    int species = 0;
    float radius = 0;
    bool present = false;
    std::array<int, 3> number{};
    int speed = 0, contacts = 0, film = 0;
};

// The grains of each moment by their ids.
std::vector<std::map<int, Grain>> read_back(const PageBed& bed) {
    const std::size_t n = bed.grains, k = bed.moments.size();
    const std::size_t each = bed.has_film_colours ? 10 : 9;
    std::vector<std::uint8_t> bytes(10 * n + each * n * k);
    const std::unique_ptr<libdeflate_decompressor, decltype(&libdeflate_free_decompressor)> unpacker(
        libdeflate_alloc_decompressor(), libdeflate_free_decompressor);
    // Null stands for the size: there must be exactly so many bytes.
    EXPECT_EQ(libdeflate_zlib_decompress(unpacker.get(), bed.packed.data(), bed.packed.size(), bytes.data(),
                                         bytes.size(), nullptr),
              LIBDEFLATE_SUCCESS);
    std::vector<std::map<int, Grain>> moments;
    std::vector<Grain> now(n);
    std::vector<int> ids(n);
    for (std::size_t i = 0; i < n; ++i) {
        std::int32_t id;
        std::uint16_t species;
        std::memcpy(&id, &bytes[4 * i], 4);
        std::memcpy(&species, &bytes[4 * n + 2 * i], 2);
        std::memcpy(&now[i].radius, &bytes[6 * n + 4 * i], 4);
        ids[i] = id;
        now[i].species = species;
    }
    for (std::size_t frame = 0; frame < k; ++frame) {
        const std::uint8_t* at = &bytes[10 * n + each * n * frame];
        std::map<int, Grain> moment;
        for (std::size_t i = 0; i < n; ++i) {
            for (std::size_t axis = 0; axis < 3; ++axis) {
                const int zigzag = at[2 * axis * n + i] + 256 * at[(2 * axis + 1) * n + i];
                const int change = zigzag % 2 == 0 ? zigzag / 2 : -(zigzag + 1) / 2;
                now[i].number[axis] = (now[i].number[axis] + change) & 0xffff;
            }
            now[i].speed = at[6 * n + i];
            now[i].contacts = at[7 * n + i];
            now[i].present = at[8 * n + i] == 1;
            now[i].film = bed.has_film_colours ? at[9 * n + i] : 0;
            moment[ids[i]] = now[i];
        }
        moments.push_back(moment);
    }
    return moments;
}

constexpr std::size_t plenty = 100'000'000;  // bytes

TEST(PageBed, PlacesAreWithinTheStatedErrorForEveryGrainOfTenMoments) {
    const std::vector<State> frames = random_frames(10, 200);
    const PageBed bed = page_bed(MadeRun(frames), plenty);
    ASSERT_EQ(bed.moments.size(), 10u);
    const auto read = read_back(bed);
    const Vec3 most = bed.error() * (1 + 1e-9);
    EXPECT_LT(most.maxCoeff(), 0.2 / 65535);
    for (std::size_t k = 0; k < 10; ++k)
        for (std::size_t i = 0; i < 200; ++i) {
            const Grain& grain = read[k].at(frames[k].id[i]);
            EXPECT_TRUE(grain.present);
            EXPECT_EQ(grain.species, frames[k].species[i]);
            EXPECT_EQ(grain.radius, static_cast<float>(frames[k].radius[i]));
            for (int axis = 0; axis < 3; ++axis) {
                const double place =
                    bed.low[axis] + grain.number[axis] * (bed.high[axis] - bed.low[axis]) / 65535;
                EXPECT_NEAR(place, frames[k].position[i][axis], most[axis]);
            }
        }
}

// Bytes are even in the logarithm: half a step of (1e5)^(1/253) is 2.3 %.
TEST(PageBed, SpeedsAreWithinTheStatedError) {
    const double step = std::pow(1e5, 1 / 253.0);
    EXPECT_LT(std::sqrt(step) - 1, 0.0231);
    for (double speed = 1e-5; speed <= 1; speed *= 1.07) {
        const int byte = speed_byte(speed, 1e-5, 1);
        ASSERT_GE(byte, 1);
        EXPECT_LE(byte, 254);
        const double told = 1e-5 * std::pow(1e5, (byte - 1) / 253.0);
        EXPECT_LE(std::max(told / speed, speed / told), std::sqrt(step) * (1 + 1e-9));
    }
    EXPECT_EQ(speed_byte(0.99e-5, 1e-5, 1), 0);
    EXPECT_EQ(speed_byte(0, 0, 0), 0);  // nothing moved at any moment
}

TEST(BedFrames, ASpeedThatIsNotKnownHasAByteOfItsOwn) {
    std::vector<State> frames = random_frames(2, 20);
    frames[1].velocity[4].y() = std::nan("");
    const PageBed bed = bed_frames(MadeRun(frames), plenty);
    EXPECT_TRUE(std::isfinite(bed.highest_speed));
    const auto read = read_back(bed);
    EXPECT_EQ(read[1].at(frames[1].id[4]).speed, kUnknownSpeed);
    EXPECT_LT(read[0].at(frames[0].id[4]).speed, kUnknownSpeed);
}

// The scale of all moments follows the fastest grain of all, which is in the first moment here.
TEST(PageBed, SpeedsAreByTheFastestGrainOfAllMoments) {
    std::vector<State> frames = random_frames(3, 20);
    frames[0].velocity[4] = Vec3(3, 0, 4);
    const PageBed bed = page_bed(MadeRun(frames), plenty);
    EXPECT_EQ(bed.highest_speed, 5);
    const auto read = read_back(bed);
    for (std::size_t k = 0; k < 3; ++k)
        for (std::size_t i = 0; i < 20; ++i)
            EXPECT_EQ(read[k].at(frames[k].id[i]).speed,
                      speed_byte(frames[k].velocity[i].norm(), 5 / 1e5, 5));
}

TEST(PageBed, GrainsThatComeAndGoAreAbsentMeanwhile) {
    std::vector<State> frames = random_frames(3, 2);
    const auto take_out = [](State& frame, std::size_t i) {
        const auto at = static_cast<std::ptrdiff_t>(i);
        frame.id.erase(frame.id.begin() + at);
        frame.species.erase(frame.species.begin() + at);
        frame.radius.erase(frame.radius.begin() + at);
        frame.position.erase(frame.position.begin() + at);
        frame.velocity.erase(frame.velocity.begin() + at);
    };
    take_out(frames[0], 1);
    take_out(frames[2], 0);
    const PageBed bed = page_bed(MadeRun(frames), plenty);
    ASSERT_EQ(bed.grains, 2u);
    const auto read = read_back(bed);
    EXPECT_TRUE(read[0].at(0).present && read[1].at(0).present && read[1].at(10).present &&
                read[2].at(10).present);
    EXPECT_FALSE(read[0].at(10).present || read[2].at(0).present);
}

// Frames have no contact numbers, like those of earlier versions.
TEST(PageBed, ContactsAreThoseThatPushWallsIncluded) {
    const std::vector<State> frames = random_frames(2, 3);
    PageContacts contacts;
    contacts.touches = [](std::size_t index) -> std::optional<std::vector<Link>> {
        if (index == 1) return std::nullopt;
        return std::vector<Link>{{0, 10, 0.5}, {10, -1, 0.25}, {10, 20, 0.0}};
    };
    const PageBed bed = page_bed(MadeRun(frames), plenty, kNoPageProgress, contacts);
    EXPECT_EQ(bed.counted, 1u);
    const auto read = read_back(bed);
    EXPECT_EQ(read[0].at(0).contacts, 1);
    EXPECT_EQ(read[0].at(10).contacts, 2);
    EXPECT_EQ(read[0].at(20).contacts, 0);
    EXPECT_EQ(read[1].at(10).contacts, 255);  // not known
}

TEST(PageBed, ContactNumbersOfTheFramesAreTaken) {
    std::vector<State> frames = random_frames(1, 3);
    frames[0].contact_number = {7, 0, 300};
    const PageBed bed = page_bed(MadeRun(frames), plenty);
    EXPECT_EQ(bed.counted, 1u);
    const auto read = read_back(bed);
    EXPECT_EQ(read[0].at(0).contacts, 7);
    EXPECT_EQ(read[0].at(10).contacts, 0);
    EXPECT_EQ(read[0].at(20).contacts, 254);  // the largest number that a byte can express
}

TEST(PageBed, KeyMomentsAreThereWithTheirPairsWhateverElseIsLeftOut) {
    const std::vector<State> frames = random_frames(101, 300);
    PageContacts contacts;
    contacts.keys = {3, 50, 77};
    contacts.touches = [](std::size_t index) -> std::optional<std::vector<Link>> {
        return std::vector<Link>{{0, 10, 0.5 + static_cast<double>(index)}, {2990, -2, 0.25}, {0, 5, 1.0}};
    };
    const std::size_t all = page_bed(MadeRun(frames), plenty).packed.size();
    const PageBed bed = page_bed(MadeRun(frames), all / 8, kNoPageProgress, contacts);
    EXPECT_LE(bed.bytes(), all / 8);
    EXPECT_LT(bed.moments.size(), 20u);
    ASSERT_EQ(bed.forces.moments.size(), 3u);
    for (std::size_t k = 0; k < 3; ++k) {
        EXPECT_EQ(bed.moments[bed.forces.moments[k].moment].time, frames[contacts.keys[k]].time);
        EXPECT_EQ(bed.forces.moments[k].pairs, 2u);  // no grain has the id 5
    }
    EXPECT_EQ(bed.forces.highest, 77.5);
}

TEST(PageBed, KeepsEvenlySpreadMomentsThatFitFirstAndLastAmongThem) {
    const std::vector<State> frames = random_frames(101, 300);
    const std::size_t all = page_bed(MadeRun(frames), plenty).packed.size();
    const PageBed bed = page_bed(MadeRun(frames), all / 4);
    EXPECT_LE(bed.packed.size(), all / 4);
    EXPECT_EQ(bed.all_moments, 101u);
    ASSERT_GT(bed.moments.size(), 15u);
    EXPECT_EQ(bed.moments.front().time, 0);
    EXPECT_EQ(bed.moments.back().time, frames.back().time);
    const double mean = frames.back().time / static_cast<double>(bed.moments.size() - 1);
    for (std::size_t k = 1; k < bed.moments.size(); ++k)
        EXPECT_NEAR(bed.moments[k].time - bed.moments[k - 1].time, mean, period);
    EXPECT_EQ(page_bed(MadeRun(frames), 1).moments.size(), 1u);
}

// A byte covers the film's range, and bands have the byte of their middle. A grain that was not there at the
// film's start has 0.
TEST(PageBed, HaveTheFilmsColours) {
    std::vector<State> frames = random_frames(3, 40);
    frames[2].id.push_back(1000);
    frames[2].species.push_back(0);
    frames[2].radius.push_back(1e-3);
    frames[2].position.emplace_back(0, 0, 0.1);
    frames[2].velocity.emplace_back(0, 0.3, 0);
    const MadeRun run(frames);
    const auto bytes_of = [&](GrainValue by, double high, double start) {
        FilmedScene scene;
        scene.film.shows.colour.by = by;
        scene.film.shows.colour.range = {0, high};
        scene.film.shows.colour.layers = 4;
        FilmColours film(scene, run, Clock(), start);
        PageContacts beside;
        beside.film = &film;
        return read_back(page_bed(run, plenty, kNoPageProgress, beside));
    };
    const auto speeds = bytes_of(GrainValue::speed, 0.5, 0),
               heights = bytes_of(GrainValue::start_height, 0.2, period);
    for (std::size_t k = 0; k < 3; ++k)
        for (std::size_t i = 0; i < frames[k].size(); ++i) {
            const int id = frames[k].id[i];
            const double share = std::min(1.0, frames[k].velocity[i].norm() / 0.5);
            EXPECT_EQ(speeds[k].at(id).film, 1 + std::lround(254 * share)) << k << " " << id;
            if (id == 1000) {
                EXPECT_EQ(heights[k].at(id).film, 0);
                continue;
            }
            const double at_start = frames[1].position[i].z();  // the film begins at the second moment
            const double band = std::clamp(std::floor(4 * at_start / 0.2), 0.0, 3.0);
            EXPECT_EQ(heights[k].at(id).film, 1 + std::lround(254 * (band + 0.5) / 4)) << k << " " << id;
        }
}

// On a logarithmic scale equal ratios have equal distances, as on the film's colour bar.
TEST(PageBed, HaveTheColoursOfALogarithmicScale) {
    const std::vector<State> frames = random_frames(2, 40);
    FilmedScene scene;
    scene.film.shows.colour.by = GrainValue::speed;
    scene.film.shows.colour.range = {0.001, 0.5};
    scene.film.shows.colour.logarithmic = true;
    const MadeRun run(frames);
    FilmColours film(scene, run, Clock(), 0);
    PageContacts beside;
    beside.film = &film;
    const auto read = read_back(page_bed(run, plenty, kNoPageProgress, beside));
    for (std::size_t k = 0; k < frames.size(); ++k)
        for (std::size_t i = 0; i < frames[k].size(); ++i) {
            const double share = std::log(frames[k].velocity[i].norm() / 0.001) / std::log(500);
            EXPECT_EQ(read[k].at(frames[k].id[i]).film, 1 + std::lround(254 * std::clamp(share, 0.0, 1.0)))
                << k << " " << i;
        }
}

// The displacement of a grain since a moment a period earlier, if there is such a moment.
TEST(PageBed, HaveWaysOverAPeriodWhereTheMomentBeforeIsKept) {
    std::vector<State> frames = random_frames(3, 5);
    FilmedScene scene;
    scene.drive.present = true;
    scene.drive.frequency = 1 / period;
    scene.film.shows.colour.by = GrainValue::displacement;
    scene.film.shows.colour.range = {0, 0.4};
    Clock clock;
    clock.step = period / 100;
    clock.steps_per_period = 100;
    for (std::size_t k = 0; k < 3; ++k) frames[k].step = static_cast<std::int64_t>(100 * k);
    const MadeRun run(frames);
    FilmColours film(scene, run, clock, 0);
    PageContacts beside;
    beside.film = &film;
    const PageBed bed = page_bed(run, plenty, kNoPageProgress, beside);
    EXPECT_EQ(bed.film_coloured, 2u);
    const auto read = read_back(bed);
    for (std::size_t i = 0; i < 5; ++i) {
        const int id = frames[0].id[i];
        EXPECT_EQ(read[0].at(id).film, 0);
        const double way = (frames[2].position[i] - frames[1].position[i]).norm();
        EXPECT_EQ(read[2].at(id).film, 1 + std::lround(254 * std::min(1.0, way / 0.4)));
    }
}

TEST(PageBed, OfTooManyGrainsThoseNearestToTheMiddleAreKept) {
    const auto extra = static_cast<std::int32_t>(kMostGrainsOnPage) + 50;
    std::vector<State> frames(1);
    for (std::int32_t id = 0; id < extra; ++id) {
        frames[0].id.push_back(id);
        frames[0].species.push_back(0);
        frames[0].radius.push_back(1e-3);
        frames[0].position.emplace_back((id % 2 ? 1 : -1) * (extra - id), 0,
                                        0);  // the grains that come last are nearest
        frames[0].velocity.emplace_back(0, 0, 0);
    }
    const PageBed bed = page_bed(MadeRun(frames), plenty);
    EXPECT_EQ(bed.grains, kMostGrainsOnPage);
    EXPECT_EQ(bed.all_grains, static_cast<std::size_t>(extra));
    const auto read = read_back(bed);
    EXPECT_EQ(read[0].begin()->first, 50);
    EXPECT_EQ(read[0].rbegin()->first, extra - 1);
}

}  // namespace
}  // namespace grainreel
