// Tests that a run keeps copies of its meshes: its folder can be moved, and another file in place of a copy
// is refused.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "engine/base/error.hpp"
#include "engine/files/frames/saved_scene.hpp"
#include "engine/files/run_folder.hpp"
#include "engine/mesh/load_mesh.hpp"
#include "engine/run/folder/scene_job.hpp"
#include "tests/scene/meshes_by_hand.hpp"
#include "tests/support/tells.hpp"

namespace grainreel {
namespace {

namespace fs = std::filesystem;
using test::tells;
using testing::HasSubstr;

class KeptMeshes : public testing::Test {
  protected:
    void SetUp() override {
        files.write("meshes of mine/plate.stl", plate(0.2));
        std::string text = ball_on_plate;
        text.replace(text.find("plate.stl"), 9, "meshes of mine/plate.stl");
        text.replace(text.find("0.2 s"), 5, "1 ms");
        scene = files.read(text);
        JobRequest request;
        request.out = files.path() / "run";
        SilentListener listener;
        SceneJob(request, listener, scene, make_plan(scene)).run();
    }
    template <class Do>
    static std::string complaint(const Do& what) {
        try {
            what();
        } catch (const UserError& error) {
            return error.what();
        }
        return "none";
    }
    MeshScenes files;
    Scene scene;
};

TEST_F(KeptMeshes, ARunsFolderNeedsNothingElse) {
    EXPECT_EQ(hash_of_file(files.path() / "run" / "meshes" / "plate.stl"), scene.meshes[0].hash);
    fs::remove_all(files.path() / "meshes of mine");
    const fs::path there = files.path() / "elsewhere";
    fs::rename(files.path() / "run", there);
    EXPECT_EQ(plain_scene_of_run(there).meshes, scene.meshes);
    EXPECT_EQ(plain_scene_of_run(there).meshes[0].file, (there / "meshes" / "plate.stl").string());
    EXPECT_EQ(scene_of_checkpoint(there / "checkpoint.grs").meshes, scene.meshes);
    for (const fs::directory_entry& kept : fs::directory_iterator(there / "checkpoints"))
        EXPECT_EQ(scene_of_checkpoint(kept.path()).meshes, scene.meshes);
    fs::rename(there / "checkpoint.grs", files.path() / "alone.grs");
    EXPECT_THAT(complaint([&] { scene_of_checkpoint(files.path() / "alone.grs"); }),
                tells({"not exist", "folder of its run"}));
}

TEST_F(KeptMeshes, AnotherFileIsRefused) {
    files.write("run/meshes/plate.stl", plate(0.3));
    const std::string now = hash_of_file(files.path() / "run" / "meshes" / "plate.stl");
    for (const std::string& wrong :
         {complaint([&] { plain_scene_of_run(files.path() / "run"); }),
          complaint([&] { scene_of_checkpoint(files.path() / "run/checkpoint.grs"); })})
        EXPECT_THAT(wrong, HasSubstr("another file now: its hash is " + now + ", but it was " +
                                     scene.meshes[0].hash + "; put the file back"));
}

// The copy is the file that was read.
TEST_F(KeptMeshes, AFileThatChangesMeanwhileIsNotKept) {
    files.write("meshes of mine/plate.stl", plate(0.3));
    EXPECT_THAT(complaint([&] { keep_mesh_files(scene, files.path() / "other"); }),
                tells({"plate.stl", "changed", "start again"}));
    EXPECT_FALSE(fs::exists(files.path() / "other" / "meshes" / "plate.stl"));
}

}  // namespace
}  // namespace grainreel
