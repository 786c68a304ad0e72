// Tests of surfaces without grains: STL, OBJ and PLY.
#include <cstring>
#include <limits>

#include "tests/foreign/vtk/vtk_files.hpp"
#include "tests/support/tells.hpp"

namespace grainreel {
namespace {

using namespace vtk_test;
using test::tells;
using testing::HasSubstr;

FileStart head_of(const std::string& bytes) {
    FileStart head;
    head.bytes = bytes.substr(0, kHeadBytes);
    head.size = bytes.size();
    return head;
}

std::string facet(double z) {
    return fmt::format(
        "facet normal 0 0 0\n outer loop\n  vertex 0 0 {0}\n  vertex 1 0 {0}\n  vertex 0 1 {0}\n endloop\n"
        "endfacet\n",
        z);
}

std::string binary_stl(std::string head, std::size_t triangles) {
    head.resize(80, ' ');
    head += as_bytes(static_cast<std::uint32_t>(triangles), false);
    for (std::size_t i = 0; i < triangles; ++i)
        head += as_bytes_all<float>({0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, static_cast<double>(i)}, false) +
                std::string(2, '\0');
    return head;
}

// The size of the file is that of its packed bytes, and only the first bytes are known.
TEST(WallSurface, ALargeStlThatWasPackedIsKnownByItsFacets) {
    FileStart head = head_of(binary_stl("mesh", 2000));
    ASSERT_EQ(head.bytes.size(), kHeadBytes);
    EXPECT_TRUE(wall_surface_format().takes(head));
    head.size = 4000;
    EXPECT_TRUE(wall_surface_format().takes(head));
    const float nowhere = std::numeric_limits<float>::infinity();
    std::memcpy(head.bytes.data() + 84 + 50 * 700 + 12, &nowhere, sizeof nowhere);
    EXPECT_FALSE(wall_surface_format().takes(head));
}

TEST(WallSurface, SolidsOfOneStl) {
    const Folder folder;
    const RawFormat format = wall_surface_format();
    const std::string text =
        "solid big drum \r\n" + facet(1) + facet(2) + "endsolid\nSOLID\n" + facet(5) + "endsolid x\n";
    ASSERT_TRUE(format.takes(head_of(text)));
    const auto file = format.open(folder.write("a.stl", text));
    EXPECT_TRUE(file->moments()[0].has_walls);
    EXPECT_EQ(file->facts().format, "ASCII STL");
    const RawFrame frame = file->read(0);
    ASSERT_EQ(frame.walls.size(), 2u);
    EXPECT_EQ(frame.walls[0].name, "big drum");
    EXPECT_EQ(frame.walls[0].mesh.triangles.size(), 2u);
    EXPECT_EQ(frame.walls[1].name, "");
    EXPECT_EQ(frame.walls[1].mesh.vertices.size(), 3u);
    EXPECT_EQ(frame.walls[1].mesh.vertices[0][2], 5);
    EXPECT_EQ(frame.grains.rows, 0u);
}

TEST(WallSurface, ContentDecides) {
    const RawFormat format = wall_surface_format();
    EXPECT_TRUE(format.takes(head_of(binary_stl("solid by Blender", 3))));
    EXPECT_TRUE(format.takes(head_of(binary_stl("", 3))));
    EXPECT_FALSE(format.takes(head_of(binary_stl("", 3) + "more")));
    EXPECT_TRUE(format.takes(head_of("ply\nformat ascii 1.0\n")));
    EXPECT_TRUE(format.takes(head_of("# Blender\nmtllib a.mtl\no Cube\nv 0 0 1\n")));
    for (const char* other :
         {"", "324\nLattice=\"1 0 0 0 1 0 0 0 1\"\n", "v,x,y,z\n1,2,3,4\n", "v x y z\n1 2 3 4\n",
          "solid argon at 10 K\n1 2 3\n", "ITEM: TIMESTEP\n0\n", "# x y z r\n0 0 0 1\n", "g\n1\n"})
        EXPECT_FALSE(format.takes(head_of(other))) << other;
}

TEST(WallSurface, EveryFormat) {
    const Folder folder;
    const RawFormat format = wall_surface_format();
    const auto triangles = [&](const std::string& bytes) {
        const RawFrame frame = frame_in(format, folder.write("m", bytes));
        return frame.walls.size() == 1 ? frame.walls[0].mesh.triangles.size() : 0;
    };
    EXPECT_EQ(triangles(binary_stl("", 3)), 3u);
    EXPECT_EQ(triangles("v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3 4\n"), 2u);
    EXPECT_EQ(
        triangles(
            "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
            "element face 1\nproperty list uchar int vertex_indices\nend_header\n0 0 0\n1 0 0\n0 1 0\n3 0 1 "
            "2\n"),
        1u);
}

TEST(WallSurface, WhatIsDamaged) {
    const Folder folder;
    const RawFormat format = wall_surface_format();
    EXPECT_THAT(complaint_of(format, folder.write("a.stl", "solid a\n" + facet(1).substr(0, 60))),
                HasSubstr("a.stl:"));
    EXPECT_THAT(complaint_of(format, folder.write("a.stl", "solid a\nendsolid a\n")),
                tells({"a.stl", "ASCII STL", "no triangles"}));
    std::string nan = binary_stl("", 2);
    nan.replace(84 + 12, 4, as_bytes(std::nanf(""), false));
    EXPECT_THAT(complaint_of(format, folder.write("a.stl", nan)), tells({"a.stl", "byte 96", "coordinate"}));
}

}  // namespace
}  // namespace grainreel
