// What exports say of boxes, steps, ids and times: what the files say that they come from, and nothing else.
#include <cmath>
#include <cstring>
#include <fstream>
#include <map>
#include <sstream>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "engine/files/foreign/foreign_archive.hpp"
#include "engine/files/frames/open_frames.hpp"
#include "engine/files/frames/state_writer.hpp"
#include "tests/support/tells.hpp"
#include "tests/support/temporary_folder.hpp"

namespace grainreel {
namespace {

namespace fs = std::filesystem;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;

class ExportFacts : public testing::Test {
  protected:
    std::unique_ptr<StateArchive> opened(const std::string& name) const {
        OpenRequest request;
        request.reading.time_step = step_;
        return open_frames(folder_ / name, request);
    }
    Exported exported(const StateArchive& from, const std::string& format, const std::string& name,
                      const ExportChoice& choice = {}) const {
        return export_frames(from, format, folder_ / name, choice, true, [](double) { return true; });
    }
    std::string text(const std::string& name) const { return test::text_of(folder_ / name); }

    test::TemporaryFolder folder_;
    std::optional<double> step_;
};

std::string box_dump(int step, const std::string& bounds, const std::string& flags = "pp pp pp") {
    return fmt::format(
        "ITEM: TIMESTEP\n{}\nITEM: NUMBER OF ATOMS\n1\nITEM: BOX BOUNDS {}\n{}"
        "ITEM: ATOMS id type x y z radius\n1 1 0 0 0 0.001\n",
        step, flags, bounds);
}

// Formats that have a box, by name and file, and the largest error of a length of 0.1 m.
const std::vector<std::tuple<const char*, const char*, double>> with_box = {{"lammps-dump", "b.dump", 1e-15},
                                                                            {"xyz", "b.xyz", 1e-15},
                                                                            {"gsd", "b.gsd", 1e-8},
                                                                            {"netcdf", "b.nc", 1e-15}};

TEST_F(ExportFacts, ABoxThatChangesIsThatOfEachFrame) {
    std::string text;
    for (int k = 0; k < 4; ++k)
        text += box_dump(100 * k,
                         fmt::format("{0} {1}\n{0} {1}\n-0.05 0.05\n", -0.05 + 1e-3 * k, 0.05 - 1e-3 * k));
    folder_.write("a.dump", text);
    step_ = 1e-5;
    const auto from = opened("a.dump");
    for (const auto& [format, name, error] : with_box) {
        SCOPED_TRACE(format);
        exported(*from, format, name);
        const auto back = opened(name);
        ASSERT_EQ(back->moments().size(), 4u);
        for (std::size_t k = 0; k < 4; ++k) {
            const std::optional<WorldCell> box = back->cell(k);
            ASSERT_TRUE(box);
            EXPECT_NEAR(box->edges[0].x(), 0.1 - 2e-3 * static_cast<double>(k), error) << k;
            EXPECT_NEAR(box->edges[2].z(), 0.1, error);
            EXPECT_TRUE(box->periodic[0]);
        }
    }
}

TEST_F(ExportFacts, ATiltedBoxKeepsItsTilt) {
    // Edges (0.1 0 0), (0.01 k 0.1 0), (0 0.02 0.1): bounds of the box around it.
    std::string text;
    for (int k = 0; k < 3; ++k)
        text += box_dump(
            100 * k, fmt::format("-0.05 {} {}\n-0.05 0.07 0\n-0.05 0.05 0.02\n", 0.05 + 0.01 * k, 0.01 * k),
            "xy xz yz pp pp pp");
    folder_.write("a.dump", text);
    step_ = 1e-5;
    const auto from = opened("a.dump");
    for (const auto& [format, name, error] : with_box) {
        SCOPED_TRACE(format);
        exported(*from, format, name);
        const auto back = opened(name);
        for (std::size_t k = 0; k < 3; ++k) {
            const WorldCell box = back->cell(k).value_or(WorldCell());
            EXPECT_NEAR((box.edges[1] - Vec3(0.01 * static_cast<double>(k), 0.1, 0)).norm(), 0, 10 * error)
                << k;
            EXPECT_NEAR((box.edges[2] - Vec3(0, 0.02, 0.1)).norm(), 0, 10 * error) << k;
        }
    }
}

TEST_F(ExportFacts, AnEdgeMayCeaseToBePeriodic) {
    folder_.write("a.dump",
                  box_dump(0, "-1 1\n-1 1\n-1 1\n") + box_dump(1, "-1 1\n-1 1\n-1 1\n", "ff pp pp"));
    exported(*opened("a.dump"), "lammps-dump", "b.dump");
    const std::string made = text("b.dump");
    EXPECT_LT(made.find("BOUNDS pp pp pp"), made.find("BOUNDS ff pp pp"));
}

// A table of grains with ids from 0 at times that are no multiples of each other.
constexpr const char* timed_table =
    "time,id,x,y,z,radius\n0.0,0,1,0,0,0.1\n0.0,1,2,0,0,0.1\n0.1,0,1,0,0,0.1\n0.1,1,2,0,0,0.1\n"
    "0.25,1,2,0,0,0.1\n";

TEST_F(ExportFacts, StepsAreNotMadeUp) {
    folder_.write("a.csv", timed_table);
    const auto from = opened("a.csv");
    exported(*from, "csv", "b.csv");
    EXPECT_TRUE(text("b.csv").starts_with("time,id,type,")) << text("b.csv").substr(0, 60);
    exported(*from, "xyz", "b.xyz");
    EXPECT_THAT(text("b.xyz"), AllOf(HasSubstr(" Time=0.25"), Not(HasSubstr("Step="))));
    exported(*from, "vtk", "b-vtk");
    EXPECT_THAT(text("b-vtk/grains_000000.vtp"), Not(HasSubstr("CYCLE")));
    exported(*from, "gsd", "b.gsd");
    EXPECT_THAT(text("b.gsd"), Not(HasSubstr("configuration/step")));
    const Exported dump = exported(*from, "lammps-dump", "b.dump");
    EXPECT_THAT(text("b.dump"), HasSubstr("ITEM: TIME\n0.25\nITEM: TIMESTEP\n2\n"));
    EXPECT_THAT(dump.news, ElementsAre(test::tells({"no steps", "TIMESTEP"})));
    // What is read back has the times, and no steps either, where the format can do without.
    exported(*from, "netcdf", "b.nc");
    for (const char* name : {"b.csv", "b.xyz", "b.gsd", "b.nc"}) {
        SCOPED_TRACE(name);
        const auto back = opened(name);
        ASSERT_EQ(back->moments().size(), 3u);
        EXPECT_NEAR(back->moments()[2].time, 0.25, 1e-12);
        EXPECT_FALSE(back->written_step(2));
    }
}

TEST_F(ExportFacts, StepsOfUnequalLengthStayAsTheyAre) {
    folder_.write("a.csv",
                  "time,step,id,x,y,z,radius\n0,0,1,1,0,0,0.1\n0.1,70,1,1,0,0,0.1\n0.3,90,1,1,0,0,0.1\n");
    const auto from = opened("a.csv");
    for (const auto& [format, name] : std::map<std::string, std::string>{{"csv", "b.csv"},
                                                                         {"xyz", "b.xyz"},
                                                                         {"lammps-dump", "b.dump"},
                                                                         {"gsd", "b.gsd"},
                                                                         {"netcdf", "b.nc"}}) {
        SCOPED_TRACE(format);
        exported(*from, format, name);
        const auto back = opened(name);
        ASSERT_EQ(back->moments().size(), 3u);
        EXPECT_EQ(back->written_step(1), 70);
        EXPECT_EQ(back->written_step(2), 90);
        EXPECT_NEAR(back->moments()[2].time, 0.3, 1e-12);
    }
}

std::vector<int> ids_in(const std::string& text, const std::string& head) {
    std::istringstream rows(text.substr(text.find('\n', text.find(head)) + 1));
    std::vector<int> ids;
    for (std::string row; std::getline(rows, row) && (ids.empty() || !row.empty());)
        if (!row.empty()) ids.push_back(std::stoi(row));
    return ids;
}

// read_dump finds the atoms of read_data by their ids. In the last frame the grain 0 has gone.
TEST_F(ExportFacts, LammpsGetsOneNumberingInBothFormats) {
    folder_.write("a.csv", timed_table);
    const auto from = opened("a.csv");
    exported(*from, "lammps-dump", "b.dump", {.at = 0.1});
    EXPECT_THAT(ids_in(text("b.dump"), "ITEM: ATOMS"), ElementsAre(1, 2));
    exported(*from, "lammps-data", "b.data", {.at = 0.1});
    EXPECT_THAT(ids_in(text("b.data"), "# sphere"), ElementsAre(1, 2));
    exported(*from, "lammps-dump", "c.dump", {.at = 0.25});
    exported(*from, "lammps-data", "c.data", {.at = 0.25});
    EXPECT_THAT(ids_in(text("c.dump"), "ITEM: ATOMS"), ElementsAre(2));
    EXPECT_THAT(ids_in(text("c.data"), "# sphere"), ElementsAre(2));
    // Ids from 1 stay, also through a file of ours.
    exported(*opened("b.dump"), "netcdf", "b.nc");
    for (const char* name : {"b.dump", "b.nc"}) {
        exported(*opened(name), "lammps-dump", "d.dump");
        EXPECT_THAT(ids_in(text("d.dump"), "ITEM: ATOMS"), ElementsAre(1, 2)) << name;
    }
}

TEST_F(ExportFacts, AMomentThatATableHasTwiceIsThatOfTheRestart) {
    std::string text = "time,id,x,y,z,radius\n";
    for (const auto& [time, x] :
         std::vector<std::pair<double, double>>{{0, 0}, {1, 1}, {2, 5}, {3, 5}, {1, 2}, {2, 3}})
        for (const int id : {7, 4}) text += fmt::format("{},{},{},0,0,0.1\n", time, id, x);
    folder_.write("a.csv", text);
    const auto back = opened("a.csv");
    ASSERT_EQ(back->moments().size(), 3u);
    EXPECT_EQ(back->grains(1).position[0].x(), 2);
    EXPECT_EQ(back->grains(2).position[1].x(), 3);
    // Rows that are sorted by grain are no restart.
    folder_.write("b.csv",
                  "time,id,x,y,z,radius\n0,1,1,0,0,0.1\n1,1,2,0,0,0.1\n0,2,3,0,0,0.1\n1,2,4,0,0,0.1\n");
    EXPECT_EQ(opened("b.csv")->grains(1).size(), 2u);
}

TEST_F(ExportFacts, FramesBesideARoundTimeAreTaken) {
    std::string text = "time,id,x,y,z,radius\n";
    for (int k = 0; k <= 10; ++k)
        text += fmt::format("{:.6f},1,0,0,0,0.1\n", std::round(0.1 * k / 1.7e-5) * 1.7e-5);
    folder_.write("a.csv", text);
    const auto from = opened("a.csv");
    EXPECT_EQ(exported(*from, "csv", "b.csv", {.from = 0.3, .until = 0.7}).frames, 5);
    EXPECT_EQ(exported(*from, "csv", "b.csv", {.from = 0, .until = 1}).frames, 11);
    EXPECT_EQ(exported(*from, "csv", "b.csv", {.from = 0.7, .until = 0.7}).frames, 1);
}

// The part "JSON" of a .glb file.
nlohmann::json json_of_glb(const std::string& bytes) {
    std::uint32_t size = 0;
    std::memcpy(&size, bytes.data() + 12, sizeof(size));
    return nlohmann::json::parse(bytes.substr(20, size));
}

TEST_F(ExportFacts, AGlbOfFewGrainsNeedsNoExtension) {
    folder_.write("few.csv", timed_table);
    exported(*opened("few.csv"), "gltf", "few.glb", {.at = 0.1});
    const nlohmann::json few = json_of_glb(text("few.glb"));
    EXPECT_FALSE(few.contains("extensionsUsed"));
    const nlohmann::json& root = few["nodes"][few["scenes"][0]["nodes"][0].get<std::size_t>()];
    ASSERT_EQ(root["children"].size(), 2u);
    const nlohmann::json& grain = few["nodes"][root["children"][1].get<std::size_t>()];
    EXPECT_EQ(grain["translation"], nlohmann::json({2, 0, 0}));
    EXPECT_FLOAT_EQ(grain["scale"][0].get<float>(), 0.1F);
}

// A program that ignores instances shows two balls of 1 m, so that it must not open the file.
TEST_F(ExportFacts, AGlbOfManyGrainsSaysThatItNeedsInstances) {
    std::string table = "id,x,y,z,radius\n";
    for (int k = 0; k < 5001; ++k) table += fmt::format("{},{},0,0,0.1\n", k, k);
    folder_.write("many.csv", table);
    exported(*opened("many.csv"), "gltf", "many.glb");
    const nlohmann::json many = json_of_glb(text("many.glb"));
    EXPECT_EQ(many["extensionsRequired"], nlohmann::json({"EXT_mesh_gpu_instancing"}));
    EXPECT_EQ(many["extensionsUsed"], many["extensionsRequired"]);
}

// A file that is written has another name until it is whole, which no user has asked for.
TEST_F(ExportFacts, MessagesNameTheFileThatIsAskedFor) {
    std::ofstream(folder_ / "still.csv") << "id,x,y,z,radius\n1,0,0,0,0.001\n";
    const Exported made = exported(*opened("still.csv"), "grain-table", "start.csv");
    ASSERT_FALSE(made.news.empty());
    EXPECT_THAT(made.news.back(), testing::StartsWith("start.csv: velocities"));
    std::ofstream(folder_ / "one.csv")
        << "id,x,y,z,radius,vx,vy,vz\n1,0,0,0,0.001,nan,0,0\n2,1,0,0,0.001,1,2,3\n";
    try {
        exported(*opened("one.csv"), "grain-table", "start.csv");
        FAIL() << "a run cannot start with an unknown velocity";
    } catch (const UserError& error) {
        EXPECT_THAT(error.what(), test::tells({"start.csv", "velocity of grain 1"}));
        EXPECT_THAT(error.what(), Not(HasSubstr(".part")));
    }
}

}  // namespace
}  // namespace grainreel
