// Tests of how much has flowed out, in outflow.csv and on the frame.
#include "engine/files/outflow_csv.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <numbers>

#include "engine/base/error.hpp"
#include "render/picture/base/shot.hpp"
#include "render/picture/words/captions.hpp"
#include "render/scene/filmed_scene.hpp"
#include "tests/support/small_scene.hpp"
#include "tests/support/temporary_folder.hpp"

namespace grainreel {
namespace {

using test::TemporaryFolder;

FilmedScene with_outlet() {
    return read_filmed_scene_text(test::small_scene_text, "sink.toml",
                                  {"container.outlet={width=\"9 mm\", exit_depth=\"6 mm\"}"});
}

std::filesystem::path file_with(const TemporaryFolder& here, const std::string& rows) {
    std::ofstream(here / "outflow.csv") << "time_s,id,type,radius,x,y,z,vx,vy,vz\n" << rows;
    return here / "outflow.csv";
}

TEST(OutflowSums, CountsRowsAndTheirMassUntilATime) {
    const TemporaryFolder here;
    const FilmedScene scene = with_outlet();
    const auto record = OutflowSums::read(file_with(here,
                                                    "0.1,7,1,0.002,0,0,0,0,0,0\n"
                                                    "0.2,3,1,0.001,0,0,0,0,0,0\n"
                                                    "0.2,5,1,0.001,0,0,0,0,0,0\n"
                                                    "0.3,6,1,0.0"),  // a row that is cut off
                                          scene);
    ASSERT_TRUE(record);
    const double unit = 4.0 / 3 * std::numbers::pi * 1e-9 * scene.species[0].density;
    const std::pair<double, FlowedOut> expected[] = {{0.05, {0, 0}},
                                                     {0.1, {1, 8 * unit}},
                                                     {0.15, {1, 8 * unit}},
                                                     {0.2, {3, 10 * unit}},
                                                     {9, {3, 10 * unit}}};
    for (const auto& [time, out] : expected) {
        EXPECT_EQ(record->until(time).grains, out.grains) << time;
        EXPECT_NEAR(record->until(time).mass, out.mass, 1e-12 * unit) << time;
    }
    EXPECT_FALSE(OutflowSums::read(here / "none.csv", scene));
}

TEST(OutflowSums, RefusesWhatIsOfAnotherScene) {
    const TemporaryFolder here;
    const FilmedScene scene = with_outlet();
    for (const char* rows : {"0.1,7,9,0.002,0,0,0,0,0,0\n", "0.1,7,1,-1,0,0,0,0,0,0\n",
                             "0.1,7,1,0.002,0,0,0,0,0,0\n0.05,8,1,0.002,0,0,0,0,0,0\n",
                             "nan,7,1,0.002,0,0,0,0,0,0\n", "0.1,7,1.5,0.002,0,0,0,0,0,0\n"}) {
        const auto file = file_with(here, rows);
        EXPECT_THROW(OutflowSums::read(file, scene), UserError) << rows;
    }
}

// Bytes that are no number are damage and are reported with file and line; none of them counts as 0.
TEST(OutflowSums, RefusesDamageWithItsLine) {
    const TemporaryFolder here;
    const FilmedScene scene = with_outlet();
    const std::string good = "0.1,7,1,0.002,0,0,0,0,0,0\n", zeros(1, '\0');
    for (const std::string& row :
         {zeros + ",8,1,0.002,0,0,0,0,0,0\n", "0.2,8,1,0.0" + zeros + "02,0,0,0,0,0,0\n",
          std::string("0.2,8,1,x,0,0,0,0,0,0\n"), std::string("0.2,8,1,0.002\n"),
          std::string("0.2,8,9,0.002,0,0,0,0,0,0\n")}) {
        const auto file = file_with(here, good + row + good);
        try {
            OutflowSums::read(file, scene);
            ADD_FAILURE() << row;
        } catch (const UserError& error) {
            EXPECT_THAT(error.what(), testing::StartsWith(file.string() + ":3: ")) << row;
        }
    }
}

TEST(OutflowOnTheFrame, SaysGrainsAndMass) {
    const FilmedScene scene = with_outlet();
    ASSERT_TRUE(scene.film.shows.outflow);
    Shot frame;
    EXPECT_EQ(note_text(scene, frame), "");
    frame.flowed_out = FlowedOut{0, 0};
    EXPECT_EQ(note_text(scene, frame), "") << "nothing has flowed out yet";
    frame.flowed_out = FlowedOut{12, 0.0415};
    EXPECT_EQ(note_text(scene, frame), "12 of " + std::to_string(scene.grains()) + " out\n41.5 g out");
    EXPECT_FALSE(longest_note(scene).empty());
}

}  // namespace
}  // namespace grainreel
