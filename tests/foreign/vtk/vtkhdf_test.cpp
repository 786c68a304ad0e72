// Tests of VTKHDF files: each step of what the writer made is read by the rules of the specification
// (docs.vtk.org, "VTKHDF file format") with the HDF5 library. ParaView 5.13.2 of Debian 13 read the same
// numbers from such files as from those of `export --to vtk` (docs/guide/other-programs.md).
#include <chrono>
#include <mutex>
#include <numeric>
#include <thread>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "engine/base/error.hpp"
#include "engine/files/foreign/h5md/hdf5_file.hpp"
#include "engine/files/frames/state_writer.hpp"
#include "engine/files/frames/writers/vtk_parts.hpp"
#include "engine/files/netcdf/hdf5_trial.hpp"
#include "tests/support/tells.hpp"
#include "tests/support/temporary_folder.hpp"

namespace grainreel {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

constexpr std::array<const char*, 4> kTopologies{"Vertices", "Lines", "Polygons", "Strips"};

// What a block has at a step.
struct Step {
    double time = 0;
    std::vector<double> points;
    std::vector<std::vector<double>> cells;  // the points of each
    std::map<std::string, std::vector<double>> arrays;
};

// Rows first to first + count of a table, one row after the other.
std::vector<double> rows(const Hdf5File& file, const std::string& path, double first, double count) {
    const Hdf5Table table = file.table(path);
    std::vector<double> numbers;
    for (auto row = static_cast<std::uint64_t>(first); row < static_cast<std::uint64_t>(first + count);
         ++row) {
        const std::vector<double> some = table.row(row);
        numbers.insert(numbers.end(), some.begin(), some.end());
    }
    return numbers;
}

Step step_of(const Hdf5File& file, const std::string& block, std::size_t k) {
    const std::string root = "VTKHDF/" + block + "/";
    const auto of_step = [&](const std::string& name) { return file.table(root + "Steps/" + name).row(k); };
    const double part = of_step("PartOffsets").at(0);
    const auto of_part = [&](const std::string& name) { return rows(file, root + name, part, 1).at(0); };
    Step step;
    step.time = of_step("Values").at(0);
    EXPECT_EQ(of_step("NumberOfParts").at(0), 1);
    const double points = of_part("NumberOfPoints");
    step.points = rows(file, root + "Points", of_step("PointOffsets").at(0), points);
    const std::vector<double> cell_offsets = of_step("CellOffsets"),
                              corner_offsets = of_step("ConnectivityIdOffsets");
    double all_cells = 0;
    for (std::size_t t = 0; t < kTopologies.size(); ++t) {
        const std::string name = kTopologies[t];
        const double cells = of_part(name + "/NumberOfCells");
        all_cells += cells;
        const std::vector<double> ends = rows(file, root + name + "/Offsets", cell_offsets.at(t), cells + 1),
                                  corners = rows(file, root + name + "/Connectivity", corner_offsets.at(t),
                                                 of_part(name + "/NumberOfConnectivityIds"));
        EXPECT_EQ(ends.back(), static_cast<double>(corners.size()));
        for (std::size_t c = 0; c + 1 < ends.size(); ++c)
            step.cells.emplace_back(corners.begin() + static_cast<std::ptrdiff_t>(ends[c]),
                                    corners.begin() + static_cast<std::ptrdiff_t>(ends[c + 1]));
    }
    for (const auto& [kind, count] : {std::pair("PointData", points), std::pair("CellData", all_cells)})
        for (const std::string& name : file.names(root + kind))
            step.arrays[name] = rows(file, root + kind + "/" + name,
                                     of_step(std::string(kind) + "Offsets/" + name).at(0), count);
    return step;
}

State grains(double time, const std::vector<int>& ids) {
    State state;
    state.time = time;
    for (const int id : ids) {
        state.id.push_back(id);
        state.species.push_back(id % 2);
        state.radius.push_back(0.001 * (1 + id));
        state.position.push_back(Vec3(id, time, -id));
        state.velocity.push_back(Vec3(time, 2, 3));
        state.spin.push_back(Vec3(0, id, 0));
    }
    state.bodies.resize(2);
    return state;
}

class VtkHdf : public testing::Test {
  protected:
    VtkHdf() {
        world_.species = {{"small"}, {"big one"}};
        world_.bodies.resize(2);
        world_.bodies[1].name = "plate";
        world_.bodies[1].mesh.vertices = {Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(1, 1, 0)};
        world_.bodies[1].mesh.triangles = {{0, 1, 2}, {1, 3, 2}};
        supply_.contacts = true;
    }
    // contacts: of each frame; none where they are not known.
    void write(const std::vector<State>& frames, const std::vector<std::vector<Link>>& touches,
               const std::vector<std::optional<std::vector<SavedContact>>>& contacts = {}) {
        const auto writer = frame_writer("vtkhdf", path_);
        writer->begin(world_, supply_);
        for (std::size_t k = 0; k < frames.size(); ++k) {
            if (k < contacts.size() && contacts[k]) writer->contacts(*contacts[k]);
            writer->frame(frames[k], touches[k]);
        }
        writer->end();
    }
    std::vector<State> four() const {
        std::vector<State> frames{grains(0, {4, 5}), grains(0.5, {4, 5, 7}), grains(1, {7}),
                                  grains(1.5, {4, 5, 8})};
        frames[2].bodies[1].place = Vec3(0, 0, 0.25);
        return frames;
    }

    test::TemporaryFolder folder_;
    std::filesystem::path path_ = folder_ / "bed.vtkhdf";
    StoredWorld world_;
    StateSupply supply_;
};

TEST_F(VtkHdf, NumbersOfGrainsAndContactsMayChange) {
    write(four(), {{}, {{4, 5, 0.5}}, {}, {{4, 5, 1}, {5, 8, 2}}});
    const std::lock_guard lock(hdf5_library());
    const Hdf5File file(path_);
    EXPECT_THAT(file.words_of("VTKHDF", "Type"), ElementsAre("PartitionedDataSetCollection"));
    for (const char* block : {"grains", "walls", "contacts"}) {
        EXPECT_THAT(file.words_of(std::string("VTKHDF/") + block, "Type"), ElementsAre("PolyData"));
        EXPECT_EQ(file.number_of(std::string("VTKHDF/") + block + "/Steps", "NSteps"), 4);
    }
    Step step = step_of(file, "grains", 0);
    EXPECT_EQ(step.time, 0);
    EXPECT_THAT(step.points, ElementsAre(4, 0, -4, 5, 0, -5));
    EXPECT_THAT(step.cells, ElementsAre(ElementsAre(0), ElementsAre(1)));
    EXPECT_THAT(step.arrays["id"], ElementsAre(4, 5));
    EXPECT_THAT(step.arrays["type"], ElementsAre(1, 2));
    step = step_of(file, "grains", 2);
    EXPECT_EQ(step.time, 1);
    EXPECT_THAT(step.points, ElementsAre(7, 1, -7));
    EXPECT_THAT(step.arrays["radius"], ElementsAre(0.008));
    EXPECT_THAT(step.arrays["velocity"], ElementsAre(1, 2, 3));
    step = step_of(file, "grains", 3);
    EXPECT_THAT(step.arrays["id"], ElementsAre(4, 5, 8));
    EXPECT_THAT(step.cells, ElementsAre(ElementsAre(0), ElementsAre(1), ElementsAre(2)));
    EXPECT_THAT(step_of(file, "contacts", 0).cells, IsEmpty());
    EXPECT_THAT(step_of(file, "contacts", 1).points, ElementsAre(4, 0.5, -4, 5, 0.5, -5));
    EXPECT_THAT(step_of(file, "contacts", 2).cells, IsEmpty());
    step = step_of(file, "contacts", 3);
    EXPECT_THAT(step.cells, ElementsAre(ElementsAre(0, 1), ElementsAre(2, 3)));
    EXPECT_THAT(step.arrays["normal_force"], ElementsAre(1, 2));
    EXPECT_THAT(step.arrays["id2"], ElementsAre(5, 8));
}

// A wall that stands still is stored once, and one that moves where it is.
TEST_F(VtkHdf, WallsMove) {
    write(four(), {{}, {}, {}, {}});
    const std::lock_guard lock(hdf5_library());
    const Hdf5File file(path_);
    EXPECT_THAT(step_of(file, "walls", 0).points, ElementsAre(0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0));
    EXPECT_THAT(step_of(file, "walls", 2).points,
                ElementsAre(0, 0, 0.25, 1, 0, 0.25, 0, 1, 0.25, 1, 1, 0.25));
    EXPECT_THAT(step_of(file, "walls", 3).points, ElementsAre(0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0));
    EXPECT_THAT(step_of(file, "walls", 3).cells, ElementsAre(ElementsAre(0, 1, 2), ElementsAre(1, 3, 2)));
    EXPECT_EQ(file.table("VTKHDF/walls/Points").rows(), 12U);
    EXPECT_EQ(file.table("VTKHDF/walls/Polygons/Connectivity").rows(), 6U);
}

// Forces that only later frames have are not known before.
TEST_F(VtkHdf, ForcesMayComeLate) {
    const SavedContact one{4, 5, 2, Vec3(0, 0, 1), Vec3(4.5, 0, -4.5)};
    write(four(), {{}, {{4, 5, 2}}, {}, {{4, 5, 2}}},
          {std::nullopt, std::nullopt, std::nullopt, std::vector<SavedContact>{one}});
    const std::lock_guard lock(hdf5_library());
    const Hdf5File file(path_);
    EXPECT_THAT(step_of(file, "grains", 1).arrays["force"], testing::Each(testing::IsNan()));
    EXPECT_EQ(step_of(file, "grains", 1).arrays["force"].size(), 9U);
    const std::vector<double> force = step_of(file, "grains", 3).arrays["force"];
    ASSERT_EQ(force.size(), 9U);
    EXPECT_NEAR(force[2], -force[5], 1e-15);
    EXPECT_GT(std::abs(force[2]), 0.1);
    EXPECT_EQ(force[6], 0);
}

TEST_F(VtkHdf, TheSameBytesEachTime) {
    write(four(), {{}, {}, {}, {}});
    const std::string first = test::text_of(path_);
    std::this_thread::sleep_for(std::chrono::milliseconds(1100));  // HDF5 would note times in seconds
    write(four(), {{}, {}, {}, {}});
    EXPECT_TRUE(test::text_of(path_) == first);
}

TEST_F(VtkHdf, AFileThatCannotBeWrittenIsToldAndTheNextOneIsFine) {
    if (!std::filesystem::exists("/dev/full")) GTEST_SKIP() << "no /dev/full";
    path_ = "/dev/full";
    try {
        write(four(), {{}, {}, {}, {}});
        FAIL() << "a full disk was not noticed";
    } catch (const RunError& error) {
        EXPECT_THAT(error.what(), test::tells({"/dev/full", "cannot be written", "disk full"}));
    }
    path_ = folder_ / "next.vtkhdf";
    write(four(), {{}, {}, {}, {}});
    const std::lock_guard lock(hdf5_library());
    EXPECT_EQ(step_of(Hdf5File(path_), "grains", 2).time, 1);
}

}  // namespace
}  // namespace grainreel
