// Tests of packings that are kept: a run that begins with a kept packing is the same, to the bit, as a run
// that packs by itself. A file that is no packing of this start is never used.
#include <fcntl.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <fmt/format.h>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <optional>

#include "engine/files/folder_lock.hpp"
#include "engine/measure/columns.hpp"
#include "engine/run/driver/packing_cache.hpp"
#include "engine/run/driver/run_driver.hpp"
#include "engine/run/simulation/simulated_bed.hpp"
#include "engine/scene/scene_file.hpp"
#include "render/app/options/cli.hpp"
#include "render/app/options/option_groups.hpp"
#include "tests/cli/program.hpp"
#include "tests/cli/small_disk.hpp"
#include "tests/support/small_scene.hpp"
#include "tests/support/tells.hpp"
#include "tests/support/temporary_folder.hpp"

namespace grainreel {
namespace {

namespace fs = std::filesystem;
using namespace test;
using testing::HasSubstr;
using testing::Not;

// ---- the engine

Scene scene_with(std::vector<std::string> sets, const std::string& more = "") {
    sets.insert(sets.begin(), "start.settle_limit=0.05 s");
    Assignments all;
    for (const std::string& set : sets) all.push_back({set, "--set " + set});
    return read_scene_text(small_scene_text + more, "fifty.toml", all, measurable_in);
}

constexpr const char* kFeed =
    "[[feed]]\nspecies = \"small\"\nrate = 400\ncount = 20\n"
    "low = [-0.004, -0.006, 0.032]\nhigh = [0.004, 0.006, 0.036]\n";

struct Variant {
    const char* name;
    std::vector<std::string> sets;
    const char* more = "";
};

const Variant variants[] = {
    {"layers", {}},
    {"rain", {"start.method=rain"}},
    {"phase", {"drive.phase=0.25", "drive.ramp=0"}},
    {"orientations", {"output.orientation=true", "output.contacts=true"}},
    {"walls", {"output.instruments=[\"walls\", \"energy_balance\", \"bed\"]"}},
    {"periodic", {"container.periodic_depth=true"}},
    {"glued", {"container.wall_grains.faces=[\"floor\"]", "container.wall_grains.species=small"}},
    {"mixed", {"run.precision=mixed"}},
    {"gear", {"run.integrator=gear"}},
    {"fed", {"run.duration=0.1 s"}, kFeed},
};

struct End {
    std::uint64_t state;
    std::vector<std::string> measures;  // the columns with every digit, as in measures.csv
    bool operator==(const End&) const = default;
};

End end_of(SimulatedBed& run, std::int64_t steps) {
    run.advance(steps);
    End end{run.state_hash(), {}};
    const std::vector<double> values = run.measures().values();
    for (std::size_t k = 0; k < values.size(); ++k)
        end.measures.push_back(
            fmt::format("{} {}", run.measured()[k], std::isnan(values[k]) ? 0.5 : values[k]));
    return end;
}

TEST(KeptPacking, RunsOnBitByBit) {
    const TemporaryFolder here;
    for (const Variant& variant : variants) {
        const Scene scene = scene_with(variant.sets, variant.more);
        const Plan plan = make_plan(scene);
        SimulatedBed packs(scene, plan, 1);
        const std::string key = packs.packing_key();
        ASSERT_FALSE(key.empty()) << variant.name;
        const PackingResult result = packs.pack();
        const fs::path file = here / (std::string(variant.name) + ".grs");
        packs.save_packing(file, key, result);
        const std::uint64_t start = packs.state_hash();
        const End end = end_of(packs, 300);
        for (const int threads : {1, 2, 3}) {
            PackingResult found;
            auto takes = SimulatedBed::with_packing(scene, plan, file, key, threads, found);
            ASSERT_TRUE(takes) << variant.name;
            EXPECT_EQ(takes->step(), 0);
            EXPECT_EQ(takes->state_hash(), start) << variant.name;
            const End there = end_of(*takes, 300);
            EXPECT_EQ(there.state, end.state) << variant.name << " at " << threads << " threads";
            EXPECT_EQ(there.measures, end.measures) << variant.name << " at " << threads << " threads";
            EXPECT_EQ(found.settle_time, result.settle_time);
            EXPECT_EQ(found.solid_fraction, result.solid_fraction);
            EXPECT_EQ(found.settled, result.settled);
        }
    }
}

std::string key_with(std::vector<std::string> sets) {
    const Scene scene = scene_with(std::move(sets));
    return SimulatedBed(scene, make_plan(scene), 1).packing_key();
}

TEST(KeptPacking, IsTheSameWhateverTheRunShowsAndHowLongItIs) {
    const std::string key = key_with({});
    for (const char* set : {"run.duration=0.3 s", "film.size=320x240", "output.contacts=true", "title=Other",
                            "output.measures_interval=1 ms", "run.threads=2", "species.big.colour=red"})
        EXPECT_EQ(key_with({set}), key) << set;
}

TEST(KeptPacking, IsAnotherWhereAnythingDecidesIt) {
    const std::string key = key_with({});
    for (const char* set :
         {"run.seed=2", "species.small.count=41", "species.big.density=2600", "contact.friction=0.3",
          "contact.wall.friction=0.3", "container.width=31 mm", "gravity=9.7", "run.overlap=0.04",
          "run.precision=mixed", "run.integrator=leapfrog", "start.settle_limit=0.06 s",
          "start.settle_damping=20 1/s", "start.method=rain", "output.orientation=true",
          "contact.arms=radius", "drive.g_level=3", "drive.moves=floor", "run.step=1 us",
          "contact.rolling_friction=0.1"})
        EXPECT_NE(key_with({set}), key) << set;
}

// With rain nothing moves before step 0, so all drives of a study share one packing. If radii grow, the
// packing has the drive's first steps in it.
TEST(KeptPacking, IsSharedByDrivesWhereNothingOfThePackingFollowsThem) {
    const std::vector<std::string> given{"start.method=rain", "contact.stiffness=700 N/m", "run.step=5 us"};
    const auto key = [&](std::vector<std::string> sets, const std::string& more) {
        sets.push_back(more);
        return key_with(sets);
    };
    EXPECT_EQ(key(given, "drive.g_level=2"), key(given, "drive.g_level=4"));
    EXPECT_NE(key({"start.method=rain"}, "drive.g_level=2"), key({"start.method=rain"}, "drive.g_level=4"));
    EXPECT_NE(key({given[1], given[2]}, "drive.g_level=2"), key({given[1], given[2]}, "drive.g_level=4"));
    // The packing is the same, to the bit.
    const TemporaryFolder here;
    std::vector<std::string> two = given, four = given;
    two.emplace_back("drive.g_level=2"), four.emplace_back("drive.g_level=4");
    const Scene one = scene_with(two), other = scene_with(four);
    const Plan plan = make_plan(one), other_plan = make_plan(other);
    SimulatedBed packs(one, plan, 1), packs_too(other, other_plan, 1);
    const std::string both = packs.packing_key();
    packs.save_packing(here / "one.grs", both, packs.pack());
    packs_too.pack();
    PackingResult found;
    auto takes = SimulatedBed::with_packing(other, other_plan, here / "one.grs", both, 1, found);
    ASSERT_TRUE(takes);
    EXPECT_EQ(end_of(*takes, 300), end_of(packs_too, 300));
}

TEST(KeptPacking, IsNotOfWhatPacksNothing) {
    const Scene scene = read_scene_text(fed_scene_text, "fed.toml", {}, measurable_in);
    EXPECT_EQ(SimulatedBed(scene, make_plan(scene), 1).packing_key(), "");
}

TEST(KeptPacking, IsBelievedInNothing) {
    const TemporaryFolder here;
    const Scene scene = scene_with({});
    const Plan plan = make_plan(scene);
    SimulatedBed packs(scene, plan, 1);
    const std::string key = packs.packing_key();
    const fs::path file = here / "packing.grs";
    packs.save_packing(file, key, packs.pack());
    const std::string good = text_of(file);
    const auto is_taken = [&](const std::string& bytes, const std::string& under) {
        write_text(file, bytes);
        PackingResult found;
        return SimulatedBed::with_packing(scene, plan, file, under, 1, found).has_value();
    };
    EXPECT_TRUE(is_taken(good, key));
    EXPECT_FALSE(is_taken(good, key + " "));
    EXPECT_FALSE(is_taken("", key));
    for (std::size_t k = 0; k < 60; ++k) {
        std::string bad = good;
        bad[k * (good.size() - 1) / 59] ^= 0x10;
        EXPECT_FALSE(is_taken(bad, key)) << "byte " << k * (good.size() - 1) / 59;
        EXPECT_FALSE(is_taken(good.substr(0, k * good.size() / 60), key)) << k;
    }
    // A checkpoint of the same state is no packing.
    packs.save_checkpoint(file);
    EXPECT_FALSE(is_taken(text_of(file), key));
}

// ---- the program

// A variable of the environment of this process, until the end of a test.
class Variable {
  public:
    Variable(const char* name, const std::string& value) : name_(name) {
        if (const char* before = std::getenv(name)) before_ = before;
        ::setenv(name, value.c_str(), 1);
    }
    ~Variable() { before_ ? ::setenv(name_, before_->c_str(), 1) : ::unsetenv(name_); }
    Variable(const Variable&) = delete;
    Variable& operator=(const Variable&) = delete;

  private:
    const char* name_;
    std::optional<std::string> before_;
};

class PackingProgram : public testing::Test {
  protected:
    Program::Setting setting(const std::string& packings = "all") const {
        return {here.path(),
                {"XDG_CACHE_HOME=" + (here / "cache").string(), "GRAINREEL_PACKINGS=" + packings}};
    }
    Ended movie(const std::string& out, const std::vector<std::string>& more = {},
                const std::string& packings = "all") const {
        std::vector<std::string> words{"movie", scene.string(), "--no-film",           "--no-report", "--out",
                                       out,     "--set",        "output.contacts=true"};
        words.insert(words.end(), more.begin(), more.end());
        return run_program(words, setting(packings));
    }
    std::vector<fs::path> kept() const {
        std::vector<fs::path> files;
        std::error_code none;
        for (const auto& one : fs::directory_iterator(here / "cache/grainreel/packings", none))
            files.push_back(one.path());
        return files;
    }
    void expect_same(const std::string& one, const std::string& other) const {
        for (const char* file : {"trajectory.nc", "contacts.nc", "measures.csv", "final.csv"})
            EXPECT_EQ(text_of(here / one / file), text_of(here / other / file)) << other << "/" << file;
    }

    TemporaryFolder here;
    fs::path scene = write_small_scene(here.path());
};

constexpr const char* kFound = "took the packing of an earlier run";

TEST_F(PackingProgram, FindsThePackingAndTheRunIsTheSame) {
    const Ended first = movie("first"), second = movie("second"), third = movie("third", {"--no-cache"}),
                longer = movie("longer", {"--duration", "0.25 s", "--threads", "2"});
    ASSERT_EQ(first.status, 0) << first.err;
    ASSERT_EQ(second.status, 0) << second.err;
    EXPECT_THAT(first.err, Not(HasSubstr(kFound)));
    EXPECT_THAT(second.err, HasSubstr(kFound));
    EXPECT_THAT(third.err, Not(HasSubstr(kFound)));
    EXPECT_THAT(longer.err, HasSubstr(kFound));
    EXPECT_EQ(kept().size(), 1u);
    expect_same("first", "second");
    expect_same("first", "third");
}

// Packs in a folder of its own and keeps packings that take at least so long (s).
void pack_and_keep_from(double shortest, const fs::path& folder) {
    const Scene scene = scene_with({});
    fs::create_directory(folder);
    const FolderLock lock = std::move(*FolderLock::take(folder, "test"));
    RunDriver driver(scene, make_plan(scene), 1);
    driver.use_folder(lock, "test");
    driver.keep_packings(shortest);
    EXPECT_TRUE(driver.pack([](const PackingProgress&) { return true; }));
}

// How long a packing takes depends on the machine, so the limits here are below and above all times.
TEST_F(PackingProgram, KeepsOnlyWhatTakesAsLongAsTheLimit) {
    const Variable cache("XDG_CACHE_HOME", (here / "cache").string());
    constexpr double year = 3e7;
    pack_and_keep_from(year, here / "short");
    EXPECT_TRUE(kept().empty());
    pack_and_keep_from(0, here / "long");
    EXPECT_EQ(kept().size(), 1u);
}

TEST_F(PackingProgram, TheUsualLimitIsASecond) {
    const Variable packings("GRAINREEL_PACKINGS", "");
    CLI::App verb;
    std::optional<double> shortest;
    add_no_cache(verb, shortest);
    EXPECT_EQ(shortest, 1.0);
}

TEST_F(PackingProgram, KeepsNothingOfWhatIsNotWanted) {
    EXPECT_EQ(movie("off", {}, "off").status, 0);
    EXPECT_EQ(movie("not", {"--no-cache"}).status, 0);
    EXPECT_TRUE(kept().empty());
    const Ended wrong = movie("wrong", {}, "some");
    EXPECT_EQ(wrong.status, 2);
    EXPECT_THAT(wrong.err, tells({"GRAINREEL_PACKINGS=some", "neither off nor all"}));
}

TEST_F(PackingProgram, PacksAnewWhereTheKeptOneIsDamaged) {
    ASSERT_EQ(movie("first").status, 0);
    ASSERT_EQ(kept().size(), 1u);
    std::string bytes = text_of(kept().front());
    bytes[bytes.size() / 2] ^= 1;
    write_text(kept().front(), bytes);
    const Ended second = movie("second");
    EXPECT_EQ(second.status, 0) << second.err;
    EXPECT_THAT(second.err, Not(HasSubstr(kFound)));
    expect_same("first", "second");
    EXPECT_THAT(movie("third").err, HasSubstr(kFound));  // the damaged one was replaced
    expect_same("first", "third");
}

TEST_F(PackingProgram, RunsWhereNothingCanBeKept) {
    write_text(here / "cache", "a file in its place");
    const Ended ended = movie("run", {"--verbose"});
    EXPECT_EQ(ended.status, 0) << ended.err;
    EXPECT_THAT(ended.err, tells({"later runs", "not kept"}));
}

TEST_F(PackingProgram, RunsWithAFullCacheAndLeavesNothingThere) {
    fs::create_directory(here / "cache");
    const SmallDisk disk(here / "cache", 8192);
    if (!disk.mounted()) GTEST_SKIP() << "no small disk can be made here";
    const Ended full = movie("full", {"--verbose"});
    EXPECT_EQ(full.status, 0) << full.err;
    EXPECT_THAT(full.err, tells({"later runs", "not kept"}));
    EXPECT_THAT(full.err, HasSubstr("is the disk full?"));
    EXPECT_TRUE(kept().empty());
}

// A link could lead to any folder, and the oldest files there would be removed.
TEST_F(PackingProgram, KeepsAndRemovesNothingBehindALink) {
    const fs::path victim = here / "victim";
    fs::create_directory(victim);
    write_text(victim / "old.jpg", "a picture");
    fs::last_write_time(victim / "old.jpg", fs::file_time_type::clock::now() - std::chrono::hours(48));
    fs::create_directories(here / "cache/grainreel");
    fs::create_symlink(victim, here / "cache/grainreel/packings");
    const Ended ended = movie("run", {"--verbose"});
    EXPECT_EQ(ended.status, 0) << ended.err;
    EXPECT_THAT(ended.err, HasSubstr("packings: is a link"));
    EXPECT_TRUE(fs::exists(victim / "old.jpg"));
    EXPECT_EQ(std::distance(fs::directory_iterator(victim), fs::directory_iterator()), 1);
}

TEST_F(PackingProgram, RemovesNothingButPackings) {
    const fs::path packings = here / "cache/grainreel/packings";
    fs::create_directories(packings);
    const std::string left_over = "0123456789abcdef0123456789abcdef.grs.17-0.new";
    for (const std::string& name : {std::string("old.jpg"), left_over}) {
        write_text(packings / name, "old");
        fs::last_write_time(packings / name, fs::file_time_type::clock::now() - std::chrono::hours(48));
    }
    ASSERT_EQ(movie("run").status, 0);
    EXPECT_TRUE(fs::exists(packings / "old.jpg"));
    EXPECT_FALSE(fs::exists(packings / left_over));
    EXPECT_EQ(kept().size(), 2u);
}

TEST_F(PackingProgram, TwoRunsAtOnceBothKeepIt) {
    const std::vector<std::string> words{"movie", scene.string(),         "--no-film", "--no-report",
                                         "--set", "output.contacts=true", "--out"};
    auto with = [&](const char* out) {
        std::vector<std::string> all = words;
        all.emplace_back(out);
        return all;
    };
    Program one(with("one"), setting()), other(with("other"), setting());
    EXPECT_EQ(one.wait().status, 0);
    EXPECT_EQ(other.wait().status, 0);
    EXPECT_EQ(kept().size(), 1u);
    expect_same("one", "other");
    EXPECT_THAT(movie("third").err, HasSubstr(kFound));
    expect_same("one", "third");
}

TEST_F(PackingProgram, DoctorTellsTheSize) {
    ASSERT_EQ(movie("first").status, 0);
    EXPECT_THAT(run_program({"doctor"}, setting()).out, HasSubstr("1 kept for later runs, "));
}

TEST_F(PackingProgram, ComparisonsTakeIt) {
    const std::vector<std::string> words{"compare", scene.string(), "--size", "480x270",
                                         "--vary",  "run.seed=1,2", "--out"};
    auto with = [&](const char* out) {
        std::vector<std::string> all = words;
        all.emplace_back(out);
        return run_program(all, setting());
    };
    const Ended first = with("first"), second = with("second");
    ASSERT_EQ(first.status, 0) << first.err;
    ASSERT_EQ(second.status, 0) << second.err;
    EXPECT_THAT(first.err, Not(HasSubstr(kFound)));
    EXPECT_THAT(second.err, HasSubstr(kFound));
    EXPECT_EQ(kept().size(), 2u);
}

}  // namespace
}  // namespace grainreel
