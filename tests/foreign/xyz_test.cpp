// Tests of the reader of XYZ files, plain and extended.
#include "tests/foreign/small_files.hpp"
#include "tests/support/tells.hpp"

namespace grainreel {

RawFormat xyz_format();

namespace {

using namespace small_files;
using test::tells;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::StartsWith;

const std::string two_frames =
    "2\n"
    "\n"
    "St 1 2 3 0.5\n"
    "Gl 4 5 6 0.25\n"
    "1\n"
    "a word\n"
    "Gl 7 8 9 0.125\n";

TEST(PlainXyz, HasElementsPlacesAndColumnsWithoutNames) {
    const RawFrame frame = frame_of(xyz_format(), two_frames);
    EXPECT_THAT(names(frame.grains), ElementsAre("species", "x", "y", "z", "c5"));
    EXPECT_THAT(words(frame.grains, "species"), ElementsAre("St", "Gl"));
    EXPECT_THAT(column(frame.grains, "y"), ElementsAre(2, 5));
    EXPECT_THAT(column(frame.grains, "c5"), ElementsAre(0.5, 0.25));
    EXPECT_FALSE(frame.box.has_value());
    EXPECT_FALSE(frame.time.has_value());
}

TEST(PlainXyz, GrainsComeAndGo) {
    EXPECT_THAT(counts(xyz_format(), two_frames), ElementsAre(2, 1));
    EXPECT_THAT(counts(xyz_format(), "0\nnone yet\n" + two_frames + "0\n\n"), ElementsAre(0, 2, 1, 0));
    EXPECT_THAT(column(frame_of(xyz_format(), two_frames, 1).grains, "z"), ElementsAre(9));
}

TEST(PlainXyz, NumbersInPlaceOfElementsAreTypes) {
    const RawFrame frame = frame_of(xyz_format(), "2\nAtoms. Timestep: 700\n10 0 0 0\n2 0 0 1\n");
    EXPECT_THAT(column(frame.grains, "species"), ElementsAre(10, 2));
    EXPECT_TRUE(frame.grains.columns[0].words.empty());
    EXPECT_EQ(frame.step, 700);  // as LAMMPS writes it
}

TEST(PlainXyz, LinesMayEndAsInWindows) {
    EXPECT_THAT(column(frame_of(xyz_format(), "1\r\n\r\nSt 1 2 3\r\n").grains, "z"), ElementsAre(3));
}

TEST(ExtendedXyz, ItsSecondLineNamesAll) {
    const RawFrame frame = frame_of(
        xyz_format(),
        "2\n"
        "Strange Lattice = \"4,0,0 1,5,0 0,0,6\" Origin='-2 -1 0' pbc=\"T F T\" note={a b} info='{\"a\": 1}' "
        "Properties=species:S:1:pos:R:3:velo:R:3:radius:R:1:high:L:1 Time=0.25 step=50\n"
        "St 1 2 3 .1 .2 .3 0.5 T\n"
        "Gl 4 5 6 .4 .5 .6 0.7 F\n");
    EXPECT_THAT(names(frame.grains),
                ElementsAre("species", "x", "y", "z", "velo:0", "velo:1", "velo:2", "radius", "high"));
    EXPECT_THAT(words(frame.grains, "high"), ElementsAre("T", "F"));
    EXPECT_THAT(column(frame.grains, "velo:1"), ElementsAre(0.2, 0.5));
    EXPECT_THAT(column(frame.grains, "radius"), ElementsAre(0.5, 0.7));
    EXPECT_EQ(frame.time, 0.25);
    EXPECT_EQ(frame.step, 50);
    ASSERT_TRUE(frame.box.has_value());
    EXPECT_EQ(frame.box->origin, Vec3(-2, -1, 0));
    EXPECT_EQ(frame.box->edges[0], Vec3(4, 0, 0));
    EXPECT_EQ(frame.box->edges[1], Vec3(1, 5, 0));  // a line of the matrix is a vector
    EXPECT_EQ(frame.box->edges[2], Vec3(0, 0, 6));
    EXPECT_THAT(frame.box->periodic, ElementsAre(true, false, true));
}

TEST(ExtendedXyz, ABoxWithoutOriginBeginsAtZero) {
    const RawFrame frame =
        frame_of(xyz_format(), "1\nLattice=\"1 0 0 0 1 0 0 0 1\" Properties=pos:R:3\n0.5 0.5 0.5\n");
    ASSERT_TRUE(frame.box.has_value());
    EXPECT_EQ(frame.box->origin, Vec3(0, 0, 0));
    EXPECT_THAT(names(frame.grains), ElementsAre("x", "y", "z"));
}

// The examples are from chemfiles' list of bad properties.
TEST(ExtendedXyz, BadPropertiesAreRefused) {
    const auto said = [](const std::string& properties) {
        return complaint_of(xyz_format(), "1\nProperties=" + properties + "\nH 1 2 3 4\n");
    };
    EXPECT_THAT(said("pos:R:3:species:S:1:q:R:1"), tells({"grains:3", "column 1 (x)", "\"H\""}));
    EXPECT_THAT(said("species:S:1:pos:R:3:bad:R:"), StartsWith("grains:2: "));
    EXPECT_THAT(said("species:S:1:pos:R:3:bad:F:1"), tells({"type \"F\"", "S, R, I or L"}));
    EXPECT_THAT(said("species:S:1:pos:R:3:bad:R:ff"), HasSubstr("\"ff\" columns"));
    EXPECT_THAT(said("species:S:1:pos:R:3:bad:R:0"), HasSubstr("\"0\" columns"));
    EXPECT_THAT(said("species:S:1:pos:R"), HasSubstr("name:type:columns"));
    EXPECT_THAT(said("species:S:1:place:R:3"), HasSubstr("no pos:R:3"));
    EXPECT_THAT(said("pos:R:3:pos:R:9"), tells({"pos 9 columns", "has 3"}));
    EXPECT_THAT(complaint_of(xyz_format(), "1\nLattice=\"1 0 0\n0 0\" Properties=pos:R:3\n1 2 3\n"),
                StartsWith("grains:"));
    EXPECT_THAT(complaint_of(xyz_format(), "1\nLattice=\"1 0 0 0\" Properties=pos:R:3\n1 2 3\n"),
                HasSubstr("grains:2: Lattice has 4 numbers"));
}

TEST(Xyz, ACutLastFrameIsLeftOut) {
    for (const std::string end :
         {"2", "2\n", "2\nwords\n", "2\n\nSt 1 2 3 4\n", "2\n\nSt 1 2 3 4\nSt 1 2", "1\n\nSt 1 2 3 0.1"}) {
        EXPECT_THAT(counts(xyz_format(), two_frames + end), ElementsAre(2, 1)) << end;
        EXPECT_THAT(news_of(xyz_format(), two_frames + end),
                    testing::AllOf(HasSubstr("last frame"), HasSubstr("left out")));
    }
    EXPECT_EQ(news_of(xyz_format(), two_frames + "\n  \n"), "");
}

TEST(Xyz, ALineWithoutEndIsTakenWhereItIsTheOnlyFrame) {
    EXPECT_THAT(counts(xyz_format(), "1\n\nSt 1 2 3"), ElementsAre(1));
    EXPECT_THAT(news_of(xyz_format(), "1\n\nSt 1 2 3"), tells({"last line", "no end"}));
}

TEST(Xyz, WithoutAWholeFrameTheFileIsRefused) {
    EXPECT_THAT(complaint_of(xyz_format(), "3\n\nSt 1 2 3\n"), tells({"no frame", "whole"}));
    EXPECT_THAT(complaint_of(xyz_format(), "1000000000\n\nSt 1 2 3\n"), tells({"no frame", "whole"}));
    EXPECT_THAT(complaint_of(xyz_format(), "99999999999999999999\n\nSt 1 2 3\n"), StartsWith("grains:1: "));
}

TEST(Xyz, WrongCountsAndColumnsAreToldWithTheirLine) {
    EXPECT_THAT(complaint_of(xyz_format(), "1\n\nSt 1 2 3\nSt 4 5 6\n1\n\nSt 1 2 3\n"),
                StartsWith("grains:4: the count of grains of a frame must stand here, not \"St 4 5 6\""));
    EXPECT_THAT(complaint_of(xyz_format(), "2\n\nSt 1 2 3\n1\n\nSt 1 2 3\n"),
                StartsWith("grains:4: row 2 of 2 has 1 column in place of 4; line 1 says 2 grains"));
    EXPECT_THAT(complaint_of(xyz_format(), "2\n\nSt 1 2 3\nSt 4 5 6 7\n"), StartsWith("grains:4: "));
    EXPECT_THAT(complaint_of(xyz_format(), "1\n\nSt 1 nan 3\n"),
                StartsWith("grains:3: the grain has no place: its y is \"nan\""));
    EXPECT_THAT(complaint_of(xyz_format(), "1\n\nSt 1 2 inf\n"),
                StartsWith("grains:3: the grain has no place"));
    EXPECT_THAT(complaint_of(xyz_format(), "2\n\nSt 1 2 3\nSt 1 2 3,5\n"),
                StartsWith("grains:4: column 4 (z) has \"3,5\", which is no number"));
}

TEST(Xyz, NumbersAreReadAsOtherProgramsWriteThem) {
    const RawFrame frame = frame_of(xyz_format(), "1\n\nSt +1.5 1d3 1e-400 -1.#IND\n");
    EXPECT_THAT(column(frame.grains, "x"), ElementsAre(1.5));
    EXPECT_THAT(column(frame.grains, "y"), ElementsAre(1000));
    EXPECT_THAT(column(frame.grains, "z"), ElementsAre(0));
    EXPECT_THAT(column(frame.grains, "c5"), ElementsAre(testing::IsNan()));
}

TEST(Xyz, GrowsByWholeFrames) {
    const OneFile file(two_frames + "2\n\nSt 1 2");
    const std::unique_ptr<RawFile> opened = xyz_format().open(file.path());
    EXPECT_FALSE(opened->grow());
    file.append(" 3 4\nSt 5 6 7");
    EXPECT_FALSE(opened->grow());
    file.append(" 8\n");
    EXPECT_TRUE(opened->grow());
    ASSERT_EQ(opened->moments().size(), 3u);
    EXPECT_THAT(column(opened->read(2).grains, "z"), ElementsAre(3, 7));
    file.write("1\n");
    EXPECT_THROW(opened->grow(), UserError);
}

TEST(Xyz, TakesWhatIsXyzAlone) {
    EXPECT_TRUE(takes(xyz_format(), two_frames));
    EXPECT_TRUE(takes(xyz_format(), "0\n\n2\n\nSt 1 2 3\n"));
    EXPECT_FALSE(takes(xyz_format(), "5\n"));
    EXPECT_FALSE(takes(xyz_format(), "1\nx,y\n1,2\n"));
    EXPECT_FALSE(takes(xyz_format(), "2 0 0 0 0 12 2 2\n-1 0 1 1 0 0 0.5 0 0 0 0 0 0 2\n"));
    EXPECT_FALSE(takes(xyz_format(), "7\nThe seventh line\nis a line of prose\n"));
}

}  // namespace
}  // namespace grainreel
