// Files that belong together by their names: series, files of several processes, and files of different runs.
#include "engine/files/foreign/file_groups.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "engine/files/foreign/foreign_archive.hpp"
#include "tests/support/tells.hpp"
#include "tests/support/temporary_folder.hpp"

namespace grainreel {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

// A dump of grains with these ids. Each place tells step and id.
std::string frame_text(int step, const std::vector<int>& ids) {
    std::string text = fmt::format(
        "ITEM: TIMESTEP\n{}\nITEM: NUMBER OF ATOMS\n{}\nITEM: BOX BOUNDS ff ff ff\n0 9\n0 9\n0 9\n"
        "ITEM: ATOMS id type x y z radius\n",
        step, ids.size());
    for (const int id : ids) text += fmt::format("{} 1 {} 1 {} 0.1\n", id, id, 1e-3 * step);
    return text;
}

class FileGroups : public testing::Test {
  protected:
    void write(const std::string& name, const std::string& text) const { folder_.write(name, text); }
    ForeignArchive archive(const std::string& name) const { return {folder_ / name, {}}; }
    // The names of the files of a series, and the ids of all grains at its moments.
    void expect_whole(const std::string& name) const {
        SCOPED_TRACE(name);
        const ForeignArchive all(folder_ / name, {});
        ASSERT_EQ(all.moments().size(), 3u);
        for (std::size_t k = 0; k < 3; ++k) {
            const State frame = all.grains(k);
            EXPECT_THAT(frame.id, ElementsAre(1, 2, 3, 4));
            for (const Vec3& place : frame.position)
                EXPECT_DOUBLE_EQ(place.z(), 1e-3 * static_cast<double>(all.moments()[k].step));
            EXPECT_EQ(all.written_step(k), 100 * static_cast<int>(k));
        }
    }

    test::TemporaryFolder folder_;
};

// `dump ... d.dump.*.%` and `e.%.*.dump` of LAMMPS' manual, with two processes.
TEST_F(FileGroups, StepsAndProcessesInOneNameAreOneSeries) {
    for (const int step : {0, 100, 200})
        for (const int process : {0, 1}) {
            const std::string text = frame_text(step, process == 0 ? std::vector{4, 1} : std::vector{3, 2});
            write(fmt::format("d.dump.{}.{}", step, process), text);
            write(fmt::format("e.{}.{}.dump", process, step), text);
        }
    for (const char* name : {"d.dump.0.0", "d.dump.100.1", "d.dump.*", "d.dump.*.*", "e.0.0.dump",
                             "e.1.200.dump", "e.*.dump", "e.*.*.dump"})
        expect_whole(name);
    EXPECT_EQ(series_of(folder_ / "e.1.100.dump").pattern, (folder_ / "e.*.*.dump").string());
}

// With one process the last number of `d.dump.*.%` is always 0.
TEST_F(FileGroups, AStepThatIsNotTheLastNumberMakesASeries) {
    for (const int step : {0, 100, 200}) {
        write(fmt::format("d.dump.{}.0", step), frame_text(step, {1, 2, 3, 4}));
        write(fmt::format("bed2.{}.v7.dump", step), frame_text(step, {1, 2, 3, 4}));
    }
    expect_whole("d.dump.100.0");
    expect_whole("bed2.0.v7.dump");
}

TEST_F(FileGroups, RunsThatDifferInADigitAreNoProcesses) {
    for (const int run : {0, 1})
        for (const int step : {0, 100, 200})
            write(fmt::format("run{}.{}.dump", run, step), frame_text(step, {1, 2, 3, 4}));
    expect_whole("run1.100.dump");
    EXPECT_EQ(series_of(folder_ / "run1.100.dump").pattern, (folder_ / "run1.*.dump").string());
}

TEST_F(FileGroups, DumpsOfTwoRunsAreNoSeries) {
    write("bed1.dump", frame_text(0, {1, 2}) + frame_text(100, {1, 2}));
    write("bed2.dump", frame_text(0, {1, 2}) + frame_text(100, {1, 2}) + frame_text(200, {1, 2}));
    const ForeignArchive one = archive("bed1.dump");
    EXPECT_EQ(one.moments().size(), 2u);
    EXPECT_THAT(one.news(), testing::Contains(test::tells({"bed1.dump", "alone", "different runs"})));
    EXPECT_EQ(archive("bed2.dump").moments().size(), 3u);
    // Continued runs and pieces are series.
    write("part1.dump", frame_text(0, {1, 2}) + frame_text(100, {1, 2}));
    write("part2.dump", frame_text(100, {1, 2}) + frame_text(200, {1, 2}));
    EXPECT_EQ(archive("part1.dump").moments().size(), 3u);
}

TEST_F(FileGroups, AFolderWithTwoRunsGivesOneAndTellsOfTheOther) {
    write("bed1.dump", frame_text(0, {1, 2}) + frame_text(100, {1, 2}));
    write("bed2.dump", frame_text(0, {1, 2}) + frame_text(300, {1, 2}));
    const ForeignArchive folder = archive("");
    EXPECT_EQ(folder.written_step(1), 100);
    EXPECT_THAT(folder.news(), testing::Contains(test::tells({"bed2.dump", "passed over"})));
}

}  // namespace
}  // namespace grainreel
