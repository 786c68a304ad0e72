// Tests of the reader of tables of numbers: CSV, and columns between blanks.
#include "tests/foreign/small_files.hpp"
#include "tests/support/tells.hpp"

namespace grainreel {

RawFormat number_table_format();

namespace {

using namespace small_files;
using test::tells;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::StartsWith;

RawTable table_of(std::string_view bytes) {
    return frame_of(number_table_format(), bytes).grains;
}

TEST(NumberTable, SeparatorsAreFound) {
    for (const std::string bytes :
         {"x,y,z\n1,2,3\n4,5,6.5\n", "x;y;z\n1;2;3\n4;5;6,5\n", "x\ty\tz\n1\t2\t3\n4\t5\t6.5\n",
          "x  y z\n 1 2   3\n4 5 6.5\n", "x, y, z\n1, 2, 3\n4, 5, 6.5\n",
          "\xef\xbb\xbfx;y;z;\r\n1;2;3;\r\n4;5;6,5;\r\n", "# x y z\n1 2 3\n4 5 6.5\n"}) {
        ASSERT_TRUE(takes(number_table_format(), bytes)) << bytes;
        const RawTable table = table_of(bytes);
        EXPECT_THAT(names(table), ElementsAre("x", "y", "z")) << bytes;
        EXPECT_THAT(column(table, "z"), ElementsAre(3, 6.5)) << bytes;
        EXPECT_EQ(news_of(number_table_format(), bytes), "");
    }
}

TEST(NumberTable, NamesOfParaViewBecomePlaces) {
    const RawTable table = table_of("\"v:0\",\"v:1\",\"Points:0\",\"Points:1\",\"Points:2\"\n1,2,3,4,5\n");
    EXPECT_THAT(names(table), ElementsAre("v:0", "v:1", "x", "y", "z"));
}

TEST(NumberTable, UnitsStayInNames) {
    const RawTable table = table_of("Position X (mm);Y [mm];r\n1,5;2;3\n");
    EXPECT_THAT(names(table), ElementsAre("Position X (mm)", "Y [mm]", "r"));
    EXPECT_THAT(column(table, "Position X (mm)"), ElementsAre(1.5));
}

TEST(NumberTable, ARowOfUnitsGoesToTheNames) {
    for (const std::string bytes : {"x,y,r,n\nmm,mm,m,-\n1,2,3,4\n", "x,y,r,n\n[mm],(mm),[m],\n1,2,3,4\n"}) {
        const RawTable table = table_of(bytes);
        EXPECT_THAT(names(table), ElementsAre("x [mm]", "y [mm]", "r [m]", "n")) << bytes;
        EXPECT_THAT(column(table, "y [mm]"), ElementsAre(2)) << bytes;
    }
    EXPECT_THAT(names(table_of("x,y,t\nMM,inch,min\n1,2,3\n")), ElementsAre("x [MM]", "y [inch]", "t [min]"));
    // These are materials with names like units.
    EXPECT_THAT(words(table_of("kind,x,y\nm,1,2\ns,3,4\n"), "kind"), ElementsAre("m", "s"));
    EXPECT_THAT(words(table_of("kind,x,y,z\nb,1,1,1\na,3,4,5\n"), "kind"), ElementsAre("b", "a"));
}

TEST(NumberTable, AWordAmongPlacesIsAMistakeInItsRow) {
    EXPECT_THAT(complaint_of(number_table_format(), "x,y,q\n1,2,3\n1,abc,3\n4,5,6\n7,8,9\n"),
                StartsWith("grains:3: column 2 (y) has \"abc\", which is no number"));
    EXPECT_THAT(words(table_of("x,y,kind\n1,2,3\n1,2,a\n4,5,6\n7,8,9\n"), "kind"),
                ElementsAre("3", "a", "6", "9"));
}

TEST(NumberTable, MeasuresOfOursAreNoGrains) {
    EXPECT_THAT(complaint_of(number_table_format(), "step,time_s,cycles,height_difference\n0,0,0,0.5\n"),
                tells({"table of measures", "holds no grains"}));
}

TEST(NumberTable, AnIndexWithoutANameIsNumbered) {
    EXPECT_THAT(names(table_of(",x,y\n0,1,2\n1,3,4\n")), ElementsAre("c1", "x", "y"));
}

TEST(NumberTable, WordsStayWords) {
    const RawTable table = table_of("kind,x,y,q\n\"St, grey\",1,2,3\nGl,3,4,\n");
    EXPECT_THAT(words(table, "kind"), ElementsAre("St, grey", "Gl"));
}

TEST(NumberTable, MissingCellsAreNoNumbersButNotInPlaces) {
    EXPECT_THAT(column(table_of("x,y,q\n1,2,\n3,4,NA\n"), "q"),
                ElementsAre(testing::IsNan(), testing::IsNan()));
    EXPECT_THAT(complaint_of(number_table_format(), "x [mm],y,q\n1,2,3\n,4,5\n"),
                StartsWith("grains:3: the grain has no place: its x [mm] is \"\""));
    EXPECT_THAT(complaint_of(number_table_format(), "x,y,q\n1,nan,3\n"), StartsWith("grains:2: "));
}

TEST(NumberTable, YadeSaysItsFormat) {
    const RawTable table = table_of("#format x_y_z_r_matId\n1\t2\t3\t0.5\t7\n");
    EXPECT_THAT(names(table), ElementsAre("x", "y", "z", "r", "matId"));
    EXPECT_THAT(names(table_of("#format x_y_z_r_attrs\n1\t2\t3\t0.5\t7\t8\n")),
                ElementsAre("x", "y", "z", "r", "attrs", "c6"));
}

TEST(NumberTable, FourNamelessColumnsAreSpheresWhereTheFourthIsSmall) {
    const std::string spheres = "0,0,0,0.1\n1,0,0,0.2\n", others = "0,0,0,3\n1,0,0,4\n";
    EXPECT_THAT(names(table_of(spheres)), ElementsAre("x", "y", "z", "radius"));
    EXPECT_THAT(news_of(number_table_format(), spheres), HasSubstr("x, y, z, radius"));
    EXPECT_THAT(names(table_of(others)), ElementsAre("c1", "c2", "c3", "c4"));
    EXPECT_THAT(news_of(number_table_format(), others), HasSubstr("--columns"));
    EXPECT_THAT(names(table_of("0,0,0\n1,0,0\n")), ElementsAre("c1", "c2", "c3"));
}

const std::string long_table =
    "id,time,x,y,step\n"
    "1,0.5,10,0,50\n"
    "1,0,11,0,0\n"
    "2,0.5,12,0,50\n"
    "2,0,13,0,0\n"
    "3,0.5,14,0,50\n";

TEST(NumberTable, RowsOfOneTimeMakeAFrame) {
    EXPECT_THAT(counts(number_table_format(), long_table), ElementsAre(2, 3));
    const RawFrame second = frame_of(number_table_format(), long_table, 1);
    EXPECT_EQ(second.time, 0.5);
    EXPECT_EQ(second.step, 50);
    EXPECT_THAT(column(second.grains, "x"), ElementsAre(10, 12, 14));
}

TEST(NumberTable, TimesMayHaveAUnit) {
    EXPECT_DOUBLE_EQ(*frame_of(number_table_format(), "time [ms],x,y\n20,1,2\n").time, 0.02);
    EXPECT_DOUBLE_EQ(*frame_of(number_table_format(), "time (h),x,y\n20,1,2\n").time, 72000);
    EXPECT_DOUBLE_EQ(*frame_of(number_table_format(), "time (mm),x,y\n20,1,2\n").time, 20);  // no time
    EXPECT_FALSE(frame_of(number_table_format(), "T,x,y\n20,1,2\n").time.has_value());  // T is a temperature
    EXPECT_EQ(frame_of(number_table_format(), "Frame,x,y\n7,1,2\n").step, 7);
}

TEST(NumberTable, ACutLastFrameIsLeftOut) {
    for (const std::string end : {"3,1.5,1,2,5", "3,1.5,1"}) {
        EXPECT_THAT(counts(number_table_format(), long_table + end), ElementsAre(2, 3));
        EXPECT_THAT(news_of(number_table_format(), long_table + end),
                    testing::AllOf(HasSubstr("last frame"), HasSubstr("left out")));
    }
    EXPECT_THAT(complaint_of(number_table_format(), "x,y,z\n1,2,3\n4,5"),
                StartsWith("grains:3: the file ends within"));
}

TEST(NumberTable, ChangingColumnsAreToldWithTheirLine) {
    EXPECT_THAT(complaint_of(number_table_format(), long_table + "1,2,3\n4,5,6,7,8\n"),
                HasSubstr("no table"));
    std::string many = "x,y\n";
    for (int i = 0; i < 100; ++i) many += "1,2\n";
    EXPECT_THAT(complaint_of(number_table_format(), many + "1,2,3\n"),
                StartsWith("grains:102: this row has 3 columns in place of 2"));
    EXPECT_THAT(complaint_of(number_table_format(), many + "1,two\n"),
                StartsWith("grains:102: column 2 (y) has \"two\", which is no number"));
}

TEST(NumberTable, ATableOfNoGrainsIsAFrame) {
    EXPECT_THAT(counts(number_table_format(), "x,y,z,radius\n"), ElementsAre(0));
}

TEST(NumberTable, TakesTablesAlone) {
    for (const std::string bytes :
         {"", "\n\n", "Once upon a time\nthere were two grains\n", "title = \"a\"\n[drum]\nspeed = 3\n",
          "{\"x\": 1, \"y\": 2}\n", "int main() {\n    return 0;\n}\n", "v 1 2 3\nv 4 5 6\nf 1 2 3\n",
          "ITEM: TIMESTEP\n0\nITEM: NUMBER OF ATOMS\n1\n", "solid a\nfacet normal 0 0 1\nouter loop\n",
          "name,word\na,b\n", "1\n2\n3\n"})
        EXPECT_FALSE(takes(number_table_format(), bytes)) << bytes;
    EXPECT_FALSE(takes(number_table_format(), std::string_view("x,y\n1,2\0\n", 9)));
}

}  // namespace
}  // namespace grainreel
