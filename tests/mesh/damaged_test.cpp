#include <fmt/format.h>
#include <gmock/gmock.h>
#include <sys/stat.h>
#include <algorithm>

#include <functional>
#include <random>

#include "engine/base/error.hpp"
#include "tests/mesh/mesh_files.hpp"
#include "tests/mesh/shapes.hpp"
#include "tests/support/tells.hpp"

namespace grainreel {
namespace {

using test::tells;
using testing::HasSubstr;

std::string complaint(const std::function<void()>& act) {
    try {
        act();
    } catch (const UserError& error) {
        return error.what();
    }
    return "no complaint";
}

std::string complaint_of(const test::TemporaryFolder& folder, std::string_view bytes) {
    const auto file = folder.write("m", bytes);
    const std::string message = complaint([&] { load_mesh(file); });
    EXPECT_EQ(message.substr(0, file.string().size() + 1), file.string() + ":") << message;
    return message.substr(std::min(message.size(), file.string().size()));
}

TEST(DamagedMesh, WhatIsNoOrdinaryFile) {
    const test::TemporaryFolder folder;
    const auto complaint_at = [](const std::filesystem::path& file) {
        return complaint([&] { load_mesh(file); });
    };
    EXPECT_THAT(complaint_at(folder.path() / "none.stl"), tells({"no such file", "path"}));
    EXPECT_THAT(complaint_at(folder.path()), HasSubstr("this is a folder"));
    ASSERT_EQ(::mkfifo((folder.path() / "pipe").c_str(), 0600), 0);
    EXPECT_THAT(complaint_at(folder.path() / "pipe"), HasSubstr("this is a pipe"));
    EXPECT_THAT(complaint_at("/dev/zero"), HasSubstr("this is a device"));
    EXPECT_THAT(complaint([&] { hash_of_file(folder.path()); }), HasSubstr("this is a folder"));
    const auto large = folder.write("large.stl", "solid");
    std::filesystem::resize_file(large, std::uintmax_t{1} << 31);  // a hole: it takes no room
    EXPECT_THAT(complaint_at(large), HasSubstr("larger than 2 GiB"));
}

TEST(DamagedMesh, BinaryStl) {
    const test::TemporaryFolder folder;
    const std::string good = binary_stl(plate(), "", 2);
    EXPECT_THAT(complaint_of(folder, ""), HasSubstr("is empty"));
    EXPECT_THAT(complaint_of(folder, binary_stl(plate(), "", 4'000'000'000u)),
                tells({"byte 80", "no mesh", "4000000000 triangles", "200000000084", "184"}));
    EXPECT_THAT(complaint_of(folder, good.substr(0, 154)), tells({"2 triangles", "184 bytes", "154"}));
    EXPECT_THAT(complaint_of(folder, binary_stl(plate(), "solid", 3)),
                tells({"byte 80", "3 triangles", "234", "184", "export"}));
    EXPECT_THAT(complaint_of(folder, binary_stl({}, "", 0)), tells({"binary STL", "no triangles"}));
    EXPECT_THAT(complaint_of(folder, good.substr(0, 20) + '\0'), HasSubstr("is no mesh"));
    for (const float bad : {std::nanf(""), -std::numeric_limits<float>::infinity(), 1e30f}) {
        std::string bytes = good;
        std::string value;
        append(value, bad);
        bytes.replace(84 + 50 + 12 + 4, 4, value);  // y of the first corner of the second triangle
        EXPECT_THAT(
            complaint_of(folder, bytes),
            testing::ContainsRegex(": byte 150: (has a coordinate that is no finite|a coordinate of 1e)"));
    }
}

TEST(DamagedMesh, AsciiStl) {
    const test::TemporaryFolder folder;
    const std::string good = std::string("solid plate\n") + plate_facets + "endsolid plate\n";
    const auto with = [&](const std::string& old, const std::string& now) {
        std::string text = good;
        return text.replace(text.find(old), old.size(), now);
    };
    for (const char* bad : {"nan", "-1.#IND", "inf", "1e400", "1.5d0", "0,25", "+-1", "0x1p3"})
        EXPECT_THAT(complaint_of(folder, with("0.25 0 0", std::string(bad) + " 0 0")),
                    HasSubstr(std::string(":5: \"") + bad + "\" is not a finite number"));
    EXPECT_THAT(complaint_of(folder, with("0.25 0 0", "1e16 0 0")), HasSubstr(":5: a coordinate of 1e+16"));
    EXPECT_THAT(complaint_of(folder, with("0.25 0 0\n", "0.25 0\n")),
                tells({":6: ", "\"vertex\"", "not a finite number"}));
    EXPECT_THAT(complaint_of(folder, with("endloop", "vertex 1 1 1\nendloop")),
                tells({":7: ", "fourth corner"}));
    EXPECT_THAT(complaint_of(folder, with("outer", "inner")), tells({":4: ", "\"vertex\"", "\"outer\""}));
    EXPECT_THAT(complaint_of(folder, good.substr(0, good.find("endloop"))), HasSubstr("ends within a facet"));
    EXPECT_THAT(complaint_of(folder, good.substr(0, good.find("endsolid"))),
                tells({"ends within a solid", "\"endsolid\""}));
    EXPECT_THAT(complaint_of(folder, "solid\nendsolid\n"), tells({"ASCII STL", "no triangles"}));
    EXPECT_THAT(complaint_of(folder, "Dear Sir,\nplease find enclosed\n"), tells({":1: ", "no mesh"}));
}

TEST(DamagedMesh, Obj) {
    const test::TemporaryFolder folder;
    const std::string vertices = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
    EXPECT_THAT(complaint_of(folder, vertices + "f 1 2 4\n"), tells({":4: ", "vertex 4", "3"}));
    EXPECT_THAT(complaint_of(folder, vertices + "f 1 2 -4\n"), tells({":4: ", "vertex -4"}));
    EXPECT_THAT(complaint_of(folder, vertices + "f 1 2 99999999999\n"),
                tells({":4: ", "vertex 99999999999"}));
    EXPECT_THAT(complaint_of(folder, vertices + "f 1 2 0\n"),
                tells({":4: ", "\"0\"", "no vertex", "begin at 1"}));
    EXPECT_THAT(complaint_of(folder, vertices + "f 1 2 x\n"), HasSubstr(":4: \"x\" names no vertex"));
    EXPECT_THAT(complaint_of(folder, vertices + "\nf 1 \\\n 2\n"), tells({":5: ", "2 corners"}));
    EXPECT_THAT(complaint_of(folder, vertices + "v 1 2\n"), HasSubstr(":4: a number is missing"));
    EXPECT_THAT(complaint_of(folder, vertices + "v 1 nan 2\n"),
                tells({":4: ", "\"nan\"", "not a finite number"}));
    EXPECT_THAT(complaint_of(folder, vertices + "w 1 1 2\n"), tells({":4: ", "\"w\"", "no line", "OBJ"}));
    EXPECT_THAT(complaint_of(folder, vertices), HasSubstr("this OBJ has no triangles"));
}

TEST(DamagedMesh, Ply) {
    const test::TemporaryFolder folder;
    const auto head = [](const std::string& vertices, const std::string& faces,
                         const std::string& format = "ascii") {
        return "ply\nformat " + format + " 1.0\nelement vertex " + vertices +
               "\nproperty float x\nproperty float y\nproperty float z\nelement face " + faces +
               "\nproperty list uchar int vertex_index\nend_header\n";
    };
    const std::string corners = "0 0 0\n1 0 0\n0 1 0\n";
    EXPECT_THAT(complaint_of(folder, head("3", "1") + corners + "3 0 1 3\n"),
                tells({":13: ", "vertex 3", "0 to 2"}));
    EXPECT_THAT(complaint_of(folder, head("3", "1") + corners + "3 0 1 -1\n"), tells({":13: ", "vertex -1"}));
    EXPECT_THAT(complaint_of(folder, head("3", "1") + corners + "2 0 1\n"), tells({":13: ", "2 corners"}));
    EXPECT_THAT(complaint_of(folder, head("3", "1") + "0 0 inf\n1 0 0\n0 1 0\n3 0 1 2\n"),
                tells({":10: ", "\"inf\"", "not a finite number"}));
    EXPECT_THAT(complaint_of(folder, head("3", "2") + corners + "3 0 1 2\n"),
                HasSubstr("ends before all elements"));
    EXPECT_THAT(complaint_of(folder, head("3000000000000", "1") + corners + "3 0 1 2\n"),
                tells({"3000000000000", "element vertex"}));
    EXPECT_THAT(complaint_of(folder, head("3", "1") + corners + "250 0 1 2\n"),
                HasSubstr("a list of 250 numbers"));
    EXPECT_THAT(complaint_of(folder, "ply\nformat ascii 1.0\nelement vertex 3\n"),
                HasSubstr("no end_header"));
    EXPECT_THAT(complaint_of(folder, "ply\nformat ebcdic 1.0\nend_header\n"),
                HasSubstr(":2: \"ebcdic\" is no format"));
    EXPECT_THAT(complaint_of(folder, "ply\nformat ascii 1.0\nelement vertex many\nend_header\n"),
                HasSubstr(":3: \"many\" is no number"));
    EXPECT_THAT(
        complaint_of(folder, "ply\nformat ascii 1.0\nelement vertex 0\nproperty quad x\nend_header\n"),
        HasSubstr(":4: \"quad\" is no type"));
    EXPECT_THAT(complaint_of(folder, "ply\nformat ascii 1.0\nend_header\n"),
                HasSubstr("has no element vertex"));
    std::string binary = head("3", "1", "binary_little_endian");
    const std::size_t body = binary.size();
    for (int i = 0; i < 9; ++i) append(binary, static_cast<float>(i * i));
    EXPECT_THAT(complaint_of(folder, binary.substr(0, binary.size() - 2)), HasSubstr("only 34 bytes"));
    append(binary, std::uint8_t{3});
    for (const int i : {0, 1, 7}) append(binary, i);
    EXPECT_THAT(complaint_of(folder, binary),
                HasSubstr(fmt::format("byte {}: a face names vertex 7", body + 36 + 1 + 8)));
    binary[body + 2] = '\x80', binary[body + 3] = '\x7f';
    EXPECT_THAT(complaint_of(folder, binary),
                HasSubstr(fmt::format("byte {}: has a coordinate that is no finite", body)));
}

TEST(DamagedMesh, TrianglesWithoutArea) {
    const test::TemporaryFolder folder;
    EXPECT_THAT(complaint_of(folder, "v 0 0 0\nv 1 1 1\nv 2 2 2\nf 1 2 3\n"),
                tells({"all triangles", "without area"}));
    EXPECT_THAT(complaint_of(folder, "v 5 5 5\nf 1 1 1\n"), tells({"all triangles", "without area"}));
    MeshPlacement huge;
    huge.scale = 1e300;
    const auto file = folder.write("plate.stl", binary_stl(plate(), "", 2));
    EXPECT_THAT(complaint([&] { load_mesh(file, huge); }), HasSubstr("give another scale or position"));
}

// Whatever is done to a file, it is read or refused.
TEST(DamagedMesh, RandomDamageIsReadOrRefused) {
    const test::TemporaryFolder folder;
    std::mt19937 random(49);
    const std::string good[] = {
        binary_stl(plate(), "solid", 2), std::string("solid plate\n") + plate_facets + "endsolid plate\n",
        "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2/1 3//2 -1\n",
        "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float "
        "z\nelement face 1\n"
        "property list uchar int vertex_indices\nend_header\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n"};
    int refused = 0;
    for (int i = 0; i < 400; ++i) {
        std::string bytes = good[i % 4];
        for (int k = 0; k < 1 + i % 3; ++k) bytes[random() % bytes.size()] = static_cast<char>(random());
        if (i % 5 == 0) bytes.resize(1 + random() % bytes.size());
        if (i % 7 == 0) bytes += bytes;
        refused += complaint([&] { load_mesh(folder.write("m", bytes)); }) != "no complaint";
    }
    EXPECT_GT(refused, 100);
    EXPECT_LT(refused, 400);
}

}  // namespace
}  // namespace grainreel
