// Tests of the meshes that come with the program.
#include "engine/mesh/file/mesh_readers.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <set>
#include <sstream>

#include "engine/base/error.hpp"
#include "engine/mesh/load_mesh.hpp"
#include "tests/support/tells.hpp"

namespace grainreel {
namespace {

using test::tells;

namespace fs = std::filesystem;

TEST(ShippedMeshes, AreTheFilesOfTheFolderMeshes) {
    const fs::path folder = GRAINREEL_SOURCE "/scenes/meshes";
    std::set<std::string> files, names;
    for (const auto& entry : fs::directory_iterator(folder))
        if (entry.path().extension() == ".stl") files.insert(entry.path().filename());
    for (const ShippedMesh& mesh : shipped_meshes()) {
        names.insert(mesh.name);
        std::ostringstream bytes;
        bytes << std::ifstream(folder / mesh.name, std::ios::binary).rdbuf();
        EXPECT_TRUE(mesh.bytes == bytes.str()) << mesh.name;
    }
    EXPECT_EQ(names, files);
}

TEST(ShippedMeshes, AreFoundByTheirWordWhateverFolderStandsBefore) {
    EXPECT_FALSE(shipped_mesh("drum.stl"));
    EXPECT_TRUE(shipped_mesh("shipped:drum.stl"));
    EXPECT_EQ(shipped_mesh("/some/where/shipped:drum.stl")->data(), shipped_mesh("shipped:drum.stl")->data());
    try {
        shipped_mesh("shipped:drun.stl");
        FAIL() << "there is no such mesh";
    } catch (const UserError& error) {
        EXPECT_THAT(error.what(), tells({"shipped:drun.stl", "no such mesh", "it has"}));
        EXPECT_THAT(error.what(), testing::HasSubstr("drum.stl"));
    }
}

TEST(ShippedMeshes, AreReadAsTheirFilesAre) {
    for (const ShippedMesh& mesh : shipped_meshes()) {
        const LoadedMesh shipped = load_mesh("shipped:" + mesh.name);
        const LoadedMesh file = load_mesh(fs::path(GRAINREEL_SOURCE "/scenes/meshes") / mesh.name);
        EXPECT_EQ(shipped.hash, file.hash);
        EXPECT_EQ(shipped.mesh.triangles, file.mesh.triangles);
        EXPECT_EQ(shipped.facts.mended, std::vector<std::string>{}) << mesh.name;
    }
}

}  // namespace
}  // namespace grainreel
