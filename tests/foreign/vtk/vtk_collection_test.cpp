// Tests of lists of VTK files: .pvd, .series and .vtm.
#include <sys/stat.h>

#include "tests/foreign/vtk/vtk_files.hpp"
#include "tests/support/tells.hpp"

namespace grainreel {
namespace {

using namespace vtk_test;
using test::tells;
using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;

// A file with one grain at x. Coding{} is text; the default is appended.
std::string grain(double x, const Coding& coding = {Form::appended_raw}) {
    XmlWriter writer(coding);
    return writer.file("PolyData", "<Piece NumberOfPoints=\"1\" NumberOfVerts=\"1\"><PointData>" +
                                       writer.array("Float64", "Name=\"radius\"", {1}) + "</PointData>" +
                                       writer.points({x, 0, 0}) + writer.cells("Verts", {0}, {1}) +
                                       "</Piece>");
}
std::string wall(double z) {
    XmlWriter writer({Form::base64, Packer::zlib});
    return writer.file("PolyData", "<Piece NumberOfPoints=\"3\" NumberOfPolys=\"1\">" +
                                       writer.points({0, 0, z, 1, 0, z, 0, 1, z}) +
                                       writer.cells("Polys", {0, 1, 2}, {3}) + "</Piece>");
}
std::string field() {
    return "<VTKFile type=\"ImageData\"><ImageData WholeExtent=\"0 1 0 1 0 1\"></ImageData></VTKFile>";
}

struct Named {
    std::string attributes, file;
};
std::string pvd(const std::vector<Named>& sets) {
    std::string text =
        "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"0.1\">\n<Collection>\n";
    for (const Named& set : sets)
        text += fmt::format("<DataSet {} file=\"{}\"/>\n", set.attributes, set.file);
    return text + "</Collection>\n</VTKFile>\n";
}

class Collections : public testing::Test {
  protected:
    Collections() {
        for (int i = 0; i < 4; ++i) {
            folder.write(fmt::format("g{}.vtp", i), grain(i));
            folder.write(fmt::format("w{}.vtp", i), wall(i));
        }
        folder.write("f0.vti", field());
    }
    std::unique_ptr<RawFile> open(const std::string& name, const std::string& text) const {
        return vtk_collection_format().open(folder.write(name, text));
    }
    std::string complaint_at(const std::string& name, const std::string& text) const {
        return complaint_of(vtk_collection_format(), folder.write(name, text));
    }
    static std::vector<double> times(const RawFile& file) {
        std::vector<double> all;
        for (const RawMoment& moment : file.moments()) all.push_back(moment.time.value_or(-1));
        return all;
    }
    // x of the first grain of each moment, or -1 without grains.
    static std::vector<double> grains(const RawFile& file) {
        std::vector<double> all;
        for (std::size_t i = 0; i < file.moments().size(); ++i) {
            const RawFrame frame = file.read(i);
            EXPECT_EQ(static_cast<std::int64_t>(frame.grains.rows), file.moments()[i].grains);
            EXPECT_EQ(!frame.walls.empty(), file.moments()[i].has_walls);
            all.push_back(frame.grains.rows == 0 ? -1 : column(frame.grains, "x")[0]);
        }
        return all;
    }

    Folder folder;
};

TEST_F(Collections, PartsOfOneTimeAreOneMoment) {
    const auto file = open("a.pvd", pvd({{"timestep=\"0\" part=\"0\"", "g0.vtp"},
                                         {"timestep=\"0.5\" part=\"0\"", "g1.vtp"},
                                         {"timestep=\"0\" part=\"1\" name=\"lid\"", "w0.vtp"},
                                         {"timestep=\"0.5\" part=\"1\" name=\"lid\"", "w1.vtp"}}));
    EXPECT_THAT(times(*file), ElementsAre(0, 0.5));
    EXPECT_THAT(grains(*file), ElementsAre(0, 1));
    const RawFrame second = file->read(1);
    ASSERT_EQ(second.walls.size(), 1u);
    EXPECT_EQ(second.walls[0].name, "lid");
    EXPECT_EQ(second.walls[0].mesh.vertices[0][2], 1);
    EXPECT_EQ(second.time, 0.5);
    EXPECT_TRUE(file->news().empty());
}

// A program on Windows writes paths like this.
TEST_F(Collections, BackslashesInNames) {
    std::filesystem::create_directory(folder.path() / "vtk");
    folder.write("vtk/g7.vtp", grain(7));
    const auto one = open("a.pvd", pvd({{"timestep=\"1\"", "vtk\\g7.vtp"}}));
    ASSERT_EQ(one->moments().size(), 1u);
    EXPECT_EQ(one->read(0).grains.find("x")->values.at(0), 7);
    // A file with exactly this name is preferred.
    folder.write("vtk\\g7.vtp", grain(3));
    EXPECT_EQ(open("b.pvd", pvd({{"timestep=\"1\"", "vtk\\g7.vtp"}}))->read(0).grains.find("x")->values.at(0),
              3);
}

// Hand-written lists give both files of a time the part 0.
TEST_F(Collections, FilesOfOneTimeAndPartWithOtherStems) {
    const auto file = open(
        "a.pvd", pvd({{"timestep=\"0\" part=\"0\"", "g0.vtp"}, {"timestep=\"0\" part=\"0\"", "w0.vtp"}}));
    ASSERT_EQ(file->moments().size(), 1u);
    EXPECT_TRUE(file->moments()[0].has_walls);
    EXPECT_EQ(file->moments()[0].grains, 1);
}

// After a restart a time may be written again.
TEST_F(Collections, TheLaterOfOneTimeCounts) {
    const auto file = open("a.pvd", pvd({{"timestep=\"0\"", "g0.vtp"},
                                         {"timestep=\"1\"", "g1.vtp"},
                                         {"timestep=\"1\"", "g3.vtp"},
                                         {"timestep=\"2\"", "g2.vtp"}}));
    EXPECT_THAT(times(*file), ElementsAre(0, 1, 2));
    EXPECT_THAT(grains(*file), ElementsAre(0, 3, 2));
    EXPECT_THAT(file->news(), ElementsAre(tells({"1 files", "again", "time"})));
}

TEST_F(Collections, WithoutTimes) {
    EXPECT_THAT(grains(*open("a.pvd", pvd({{"", "g2.vtp"}, {"", "g0.vtp"}}))), ElementsAre(2, 0));
    const auto parts = open("b.pvd", pvd({{"part=\"0\"", "g2.vtp"}, {"part=\"1\"", "g0.vtp"}}));
    EXPECT_EQ(parts->moments()[0].grains, 2);
    EXPECT_THAT(times(*parts), ElementsAre(-1));
    const auto kinds = open("c.pvd", pvd({{"", "g2.vtp"}, {"", "w0.vtp"}}));
    EXPECT_EQ(kinds->moments().size(), 1u);
}

TEST_F(Collections, FilesThatAreNotThereYet) {
    const std::vector<Named> sets{
        {"timestep=\"0\"", "g0.vtp"}, {"timestep=\"1\"", "g1.vtp"}, {"timestep=\"2\"", "g7.vtp"}};
    const auto file = open("a.pvd", pvd(sets));
    EXPECT_THAT(times(*file), ElementsAre(0, 1));
    EXPECT_THAT(file->news(),
                ElementsAre(AllOf(tells({"1 of the files", "not there"}), HasSubstr("g7.vtp"))));
    EXPECT_FALSE(file->grow());
    folder.write("g7.vtp", grain(7));
    EXPECT_TRUE(file->grow());
    EXPECT_THAT(grains(*file), ElementsAre(0, 1, 7));
    folder.write("a.pvd", pvd({{"timestep=\"0\"", "g1.vtp"}}));
    EXPECT_THAT(complaint([&] { file->grow(); }), HasSubstr("was replaced by another list"));
    EXPECT_THAT(complaint_at("b.pvd", pvd({{"timestep=\"2\"", "g9.vtp"}})),
                tells({"g9.vtp\"", "not there", "copy"}));
}

// A missing moment in the middle is left out; where only a wall is missing, the grains stay.
TEST_F(Collections, Holes) {
    const auto file = open("a.pvd", pvd({{"timestep=\"0\"", "g0.vtp"},
                                         {"timestep=\"1\"", "g8.vtp"},
                                         {"timestep=\"2\"", "g2.vtp"},
                                         {"timestep=\"2\"", "w9.vtp"},
                                         {"timestep=\"3\"", "g3.vtp"}}));
    EXPECT_THAT(times(*file), ElementsAre(0, 2, 3));
    EXPECT_THAT(grains(*file), ElementsAre(0, 2, 3));
}

TEST_F(Collections, ADamagedFileIsLeftOut) {
    folder.write("g2.vtp", grain(2, {}).substr(0, 200));
    const auto file = open("a.pvd", pvd({{"timestep=\"1\"", "g1.vtp"}, {"timestep=\"2\"", "g2.vtp"}}));
    EXPECT_THAT(times(*file), ElementsAre(1));
    EXPECT_THAT(file->news(), ElementsAre(HasSubstr("left out is")));
    EXPECT_THAT(complaint_at("b.pvd", pvd({{"timestep=\"2\"", "g2.vtp"}})), HasSubstr("g2.vtp:"));
}

TEST_F(Collections, GridsArePassedOver) {
    const auto file = open(
        "a.pvd", pvd({{"timestep=\"1\" part=\"0\"", "g1.vtp"}, {"timestep=\"1\" part=\"1\"", "f0.vti"}}));
    EXPECT_THAT(grains(*file), ElementsAre(1));
    EXPECT_THAT(file->news(), ElementsAre(tells({"\"f0.vti\"", "no grains", "passed over"})));
    EXPECT_THAT(complaint_at("b.pvd", pvd({{"timestep=\"1\"", "f0.vti"}})),
                HasSubstr("holds a grid, not grains"));
}

TEST_F(Collections, AListThatIsStillWritten) {
    const std::string whole = pvd({{"timestep=\"0\"", "g0.vtp"}, {"timestep=\"1\"", "g1.vtp"}});
    EXPECT_THAT(times(*open("a.pvd", whole.substr(0, whole.find("</Collection")))), ElementsAre(0, 1));
    EXPECT_THAT(times(*open("a.pvd", whole.substr(0, whole.find("g1.vtp")))), ElementsAre(0));
    EXPECT_THAT(complaint_at("a.pvd", whole.substr(0, whole.find("<DataSet"))), HasSubstr("names no files"));
}

std::string blocks(const std::string& inside) {
    return "<?xml version=\"1.0\"?>\n<VTKFile type=\"vtkMultiBlockDataSet\" "
           "version=\"1.0\">\n<vtkMultiBlockDataSet>\n" +
           inside + "</vtkMultiBlockDataSet>\n</VTKFile>\n";
}
std::string domain() {
    XmlWriter writer({});
    return writer.file("RectilinearGrid", "<Piece Extent=\"0 1 0 1 0 1\"><Coordinates>" +
                                              writer.array("Float64", "", {-1, 2}) +
                                              writer.array("Float64", "", {0, 4}) +
                                              writer.array("Float64", "", {1, 6}) + "</Coordinates></Piece>");
}

// The list is like those of dump custom/vtm of LIGGGHTS: timestep is the number of the frame.
TEST_F(Collections, LiggghtsBlocks) {
    folder.write("d/box.vtr", domain());
    folder.write("d/g.vtp", grain(5));
    folder.write("d/w.vtp", wall(3));
    const std::string box = "<DataSet index=\"2\" name=\"Domain\" file=\"d/box.vtr\"/>\n";
    const std::string all =
        "<DataSet index=\"1\" name=\"Particles\" file=\"d/g.vtp\"/>\n<Block index=\"3\" name=\"drum\">\n"
        "<DataSet index=\"0\" file=\"d/w.vtp\"/>\n</Block>\n" +
        box;
    const auto one = open("dump2000.vtm", blocks(all));
    EXPECT_EQ(one->facts().program, "LIGGGHTS");
    EXPECT_EQ(one->moments()[0].grains, 1);
    const RawFrame frame = one->read(0);
    ASSERT_EQ(frame.walls.size(), 1u);
    EXPECT_EQ(frame.walls[0].name, "drum");
    ASSERT_TRUE(frame.box.has_value());
    EXPECT_EQ(frame.box->origin, Vec3(-1, 0, 1));
    EXPECT_EQ(frame.box->edges[0] + frame.box->edges[1] + frame.box->edges[2], Vec3(3, 4, 5));

    folder.write("dump0.vtm", blocks(box));  // there are no grains yet
    std::string list =
        "<VTKFile type=\"Collection\" version=\"1.0\" byte_order=\"LittleEndian\" header_type=\"UInt64\">\n"
        "<Collection>\n<DataSet timestep=\"0\" part=\"0\" file=\"dump0.vtm\"/>\n"
        "<DataSet timestep=\"1\" part=\"0\" file=\"dump2000.vtm\"/>\n</Collection>\n</VTKFile>\n";
    const auto series = open("liggghts_simulation.pvd", list);
    EXPECT_EQ(series->facts().program, "LIGGGHTS");
    EXPECT_THAT(times(*series), ElementsAre(-1, -1));
    EXPECT_EQ(series->moments()[0].step, 0);
    EXPECT_EQ(series->moments()[1].step, 2000);
    EXPECT_EQ(series->moments()[0].grains, 0);
    // Values that are no numbers of frames are times.
    list.replace(list.find("timestep=\"1\""), 12, "timestep=\"0.1\"");
    EXPECT_THAT(times(*open("other.pvd", list)), ElementsAre(0, 0.1));
}

TEST_F(Collections, ListsWithoutAnEnd) {
    const std::string self = blocks("<DataSet index=\"0\" file=\"self.vtm\"/>\n");
    EXPECT_THAT(complaint_at("self.vtm", self), tells({"within lists", "without an end"}));
    ASSERT_EQ(::mkfifo((folder.path() / "pipe.vtp").c_str(), 0600), 0);
    EXPECT_THAT(complaint_at("a.pvd", pvd({{"timestep=\"0\"", "pipe.vtp"}})), HasSubstr("is not there"));
}

TEST_F(Collections, SeriesOfParaView) {
    const auto file = open("g.vtp.series",
                           "{\n \"file-series-version\" : \"1.0\",\n \"files\" : [\n"
                           "{ \"name\" : \"g1.vtp\", \"time\" : 0.25 },\n"
                           "{ \"name\" : \"g3.vtp\", \"time\" : 0.5 }\n]}\n");
    EXPECT_THAT(times(*file), ElementsAre(0.25, 0.5));
    EXPECT_THAT(grains(*file), ElementsAre(1, 3));
    EXPECT_THAT(complaint_at("g.vtp.series", "{\"file-series-version\":\"1.0\",\n\"files\":[\n,]}"),
                tells({"g.vtp.series:3", "no valid JSON"}));
    EXPECT_THAT(complaint_at("g.vtp.series", "{\"file-series-version\":\"1.0\"}"),
                HasSubstr("its list \"files\" is missing"));
    EXPECT_THAT(complaint_at("g.vtp.series", "{\"files\":[{\"name\":\"g1.vtp\"},{\"name\":3}]}"),
                tells({"entry 2", "\"files\"", "no \"name\""}));
}

// Another file of the same moment has other columns: missing values are NaN.
TEST_F(Collections, GrainsOfTwoFiles) {
    XmlWriter writer({});
    folder.write("h1.vtp",
                 writer.file("PolyData", "<Piece NumberOfPoints=\"1\"><PointData>" +
                                             writer.array("Float64", "Name=\"heat\"", {300}) +
                                             "</PointData>" + writer.points({9, 0, 0}) + "</Piece>"));
    const RawTable both =
        open("a.pvd", pvd({{"timestep=\"1\"", "g1.vtp"}, {"timestep=\"1\"", "h1.vtp"}}))->read(0).grains;
    EXPECT_THAT(column(both, "x"), ElementsAre(1, 9));
    EXPECT_EQ(column(both, "radius")[0], 1);
    EXPECT_TRUE(std::isnan(column(both, "radius")[1]));
    EXPECT_TRUE(std::isnan(column(both, "heat")[0]));
    EXPECT_EQ(column(both, "heat")[1], 300);
}

}  // namespace
}  // namespace grainreel
