// Tests of VTK files that are damaged or cut.
#include "tests/foreign/vtk/vtk_files.hpp"
#include "tests/support/tells.hpp"

namespace grainreel {
namespace {

using namespace vtk_test;
using test::tells;
using testing::AnyOf;
using testing::HasSubstr;

std::string xml_complaint(const Folder& folder, const std::string& bytes) {
    return complaint_of(vtk_xml_format(), folder.write("x.vtu", bytes));
}
std::string legacy_complaint(const Folder& folder, const std::string& bytes) {
    return complaint_of(vtk_legacy_format(), folder.write("x.vtk", bytes));
}

std::string with(std::string text, const std::string& what, const std::string& by) {
    const std::size_t at = text.find(what);
    EXPECT_NE(at, std::string::npos) << what;
    return at == std::string::npos ? text : text.replace(at, what.size(), by);
}

// A file that ends anywhere is refused, unless only closing tags are missing.
TEST(DamagedVtk, CutAnywhere) {
    const Folder folder;
    for (const Form form : {Form::ascii, Form::base64, Form::appended_raw, Form::appended_base64})
        for (const Packer packer : {Packer::none, Packer::zlib}) {
            const std::string whole = bed_file({form, packer}, false);
            const std::size_t appended = whole.rfind("\n</AppendedData>");
            int refused = 0;
            for (std::size_t size = 60; size < whole.size(); size += 41) {
                const std::string message = xml_complaint(folder, whole.substr(0, size));
                const bool all = size >= appended;
                // Fill bits at the end of base64 may also be missing.
                if (message == "no complaint")
                    EXPECT_TRUE(all || size + 8 > whole.find("</VTKFile>")) << size << " of " << whole.size();
                else
                    EXPECT_THAT(message, HasSubstr("x.vtu:")) << size;
                refused += message != "no complaint";
            }
            EXPECT_GT(refused, 40);
        }
}

// Any byte may change: the file is read or refused, and nothing else happens.
TEST(DamagedVtk, OtherBytes) {
    const Folder folder;
    for (const Form form : {Form::base64, Form::appended_raw})
        for (const Packer packer : {Packer::none, Packer::zlib, Packer::lz4}) {
            const std::string whole = bed_file({form, packer}, true);
            for (std::size_t at = 30; at < whole.size(); at += 61)
                for (const char other : {'\0', '9', '\xff', '<'}) {
                    std::string text = whole;
                    text[at] = other;
                    xml_complaint(folder, text);
                }
        }
}

// Counts are believed only if the file can hold so many values.
TEST(DamagedVtk, ClaimsOfMore) {
    const Folder folder;
    const std::string text = bed_file({}, false);
    EXPECT_THAT(xml_complaint(folder, with(text, "NumberOfPoints=\"37\"", "NumberOfPoints=\"1000000000\"")),
                tells({"3000000000 numbers", "too short"}));
    EXPECT_THAT(xml_complaint(folder, with(text, "NumberOfPoints=\"37\"", "NumberOfPoints=\"38\"")),
                tells({"\"Points\"", "111", "114"}));
    EXPECT_THAT(xml_complaint(folder, with(text, "NumberOfPoints=\"37\"", "NumberOfPoints=\"36\"")),
                tells({"cell 36", "point 36", "36, from 0"}));
    EXPECT_THAT(xml_complaint(folder, with(text, "NumberOfPoints=\"37\"", "NumberOfPoints=\"-1\"")),
                HasSubstr("x.vtu:4: NumberOfPoints=\"-1\" is no count"));
    XmlWriter writer({});
    const std::string more = "<Piece NumberOfPoints=\"1\">" + writer.points({0, 1, 2, 3}) + "</Piece>";
    EXPECT_THAT(xml_complaint(folder, writer.file("PolyData", more)), tells({"more numbers", "the 3 that"}));
    const std::string bomb = with(bed_file({Form::appended_raw, Packer::none}, true), "NumberOfPoints=\"37\"",
                                  "NumberOfPoints=\"99999999999\"");
    EXPECT_THAT(xml_complaint(folder, bomb), HasSubstr("where its numbers take"));
}

// A block claims more bytes than its compressed bytes can give.
TEST(DamagedVtk, BlocksThatCannotBe) {
    const Folder folder;
    const auto file = [&](const std::vector<std::uint64_t>& head, const std::string& data) {
        const Coding coding{Form::base64, Packer::zlib, false, true};
        XmlWriter writer(coding);
        return writer.file("PolyData",
                           "<Piece NumberOfPoints=\"100000000\"><Points><DataArray type=\"Float32\" "
                           "NumberOfComponents=\"3\" format=\"binary\">" +
                               base64(header(head, coding)) + base64(data) + "</DataArray></Points></Piece>");
    };
    EXPECT_THAT(xml_complaint(folder, file({1, 1'200'000'000, 0, 20}, std::string(20, 'x'))),
                tells({"block 1", "1200000000 bytes", "20 compressed", "more than"}));
    EXPECT_THAT(xml_complaint(folder, file({1, 1'200'000'000, 0, 2'000'000'000}, std::string(20, 'x'))),
                tells({"block 1", "compressed data", "beyond the end"}));
    EXPECT_THAT(xml_complaint(folder, file({std::uint64_t{1} << 61, 8, 0, 20}, std::string(20, 'x'))),
                tells({"compressed blocks", "cannot hold"}));
}

TEST(DamagedVtk, Encodings) {
    const Folder folder;
    const std::string raw = bed_file({Form::appended_raw}, true), text = bed_file({Form::base64}, true);
    EXPECT_THAT(xml_complaint(folder, with(raw, "offset=\"0\"", "offset=\"99999\"")),
                tells({"begins at 99999", "end at"}));
    EXPECT_THAT(xml_complaint(folder, with(raw, "encoding=\"raw\"", "encoding=\"hex\"")),
                tells({"appended data", "\"hex\"", "not read"}));
    EXPECT_THAT(xml_complaint(folder, with(text, "format=\"binary\"", "format=\"appended\"")),
                HasSubstr("its appended data are missing"));
    const std::size_t letter = text.find("format=\"binary\"") + 40;
    std::string odd = text;
    odd[letter] = '!';
    EXPECT_THAT(xml_complaint(folder, odd), HasSubstr("array \"radius\": \"!\" within base64"));
    odd[letter] = '=';
    EXPECT_THAT(xml_complaint(folder, odd), HasSubstr("x.vtu:"));
    for (const auto& [word, why] : std::vector<std::pair<std::string, std::string>>{
             {"vtkLZMADataCompressor",
              "is compressed with LZMA, which is not read; write the file with ZLib or LZ4"},
             {"vtkOtherCompressor", "is compressed with \"vtkOtherCompressor\", which is not read"}})
        EXPECT_THAT(
            xml_complaint(folder, with(text, " byte_order", " compressor=\"" + word + "\" byte_order")),
            HasSubstr(why));
    EXPECT_THAT(xml_complaint(folder, with(text, "LittleEndian", "MiddleEndian")),
                HasSubstr("byte_order=\"MiddleEndian\""));
    EXPECT_THAT(xml_complaint(folder, with(text, " byte_order", " header_type=\"UInt16\" byte_order")),
                HasSubstr("header_type=\"UInt16\""));
    EXPECT_THAT(xml_complaint(folder, with(text, "Float64", "Float80")),
                HasSubstr("numbers of type \"Float80\""));
}

TEST(DamagedVtk, PlacesThatAreNone) {
    const Folder folder;
    const double nan = std::nan("");
    for (const Form form : {Form::ascii, Form::base64, Form::appended_raw}) {
        XmlWriter writer({form});
        const std::string piece =
            "<Piece NumberOfPoints=\"2\">\n" + writer.points({0, 1, 2, 3, nan, 5}) + "</Piece>";
        EXPECT_THAT(xml_complaint(folder, writer.file("PolyData", piece)),
                    AnyOf(tells({"x.vtu:7", "place", "no number"}),
                          tells({"x.vtu:6", "\"Points\"", "number 5", "nan", "no place"})));
    }
    const std::string head = "# vtk DataFile Version 3.0\nx\nASCII\nDATASET POLYDATA\nPOINTS 2 float\n";
    EXPECT_THAT(legacy_complaint(folder, head + "0 0 0\n1 -1.#IND 0\n"),
                tells({"x.vtk:7", "place", "no number", "remove"}));
    EXPECT_THAT(legacy_complaint(folder, head + "0 0 0\n1 inf 0\n"), HasSubstr("x.vtk:7: "));
    EXPECT_THAT(legacy_complaint(folder, head + "0 0 0\n1 no 0\n"), tells({"x.vtk:7", "\"no\"", "4 of 6"}));
    const std::string binary = with(head, "ASCII", "BINARY");
    EXPECT_THAT(
        legacy_complaint(folder, binary + bytes_of_numbers("Float32", {0, 1, 2, 3, nan, 5}, true) + "\n"),
        HasSubstr(fmt::format("x.vtk: byte {}: a place that is no number", binary.size() + 16)));
}

TEST(DamagedVtk, CellsThatNameNoPoints) {
    const Folder folder;
    XmlWriter writer({});
    const auto file = [&](const std::vector<double>& corners, const std::vector<double>& ends) {
        return writer.file("PolyData",
                           fmt::format("<Piece NumberOfPoints=\"3\" NumberOfPolys=\"{}\">", ends.size()) +
                               writer.points({0, 0, 0, 1, 0, 0, 0, 1, 0}) +
                               writer.cells("Polys", corners, ends) + "</Piece>");
    };
    EXPECT_EQ(xml_complaint(folder, file({0, 1, 2}, {3})), "no complaint");
    EXPECT_THAT(xml_complaint(folder, file({0, 1, 3}, {3})), tells({"cell 0", "point 3", "3, from 0"}));
    EXPECT_THAT(xml_complaint(folder, file({0, 1, -1}, {3})), HasSubstr("cell 0 names point -1"));
    EXPECT_THAT(xml_complaint(folder, file({0, 1, 2}, {4})), tells({"3 numbers", "the 4 that"}));
    EXPECT_THAT(xml_complaint(folder, file({0, 1, 2, 0, 1, 2}, {6, 3})), HasSubstr("offset 3 after 6"));
    EXPECT_THAT(xml_complaint(folder, file({0, 1, 2}, {-3})), HasSubstr("offset -3 after 0"));
}

TEST(DamagedVtk, CellsWhoseSurfaceIsNotRead) {
    const Folder folder;
    const auto cell = [&](const std::string& list, int size, int type) {
        return legacy_complaint(
            folder,
            fmt::format(
                "# vtk DataFile Version 3.0\nx\nASCII\nDATASET UNSTRUCTURED_GRID\nPOINTS 8 float\n0 0 0 1 0 "
                "0 1 1 0 0 1 0 0 0 1 1 0 1 1 1 1 0 1 1\nCELLS 1 {}\n{}\nCELL_TYPES 1\n{}\n",
                size, list, type));
    };
    EXPECT_THAT(cell("6 0 1 2 3 4 5", 7, 22), tells({"cell 0", "type 22", "not read", "triangles"}));
    EXPECT_THAT(cell("8 0 1 2 3 4 5 6 7", 9, 11), tells({"cell 0", "hexahedron", "grid"}));
    EXPECT_THAT(cell("4 0 1 2 3", 5, 5), tells({"cell 0", "4 corners", "type 5 has 3"}));
    EXPECT_THAT(cell("5 1 9 0 1 2", 6, 42), tells({"cell 0", "polyhedron", "wrong faces"}));
    EXPECT_THAT(cell("5 1 3 0 1 8", 6, 42), tells({"cell 0", "polyhedron", "wrong faces"}));
}

TEST(DamagedVtk, LegacyCounts) {
    const Folder folder;
    const std::string head = "# vtk DataFile Version 3.0\nx\nASCII\nDATASET POLYDATA\n";
    const std::string points = "POINTS 2 float\n0 0 0\n1 1 1\n";
    const std::vector<std::pair<std::string, std::string>> wrong{
        {"POINTS 1000000000 float\n0 0 0\n",
         "x.vtk:5: 3000000000 numbers, for which the rest of the file is too short"},
        {"POINTS 3 float\n0 0 0\n1 1 1\n2 2", "after 8 of 9 numbers"},
        {"POINTS 1 float\n0 0 0\n1 1 1\n", "x.vtk:7: a number, 1, after the last that must stand here"},
        {points + "POINT_DATA 3\n", "x.vtk:8: 3 rows of data, and there are 2 points"},
        {points + "POINT_DATA 2\nFIELD f 1\nr 1 3 float\n1 2 3\n", "array \"r\" has 3 rows, where 2 must be"},
        {points + "POINT_DATA 2\nFIELD f 2\nr 1 2 float\n1 2\n", "the file ends after 1 of 2 arrays"},
        {points + "POINT_DATA 2\nSCALARS r float\nLOOKUP_TABLE default\n1\nVECTORS v float\n0 0 0 0 0 0\n",
         "x.vtk:12: \"VECTORS\" after 1 of 2 numbers"},
        {points + "VERTICES 2 4\n1 0 2 1\n", "cell 1 of 2 has no place in a list of 4 numbers"},
        {points + "VERTICES 1 4\n1 0 1 1\n", "2 numbers are left behind its 1 cells"},
        {points + "VERTICES 3 2\nOFFSETS vtktypeint64\n0 2 1\nCONNECTIVITY vtktypeint64\n0 1\n",
         "must rise from 0 to 2"},
        {points + "SCALARS r float\n1 2\n", "SCALARS before POINT_DATA or CELL_DATA"},
        {points + "POINT_DATA 2\nSCALARS r quad\n1 2\n", "numbers of type \"quad\""},
        {points + "GRAINS 2\n", "x.vtk:8: \"GRAINS\" is no keyword of a VTK file"}};
    for (const auto& [text, why] : wrong)
        EXPECT_THAT(legacy_complaint(folder, head + text), HasSubstr(why)) << text;
    EXPECT_THAT(legacy_complaint(folder, "# vtk DataFile Version 3.0\nx\nASCII\n"),
                HasSubstr("ends before DATASET"));
    EXPECT_THAT(legacy_complaint(folder, "# vtk DataFile Version 3.0\nx\nASCII\nDATASET TABLE\n"),
                tells({"\"TABLE\"", "not read"}));
    const std::string binary = with(head, "ASCII", "BINARY");
    EXPECT_THAT(legacy_complaint(folder, binary + "POINTS 1000000000 float\n0123"),
                tells({"12000000000 bytes", "4 are left"}));
}

TEST(DamagedVtk, XmlThatIsNone) {
    const Folder folder;
    EXPECT_THAT(xml_complaint(folder, "<VTKFile type=\"ImageData\"><ImageData/></VTKFile>"),
                tells({"x.vtu:1", "grid", "ImageData"}));
    EXPECT_THAT(xml_complaint(folder, "<VTKFile type=\"Table\"><Table/></VTKFile>"),
                tells({"\"Table\"", "not read"}));
    EXPECT_THAT(xml_complaint(folder, "<VTKFile type=\"PolyData\">\n<PolyData>\n</Piece></VTKFile>"),
                tells({"x.vtu:3", "no valid XML", "mismatched tag"}));
    EXPECT_THAT(xml_complaint(folder, "<!DOCTYPE a [<!ENTITY b \"c\">]><VTKFile type=\"PolyData\"/>"),
                tells({"document type", "not read"}));
    std::string deep = "<VTKFile type=\"PolyData\">";
    for (int i = 0; i < 100000; ++i) deep += "<a>";
    EXPECT_THAT(xml_complaint(folder, deep), HasSubstr("elements within elements"));
}

}  // namespace
}  // namespace grainreel
