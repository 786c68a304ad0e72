// The library's Simulation, Scene, run() and Error where users make mistakes: public headers alone.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <functional>
#include <limits>
#include <memory>
#include <string>
#include <vector>

#include <grainreel/error.hpp>
#include <grainreel/run.hpp>
#include <grainreel/simulation.hpp>

#include "tests/support/small_scene.hpp"
#include "tests/support/tells.hpp"
#include "tests/support/temporary_folder.hpp"

namespace gr = grainreel;

namespace {

using grainreel::test::tells;
using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

// A box of 20 mm x 15 mm x 40 mm; "more" ends in further tables.
std::string text_of(const std::string& more = "") {
    return grainreel::test::SmallScene()
               .beads(8, "small", "3 mm", "2.5 g/cm3")
               .box("20 mm", "15 mm", "40 mm")
               .shaken("30 Hz", "2")
               .lasts("0.05 s")
               .more("accuracy = \"draft\"\n")
               .text() +
           more;
}

gr::Scene scene(const std::string& more = "", const std::vector<std::string>& settings = {}) {
    return gr::Scene::from_text(text_of(more), "box.toml", settings);
}

template <class Call>
gr::Error error_of(const Call& call) {
    try {
        call();
    } catch (const gr::Error& error) {
        return error;
    }
    ADD_FAILURE() << "nothing was thrown";
    return gr::Error("");
}

std::string message_of(const std::function<void()>& call) {
    return error_of(call).what();
}

// A spring without losses that keeps as many numbers as it is told, and answers NaN beyond an overlap.
class Spring final : public gr::ContactLaw {
  public:
    explicit Spring(int numbers = 0, double breaks_at = 1) : numbers_(numbers), breaks_at_(breaks_at) {}
    int numbers() const override { return numbers_; }
    gr::ContactForce force(const gr::Touch& touch, gr::ContactMemory) const override {
        if (touch.overlap > breaks_at_) return {std::numeric_limits<double>::quiet_NaN(), {}};
        return {touch.stiffness * touch.overlap +
                    0.5 * touch.closing_speed * std::sqrt(touch.stiffness * touch.effective_mass),
                {}};
    }

  private:
    int numbers_;
    double breaks_at_;
};

TEST(LibraryError, NamesAFileOnlyWhereThereIsOne) {
    for (const char* message :
         {"setting film.colour.by: 'by' is wrong", "--set film.size: no", "step 7700 (0.05 s): grain 3 left",
          "step 0 (0 s): grain 3 left", "a frame for more/c.xyz: has 3 ids",
          "the first frame of a painter: is empty", "settings of a painter:15:1: 'name' is no name",
          "'cvs' is no format. There are:\n  csv.gz  a table: old", "wall \"drum.stl\": has no triangle",
          "every: must be at least 0 s", "law 0.5: none"}) {
        EXPECT_EQ(gr::Error(message).file(), "") << message;
        EXPECT_EQ(gr::Error(message).line(), 0) << message;
    }
    EXPECT_EQ(gr::Error("my runs/a b.csv: is short").file(), "my runs/a b.csv");
    EXPECT_EQ(gr::Error("final.csv:3: is short").file(), "final.csv");
    EXPECT_EQ(gr::Error("trajectory.nc: is short").file(), "trajectory.nc");
    EXPECT_EQ(gr::Error("Makefile:3:9: is short").column(), 9);
}

TEST(LibraryError, HasTheWordsOfTheLibrary) {
    EXPECT_THAT(message_of([] { scene("", {"run.duration=2 kg"}); }),
                StartsWith("setting run.duration: 'duration' "));
    EXPECT_EQ(message_of([] { scene("", {"run.duration"}); }),
              "setting run.duration: no assignment; write drive.frequency=\"30 Hz\"");
    const grainreel::test::TemporaryFolder folder;
    std::ofstream(folder / "there") << "not a run";
    gr::RunOptions options;
    options.folder = folder / "there";
    const gr::Error error = error_of([&] { gr::run(scene(), options); });
    EXPECT_EQ(error.file(), options.folder.string());
    EXPECT_THAT(error.what(), Not(HasSubstr("--")));
}

TEST(LibraryScene, RefusesTwoSettingsThatExcludeEachOther) {
    EXPECT_EQ(
        message_of([] {
            scene("", {"drive.g_level=2", "drive.amplitude=1 mm"});
        }),
        "setting drive.amplitude: 'drive.amplitude' and 'drive.g_level' exclude each other, and both are set "
        "(the setting drive.g_level); leave out one");
    EXPECT_THAT(message_of([] {
                    scene("", {"species.small.mass=1 g", "species[0].density=2000"});
                }),
                tells({"'species[0].density'", "'species[0].mass'", "exclude"}));
    EXPECT_NO_THROW(scene("", {"drive.amplitude=1 mm"}));  // takes the place of the file's g_level
    EXPECT_NO_THROW(scene("", {"drive.g_level=3", "drive.g_level=2"}));
}

TEST(LibraryScene, KnowsTheWallsByThreeNames) {
    const double friction = scene().contact("small").stiffness;
    EXPECT_EQ(scene().contact("small", "walls").stiffness, friction);
    EXPECT_EQ(scene().contact("small", "wall").stiffness, friction);
    EXPECT_THAT(message_of([] { scene().contact("small", "floor"); }), HasSubstr("there are small"));
}

TEST(LibrarySimulation, RefusesTimesThatStepsCannotCount) {
    gr::Simulation simulation(scene());
    simulation.advance(0.001);
    const std::int64_t step = simulation.step();
    for (const double time : {1e15, 1e30, 1e300, std::numeric_limits<double>::infinity()}) {
        EXPECT_THROW(simulation.advance(time), gr::Error) << time;
        EXPECT_EQ(simulation.advance(-time / 2 < -1e300 ? -1e300 : -time), simulation.time());
    }
    EXPECT_THROW(simulation.advance_steps(std::numeric_limits<std::int64_t>::max()), gr::Error);
    EXPECT_EQ(simulation.step(), step);
}

TEST(LibrarySimulation, RefusesThreadsAsAScene) {
    EXPECT_EQ(message_of([] {
                  gr::Simulation(scene(), {1025, {}});
              }),
              "threads: must be from 0 to 1024, but is 1025");
    EXPECT_THROW(gr::Simulation(scene(), {-1, {}}), gr::Error);
    gr::RunOptions options;
    options.threads = 100000;
    EXPECT_THROW(gr::run(scene(), options), gr::Error);
}

TEST(LibrarySimulation, NamesTheInstrumentOfAColumn) {
    gr::Simulation simulation(scene());
    simulation.pack();
    EXPECT_THAT(message_of([&] { simulation.measure("floor_force_z_N"); }),
                HasSubstr("output.instruments = [\"walls\"]"));
    EXPECT_THAT(message_of([&] { simulation.measure("kinetik_J"); }), HasSubstr("'kinetic_J' is one"));
}

gr::NewGrain small_at(double x, double y, double z, double density = 0) {
    return {0, 0.0015, density, {x, y, z}, {}, {}};
}

// The inner walls are at x = -7.5 and 7.5 mm, y = -10 and 10 mm, z = 0 and 40 mm; a radius is 1.5 mm.
TEST(LibraryInsert, RefusesWhatIsNotInTheContainer) {
    gr::Simulation simulation(scene());
    simulation.pack();
    const auto why = [&](const gr::NewGrain& grain) {
        return message_of([&] { simulation.insert({grain}); });
    };
    EXPECT_THAT(why(small_at(1, 1, 1)), HasSubstr("lies beyond the"));
    EXPECT_THAT(why(small_at(0, 0.0095, 0.03)), HasSubstr("touches the right wall"));
    EXPECT_THAT(why(small_at(0, 0.0105, 0.03)), HasSubstr("lies beyond the right wall"));
    EXPECT_THAT(why(small_at(0.0070, 0, 0.03)), HasSubstr("touches the front"));
    EXPECT_THAT(why(small_at(0, 0, 0.05)), HasSubstr("lies beyond the lid"));
    EXPECT_THAT(why(small_at(0, 0, 1e12)), HasSubstr("so far out"));
    EXPECT_THROW(simulation.insert({small_at(0, 0, 0.03), small_at(0, 0.002, 0.03)}), gr::Error);
    EXPECT_EQ(simulation.frame().size(), 8U);
    simulation.insert({small_at(0.0059, 0.0084, 0.0384)});
    EXPECT_NO_THROW(simulation.advance(0.01));
}

TEST(LibraryInsert, RefusesDensitiesThatNoSceneMayHave) {
    gr::Simulation simulation(scene());
    simulation.pack();
    for (const double density : {-1.0, -2500.0, 1e-300, 1e300, std::numeric_limits<double>::quiet_NaN()})
        EXPECT_THAT(message_of([&] { simulation.insert({small_at(0, 0, 0.03, density)}); }),
                    HasSubstr("density"))
            << density;
    EXPECT_EQ(simulation.insert({small_at(0, 0, 0.03, 8000)}), 8);
}

// The container has gone up by 2a = 20 mm after half a period of a sine that begins at its lowest point, and
// the floor with it.
TEST(LibraryInsert, LooksWhereTheWallsAreNow) {
    const std::string slow = "    [start]\n    method = \"rain\"\n";
    gr::Simulation simulation(scene(
        slow, {"drive.frequency=5 Hz", "drive.amplitude=10 mm", "drive.phase=-90 deg", "drive.ramp=0"}));
    simulation.pack();
    simulation.advance(0.1);
    EXPECT_THAT(message_of([&] { simulation.insert({small_at(0, 0, 0.002)}); }),
                HasSubstr("beyond the floor"));
    EXPECT_NO_THROW(simulation.insert({small_at(0, 0, 0.055)}));  // the lid, at 40 mm, is at 60 mm now
}

TEST(LibraryInsert, RefusesPlacesInPlanesAndMeshes) {
    const grainreel::test::TemporaryFolder folder;
    std::ofstream cube(folder / "cube.obj");
    for (int k = 0; k < 8; ++k)
        cube << "v " << (k & 1 ? 0.004 : -0.004) << ' ' << (k & 2 ? 0.009 : 0.001) << ' '
             << (k & 4 ? 0.03 : 0.022) << '\n';
    cube << "f 1 4 2\nf 1 3 4\nf 5 7 8\nf 5 8 6\nf 1 7 3\nf 1 5 7\nf 2 6 8\nf 2 8 4\nf 1 5 6\nf 1 6 2\nf 3 4 "
            "8\nf 3 8 7\n";
    cube.close();
    const std::string more =
        "[[wall]]\nname = \"ramp\"\npoint = [0, \"-5 mm\", 0]\nnormal = [0, 1, 0]\n[[mesh]]\nname = "
        "\"cube\"\nfile = \"" +
        (folder / "cube.obj").string() + "\"\n";
    gr::Simulation simulation(scene(more));
    simulation.pack();
    const auto why = [&](const gr::NewGrain& grain) {
        return message_of([&] { simulation.insert({grain}); });
    };
    EXPECT_THAT(why(small_at(0, -0.007, 0.02)), HasSubstr("lies beyond the ramp"));
    EXPECT_THAT(why(small_at(0, -0.004, 0.02)), HasSubstr("touches the ramp"));
    EXPECT_THAT(why(small_at(0, 0.005, 0.026)), HasSubstr("lies inside the mesh \"cube\""));
    EXPECT_THAT(why(small_at(0, 0.005, 0.031)), HasSubstr("touches the mesh \"cube\""));
    EXPECT_NO_THROW(simulation.insert({small_at(0, 0.005, 0.0325)}));
}

TEST(LibraryCheckpoint, SaysWhatIsWrongWithIt) {
    const grainreel::test::TemporaryFolder folder;
    const auto opened = [&](const char* name, const gr::SimulationOptions& options = {}) {
        return error_of([&] { gr::Simulation::from_checkpoint(scene(), folder / name, options); });
    };
    EXPECT_THAT(opened("none.grs").what(), HasSubstr("there is no such file"));
    EXPECT_EQ(opened("none.grs").file(), (folder / "none.grs").string());
    std::ofstream(folder / "other.txt") << "text\n";
    EXPECT_THAT(opened("other.txt").what(), HasSubstr("is no checkpoint"));

    gr::Simulation simulation(scene(), {0, {{std::make_shared<Spring>(9), "", ""}}});
    simulation.advance(0.01);
    simulation.save_checkpoint(folder / "law.grs");
    EXPECT_THAT(opened("law.grs").what(), HasSubstr("SimulationOptions::laws"));
    EXPECT_THAT(opened("law.grs", {0, {{std::make_shared<Spring>(2), "", ""}}}).what(),
                HasSubstr("SimulationOptions::laws"));
    std::filesystem::resize_file(folder / "law.grs", std::filesystem::file_size(folder / "law.grs") - 5);
    EXPECT_EQ(std::string(opened("law.grs").what()),
              (folder / "law.grs").string() + ": is damaged; take another checkpoint");

    const gr::Error error = error_of([&] { simulation.save_checkpoint(folder / "nofolder/c.grs"); });
    EXPECT_THAT(error.what(), HasSubstr("there is no folder"));
    EXPECT_EQ(error.file(), (folder / "nofolder/c.grs").string());
}

TEST(LibraryOwnLaw, IsNamedWhereItsForceIsNoNumber) {
    const auto good = std::make_shared<Spring>(), bad = std::make_shared<Spring>(0, 1e-9);
    gr::Simulation simulation(scene(), {2, {{good, "", ""}, {bad, "small", "wall"}}});
    const gr::Error error = error_of([&] { simulation.advance(0.05); });
    EXPECT_THAT(error.what(),
                StartsWith("law 1 of SimulationOptions::laws (of \"small\" and \"wall\") returned"));
    EXPECT_EQ(error.kind(), gr::Error::Kind::failure);
}

TEST(LibraryOwnLaw, ListsThePartnersThatItMayHave) {
    const auto law = std::make_shared<Spring>();
    EXPECT_EQ(message_of([&] {
                  gr::Simulation(scene(), {0, {{law, "small", "wal"}}});
              }),
              "a contact law is chosen for second = \"wal\"; it may be small, walls, or empty for any");
    EXPECT_EQ(message_of([&] {
                  gr::Simulation(scene(), {0, {{law, "walls", "small"}}});
              }),
              "a contact law is chosen for first = \"walls\"; it may be small, or empty for any");
}

}  // namespace
