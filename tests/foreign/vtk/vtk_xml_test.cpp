// Tests of the reader of VTK's XML files.
#include "tests/foreign/vtk/vtk_files.hpp"
#include "tests/support/tells.hpp"

namespace grainreel {
namespace {

using namespace vtk_test;
using test::tells;
using testing::ElementsAre;
using testing::HasSubstr;

RawFrame frame(const Folder& folder, const std::string& bytes) {
    return frame_in(vtk_xml_format(), folder.write("bed.vtp", bytes));
}

TEST(VtkXml, OneBedInEveryEncoding) {
    const Folder folder;
    int files = 0;
    for (const Form form : {Form::ascii, Form::base64, Form::appended_raw, Form::appended_base64})
        for (const Packer packer : {Packer::none, Packer::zlib, Packer::lz4})
            for (const bool big : {false, true})
                for (const bool wide : {false, true})
                    for (const bool poly : {false, true}) {
                        SCOPED_TRACE(fmt::format("form {} packer {} big {} wide {} poly {}",
                                                 static_cast<int>(form), static_cast<int>(packer), big, wide,
                                                 poly));
                        const auto file = folder.write("bed", bed_file({form, packer, big, wide}, poly));
                        const auto opened = vtk_xml_format().open(file);
                        ASSERT_EQ(opened->moments().size(), 1u);
                        EXPECT_EQ(opened->moments()[0].grains, static_cast<std::int64_t>(bed_grains));
                        EXPECT_FALSE(opened->moments()[0].has_walls);
                        expect_bed(opened->read(0).grains);
                        ++files;
                    }
    EXPECT_EQ(files, 96);
}

TEST(VtkXml, BlocksOfAnySize) {
    const Folder folder;
    for (const std::size_t block : {1u, 7u, 8u, 37u * 8u, 100000u}) {
        SCOPED_TRACE(block);
        expect_bed(frame(folder, bed_file({Form::base64, Packer::zlib, false, false, block}, true)).grains);
    }
}

TEST(VtkXml, EveryType) {
    const Folder folder;
    for (const char* type :
         {"Int8", "UInt8", "Int16", "UInt16", "Int32", "UInt32", "Int64", "UInt64", "Float32", "Float64"})
        for (const Form form : {Form::ascii, Form::appended_raw}) {
            SCOPED_TRACE(type);
            XmlWriter writer({form, Packer::none, true});
            const std::string piece = "<Piece NumberOfPoints=\"2\"><PointData>" +
                                      writer.array(type, "Name=\"k\"", {7, 100}) + "</PointData>" +
                                      writer.points({0, 0, 0, 1, 1, 1}) + "</Piece>";
            EXPECT_THAT(column(frame(folder, writer.file("PolyData", piece)).grains, "k"),
                        ElementsAre(7, 100));
        }
}

// This is the form of our export: types from 1, and their names as bytes with a 0 after each.
TEST(VtkXml, TypesThatHaveNames) {
    const Folder folder;
    const auto types = [&](const std::vector<double>& numbers, const std::string& names) {
        XmlWriter writer({});
        const std::string set =
            "<FieldData><Array type=\"String\" Name=\"species\" NumberOfTuples=\"2\" "
            "format=\"ascii\">" +
            names + "</Array></FieldData><Piece NumberOfPoints=\"2\"><PointData>" +
            writer.array("Int32", "Name=\"type\"", numbers) + "</PointData>" +
            writer.points({0, 0, 0, 1, 1, 1}) + "</Piece>";
        return *frame(folder, writer.file("PolyData", set)).grains.find("type");
    };
    const RawColumn named = types({2, 1}, "98 105 103 0 97 0 ");  // "big", "a"
    EXPECT_THAT(named.words, ElementsAre("big", "a"));
    EXPECT_THAT(named.values, ElementsAre(1, 0));
    // Wrong are a type without a name, a name without an end, a name that comes twice, a value that is no
    // byte, and no name at all.
    for (const char* names : {"98 0 ", "98 0 97", "98 0 98 0 ", "98 0 300 0 ", "98 0 0 ", ""}) {
        SCOPED_TRACE(names);
        const RawColumn plain = types({2, 1}, names);
        EXPECT_TRUE(plain.words.empty());
        EXPECT_THAT(plain.values, ElementsAre(2, 1));
    }
}

// VTK packs eight bits into a byte, the first one highest; the file is of VTK 9.1.
TEST(VtkXml, Bits) {
    const Folder folder;
    const std::string text =
        "<VTKFile type=\"PolyData\"><PolyData><Piece NumberOfPoints=\"8\"><PointData>"
        "<DataArray type=\"Bit\" Name=\"bits\" format=\"binary\">AQAAAJI=</DataArray></PointData><Points>"
        "<DataArray type=\"Float32\" NumberOfComponents=\"3\" format=\"ascii\">" +
        std::string("0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0") +
        "</DataArray></Points></Piece></PolyData></VTKFile>";
    EXPECT_THAT(column(frame(folder, text).grains, "bits"), ElementsAre(1, 0, 0, 1, 0, 0, 1, 0));
}

TEST(VtkXml, PointsWithoutCellsAreGrains) {
    const Folder folder;
    XmlWriter writer({});
    for (const char* counts : {"", "NumberOfVerts=\"0\"", "NumberOfCells=\"0\""}) {
        const std::string piece = fmt::format("<Piece NumberOfPoints=\"2\" {}>", counts) +
                                  writer.points({1, 2, 3, 4, 5, 6}, "") + "</Piece>";
        const std::string type =
            std::string(counts).starts_with("NumberOfC") ? "UnstructuredGrid" : "PolyData";
        const RawFrame read = frame(folder, writer.file(type, piece));
        EXPECT_THAT(column(read.grains, "x"), ElementsAre(1, 4));
        EXPECT_THAT(column(read.grains, "z"), ElementsAre(3, 6));
    }
}

TEST(VtkXml, PiecesFollowEachOther) {
    const Folder folder;
    XmlWriter writer({Form::appended_raw, Packer::lz4});
    std::string pieces;
    for (const double first : {0., 10.})
        pieces += "<Piece NumberOfPoints=\"2\"><PointData>" +
                  writer.array("Float64", "Name=\"radius\"", {first + 1, first + 2}) + "</PointData>" +
                  writer.points({first, 0, 0, first + 1, 0, 0}) +
                  "</Piece><Piece NumberOfPoints=\"0\"></Piece>";
    const RawFrame read = frame(folder, writer.file("PolyData", pieces));
    EXPECT_THAT(column(read.grains, "x"), ElementsAre(0, 1, 10, 11));
    EXPECT_THAT(column(read.grains, "radius"), ElementsAre(1, 2, 11, 12));
}

TEST(VtkXml, PiecesOfOtherColumnsAreRefused) {
    const Folder folder;
    XmlWriter writer({});
    const std::string one = writer.points({0, 0, 0}),
                      number = writer.array("Float64", "Name=\"radius\"", {1});
    const std::string text =
        writer.file("PolyData", "<Piece NumberOfPoints=\"1\"><PointData>" + number + "</PointData>" + one +
                                    "</Piece>\n<Piece NumberOfPoints=\"1\">" + one + "</Piece>");
    EXPECT_THAT(complaint_of(vtk_xml_format(), folder.write("two.vtp", text)),
                tells({"columns x, y, z, and", "before it", "x, y, z, radius"}));
}

// Cell data of vertices belong to the grains, in whatever order the vertices name the points.
TEST(VtkXml, CellDataOfVertices) {
    const Folder folder;
    XmlWriter writer({Form::base64});
    const std::string piece =
        "<Piece NumberOfPoints=\"4\" NumberOfVerts=\"2\" NumberOfPolys=\"1\"><CellData>" +
        writer.array("Int32", "Name=\"id\"", {70, 50, 9}) + "</CellData>" +
        writer.points({0, 0, 0, 1, 0, 0, 2, 0, 0, 3, 1, 0}) + writer.cells("Verts", {3, 1}, {1, 2}) +
        writer.cells("Polys", {0, 1, 3}, {3}) + "</Piece>";
    const RawFrame read = frame(folder, writer.file("PolyData", piece));
    EXPECT_THAT(column(read.grains, "x"), ElementsAre(1, 3));
    EXPECT_THAT(column(read.grains, "id"), ElementsAre(50, 70));
    ASSERT_EQ(read.walls.size(), 1u);
    EXPECT_THAT(column(read.walls[0].cells, "id"), ElementsAre(9));
}

TEST(VtkXml, Times) {
    const Folder folder;
    XmlWriter writer({Form::appended_base64, Packer::zlib});
    const std::string field =
        "<FieldData>" + writer.array("Float64", "Name=\"TimeValue\" NumberOfTuples=\"1\"", {2.5}) +
        "</FieldData><Piece NumberOfPoints=\"1\">" + writer.points({0, 0, 0}) + "</Piece>";
    EXPECT_EQ(frame(folder, writer.file("PolyData", field)).time, 2.5);
    XmlWriter plain({});
    const std::string piece = "<Piece NumberOfPoints=\"1\">" + plain.points({0, 0, 0}) + "</Piece>";
    std::string text = plain.file("PolyData", piece);
    EXPECT_EQ(frame(folder, text).time, std::nullopt);
    text.insert(text.find("<VTKFile"), "<!-- time 1.00013-->\n");  // MercuryDPM
    EXPECT_EQ(frame(folder, text).time, 1.00013);
    text.replace(text.find("time 1.00013"), 12, "Time =  0.75 sec. ");  // MFIX
    EXPECT_EQ(frame(folder, text).time, 0.75);
    text.replace(text.find("Time =  0.75"), 12, "times are rare");
    EXPECT_EQ(frame(folder, text).time, std::nullopt);
}

TEST(VtkXml, PiecesInFilesOfTheirOwn) {
    const Folder folder;
    XmlWriter writer({Form::appended_raw});
    const auto part = [&](double x) {
        XmlWriter own({Form::appended_raw});
        return own.file("PolyData", "<Piece NumberOfPoints=\"1\">" + own.points({x, 0, 0}) + "</Piece>");
    };
    folder.write("parts/a_0.vtp", part(4));
    folder.write("parts/a_1.vtp", part(5));
    const auto list =
        folder.write("a.pvtp", writer.file("PPolyData",
                                           "<Piece Source=\"parts/a_0.vtp\"/>\n<Piece Source=\"parts/"
                                           "a_1.vtp\"/>\n"));
    const auto opened = vtk_xml_format().open(list);
    EXPECT_EQ(opened->moments()[0].grains, 2);
    EXPECT_THAT(column(opened->read(0).grains, "x"), ElementsAre(4, 5));
    std::filesystem::remove(folder.path() / "parts/a_1.vtp");
    EXPECT_THAT(complaint_of(vtk_xml_format(), list),
                tells({"a.pvtp:5", "\"parts/a_1.vtp\"", "not there", "copy"}));
    folder.write("parts/a_1.vtp", writer.file("PPolyData", "<Piece Source=\"a_1.vtp\"/>"));
    EXPECT_THAT(complaint_of(vtk_xml_format(), list), HasSubstr("list of pieces"));
}

// MFIX and LIGGGHTS name a compressor although the numbers are text.
TEST(VtkXml, CompressorOfTextsDoesNotMatter) {
    const Folder folder;
    std::string text = bed_file({}, true);
    text.insert(text.find(" byte_order"), " compressor=\"vtkLZMADataCompressor\"");
    expect_bed(frame(folder, text).grains);
}

TEST(VtkXml, TakesWhatItReads) {
    const Folder folder;
    FileStart head;
    head.bytes = "<?xml version='1.0'?><VTKFile header_type=\"UInt64\" type='PolyData'>";
    EXPECT_TRUE(vtk_xml_format().takes(head));
    EXPECT_FALSE(vtk_collection_format().takes(head));
    head.bytes = "<VTKFile type=\"Collection\">";
    EXPECT_FALSE(vtk_xml_format().takes(head));
    EXPECT_TRUE(vtk_collection_format().takes(head));
    for (const char* other : {"", "<svg/>", "# vtk DataFile Version 3.0", "id,x,y,z"}) {
        head.bytes = other;
        EXPECT_FALSE(vtk_xml_format().takes(head)) << other;
        EXPECT_FALSE(vtk_collection_format().takes(head)) << other;
    }
}

}  // namespace
}  // namespace grainreel
