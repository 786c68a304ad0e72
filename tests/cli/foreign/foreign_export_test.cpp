// Tests of `grainreel export`: from a file of another program to each format, and back if the format can be
// read.
#include <algorithm>
#include <cmath>
#include <fstream>
#include <map>

#include <gmock/gmock.h>

#include <nlohmann/json.hpp>

#include "engine/files/frames/open_frames.hpp"
#include "engine/files/frames/state_writer.hpp"
#include "tests/cli/foreign/foreign_bed.hpp"
#include "tests/support/small_scene.hpp"

namespace grainreel {
namespace {

namespace fs = std::filesystem;
using namespace test;
using testing::HasSubstr;

class ForeignExport : public ForeignBed {
  protected:
    fs::path exported(const std::string& from, const std::string& format) {
        Ended ended = timed({"export", from, "--to", format, "--out", "made-" + format, "--walls",
                             "paddle_0.stl", "--contacts", "contacts.dump"});
        EXPECT_EQ(ended.status, 0) << format << ' ' << ended.err;
        EXPECT_TRUE(ended.out.ends_with("made-" + format + "\n")) << ended.out;
        return here / ("made-" + format);
    }
};

// Compares grains by their ids, to the precision (m) of the format.
void expect_same_grains(const State& a, const State& b, double precision) {
    ASSERT_EQ(a.id, b.id);
    EXPECT_EQ(a.species, b.species);
    for (std::size_t i = 0; i < a.size(); ++i) {
        ASSERT_NEAR((a.position[i] - b.position[i]).norm(), 0, precision) << a.id[i];
        ASSERT_NEAR(a.radius[i], b.radius[i], precision) << a.id[i];
    }
}

TEST_F(ForeignExport, WritesEachFormat) {
    for (const WriteFormat& format : frame_formats()) {
        const fs::path made = exported("bed.dump", format.name);
        EXPECT_TRUE(fs::exists(made)) << format.name;
    }
}

TEST_F(ForeignExport, WhatIsReadBackHasTheSameGrains) {
    OpenRequest request;
    request.reading.time_step = kForeignStep;
    const auto wanted = open_frames(here / "bed.dump", request);
    // Floats of some centimetres are exact to 4e-9 m.
    const std::vector<std::pair<std::string, double>> formats = {{"lammps-dump", 1e-12}, {"xyz", 1e-12},
                                                                 {"csv", 1e-12},         {"netcdf", 1e-12},
                                                                 {"gsd", 4e-9},          {"vtk", 4e-9}};
    for (const auto& [format, precision] : formats) {
        SCOPED_TRACE(format);
        fs::path made = exported("bed.dump", format);
        if (format == "vtk") made /= "grains.pvd";
        const auto found = open_frames(made, format == "lammps-dump" ? request : OpenRequest());
        ASSERT_EQ(found->moments().size(), wanted->moments().size());
        for (std::size_t k = 0; k < wanted->moments().size(); ++k)
            expect_same_grains(wanted->grains(k), found->grains(k), precision);
    }
}

// A format through which a run of ours goes, and what comes back.
struct Returned {
    const char* format;
    const char* inside;  // the file in the folder that is read
    double precision;    // m, of places and radii of some centimetres: 0 for doubles, 2^-24 of it for floats
    bool names;          // whether species have their names, and not only their numbers
    int first_id = 0;    // of grains; ours count from 0, and LAMMPS from 1
};

constexpr Returned returned_formats[] = {
    {"lammps-dump", "", 0, false, 1}, {"xyz", "", 0, true},    {"csv", "", 0, false},
    {"vtk", "grains.pvd", 0, true},   {"gsd", "", 4e-9, true}, {"netcdf", "", 0, true},
};

// Our run, files of other programs made from it, and both in one picture.
TEST_F(ForeignExport, ARunOfOursComesBackAsItWas) {
    std::string scene = small_scene_text;
    ASSERT_NE(scene.find("duration = \"0.2 s\""), std::string::npos);
    scene.replace(scene.find("duration = \"0.2 s\""), 18, "duration = \"0.02 s\"");
    write_text(here / "fifty.toml", scene);
    const Ended run = program(
        {"movie", "fifty.toml", "--out", "ours", "--no-film", "--set", "output.trajectory_interval=0.01"});
    ASSERT_EQ(run.status, 0) << run.err;
    const auto wanted = open_frames(here / "ours");
    for (const Returned& one : returned_formats) {
        SCOPED_TRACE(one.format);
        const std::string name = std::string("through-") + one.format;
        ASSERT_EQ(program({"export", "ours", "--to", one.format, "--out", name}).status, 0);
        const fs::path made = here / name;
        const auto found = open_frames(*one.inside == '\0' ? made : made / one.inside);
        ASSERT_EQ(found->moments().size(), wanted->moments().size());
        for (std::size_t k = 0; k < wanted->moments().size(); ++k) {
            const State a = wanted->grains(k), b = found->grains(k);
            std::vector<std::int32_t> ids = a.id;
            for (std::int32_t& id : ids) id += one.first_id;
            ASSERT_EQ(b.id, ids);
            EXPECT_NEAR(b.time, a.time, 1e-12);
            for (std::size_t i = 0; i < a.size(); ++i) {
                const auto species = [&](const StateArchive& archive, const State& frame) {
                    return archive.world().species.at(static_cast<std::size_t>(frame.species[i])).name;
                };
                if (one.names) {
                    ASSERT_EQ(species(*found, b), species(*wanted, a)) << a.id[i];
                } else {
                    ASSERT_EQ(b.species[i], a.species[i]) << a.id[i];
                }
                ASSERT_LE((a.position[i] - b.position[i]).norm(), one.precision) << a.id[i];
                ASSERT_LE(std::abs(a.radius[i] - b.radius[i]), one.precision) << a.id[i];
            }
        }
    }
    const Ended one =
        program({"export", "ours", "--to", "csv", "--at", "0", "--out", "one.csv", "--progress", "json"});
    EXPECT_THAT(one.err, HasSubstr(R"("stage":"exporting")"));
    EXPECT_THAT(one.err, HasSubstr("wrote one.csv: 1 frame, "));
    const Ended both = program(
        {"compare", "ours", "through-lammps-dump", "--at", "0.01", "--size", "640x360", "--out", "both"});
    EXPECT_EQ(both.status, 0) << both.err;
}

// The section Atoms of atom_style sphere has id, type, diameter, density, x, y, z (LAMMPS, read_data).
TEST_F(ForeignExport, ADataFileOfLammpsHasTheLastFrame) {
    const fs::path made = exported("bed.dump", "lammps-data");
    OpenRequest request;
    request.reading.time_step = kForeignStep;
    const auto frames = open_frames(here / "bed.dump", request);
    const State last = frames->grains(frames->moments().size() - 1);
    std::ifstream file(made);
    std::string line;
    while (std::getline(file, line) && line != "Atoms # sphere") continue;
    for (std::size_t i = 0; i < last.size(); ++i) {
        int id = 0, type = 0;
        double diameter = 0, density = 0;
        Vec3 place;
        ASSERT_TRUE(file >> id >> type >> diameter >> density >> place.x() >> place.y() >> place.z());
        EXPECT_EQ(id, last.id[i]);
        EXPECT_EQ(type, last.species[i] + 1);
        EXPECT_DOUBLE_EQ(diameter, 2 * last.radius[i]);
        EXPECT_EQ(place, last.position[i]);
    }
}

TEST_F(ForeignExport, NeverWritesOverWhatIsThere) {
    write_text(here / "mine.csv", "precious");
    const Ended ended = timed({"export", "bed.dump", "--to", "csv", "--out", "mine.csv"});
    EXPECT_EQ(ended.status, 2);
    EXPECT_THAT(ended.err, HasSubstr("mine.csv"));
    EXPECT_EQ(text_of(here / "mine.csv"), "precious");
    EXPECT_EQ(timed({"export", "bed.dump", "--to", "csv", "--out", "mine.csv", "--force"}).status, 0);
    EXPECT_NE(text_of(here / "mine.csv"), "precious");
}

// A second run of a scene "bed" is "bed-2", so the second export of a run "bed" has another kind of name.
TEST_F(ForeignExport, NamesOfSecondExportsAreNotThoseOfSecondRuns) {
    for (const auto& [format, names] : std::map<std::string, std::vector<std::string>>{
             {"csv", {"bed.csv", "bed.2.csv", "bed.3.csv"}}, {"vtk", {"bed-vtk", "bed.2-vtk"}}})
        for (const std::string& name : names) {
            const Ended ended = timed({"export", "bed.dump", "--to", format});
            EXPECT_EQ(ended.status, 0) << ended.err;
            EXPECT_EQ(fs::path(ended.out.substr(0, ended.out.size() - 1)).filename(), name);
            EXPECT_TRUE(fs::exists(here / name));
        }
}

TEST_F(ForeignExport, TakesTheMomentsThatWereChosen) {
    ASSERT_EQ(
        timed({"export", "bed.dump", "--to", "csv", "--from", "0.01", "--every", "2", "--out", "two.csv"})
            .status,
        0);
    const std::string text = text_of(here / "two.csv");
    // There is a line for each grain of frames 1 and 3, and the header.
    EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 2 * kForeignGrains + 1);
    const Ended none = timed({"export", "bed.dump", "--to", "csv", "--from", "7", "--out", "none.csv"});
    EXPECT_EQ(none.status, 2) << none.err;
    EXPECT_FALSE(fs::exists(here / "none.csv"));
}

TEST_F(ForeignExport, RefusesATimeOutsideTheRun) {
    const double apart = 1000 * kForeignStep, last = (kForeignFrames - 1) * apart;
    const std::string range = fmt::format("which goes from 0 to {:.6g} s", last);
    for (const char* option : {"--at", "--from", "--until"})
        for (const double time : {-1.5 * apart, last + 1.5 * apart, 9.0}) {
            const Ended ended = timed(
                {"export", "bed.dump", "--to", "csv", fmt::format("{}={}", option, time), "--out", "no.csv"});
            EXPECT_EQ(ended.status, 2) << option << time;
            EXPECT_THAT(ended.err,
                        HasSubstr(fmt::format("{}: {:.6g} s is outside the run, {}", option, time, range)));
            EXPECT_FALSE(fs::exists(here / "no.csv"));
        }
    const Ended turned = timed({"export", "bed.dump", "--to", "csv", "--from", fmt::format("{}", last),
                                "--until", "0", "--out", "no.csv"});
    EXPECT_EQ(turned.status, 2);
    EXPECT_THAT(turned.err, HasSubstr("is later than --until"));
    // A run may end a little after its last frame. What is written then is said.
    const Ended near = timed({"export", "bed.dump", "--to", "csv", "--at",
                              fmt::format("{}", last + 0.5 * apart), "--out", "last.csv"});
    EXPECT_EQ(near.status, 0) << near.err;
    EXPECT_THAT(near.err, HasSubstr(fmt::format("{:.6g} s is written, the kept moment", last)));
}

}  // namespace
}  // namespace grainreel
