// Tests of the reader of data files of LAMMPS and LIGGGHTS.
#include <fmt/format.h>

#include "engine/files/foreign/foreign_archive.hpp"
#include "engine/files/frames/state_writer.hpp"
#include "tests/foreign/small_files.hpp"
#include "tests/support/tells.hpp"

namespace grainreel {

RawFormat lammps_state_format();

namespace {

using namespace small_files;
using test::tells;
using testing::ElementsAre;

// A data file with three atoms. style: what stands behind the word Atoms.
std::string data_file(const std::string& style, const std::string& rows, const std::string& others = "",
                      const std::string& first = "a bed of spheres") {
    return fmt::format(
        "{}\n\n3 atoms\n2  atom types\n\n0 0.1 xlo xhi\n-0.1 0.1 ylo yhi\n0 0.3 zlo zhi\n\nAtoms{}\n\n{}{}",
        first, style, rows, others);
}

constexpr const char* kSpheres =
    "7 1 0.002 2500 0.01 0.02 0.03\n2 2 0.004 2600 0.04 0.05 0.06\n5 1 0.002 2500 0 0 0.1\n";
constexpr const char* kVelocities = "\nVelocities\n\n2 1 2 3 4 5 6\n5 0 0 0 0 0 0\n7 -1 -2 -3 0 0 0.5\n";

const RawFormat& format() {
    static const RawFormat one = lammps_state_format();
    return one;
}

TEST(LammpsData, SpheresWithTheirStyle) {
    const std::string bytes =
        data_file("   # sphere", kSpheres, kVelocities,
                  "LAMMPS data file via write_data, version 29 Sep 2021, timestep = 3000, units = cgs");
    ASSERT_TRUE(takes(format(), bytes));
    const OneFile file(bytes);
    const auto opened = format().open(file.path());
    EXPECT_EQ(opened->facts().units, "cgs");
    EXPECT_EQ(opened->facts().program, "LAMMPS 29 Sep 2021");
    ASSERT_EQ(opened->moments().size(), 1u);
    EXPECT_EQ(opened->moments()[0].step, 3000);
    EXPECT_EQ(opened->moments()[0].grains, 3);
    const RawFrame frame = opened->read(0);
    EXPECT_THAT(names(frame.grains), ElementsAre("id", "type", "diameter", "density", "x", "y", "z", "vx",
                                                 "vy", "vz", "wx", "wy", "wz"));
    EXPECT_THAT(column(frame.grains, "id"), ElementsAre(7, 2, 5));
    EXPECT_THAT(column(frame.grains, "type"), ElementsAre(1, 2, 1));
    EXPECT_THAT(column(frame.grains, "diameter"), ElementsAre(0.002, 0.004, 0.002));
    EXPECT_THAT(column(frame.grains, "density"), ElementsAre(2500, 2600, 2500));
    EXPECT_THAT(column(frame.grains, "z"), ElementsAre(0.03, 0.06, 0.1));
    EXPECT_THAT(column(frame.grains, "vy"), ElementsAre(-2, 2, 0));
    EXPECT_THAT(column(frame.grains, "wz"), ElementsAre(0.5, 6, 0));
    EXPECT_EQ(frame.box->origin, Vec3(0, -0.1, 0));
    EXPECT_EQ(frame.box->edges[1], Vec3(0, 0.2, 0));
    EXPECT_EQ(news_of(format(), bytes), "");
}

TEST(LammpsData, StylesThatCarrySpheres) {
    const std::string bpm =
        "1 9 1 0.002 2500 0.01 0 0.03\n2 9 1 0.002 2500 0.04 0 0.06\n3 9 1 0.002 2500 0 0 0.1 0 -1 0\n";
    EXPECT_THAT(column(frame_of(format(), data_file(" # bpm/sphere", bpm)).grains, "x"),
                ElementsAre(0.01, 0.04, 0));
    EXPECT_THAT(column(frame_of(format(), data_file(" # granular", kSpheres)).grains, "x"),
                ElementsAre(0.01, 0.04, 0));
    const std::string hybrid =
        "1 1 0.01 0 0.03 8 0.002 2500\n2 1 0.04 0 0.06 8 0.002 2500\n3 2 0 0 0.1 9 0.004 2600\n";
    const RawTable bonded = frame_of(format(), data_file(" # hybrid bond sphere", hybrid)).grains;
    EXPECT_THAT(column(bonded, "x"), ElementsAre(0.01, 0.04, 0));
    EXPECT_THAT(column(bonded, "diameter"), ElementsAre(0.002, 0.002, 0.004));
    const std::string first =
        "1 1 0.01 0 0.03 0.002 2500 8\n2 1 0.04 0 0.06 0.002 2500 8\n3 2 0 0 0.1 0.004 2600 9\n";
    EXPECT_THAT(column(frame_of(format(), data_file(" # hybrid sphere/kk bond", first)).grains, "density"),
                ElementsAre(2500, 2500, 2600));
}

TEST(LammpsData, AStyleThatIsNotSaidIsGuessedAndTold) {
    const std::string bytes = data_file("", kSpheres);
    EXPECT_THAT(column(frame_of(format(), bytes).grains, "y"), ElementsAre(0.02, 0.05, 0));
    EXPECT_THAT(news_of(format(), bytes), tells({"grains", "atom_style", "7 columns", "sphere"}));
    const std::string images =
        "1 1 0.002 2500 0.01 0 0.03 0 0 0\n2 1 0.002 2500 0.04 0 0.06 0 0 1\n3 1 0.002 2500 0 0 1 0 0 0\n";
    EXPECT_THAT(column(frame_of(format(), data_file("", images)).grains, "z"), ElementsAre(0.03, 0.06, 1));
    const std::string bpm =
        "1 9 1 0.002 2500 0.01 0 0.03\n2 9 1 0.002 2500 0.04 0 0.06\n3 9 1 0.002 2500 0 0 0.1\n";
    EXPECT_THAT(column(frame_of(format(), data_file("", bpm)).grains, "density"),
                ElementsAre(2500, 2500, 2500));
}

// Atoms of full have a molecule, a type and a charge where spheres have a type, a diameter and a density.
// Rows that may be either are refused.
TEST(LammpsData, AStyleThatCannotBeToldIsRefused) {
    const std::string full = "1 1 2 0.4 0 0 0.1\n2 1 2 0.4 0 0 0.2\n3 1 1 0.8 0 0 0.3\n";
    EXPECT_THAT(complaint_of(format(), data_file("", full)),
                tells({"grains:12", "7 columns", "several", "Atoms # sphere"}));
    EXPECT_THAT(complaint_of(format(), data_file("", "1 1 0 0 0\n2 1 0 0 1\n3 1 0 0 2\n")),
                tells({"grains:12", "5 columns", "Atoms # sphere"}));
}

TEST(LammpsData, AnotherStyleIsNamedAndRefused) {
    EXPECT_THAT(complaint_of(format(), data_file(" # full", "1 1 2 0.4 0 0 0.1\n")),
                tells({"grains:10", "atom_style full", "no spheres", "--radius"}));
    EXPECT_THAT(complaint_of(format(), data_file(" # ellipsoid", "1 1 1 2500 0 0 0.1\n")),
                tells({"atom_style ellipsoid"}));
    EXPECT_THAT(complaint_of(format(), data_file(" # hybrid bond charge", "1 1 0 0 0 1 1\n")),
                tells({"hybrid", "spheres"}));
    EXPECT_THAT(complaint_of(format(), data_file(" # hybrid tri sphere", "1 1 0 0 0 1 1\n")),
                tells({"tri", "sphere first"}));
}

TEST(LammpsData, TiltedBoxes) {
    const std::string tilted =
        "bed\n3 atoms\n2 atom types\n0 2 xlo xhi\n0 1 ylo yhi\n0 1 zlo zhi\n0.5 0.25 -0.125 xy xz "
        "yz\n\nAtoms # sphere\n\n";
    const RawFrame frame = frame_of(format(), tilted + kSpheres);
    EXPECT_EQ(frame.box->edges[0], Vec3(2, 0, 0));
    EXPECT_EQ(frame.box->edges[1], Vec3(0.5, 1, 0));
    EXPECT_EQ(frame.box->edges[2], Vec3(0.25, -0.125, 1));
    const std::string general =
        "bed\n3 atoms\n2 atom types\n0 2 0 avec\n-1 0 0 bvec\n0 0 1 cvec\n1 2 3 abc origin\n\nAtoms # "
        "sphere\n\n";
    const RawFrame turned = frame_of(format(), general + kSpheres);
    EXPECT_EQ(turned.box->origin, Vec3(1, 2, 3));
    EXPECT_EQ(turned.box->edges[1], Vec3(-1, 0, 0));
}

// Other sections are passed over, whose rows may begin with a capital letter (a type label).
TEST(LammpsData, TypesHaveTheirLabels) {
    const std::string text =
        "bed\n\n3 atoms\n2 atom types\n\n0 1 xlo xhi\n0 1 ylo yhi\n0 1 zlo zhi\n\nAtom Type Labels\n\n1 "
        "glass\n2 lead\n\n"
        "Masses\n\nGlass 1.5\nLead 2\n\nPair Coeffs # gran\n\n1 5\n\nAtoms # sphere\n\n"
        "1 lead 0.02 2500 0 0 0.1  # a comment\n2 glass 0.02 2500 0 0 0.2\n3 1 0.02 2500 0 0 "
        "0.3\n\nBonds\n\n1 1 1 2\n";
    const RawFrame frame = frame_of(format(), text);
    EXPECT_THAT(words(frame.grains, "type"), ElementsAre("lead", "glass", "glass"));
}

TEST(LammpsData, DamageIsRefusedWithItsLine) {
    const auto told = [](const std::string& style, const std::string& rows, const std::string& others = "") {
        return complaint_of(format(), data_file(style, rows, others));
    };
    EXPECT_THAT(told(" # sphere", "1 1 0.002 2500 0 0 0\n2 1 0.002 2500 0 0 1\n"),
                tells({"grains:13", "2 of 3 atoms"}));
    EXPECT_THAT(told(" # sphere", std::string(kSpheres) + "8 1 0.1 1 0 0 0\n"),
                tells({"grains:15", "behind the 3"}));
    EXPECT_THAT(told(" # sphere", "1 1 0.002 2500 0 0\n"), tells({"grains:12", "6 columns", "7 at least"}));
    EXPECT_THAT(told(" # sphere", "1 1 0.002 2500 0 0 nan\n"), tells({"grains:12", "place z", "nan"}));
    EXPECT_THAT(told(" # sphere", "1 1 0 2500 0 0 0\n"), tells({"grains:12", "atom 1", "diameter"}));
    EXPECT_THAT(told(" # sphere", "1 3 0.1 2500 0 0 0\n"), tells({"grains:12", "\"3\"", "2 types"}));
    EXPECT_THAT(told(" # sphere", "1 1 0.1 2500 0 0 0\n1 1 0.1 2500 0 0 0\n"),
                tells({"grains:13", "atom 1", "twice"}));
    EXPECT_THAT(told(" # sphere", kSpheres, "\nVelocities\n\n2 1 2 3\n"),
                tells({"Velocities", "1 rows", "3 atoms"}));
    EXPECT_THAT(told(" # sphere", kSpheres, "\nVelocities\n\n9 1 2 3\n"), tells({"grains:18", "no atom 9"}));
    EXPECT_THAT(
        complaint_of(
            format(),
            "bed\n\n99999999999999 atoms\n1 atom types\n0 1 xlo xhi\n\nAtoms # sphere\n\n1 1 1 1 0 0 0\n"),
        tells({"1 of 99999999999999 atoms"}));
    EXPECT_THAT(complaint_of(format(), "bed\n3 atoms\n1 atom types\n1 0 xlo xhi\n"),
                tells({"grains:4", "box ends at 0", "begins at 1"}));
    const std::string cut =
        data_file(" # sphere", std::string(kSpheres).substr(0, std::string(kSpheres).size() - 1));
    EXPECT_THAT(news_of(format(), cut), tells({"no line ends", "Atoms"}));
}

TEST(LammpsData, OnlyDataFilesAreTaken) {
    EXPECT_TRUE(
        takes(format(), "LIGGGHTS data file\n\n 514  atoms\n\n 2  atom types\n\n -0.0101  0.1701 xlo xhi\n"));
    EXPECT_TRUE(takes(format(), "a # comment\r\n\r\n10\tatoms\t\t\r\n3\tatom types\t\r\n0 0.02 xlo xhi\r\n"));
    EXPECT_FALSE(takes(format(), "3\n\nH 0 0 0\nH 0 0 1\nH 0 0 2\n"));
    EXPECT_FALSE(takes(format(), "ITEM: TIMESTEP\n0\nITEM: NUMBER OF ATOMS\n3\n"));
    EXPECT_FALSE(takes(format(), "x,y,z\n3,4,5\n"));
}

// What our export writes comes back to the last bit.
TEST(LammpsData, OurExportComesBack) {
    const test::TemporaryFolder folder;
    StoredWorld world;
    world.title = "bed";
    world.first_id = 1;
    world.species.resize(2);
    world.cell = WorldCell{.origin = Vec3(-1, -2, 0),
                           .edges = {Vec3(2, 0, 0), Vec3(0.5, 4, 0), Vec3(0, 0, 3)},
                           .periodic = {true, true, false}};
    State state;
    state.time = 0.30000000000000004;
    for (int i = 0; i < 5; ++i) {
        state.id.push_back(i + 1);
        state.species.push_back(i % 2);
        state.radius.push_back(0.1 + i / 30.0);
        state.position.push_back(Vec3(-0.9 + i / 7.0, i / 3.0, 0.1 * i));
        state.velocity.push_back(Vec3(0.1 * i, 1.0 / (i + 3), -i));
        state.spin.push_back(Vec3(i / 11.0, -2, 1e-9 * i));
        state.mass.push_back(0.5 + i);
    }
    StateSupply supply;
    supply.masses = true;
    for (const WriteFormat& one : frame_formats()) {
        if (std::string(one.name) != "lammps-data") continue;
        const auto writer = one.make(folder / "bed.data");
        writer->begin(world, supply);
        writer->frame(state, {});
        writer->end();
    }
    const ForeignArchive archive(folder / "bed.data", {});
    ASSERT_EQ(archive.moments().size(), 1u);
    EXPECT_DOUBLE_EQ(archive.moments()[0].time, state.time);
    const State back = archive.grains(0);
    EXPECT_EQ(back.id, state.id);
    EXPECT_EQ(back.species, state.species);
    EXPECT_EQ(back.radius, state.radius);
    EXPECT_EQ(back.position, state.position);
    EXPECT_EQ(back.velocity, state.velocity);
    EXPECT_EQ(back.spin, state.spin);
    for (std::size_t i = 0; i < 5; ++i) EXPECT_NEAR(back.mass[i] / state.mass[i], 1, 1e-15);
    EXPECT_EQ(archive.world().cell->edges[1], world.cell->edges[1]);
}

}  // namespace
}  // namespace grainreel
