#include <gmock/gmock.h>

#include "tests/mesh/mesh_files.hpp"
#include "tests/mesh/shapes.hpp"

namespace grainreel {
namespace {

void expect_plate(const test::TemporaryFolder& folder, std::string_view bytes, const std::string& format,
                  const char* what) {
    const LoadedMesh loaded = load_mesh(folder.write("a file without a suffix", bytes));
    EXPECT_EQ(loaded.facts.format, format) << what;
    EXPECT_EQ(loaded.facts.read, 2) << what;
    EXPECT_EQ(loaded.mesh.vertices, plate().vertices) << what;
    EXPECT_EQ(loaded.mesh.triangles, plate().triangles) << what;
    EXPECT_TRUE(loaded.facts.mended.empty()) << what;
}

TEST(MeshFile, BinaryStlIsToldByItsSize) {
    const test::TemporaryFolder folder;
    expect_plate(folder, binary_stl(plate(), "a head", 2), "binary STL", "plain");
    expect_plate(folder, binary_stl(plate(), "solid by some program", 2), "binary STL", "begins with solid");
    expect_plate(folder, binary_stl(plate(), "a head", 2, 0x7fff), "binary STL", "attributes");
}

TEST(MeshFile, AsciiStlTakesWhatProgramsWrite) {
    const test::TemporaryFolder folder;
    const std::string facets = plate_facets, plain = "solid plate\n" + facets + "endsolid plate\n";
    expect_plate(folder, plain, "ASCII STL", "plain");
    expect_plate(folder, with_ends(plain, "\r\n"), "ASCII STL", "CRLF");
    expect_plate(folder, with_ends(plain, "\r"), "ASCII STL", "CR");
    expect_plate(folder, "solid\n" + facets + "endsolid", "ASCII STL", "no name, no end of the last line");
    expect_plate(folder, "solid facet vertex 7\n" + facets + "endsolid facet\n", "ASCII STL",
                 "facet in the name");
    std::string capitals = plain;
    for (char& c : capitals) c = static_cast<char>(std::toupper(c));
    expect_plate(folder, capitals, "ASCII STL", "capitals");
    const std::size_t second = facets.find("  facet", 5);
    expect_plate(folder,
                 "solid a\n" + facets.substr(0, second) + "endsolid a\nsolid b\n" + facets.substr(second) +
                     "endsolid b\n",
                 "ASCII STL", "two solids");
}

TEST(MeshFile, NormalsOfTheFileAreLeftOut) {
    const test::TemporaryFolder folder;
    for (const char* normal : {"0 0 -1", "0 0 0", "nan nan nan", "-1.#IND 0 7", ""}) {
        std::string facets = plate_facets;
        for (std::size_t at = 0; (at = facets.find("0 0 1\n", at)) != std::string::npos;)
            facets.replace(at, 5, normal);
        expect_plate(folder, "solid plate\n" + facets + "endsolid plate\n", "ASCII STL", normal);
    }
}

TEST(MeshFile, NumbersOfAllKinds) {
    const test::TemporaryFolder folder;
    const LoadedMesh loaded =
        load_mesh(folder.write("numbers.stl",
                               "solid\nfacet\nouter loop\nvertex +1.5 0. -2.e-016\nvertex -1. 1e-400 "
                               ".5\nvertex 2E+0 -3.25 1.0e+000\nendloop\nendfacet\nendsolid\n"));
    const std::vector<Vec3> expected{{1.5, 0, -2e-16}, {-1, 0, 0.5}, {2, -3.25, 1}};
    EXPECT_EQ(loaded.mesh.vertices, expected);
}

// 0.1f is not 0.1; who wrote it meant the same.
TEST(MeshFile, FloatsMeanTheirShortestDecimals) {
    const test::TemporaryFolder folder;
    TriangleMesh mesh;
    const std::vector<Vec3> expected{{0.1, -0.3, 1e-7}, {123.456, 3, 16777216}, {0.7, 0.0554222, -2.5e-5}};
    shapes::add_triangle(mesh, expected[0], expected[1], expected[2]);
    EXPECT_EQ(load_mesh(folder.write("m.stl", binary_stl(mesh, "", 1))).mesh.vertices, expected);
}

TEST(MeshFile, ObjNamesVerticesInManyWays) {
    const test::TemporaryFolder folder;
    const std::string vertices =
        "# a plate\nmtllib none.mtl\no plate\nv 0 0 0\nv 0.25 0 0 1\nv 0.25 0.25 0 1 0.5 0\nv 0 0.25 0 1 1 1 "
        "1\n";
    for (const char* faces : {"f 1 2 3\nf 1 3 4\n", "f 1 2 3 4\n", "f 1// 2// 3//\nf 1/2/3 3/2/3 4/2/3\n",
                              "vn 0 0 1\nvt 0 0\nf 1//1 2//1 3//1 4//1 \n", "f -4 -3 -2 -1\n",
                              "f 1/1 \\\n  2/1 \\\n 3/1 4/1 # and a comment \\\ng more\n",
                              "f 1 2 3 4\\\n\nusemtl glass\ns off\nl 1 2\np 1\n"}) {
        expect_plate(folder, vertices + faces, "OBJ", faces);
        expect_plate(folder, with_ends(vertices + faces, "\r\n"), "OBJ", faces);
    }
    expect_plate(folder, "f 1 2 3 4\n" + vertices, "OBJ", "a face before its vertices");
}

std::string ply_head(const std::string& format, const std::string& vertex_more,
                     const std::string& face_more) {
    return "ply\nformat " + format +
           " 1.0\ncomment format ascii\nobj_info by hand\nelement vertex 4\nproperty float x\n" +
           vertex_more + "property double y\nproperty float32 z\nelement face 1\n" + face_more +
           "property list uchar int vertex_indices\nelement edge 1\nproperty int vertex1\nproperty ushort "
           "vertex2\nend_header\n";
}

std::string ply_body(bool big_endian) {
    std::string bytes;
    for (const Vec3& v : plate().vertices) {
        append(bytes, static_cast<float>(v.x()), big_endian);
        append(bytes, std::int16_t{-7}, big_endian);  // an extra property, and an extra list
        append(bytes, std::uint8_t{2}, big_endian);
        append(bytes, 0.5, big_endian);
        append(bytes, 0.5, big_endian);
        append(bytes, v.y(), big_endian);
        append(bytes, static_cast<float>(v.z()), big_endian);
    }
    append(bytes, std::uint16_t{9}, big_endian);
    append(bytes, std::uint8_t{4}, big_endian);
    for (std::int32_t i = 0; i < 4; ++i) append(bytes, i, big_endian);
    append(bytes, std::int32_t{0}, big_endian);
    append(bytes, std::uint16_t{1}, big_endian);
    return bytes;
}

TEST(MeshFile, PlyOfBothByteOrdersAndText) {
    const test::TemporaryFolder folder;
    const std::string more = "property short nx\nproperty list uint8 double weights\n",
                      flags = "property uint16 flags\n";
    expect_plate(folder, ply_head("binary_little_endian", more, flags) + ply_body(false), "PLY",
                 "little endian");
    expect_plate(folder, ply_head("binary_big_endian", more, flags) + ply_body(true), "PLY", "big endian");
    const std::string text =
        "0 -7 2 0.5 nan 0 0\n0.25 -7 0 0 0\n0.25 -7 0 0.25 0\n0 -7 1 3 0.25 0\n9 4 0 1 2 3\n0 1\n";
    expect_plate(folder, ply_head("ascii", more, flags) + text, "PLY", "ascii");
    expect_plate(folder, with_ends(ply_head("ascii", more, flags) + text, "\r\n"), "PLY", "ascii, CRLF");
}

TEST(MeshFile, PolygonsAreCutFromTheirFirstCorner) {
    const test::TemporaryFolder folder;
    const LoadedMesh loaded =
        load_mesh(folder.write("five.obj", "v 0 0 0\nv 2 0 0\nv 3 1 0\nv 1 2 0\nv 0 1 0\nf 1 2 3 4 5\n"));
    const std::vector<TriangleMesh::Triangle> expected{{0, 1, 2}, {0, 2, 3}, {0, 3, 4}};
    EXPECT_EQ(loaded.mesh.triangles, expected);
}

TEST(MeshFile, IsPlacedByScaleThenRotationThenPosition) {
    const test::TemporaryFolder folder;
    const auto file = folder.write("plate.stl", binary_stl(plate(), "", 2));
    MeshPlacement placement;
    placement.scale = 0.001;
    placement.rotation = Quaternion(Eigen::AngleAxisd(std::numbers::pi / 2, Vec3(0, 0, 1)));
    placement.position = Vec3(1, 2, 3);
    const LoadedMesh loaded = load_mesh(file, placement);
    for (std::size_t i = 0; i < 4; ++i) {
        const Vec3 v = plate().vertices[i];
        EXPECT_LT((loaded.mesh.vertices[i] - Vec3(1 - 0.001 * v.y(), 2 + 0.001 * v.x(), 3)).norm(), 1e-15);
    }
    EXPECT_LT((loaded.facts.low - Vec3(1 - 0.00025, 2, 3)).norm(), 1e-15);
    EXPECT_LT((loaded.facts.high - Vec3(1, 2 + 0.00025, 3)).norm(), 1e-15);
}

TEST(MeshFile, HashIsOfTheBytesAlone) {
    const test::TemporaryFolder folder;
    const std::string bytes = binary_stl(plate(), "", 2);
    const auto file = folder.write("a.stl", bytes), same = folder.write("b.stl", bytes),
               other = folder.write("c.stl", binary_stl(plate(), "other", 2));
    MeshPlacement twice;
    twice.scale = 2;
    EXPECT_EQ(load_mesh(file).hash, hash_of_file(file));
    EXPECT_EQ(load_mesh(file, twice).hash, hash_of_file(same));
    EXPECT_NE(hash_of_file(file), hash_of_file(other));
    EXPECT_EQ(hash_of_file(folder.write("text", "abc")), "44bc2cf5ad770999");  // XXH64 of "abc" with seed 0
}

}  // namespace
}  // namespace grainreel
