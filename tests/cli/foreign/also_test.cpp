// Tests of [output] also: a run's folder gets formats of other programs when the run ends, however it ends.
#include <signal.h>

#include <fmt/format.h>
#include <algorithm>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "engine/files/frames/open_frames.hpp"
#include "engine/files/frames/state_writer.hpp"
#include "engine/files/run_names.hpp"
#include "engine/scene/output.hpp"
#include "tests/cli/mesh_scene.hpp"
#include "tests/cli/program.hpp"
#include "tests/support/small_scene.hpp"
#include "tests/support/tells.hpp"
#include "tests/support/temporary_folder.hpp"

namespace grainreel {
namespace {

namespace fs = std::filesystem;
using namespace test;
using testing::HasSubstr;
using Words = std::vector<std::string>;

class Also : public testing::Test {
  protected:
    void SetUp() override { write_small_scene(here.path()); }

    Ended run(const Words& words) const { return run_program(words, {.folder = here.path()}); }
    Words movie(const std::string& scene, const Words& more) const {
        Words words = {"movie",     scene,         "--out", "run",
                       "--no-film", "--no-report", "--set", "output.trajectory_interval=0.01"};
        words.insert(words.end(), more.begin(), more.end());
        return words;
    }
    // Adds lines after the line [run] of the small scene, or at its end.
    std::string with(const std::string& output) const {
        const std::string name = "also.toml";
        std::string text = small_scene_text;
        text.insert(text.find("[film]"), "[output]\n" + output);
        write_text(here / name, text);
        return name;
    }
    // Expects that the files there have the moments and the grains of the run's own trajectory.
    void expect_like_run(const std::string& inside) const {
        SCOPED_TRACE(inside);
        const auto wanted = open_frames(here / "run"), found = open_frames(here / "run" / "also" / inside);
        ASSERT_EQ(found->moments().size(), wanted->moments().size());
        const std::size_t last = wanted->moments().size() - 1;
        const State a = wanted->grains(last), b = found->grains(last);
        std::vector<std::int32_t> ids = a.id;
        if (inside.starts_with("lammps"))
            for (std::int32_t& id : ids) ++id;  // LAMMPS counts from 1
        ASSERT_EQ(b.id, ids);
        for (std::size_t i = 0; i < a.size(); ++i)
            ASSERT_LT((a.position[i] - b.position[i]).norm(), 1e-8) << a.id[i];  // floats of 0.1 m
    }
    // Names in the folder also/, separated by blanks.
    std::string names(const std::string& folder = "run") const {
        std::vector<std::string> all;
        std::error_code none;
        for (const fs::directory_entry& entry : fs::directory_iterator(here / folder / "also", none))
            all.push_back(entry.path().filename().string());
        std::sort(all.begin(), all.end());
        std::string text;
        for (const std::string& name : all) text += (text.empty() ? "" : " ") + name;
        return text;
    }

    TemporaryFolder here;
};

TEST(AlsoFormats, AreThoseThatAreWritten) {
    std::vector<std::string> listed(kAlsoFormats.begin(), kAlsoFormats.end()), written{};
    for (const WriteFormat& format : frame_formats())
        if (std::string(format.name) != "grain-table") written.emplace_back(format.name);  // final.csv
    EXPECT_THAT(listed, testing::UnorderedElementsAreArray(written));
}

// Else --force would not replace a run that has such a file.
TEST(AlsoFormats, FilesOfAllFormatsAreKnownAsThoseOfRuns) {
    for (const WriteFormat& format : frame_formats()) {
        const std::string ending = format.ending;
        EXPECT_TRUE(ending.starts_with('-') || is_in_also("bed" + ending)) << format.name;
    }
}

TEST_F(Also, ARunLeavesEachFormat) {
    std::string list;
    for (const std::string_view name : kAlsoFormats)
        list += (list.empty() ? "\"" : ", \"") + std::string(name) + "\"";
    const Ended ended =
        run(movie(with("also = [" + list + "]\ncontacts = true\n"), {"--set", "run.duration=0.05"}));
    ASSERT_EQ(ended.status, 0) << ended.err;
    EXPECT_EQ(names(),
              "blender csv.csv gltf.glb gsd.gsd lammps-data.data lammps-dump.dump netcdf.nc stl.stl vtk "
              "vtkhdf.vtkhdf xyz.xyz");
    for (const char* inside :
         {"vtk/grains.pvd", "gsd.gsd", "xyz.xyz", "csv.csv", "lammps-dump.dump", "netcdf.nc"})
        expect_like_run(inside);
    EXPECT_THAT(text_of(here / "run" / "scene.toml"), HasSubstr("also = ["));
    EXPECT_THAT(ended.err, HasSubstr("also/vtk"));
}

TEST_F(Also, WithoutTheKeyNothingIsThere) {
    ASSERT_EQ(run(movie("fifty.toml", {"--set", "run.duration=0.02"})).status, 0);
    EXPECT_FALSE(fs::exists(here / "run" / "also"));
    EXPECT_THAT(text_of(here / "run" / "scene.toml"), testing::Not(HasSubstr("also")));
}

// VTKHDF has one list of times for all, and records of fields have others than frames.
TEST_F(Also, VtkHdfSaysThatFieldsAreLeftOut) {
    const std::string scene = with("[output.fields]\ngrid = \"yz\"\nperiods = 1\nsamples = 2\n");
    ASSERT_EQ(run(movie(scene, {"--set", "run.duration=0.12"})).status, 0);
    ASSERT_TRUE(fs::exists(here / "run" / "fields.nc"));
    const Ended left = run({"export", "run", "--to", "vtkhdf"});
    EXPECT_EQ(left.status, 0) << left.err;
    EXPECT_THAT(left.err, tells({"VTKHDF", "no place", "fields", "--to vtk"}));
    const Ended with_them = run({"export", "run", "--to", "vtk"});
    EXPECT_THAT(with_them.err, testing::Not(HasSubstr("fields;")));
    EXPECT_TRUE(fs::exists(here / with_them.out.substr(0, with_them.out.find('\n')) / "fields.pvd"));
}

TEST_F(Also, AWrongNameIsRefusedWhereItStands) {
    const Ended wrong = run({"check", with("also = [\"vtk\", \"paraview\"]\n")});
    EXPECT_EQ(wrong.status, 2);
    EXPECT_THAT(wrong.err, tells({"also.toml:27:1", "'also'", "\"paraview\"", "no format"}));
    EXPECT_THAT(wrong.err, HasSubstr("lammps-dump"));
    const Ended none = run({"check", with("trajectory = false\nalso = [\"vtk\"]\n")});
    EXPECT_EQ(none.status, 2);
    EXPECT_THAT(none.err, tells({"also.toml:28:1", "'also'", "of no use"}));
    EXPECT_THAT(none.err, HasSubstr("no trajectory is kept"));
}

TEST_F(Also, ARunThatWasStoppedHasItsFramesAndAResumedOneAllOfThem) {
    const std::string scene = with("also = [\"xyz\", \"vtk\"]\n");
    {
        Program program(movie(scene, {"--set", "run.duration=60"}), {.folder = here.path()});
        ASSERT_TRUE(wait_until(program, [&] {
            return fs::exists(here / "run" / "trajectory.nc") &&
                   fs::file_size(here / "run" / "trajectory.nc") > 30000;
        }));
        program.send(SIGINT);
        EXPECT_EQ(program.wait().status, 128 + SIGINT);
    }
    expect_like_run("xyz.xyz");
    const std::uintmax_t before = fs::file_size(here / "run" / "also" / "xyz.xyz");
    const double reached = open_frames(here / "run")->moments().back().time;
    const Ended resumed = run({"resume", "run", "--until", fmt::format("{} s", reached + 0.1), "--no-film"});
    ASSERT_EQ(resumed.status, 0) << resumed.err;
    expect_like_run("xyz.xyz");
    expect_like_run("vtk/grains.pvd");
    EXPECT_GT(fs::file_size(here / "run" / "also" / "xyz.xyz"), before);
    EXPECT_EQ(names(), "vtk xyz.xyz");
}

TEST_F(Also, AnotherRunTakesItsPlaceAndForeignFilesStay) {
    const std::string scene = with("also = [\"vtk\"]\n");
    ASSERT_EQ(run(movie(scene, {"--set", "run.duration=0.02"})).status, 0);
    EXPECT_EQ(run(movie(scene, {"--set", "run.duration=0.02", "--force"})).status, 0);
    write_text(here / "run" / "also" / "vtk" / "mine.pvsm", "precious");
    const Ended refused = run(movie(scene, {"--set", "run.duration=0.02", "--force"}));
    EXPECT_EQ(refused.status, 2);
    EXPECT_THAT(refused.err, HasSubstr("also/vtk"));
    EXPECT_EQ(text_of(here / "run" / "also" / "vtk" / "mine.pvsm"), "precious");
}

TEST_F(Also, MeshesStagesAndPeriodicDepthComeAlong) {
    write_mesh_scene(here.path());
    ASSERT_EQ(run(movie("plate.toml", {"--set", "output.also=[\"vtk\", \"stl\"]"})).status, 0);
    EXPECT_EQ(names(), "stl.stl vtk");
    EXPECT_TRUE(fs::exists(here / "run" / "also" / "vtk" / "walls.pvd"));
    fs::remove_all(here / "run");
    ASSERT_EQ(
        run(movie("fifty.toml", {"--set", "container.periodic_depth=true", "--set",
                                 "drive.stage=[{from = 0.05, g_level = 3}]", "--set", "run.duration=0.1",
                                 "--set", "output.contacts=true", "--set", "output.also=[\"vtk\", \"xyz\"]"}))
            .status,
        0);
    expect_like_run("vtk/grains.pvd");
    EXPECT_THAT(text_of(here / "run" / "also" / "xyz.xyz"), HasSubstr("pbc=\"T F F\""));
}

TEST_F(Also, EachMemberOfAComparisonHasItsOwn) {
    const std::string scene = with("also = [\"xyz\"]\n");
    const Ended ended = run({"compare", scene, scene, "--at", "0.02", "--size", "640x360", "--out", "both",
                             "--set", "run.duration=0.03"});
    ASSERT_EQ(ended.status, 0) << ended.err;
    int found = 0;
    for (const fs::directory_entry& entry : fs::directory_iterator(here / "both"))
        if (fs::exists(entry.path() / "also" / "xyz.xyz")) ++found;
    EXPECT_EQ(found, 2);
}

}  // namespace
}  // namespace grainreel
