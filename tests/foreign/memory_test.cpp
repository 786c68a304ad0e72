// How much memory the readers take for packed files that unpack to much more than the frame in them needs.
#include <gmock/gmock.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdint>
#include <fstream>
#include <functional>
#include <string>

#include "engine/base/error.hpp"
#include "engine/files/foreign/raw_series.hpp"
#include "tests/foreign/dumps/dump_files.hpp"

namespace grainreel {
namespace {

constexpr std::int64_t kMegabyte = 1 << 20;

// A figure of this process in bytes (man 5 proc), as VmRSS.
std::int64_t figure(const std::string& wanted) {
    std::ifstream status("/proc/self/status");
    for (std::string name; status >> name; std::getline(status, name)) {
        std::int64_t kilobytes = 0;
        if (name == wanted + ":" && status >> kilobytes) return 1024 * kilobytes;
    }
    return 0;
}

// How much more memory a process holds at most while it does the work. A child does it.
std::int64_t peak_growth(const std::function<void()>& work) {
    int ends[2];
    EXPECT_EQ(::pipe(ends), 0);
    const pid_t child = ::fork();
    if (child == 0) {
        std::ofstream("/proc/self/clear_refs") << "5";  // the peak is the present size
        const std::int64_t before = figure("VmRSS");
        try {
            work();
        } catch (const UserError&) {  // it may be refused
        }
        const std::int64_t growth = figure("VmHWM") - before;
        const bool written = ::write(ends[1], &growth, sizeof growth) == sizeof growth;
        ::_exit(written ? 0 : 1);
    }
    ::close(ends[1]);
    std::int64_t growth = -1;
    EXPECT_EQ(::read(ends[0], &growth, sizeof growth), static_cast<ssize_t>(sizeof growth));
    ::close(ends[0]);
    int status = 0;
    ::waitpid(child, &status, 0);
    EXPECT_EQ(status, 0);
    return growth;
}

// head, then 68 times `piece` repeated to a megabyte, then tail, packed by gzip.
std::string bomb(const std::string& head, const std::string& piece, const std::string& tail) {
    std::string megabyte;
    while (megabyte.size() < static_cast<std::size_t>(kMegabyte)) megabyte += piece;
    const std::string packed = gzip_of(megabyte);
    std::string all = gzip_of(head);
    for (int k = 0; k < 68; ++k) all += packed;
    return all + gzip_of(tail);
}

const std::string kArray =
    "<Points><DataArray type=\"Float64\" NumberOfComponents=\"3\" format=\"ascii\">0 0 0";
const std::string kPoly = "<VTKFile type=\"PolyData\"><PolyData>";
const std::string kPiece = "<Piece NumberOfPoints=\"1\">";
const std::string kEnd = "</DataArray></Points></Piece></PolyData></VTKFile>";
const std::string kLegacy = "# vtk DataFile Version 3.0\nt\nASCII\nDATASET POLYDATA\nPOINTS 1 float\n0 0 0\n";

TEST(Memory, OfAPackedFileIsThatOfItsFrame) {
    const std::vector<std::pair<std::string, std::string>> files = {
        {"blank.vtp", bomb(kPoly + kPiece + kArray, " ", kEnd)},
        {"comment.vtp", bomb(kPoly + "<!-- ", "x", "-->" + kPiece + kArray + kEnd)},
        {"attribute.vtp",
         bomb("<VTKFile type=\"PolyData\" a=\"", "x", "\"><PolyData>" + kPiece + kArray + kEnd)},
        {"elements.vtp", bomb(kPoly, "<a b=\"\"/>", "</PolyData></VTKFile>")},
        {"claim.vtp", bomb(kPoly + "<Piece NumberOfPoints=\"40000000\">" + kArray, " ", kEnd)},
        {"base64.vtp", bomb(kPoly + "<Piece NumberOfPoints=\"1\"><Points><DataArray type=\"Float64\" "
                                    "NumberOfComponents=\"3\" format=\"binary\">",
                            " ", kEnd)},
        {"list.pvd", bomb("<VTKFile type=\"Collection\"><Collection>", " ", "</Collection></VTKFile>")},
        {"blank.vtk", bomb(kLegacy, " ", "")},
        {"claim.vtk",
         bomb("# vtk DataFile Version 3.0\nt\nASCII\nDATASET POLYDATA\nPOINTS 40000000 float\n", " ", "")},
        {"metadata.vtk", bomb(kLegacy + "METADATA\n", "a\n", "")},
        {"bytes.vtk",
         bomb("# vtk DataFile Version 3.0\nt\nBINARY\nDATASET POLYDATA\nPOINTS 1 float\n", " ", "")},
        {"line.dump", bomb(frame_text("0", "1", "id x y z", "1 0 0 0"), " ", "\n")},
        {"columns.dump",
         bomb("ITEM: TIMESTEP\n0\nITEM: NUMBER OF ATOMS\n1\nITEM: BOX BOUNDS pp pp ff\n0 1\n0 1\n"
              "0 1\nITEM: ATOMS id",
              " x", "\n1\n")},
        {"blank.obj", bomb("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n", " ", "")},
        {"blank.csv", bomb("id,x,y,z,radius\n1,0,0,0,0.1\n", "\n", "")},
    };
    const test::TemporaryFolder folder;
    for (const auto& [name, content] : files) {
        const auto file = folder.write_old(name, content);
        const std::int64_t growth = peak_growth([&file = file] {
            const RawFormat* const format = raw_format_of(file);
            ASSERT_NE(format, nullptr) << file;
            const std::unique_ptr<RawFile> raw = format->open(file);
            for (std::size_t k = 0; k < raw->moments().size(); ++k) raw->read(k);
        });
        EXPECT_GT(growth, 0) << name;
        EXPECT_LT(growth, 64 * kMegabyte) << name;
    }
}

// What a large content holds is read as if it were small: its arrays lie beyond the part that is held in
// memory.
TEST(Memory, OfALargeFileIsReadAtAnyPlace) {
    const test::TemporaryFolder folder;
    const std::string gap(static_cast<std::size_t>(40 * kMegabyte), ' ');
    const std::string vtp = kPoly + kPiece + "<PointData><DataArray type=\"Float64\" Name=\"radius\">" + gap +
                            "0.25</DataArray></PointData><Points><DataArray type=\"Float64\" "
                            "NumberOfComponents=\"3\" format=\"ascii\">1 2" +
                            gap + "3" + kEnd;
    const std::string vtk =
        kLegacy + gap + "POINT_DATA 1\nSCALARS radius float\nLOOKUP_TABLE default\n" + gap + "0.25\n";
    for (const auto& [name, content] : {std::pair{"a.vtp", vtp}, {"a.vtk", vtk}})
        for (const bool packed : {false, true}) {
            const auto file = folder.write_old(name, packed ? gzip_of(content) : content);
            const RawFrame frame = raw_format_of(file)->open(file)->read(0);
            EXPECT_EQ(column_of(frame.grains, "radius"), std::vector<double>{0.25}) << name << packed;
        }
}

}  // namespace
}  // namespace grainreel
