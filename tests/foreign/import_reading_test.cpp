// Tests of how an import reads: each byte once for the index and once for the run, and a second time for the
// run only where the first frame did not say all that files depend on.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <filesystem>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "engine/base/error.hpp"
#include "engine/run/import/import_run.hpp"
#include "tests/cli/small_disk.hpp"
#include "tests/foreign/dumps/dump_files.hpp"
#include "tests/support/tells.hpp"
#include "tests/support/temporary_folder.hpp"

namespace grainreel {
namespace {

namespace fs = std::filesystem;
using test::SmallDisk;
using test::TemporaryFolder;
using test::write_old_text;
using testing::HasSubstr;

// A dump of a bed of two types. radius: of the grain with id 1 in a frame, in mm. unused: number of columns
// that an import does not need.
std::string bed_dump(int frames, int grains, double (*radius)(int frame), int unused = 0,
                     bool velocities = true) {
    std::string names = velocities ? "id type x y z radius vx vy vz" : "id type x y z radius", filling, text;
    for (int k = 0; k < unused; ++k) {
        names += fmt::format(" c_{}", k);
        filling += " 0.12345";
    }
    for (int k = 0; k < frames; ++k) {
        std::string rows;
        for (int i = 1; i <= grains; ++i)
            rows +=
                fmt::format("{} {} {} {} {} {}{}{}\n", i, 1 + i % 2, 0.01 * (i % 10), 0.01 * (i / 10 % 10),
                            0.01 * (i / 100) + 0.0001 * k, i == 1 ? 1e-3 * radius(k) : 0.004,
                            velocities ? " 0.012345 -0.023456 0.5" : "", filling);
        text += frame_text(std::to_string(10 * k), std::to_string(grains), names, rows);
    }
    return text;
}

double constant(int) {
    return 4;
}
double growing(int frame) {
    return 4 + frame;
}

ImportRequest request_of(const fs::path& dump, const fs::path& folder) {
    ImportRequest request;
    request.from = dump;
    request.folder = folder;
    request.reading.time_step = 1e-4;
    request.program_version = "test";
    return request;
}

// Bytes that an import of this dump asks the system for, divided by its size. NetCDF reads what it has
// written, so a grain has a thousand columns: then trajectory.nc is small beside the dump.
constexpr int kUnused = 1000;
double bytes_for_each(const std::string& text) {
    const TemporaryFolder folder;
    write_old_text(folder / "bed.dump", text);
    const std::int64_t before = bytes_read();
    import_run(request_of(folder / "bed.dump", folder / "run"));
    return static_cast<double>(bytes_read() - before) / static_cast<double>(text.size());
}

TEST(ImportReads, ADumpOfManyFramesTwice) {
    const std::string text = bed_dump(40, 30, constant, kUnused);
    ASSERT_GT(text.size(), 9'400'000u);
    EXPECT_LT(bytes_for_each(text), 2.1);
}

TEST(ImportReads, ADumpOfFewFramesTwice) {
    const std::string text = bed_dump(3, 260, constant, kUnused);
    ASSERT_GT(text.size(), 6'200'000u);
    EXPECT_LT(bytes_for_each(text), 2.1);
}

// Each frame gets its velocities from both of its neighbours. Whether they can be had is found out from two
// frames in the middle, and the reader's buffer goes on to others.
TEST(ImportReads, ADumpWithoutVelocitiesTwice) {
    EXPECT_LT(bytes_for_each(bed_dump(40, 30, constant, kUnused, false)), 2.3);
}

TEST(ImportReads, ADumpWhoseSizesWidenThreeTimes) {
    EXPECT_LT(bytes_for_each(bed_dump(40, 30, growing, kUnused)), 3.1);
}

// The first reading gives up its files with the second frame; then the second one fills the disk.
TEST(ImportReads, ADiskThatIsFullInTheSecondReadingLeavesNothing) {
    const TemporaryFolder folder;
    write_old_text(folder / "bed.dump", bed_dump(20, 1000, growing));
    fs::create_directory(folder / "disk");
    constexpr std::size_t room = 300'000;  // bytes; a frame of the trajectory takes 100,000
    const SmallDisk disk(folder / "disk", room);
    if (!disk.mounted()) GTEST_SKIP() << "mounting is not allowed here";
    try {
        import_run(request_of(folder / "bed.dump", folder / "disk/run"));
        ADD_FAILURE() << "it was imported";
    } catch (const RunError& why) {
        EXPECT_THAT(why.what(), HasSubstr("run/"));
    }
    EXPECT_FALSE(fs::exists(folder / "disk/run"));
}

// The share that is done begins anew with the second reading.
TEST(ImportReads, TheWatcherSeesBothReadings) {
    for (const bool twice : {false, true}) {
        const TemporaryFolder folder;
        write_old_text(folder / "bed.dump", bed_dump(4, 10, twice ? growing : constant));
        ImportRequest request = request_of(folder / "bed.dump", folder / "run");
        std::vector<double> shares;
        request.watcher = [&](double done) {
            shares.push_back(done);
            return true;
        };
        import_run(request);
        const std::vector<double> once{0, 0.25, 0.5, 0.75};
        std::vector<double> wanted = once;
        if (twice) wanted.insert(wanted.end(), once.begin(), once.end());
        EXPECT_EQ(shares, wanted);
    }
}

TEST(ImportReads, AWatcherThatStopsItLeavesNothing) {
    const TemporaryFolder folder;
    write_old_text(folder / "bed.dump", bed_dump(4, 10, constant));
    ImportRequest request = request_of(folder / "bed.dump", folder / "run");
    request.watcher = [](double done) { return done < 0.5; };
    EXPECT_THROW(import_run(request), RunError);
    EXPECT_FALSE(fs::exists(folder / "run"));
}

// A dump of pairs of ids, as `dump local` writes it.
std::string pairs_dump(int step, const std::vector<std::array<int, 2>>& pairs) {
    std::string text = fmt::format(
        "ITEM: TIMESTEP\n{}\nITEM: NUMBER OF ENTRIES\n{}\nITEM: BOX BOUNDS ff ff ff\n0 1\n0 1\n0 1\n"
        "ITEM: ENTRIES id1 id2 force\n",
        step, pairs.size());
    for (const auto& [first, second] : pairs) text += fmt::format("{} {} 1\n", first, second);
    return text;
}

std::vector<std::string> news_with_contacts(const std::string& contacts) {
    const TemporaryFolder folder;
    // Grains 1 to 10 stand in a row, 10 mm apart, with radii of 4 mm (grain 1) and 4 mm: none of them touch.
    // So grain 1 gets 20 mm, and touches 2 and 3.
    write_old_text(folder / "bed.dump", bed_dump(2, 10, [](int) { return 20.0; }));
    write_old_text(folder / "pairs.dump", contacts);
    ImportRequest request = request_of(folder / "bed.dump", folder / "run");
    request.reading.contacts = {(folder / "pairs.dump").string()};
    return import_run(request).news;
}

TEST(ImportTells, WhichContactsItLeavesOut) {
    using test::tells;
    const std::vector<std::string> all =
        news_with_contacts(pairs_dump(0, {{1, 2}}) + pairs_dump(10, {{1, 2}}));
    EXPECT_THAT(all, testing::Not(testing::Contains(HasSubstr("contacts"))));
    const std::vector<std::string> some =
        news_with_contacts(pairs_dump(0, {{1, 2}, {1, 77}}) + pairs_dump(10, {{1, 3}, {4, 8}, {-1, -2}}));
    EXPECT_THAT(some, testing::Contains(tells({"bed.dump", "3 of 5 contacts", "1 with a grain", "1 of grains",
                                               "1 between walls"})));
}

TEST(ImportTells, WhichFramesHaveNoContacts) {
    EXPECT_THAT(news_with_contacts(pairs_dump(10, {{1, 2}})),
                testing::Contains(test::tells({"pairs.dump", "1 of the 2 frames"})));
    EXPECT_THAT(news_with_contacts(pairs_dump(7, {{1, 2}})),
                testing::Contains(test::tells({"pairs.dump", "left out"})));
}

TEST(ImportTells, ThatABoxChanges) {
    const TemporaryFolder folder;
    const std::string names = "id type x y z radius vx vy vz", row = "1 1 0.5 0.5 0.5 0.1 0 0 0\n";
    std::string text = frame_text("0", "1", names, row);
    const std::string same = text + frame_text("10", "1", names, row);
    write_old_text(folder / "bed.dump", same);
    const auto is_told = testing::Contains(test::tells({"box changes", "at first"}));
    EXPECT_THAT(import_run(request_of(folder / "bed.dump", folder / "a")).news, testing::Not(is_told));
    const std::size_t bounds = same.rfind("ITEM: BOX BOUNDS");
    const std::size_t line = same.find('\n', bounds) + 1;
    write_old_text(folder / "bed.dump",
                   same.substr(0, line) + "-0.5 7\n" + same.substr(same.find('\n', line) + 1));
    EXPECT_THAT(import_run(request_of(folder / "bed.dump", folder / "b")).news, is_told);
}

}  // namespace
}  // namespace grainreel
