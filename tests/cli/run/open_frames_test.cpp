// Tests of frames in all formats on disk, read through the one list of readers and written through the one
// list of writers.
#include "engine/files/frames/open_frames.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>

#include "engine/base/error.hpp"
#include "engine/files/frames/state_writer.hpp"
#include "engine/grain_table.hpp"
#include "engine/questions/asked_moment.hpp"
#include "engine/questions/questions.hpp"
#include "engine/run/replay/replay.hpp"
#include "engine/state/checkpoint_file.hpp"
#include "engine/state/container_faces.hpp"
#include "tests/cli/made_frame.hpp"
#include "tests/cli/program.hpp"
#include "tests/support/small_scene.hpp"
#include "tests/support/temporary_folder.hpp"

namespace grainreel {
namespace {

namespace fs = std::filesystem;
using namespace test;
using testing::ElementsAre;
using testing::HasSubstr;

void expect_same_grains(const State& is, const State& wanted) {
    EXPECT_EQ(is.id, wanted.id);
    EXPECT_EQ(is.species, wanted.species);
    EXPECT_EQ(is.radius, wanted.radius);
    EXPECT_EQ(is.position, wanted.position);
    EXPECT_EQ(is.velocity, wanted.velocity);
    EXPECT_EQ(is.spin, wanted.spin);
    ASSERT_EQ(is.orientation.size(), wanted.orientation.size());
    for (std::size_t i = 0; i < is.orientation.size(); ++i)
        EXPECT_EQ(is.orientation[i].coeffs(), wanted.orientation[i].coeffs());
}

std::vector<std::string> names_of(const StoredWorld& world) {
    std::vector<std::string> names;
    for (const WorldSpecies& species : world.species) names.push_back(species.name);
    return names;
}

// A run of fifty grains, made once for all tests of this file.
class OpenFrames : public testing::Test {
  protected:
    static void SetUpTestSuite() {
        run_ = new TemporaryFolder;
        write_small_scene(run_->path());
        const Ended ended = run_program({"movie", "fifty.toml", "--no-film", "--no-report", "--out", "run",
                                         "--set", "output.contacts=true"},
                                        {run_->path(), {}});
        ASSERT_EQ(ended.status, 0) << ended.err;
    }
    static void TearDownTestSuite() { delete run_; }

    static fs::path run() { return *run_ / "run"; }
    // A copy of one of its files, alone and under another name.
    fs::path copied(const char* file, const char* name) const {
        fs::copy_file(run() / file, here / name);
        return here / name;
    }

    TemporaryFolder here;

  private:
    static inline TemporaryFolder* run_ = nullptr;
};

TEST_F(OpenFrames, OfARunsFolderHasAllThatLiesThere) {
    const auto frames = std::make_unique<StoredRun>(run());
    expect_same_grains(open_frames(run())->grains(4), frames->grains(4));
    EXPECT_EQ(frames->moments().size(), 5u);
    EXPECT_THAT(names_of(frames->world()), ElementsAre("small", "big"));
    EXPECT_NEAR(frames->world().species[0].density, 2500, 1e-9);
    EXPECT_FALSE(frames->world().bodies.at(kContainerBody).faces.empty());
    EXPECT_TRUE(frames->supply().contacts && frames->supply().measures && !frames->supply().orientations);
    EXPECT_FALSE(frames->touches(4)->empty());
    EXPECT_NEAR(frames->measured_near(4)->time, frames->moments()[4].time, 1e-12);
    ASSERT_NE(frames->scene(), nullptr);
    EXPECT_EQ(frames->scene()->grains(), 50);
}

TEST_F(OpenFrames, OfATrajectoryAloneByItsContent) {
    const auto frames = open_frames(copied("trajectory.nc", "bed.txt")), whole = open_frames(run());
    EXPECT_STREQ(reader_of(here / "bed.txt")->name, "trajectory");
    ASSERT_EQ(frames->moments().size(), 5u);
    expect_same_grains(frames->grains(4), whole->grains(4));
    EXPECT_EQ(frames->grains(3).bodies, whole->grains(3).bodies);
    EXPECT_EQ(frames->moments()[4].time, whole->moments()[4].time);
    EXPECT_EQ(frames->scene(), nullptr);
    EXPECT_THAT(names_of(frames->world()), ElementsAre("small", "big"));
    EXPECT_NEAR(frames->world().species[1].density, 2500, 1e-9);
    EXPECT_EQ(frames->world().most_grains, 50u);
    EXPECT_TRUE(frames->supply().velocities && frames->supply().contact_numbers);
    EXPECT_FALSE(frames->supply().contacts || frames->supply().measures);
    EXPECT_FALSE(frames->touches(0));
}

TEST_F(OpenFrames, OfATableOfGrainsByItsContent) {
    const auto frames = open_frames(copied("final.csv", "grains.nc"));
    EXPECT_STREQ(reader_of(here / "grains.nc")->name, "grain-table");
    ASSERT_EQ(frames->moments().size(), 1u);
    EXPECT_FALSE(frames->world().time_known);
    EXPECT_TRUE(std::isnan(frames->moments()[0].time));
    EXPECT_THAT(names_of(frames->world()), ElementsAre("type 1", "type 2"));
    EXPECT_TRUE(std::isnan(frames->world().species[0].density));
    EXPECT_EQ(frames->scene(), nullptr);
    const auto beside = open_frames(run() / "final.csv");
    EXPECT_THAT(names_of(beside->world()), ElementsAre("small", "big"));
    EXPECT_NE(beside->scene(), nullptr);
    expect_same_grains(frames->grains(0), beside->grains(0));
}

TEST_F(OpenFrames, OfACheckpointAreThoseOfTheRunThatItRestores) {
    const auto frames = open_frames(copied("checkpoint.grs", "state.csv"));
    EXPECT_STREQ(reader_of(here / "state.csv")->name, "checkpoint");
    const SimulatedBed restored = run_of_checkpoint(run() / "checkpoint.grs", 1);
    const State is = frames->grains(0), wanted = restored.frame();
    expect_same_grains(is, wanted);
    EXPECT_EQ(is.step, wanted.step);
    EXPECT_EQ(is.time, wanted.time);
    EXPECT_EQ(is.cycles, wanted.cycles);
    EXPECT_EQ(is.phase, wanted.phase);
    EXPECT_EQ(is.bodies, wanted.bodies);
    EXPECT_EQ(frames->moments().at(0).step, wanted.step);
    EXPECT_THAT(names_of(frames->world()), ElementsAre("small", "big"));
}

TEST_F(OpenFrames, RefusesWhatItDoesNotKnowWithAListOfWhatItReads) {
    write_text(here / "trajectory.nc", "Dear diary, no grain fell today.\n");
    fs::create_directory(here / "empty");
    for (const char* name : {"trajectory.nc", "empty"}) {
        try {
            open_frames(here / name);
            FAIL() << name;
        } catch (const UserError& mistake) {
            EXPECT_THAT(mistake.what(), HasSubstr((here / name).string()));
            for (const ReadFormat& reader : frame_readers())
                EXPECT_THAT(mistake.what(), HasSubstr(reader.about)) << name;
        }
    }
    EXPECT_THROW(open_frames(here / "missing"), UserError);
    EXPECT_THROW(open_frames(run() / "contacts.nc"), UserError);  // the file has no grains
}

// Counts in a file are not believed.
TEST_F(OpenFrames, CountsAreBoundedBeforeMemoryIsAskedFor) {
    std::string bytes = text_of(run() / "checkpoint.grs");
    const std::size_t prologue = 16;
    const auto number = [&](std::size_t at) {
        std::uint64_t value = 0;
        std::memcpy(&value, bytes.data() + at, sizeof value);
        return value;
    };
    const std::size_t header = prologue + 8 + number(prologue);
    const std::size_t gathered = header + sizeof(CheckpointHeader) + 1;
    const std::size_t ids = gathered + 8 + number(gathered) + 8;
    ASSERT_EQ(number(ids), 50u);
    const std::uint64_t claimed = 1'000'000'000'000;
    std::memcpy(bytes.data() + ids, &claimed, sizeof claimed);
    const std::uint64_t sum = mark_of_table(0, std::string_view(bytes).substr(prologue)).checksum;
    std::memcpy(bytes.data() + 8, &sum, sizeof sum);
    write_text(here / "forged.grs", bytes);
    try {
        open_frames(here / "forged.grs");
        FAIL();
    } catch (const UserError& mistake) {
        EXPECT_THAT(mistake.what(), HasSubstr("forged.grs: is damaged"));
    }
}

TEST(FrameWriters, ATableOfGrainsIsReadBackToTheLastBit) {
    const TemporaryFolder here;
    for (const bool orientation : {false, true}) {
        const State wanted = made_frame(7, 3, orientation);
        const auto writer = frame_writer("grain-table", here / "grains");
        StateSupply supply;
        supply.orientations = orientation;
        writer->begin(StoredWorld(), supply);
        writer->frame(made_frame(5, 1, orientation), {});
        writer->frame(wanted, {});
        writer->end();
        const auto frames = open_frames(here / "grains");
        EXPECT_EQ(frames->supply().orientations, orientation);
        expect_same_grains(frames->grains(0), wanted);
    }
}

TEST(FrameWriters, ATrajectoryKeepsItsWorld) {
    const TemporaryFolder here;
    StoredWorld world;
    world.title = "made";
    world.species.resize(3);
    for (int s = 0; s < 3; ++s) {
        world.species[s].name = std::string(1, static_cast<char>('a' + s));
        world.facts.densities.push_back(1000.0 + s);
    }
    WorldCell& cell = world.cell.emplace();
    cell.origin = Vec3(-1, -2, 0);
    cell.edges[0] = Vec3(0.5, 0, 0);
    cell.periodic[0] = true;
    world.most_grains = 9;
    const auto writer = frame_writer("netcdf", here / "moments");
    writer->begin(world, {});
    writer->frame(made_frame(9, 1), {});
    writer->frame(made_frame(9, 2), {});
    writer->end();
    const auto frames = open_frames(here / "moments");
    ASSERT_EQ(frames->moments().size(), 2u);
    const State is = frames->grains(1), wanted = made_frame(9, 2);
    EXPECT_EQ(is.id, wanted.id);
    EXPECT_EQ(is.species, wanted.species);
    EXPECT_EQ(is.position, wanted.position);  // velocities are floats there
    EXPECT_EQ(frames->moments()[1].step, made_frame(9, 2).step);
    EXPECT_EQ(frames->world().title, "made");
    EXPECT_THAT(names_of(frames->world()), ElementsAre("a", "b", "c"));
    EXPECT_EQ(frames->world().species[2].density, 1002);
    EXPECT_EQ(frames->world().cell->origin, cell.origin);
    EXPECT_EQ(frames->world().cell->edges[0], cell.edges[0]);
    EXPECT_TRUE(frames->world().cell->periodic[0] && !frames->world().cell->periodic[1]);
}

TEST(FrameWriters, AnUnknownFormatIsRefusedWithAList) {
    try {
        frame_writer("hologram", "x");
        FAIL();
    } catch (const UserError& mistake) {
        for (const WriteFormat& format : frame_formats()) EXPECT_THAT(mistake.what(), HasSubstr(format.name));
    }
}

// Frames as of another program: they have no scene, no density and no step.
class Foreign final : public StateArchive {
  public:
    Foreign() : path_("foreign.dump") {
        world_.species = {{"sand"}, {"clay"}, {"gravel"}};
        for (int k = 0; k < 3; ++k) {
            frames_.push_back(made_frame(6, k));
            moments_.push_back(moment_of(frames_.back()));
        }
    }
    const fs::path& path() const override { return path_; }
    const StoredWorld& world() const override { return world_; }
    StateSupply supply() const override { return {}; }
    const std::vector<State>& moments() const override { return moments_; }
    State grains(std::size_t index) const override { return frames_.at(index); }

  private:
    fs::path path_;
    StoredWorld world_;
    std::vector<State> frames_, moments_;
};

TEST(FrameArchives, WithoutASceneAnswerQuestions) {
    const StoredRun run(std::make_shared<const Foreign>());
    EXPECT_TRUE(run.checkpoints().empty());
    const AskedMoment asked = find_moment(run, {});
    EXPECT_EQ(asked.nearest, 2u);
    const Answer answer = where_answer(kept_snapshot(run, asked.nearest), "species == gravel", 10);
    EXPECT_THAT(grains_in(answer), ElementsAre(5, 11));
}

}  // namespace
}  // namespace grainreel
