// Tests of scenes with meshes: what is read, the defaults, and what is refused.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <cmath>

#include <algorithm>
#include <numbers>

#include "engine/mesh/room.hpp"
#include "engine/plan/plan.hpp"
#include "engine/scene/bed.hpp"
#include "engine/scene/free_space.hpp"
#include "engine/scene/scene_file.hpp"
#include "tests/scene/meshes_by_hand.hpp"
#include "tests/support/tells.hpp"

namespace grainreel {
namespace {

using std::numbers::pi;
using test::tells;
using test::tells_only;
using testing::HasSubstr;

// `text` with `from` replaced by `to`.
std::string with(std::string text, const std::string& from, const std::string& to) {
    const auto at = text.find(from);
    return at == std::string::npos ? throw std::logic_error("no '" + from + "' in the scene")
                                   : text.replace(at, from.size(), to);
}

const std::string path_text = "t,x,y,z\n0,0,0,0\n1,0.001,0,0\n2,0.002,0,0\n3,0.004,0,0\n";
const std::string driven = "[drive]\nfrequency = 20\namplitude = 0.001\n";

class MeshScene : public testing::Test {
  protected:
    void SetUp() override {
        files.write("plate.stl", plate(0.2));
        files.write("tank.stl", box_of_sheets(0.1, 0.08));
        files.write("path.csv", path_text);
    }
    // The mesh of a ball on a plate, with these additional keys.
    SceneMesh mesh(const std::string& keys, const std::string& more = "") const {
        return files
            .read(with(ball_on_plate, "file = \"plate.stl\"\n", "file = \"plate.stl\"\n" + keys) + more)
            .meshes.at(0);
    }
    std::string complaint(const std::string& keys, const std::string& more = "") const {
        return files.complaint(
            with(ball_on_plate, "file = \"plate.stl\"\n", "file = \"plate.stl\"\n" + keys) + more);
    }
    MeshScenes files;
};

TEST_F(MeshScene, HasDefaults) {
    const Scene scene = files.read(with(ball_on_plate, "name = \"plate\"\n", ""));
    ASSERT_EQ(scene.meshes.size(), 1u);
    const SceneMesh& one = scene.meshes[0];
    EXPECT_EQ(one.name, "mesh 1");
    EXPECT_EQ(one.file, (files.path() / "plate.stl").string());
    EXPECT_EQ(one.hash.size(), 16u);
    EXPECT_EQ(one.scale, 1);
    EXPECT_FALSE(one.moves());
    EXPECT_EQ(one.surface->size(), 2);
    EXPECT_EQ(one.surface->facts().high, Vec3(0.1, 0.1, 0));
    EXPECT_EQ(scene.notes, std::vector<std::string>{});
}

// x = position + rotation (scale * x_file).
TEST_F(MeshScene, IsPlaced) {
    const SceneMesh one = mesh(
        "scale = 0.5\nposition = [0.1, \"2 cm\", 0]\nrotation = { axis = [2, 0, 0], angle = \"90 deg\" }\n");
    EXPECT_LT((one.surface->facts().low - Vec3(0.05, 0.02, -0.05)).norm(), 1e-15);
    EXPECT_LT((one.surface->facts().high - Vec3(0.15, 0.02, 0.05)).norm(), 1e-15);
}

TEST_F(MeshScene, HasOneMotion) {
    EXPECT_TRUE(mesh("driven = true\n", driven).driven);
    const SceneMesh turning = mesh(
        "turn = { axis = [0, 2, 0], through = [0, 0, \"1 cm\"], rate = \"30 rpm\", from = 1, over "
        "= 0.5, until = 4 }\n");
    ASSERT_TRUE(turning.turn);
    EXPECT_DOUBLE_EQ(turning.turn->rate, pi);
    EXPECT_EQ(turning.turn->axis, Vec3(0, 1, 0));
    EXPECT_EQ(turning.turn->through, Vec3(0, 0, 0.01));
    EXPECT_EQ(turning.turn->from, 1);
    EXPECT_EQ(turning.turn->over, 0.5);
    EXPECT_EQ(turning.turn->until, 4);
    EXPECT_DOUBLE_EQ(mesh("turn = { axis = [0, 0, 1], rate = \"0.5 rev/s\" }\n").turn->rate, pi);
    EXPECT_DOUBLE_EQ(mesh("turn = { axis = [0, 0, 1], rate = \"-180 deg/s\" }\n").turn->rate, -pi);
    EXPECT_EQ(mesh("turn = { axis = [0, 0, 1], rate = 2 }\n").turn->rate, 2);
    EXPECT_EQ(mesh("velocity = [0, 0, \"1 cm/s\"]\n").velocity, Vec3(0, 0, 0.01));
    EXPECT_EQ(mesh("path = \"path.csv\"\n").path->last(), 3);
}

TEST_F(MeshScene, PairsNameMeshesAndWallsHoldForThem) {
    const std::string two = ball_on_plate +
                            "[[mesh]]\nname = \"vane\"\nfile = \"plate.stl\"\nposition = [0, 0, 1]\n"
                            "[[contact.pair]]\nbetween = [\"vane\", \"ball\"]\nfriction = 0.7\n"
                            "[[contact.pair]]\nbetween = [\"ball\", \"wall\"]\nrestitution = 0.4\n"
                            "[contact.wall]\nfriction = 0.1\n";
    const SceneContacts contact = files.read(two).contact;
    ASSERT_EQ(contact.mesh.size(), 2u);
    EXPECT_EQ(contact.mesh[0], contact.wall[0]);
    EXPECT_EQ(contact.mesh[0].friction, 0.1);
    EXPECT_EQ(contact.mesh[0].restitution, 0.4);
    EXPECT_EQ(contact.mesh[1].friction, 0.7);
    EXPECT_EQ(contact.mesh[1].restitution, 0.4);
    EXPECT_EQ(contact.grain[0].restitution, 0.8);
}

TEST_F(MeshScene, AVesselSaysTheContainersSizes) {
    const Scene scene = files.read(in_vessel + driven);
    const Container& c = scene.container;
    EXPECT_TRUE(scene.meshes[0].driven);
    EXPECT_EQ(scene.vessel(), &scene.meshes[0]);
    EXPECT_NEAR(c.half_width, 0.05, 1e-9);
    EXPECT_NEAR(c.depth, 0.1, 1e-9);
    EXPECT_NEAR(c.height, 0.08, 1e-9);
    EXPECT_EQ(c.base(), 0);
    EXPECT_FALSE(c.lid);
    EXPECT_NEAR(c.volume(), 8e-4, 1e-9);
    EXPECT_NEAR(c.volume_below(0.02), 2e-4, 1e-9);
    EXPECT_NEAR(fill_height(scene, 0.5), solid_volume(scene) / 0.5 / 0.01, 1e-9);
    EXPECT_NEAR(FreeSpace(scene).volume(), c.volume(), 1e-12);
    EXPECT_TRUE(FreeSpace(scene).holds({0.044, 0, 0.006}, 0.005));
    EXPECT_FALSE(FreeSpace(scene).holds({0.044, 0, 0.006}, 0.0065));
    EXPECT_NEAR(FreeSpace(scene).height_of_share(0.25), 0.02, 1e-6);
    EXPECT_LT((extent_of(scene).high - Vec3(0.05, 0.05, 0.08)).norm(), 1e-12);
    EXPECT_FALSE(files.read(in_vessel).meshes[0].driven);
    EXPECT_FALSE(
        files.read(with(in_vessel, "file = \"tank.stl\"\n", "file = \"tank.stl\"\ndriven = false\n") + driven)
            .meshes[0]
            .driven);
    EXPECT_FALSE(files
                     .read(with(in_vessel, "file = \"tank.stl\"\n",
                                "file = \"tank.stl\"\nturn = { axis = [0, 0, 1], rate = 1 }\n") +
                           driven)
                     .meshes[0]
                     .driven);
}

TEST_F(MeshScene, AVesselMayLieBelowTheOrigin) {
    const Container c =
        files
            .read(with(in_vessel, "file = \"tank.stl\"\n", "file = \"tank.stl\"\nposition = [0, 0, -0.03]\n"))
            .container;
    EXPECT_NEAR(c.base(), -0.03, 1e-9);
    EXPECT_NEAR(c.height, 0.05, 1e-9);
    EXPECT_NEAR(c.volume(), 8e-4, 1e-9);
}

TEST_F(MeshScene, MeshesAreCutOutOfTheRoom) {
    const Scene scene = files.read(
        in_vessel + "[[mesh]]\nname = \"block\"\nfile = \"block.stl\"\n",
        {{"mesh.block.file=" + files.write("block.stl", box_of_sheets(0.04, 0.04, true)).string()}});
    EXPECT_NEAR(FreeSpace(scene).volume(), 8e-4 - 0.04 * 0.04 * 0.04, 1e-5);
    EXPECT_FALSE(FreeSpace(scene).holds({0, 0, 0.02}, 0));
    EXPECT_FALSE(FreeSpace(scene).holds({0, 0, 0.044}, 0.005));
    EXPECT_TRUE(FreeSpace(scene).holds({0, 0, 0.046}, 0.005));
}

TEST_F(MeshScene, ARegionIsPackedAlsoWithoutAContainer) {
    const std::string text =
        with(with(ball_on_plate, "[[grain]]\nposition = [0, 0, \"7 mm\"]\n",
                  "[start]\nregion = { low = [-0.05, -0.05, 0], high = [0.05, 0.05, \"10 cm\"] }\n"),
             "density = 2500\n", "density = 2500\ncount = 50\n");
    const Scene scene = files.read(text);
    ASSERT_TRUE(scene.start.region);
    EXPECT_EQ(scene.start.method, Start::Method::layers);
    EXPECT_NEAR(FreeSpace(scene).volume(), 1e-3, 1e-12);
    EXPECT_NEAR(FreeSpace(scene).height_of_share(0.3), 0.03, 1e-3);
}

TEST_F(MeshScene, ExitsTakeWhatIsInThemOrOutside) {
    const Scene scene = files.read(ball_on_plate +
                                   "[[exit]]\nlow = [-1, -1, -1]\nhigh = [1, 1, \"-10 cm\"]\n"
                                   "[[exit]]\nlow = [-1, -1, -1]\nhigh = [1, 1, 1]\noutside = true\n");
    ASSERT_EQ(scene.exits.size(), 2u);
    EXPECT_TRUE(scene.exits[0].holds({0, 0, -0.5}));
    EXPECT_FALSE(scene.exits[0].holds({0, 0, 0}));
    EXPECT_FALSE(scene.exits[1].holds({0, 0, 0}));
    EXPECT_TRUE(scene.exits[1].holds({0, 2, 0}));
}

// The extent includes the box that a moving mesh sweeps.
TEST_F(MeshScene, ExtentsHoldMeshesAsTheyMove) {
    const Extent still = extent_of(files.read(ball_on_plate));
    EXPECT_LE(still.low.x(), -0.1);
    EXPECT_NEAR(still.high.x(), 0.1, 1e-12);
    const Scene turning =
        files.read(with(ball_on_plate, "file = \"plate.stl\"\n",
                        "file = \"plate.stl\"\nturn = { axis = [0, 0, 1], rate = \"600 rpm\" }\n"));
    EXPECT_NEAR(extent_of(turning).high.x(), 0.1 * std::sqrt(2.0), 1e-9);
    const Scene going = files.read(
        with(ball_on_plate, "file = \"plate.stl\"\n", "file = \"plate.stl\"\nvelocity = [0, 1, 0]\n"));
    EXPECT_NEAR(extent_of(going).high.y(), 0.1 + 0.2, 1e-9);
    // A ground of 200 m does not count as a whole.
    files.write("plate.stl", plate(200));
    EXPECT_LT(extent_of(files.read(ball_on_plate)).size().x(), 1);
}

TEST_F(MeshScene, ScenesReadBackAsTheyWere) {
    const std::string text =
        with(in_vessel, "file = \"tank.stl\"\n",
             "file = \"tank.stl\"\nscale = 1.1\nposition = [0.01, 0.02, 0.003]\n"
             "rotation = { axis = [0, 0, 3], angle = \"17 deg\" }\n") +
        driven +
        "[[mesh]]\nname = \"vane\"\nfile = \"plate.stl\"\nscale = 0.1\nposition = [0, 0, 0.05]\n"
        "turn = { axis = [1, 2, 3], through = [0, 0, 0.05], rate = \"30 rpm\", over = 0.1 }\n"
        "[[mesh]]\nfile = \"plate.stl\"\nscale = 0.1\npath = \"path.csv\"\nposition = [0, 0, 0.15]\n"
        "[[mesh]]\nfile = \"plate.stl\"\nvelocity = [0, 0, 0.1]\nposition = [0, 0, -0.3]\n"
        "[[contact.pair]]\nbetween = [\"vane\", \"big\"]\nlaw = \"hertz\"\nfriction = 0.7\n"
        "[[contact.pair]]\nbetween = [\"small\", \"wall\"]\nrestitution = 0.4\n"
        "[[exit]]\nlow = [-1, -1, -1]\nhigh = [1, 1, -0.1]\n"
        "[start]\nregion = { low = [-0.03, -0.03, 0.06], high = [0.03, 0.03, 0.08] }\n";
    const Scene scene = files.read(text);
    const Scene back = files.read(written_scene(scene));
    EXPECT_EQ(back.meshes, scene.meshes);
    EXPECT_EQ(back.contact, scene.contact);
    EXPECT_EQ(back.container, scene.container);
    EXPECT_EQ(back.exits, scene.exits);
    EXPECT_EQ(back.start, scene.start);
    EXPECT_EQ(written_scene(back), written_scene(scene));
    EXPECT_EQ(back.meshes[0].surface->facts().low, scene.meshes[0].surface->facts().low);

    Scene turning = scene;
    turning.container = {};
    turning.container.shape = Container::Shape::box;
    turning.container.turn = scene.meshes[1].turn;
    turning.container.half_width = turning.container.depth = turning.container.height = 0.1;
    EXPECT_EQ(files.read(written_scene(turning)).container, turning.container);
}

// This is the form in a run's folder: the files are beside the scene, and their hashes are in it.
TEST_F(MeshScene, RunsNameTheirCopies) {
    const MeshScenes other;
    const Scene scene = files.read(
        ball_on_plate +
            "[[mesh]]\nfile = \"plate.stl\"\nposition = [0, 0, 1]\n"
            "[[mesh]]\nfile = \"shipped/../deep/plate.stl\"\npath = \"path.csv\"\nposition = [0, 0, 2]\n",
        {{"mesh[2].file=" + files.write("deep/plate.stl", plate(0.3)).string()}});
    const std::vector<KeptFile> kept = kept_files(scene);
    ASSERT_EQ(kept.size(), 3u);
    EXPECT_EQ(kept[0].name, "meshes/plate.stl");
    EXPECT_EQ(kept[1].name, "meshes/plate-2.stl");
    EXPECT_EQ(kept[2].name, "meshes/path.csv");
    for (const KeptFile& one : kept) {
        std::filesystem::create_directories(other.path() / "meshes");
        std::filesystem::copy_file(one.from, other.path() / one.name);
    }
    const std::string text = written_scene(naming_kept_files(scene));
    const Scene there = other.read(text);
    EXPECT_EQ(there.meshes, scene.meshes);
    EXPECT_EQ(written_scene(naming_kept_files(there)), text);

    // Checkpoints are in the folder or in one below it.
    std::filesystem::create_directories(other.path() / "checkpoints");
    EXPECT_EQ(read_scene_text(text, other.path() / "checkpoints" / "0001.grs").meshes, scene.meshes);
    EXPECT_EQ(read_scene_text(text, other.path() / "checkpoint.grs").meshes, scene.meshes);
    EXPECT_THAT(files.complaint(text), HasSubstr("meshes/plate.stl, which does not exist"));

    // Another file takes the place of the copy.
    other.write("meshes/plate.stl", plate(0.21));
    const std::string wrong = other.complaint(text);
    EXPECT_THAT(wrong, HasSubstr("scene.toml:"));
    EXPECT_THAT(wrong, tells({"'file'", "meshes/plate.stl", "another file", "hash"}));
    EXPECT_THAT(wrong, HasSubstr(", but it was " + scene.meshes[0].hash + "; put the file back as it was"));
    other.write("meshes/plate.stl", plate(0.2));
    other.write("meshes/path.csv", path_text + "4,0.005,0,0\n");
    EXPECT_THAT(other.complaint(text), tells({"'path'", "meshes/path.csv", "another file"}));
}

TEST_F(MeshScene, RefusesFilesThatAreNone) {
    EXPECT_THAT(files.complaint(with(ball_on_plate, "plate.stl", "drum.stl")),
                tells_only({"scene.toml:12:1", "'file'", "drum.stl", "not exist", "scene's folder"}));
    files.write("empty.stl", "");
    EXPECT_THAT(files.complaint(with(ball_on_plate, "plate.stl", "empty.stl")),
                tells({"scene.toml:12:1", "'file'", "cannot be used", "empty.stl"}));
    EXPECT_THAT(files.complaint(with(ball_on_plate, "file = \"plate.stl\"\n", "")),
                HasSubstr("[[mesh]] lacks 'file'"));
    EXPECT_THAT(complaint("path = \"none.csv\"\n"), tells({"'path'", "none.csv", "not exist"}));
    files.write("back.csv", "t,x,y,z\n0,0,0,0\n1,0,0,0\n0.5,0,0,0\n");
    EXPECT_THAT(complaint("path = \"back.csv\"\n"),
                tells({"scene.toml:13:1", "'path'", "cannot be used", "back.csv:4", "0.5 s"}));
    EXPECT_THAT(complaint("hash = \"0123456789abcdef\"\n"), HasSubstr("but it was 0123456789abcdef;"));
}

TEST_F(MeshScene, RefusesWhatDoesNotGoTogether) {
    struct Case {
        const char *keys, *more, *says;
    };
    const std::string turn = "turn = { axis = [0, 0, 1], rate = 1 }\n";
    for (const auto& [keys, more, says] : std::initializer_list<Case>{
             {"driven = true\n", "", "'driven' follows a drive, but there is none"},
             {"turn = { axis = [0, 0, 1], rate = 1 }\nvelocity = [1, 0, 0]\n", "",
              "'velocity' stands beside 'turn', but a mesh has one motion"},
             {"driven = true\nturn = { axis = [0, 0, 1], rate = 1 }\n", driven.c_str(),
              "'turn' stands beside 'driven'"},
             {"velocity = [1, 0, 0]\npath = \"path.csv\"\n", "", "'path' stands beside 'velocity'"},
             {"path_hash = \"x\"\n", "", "'path_hash' is of no use here: there is no 'path'"},
             {"turn = 3\n", "", "'turn' is 3; write { axis = "},
             {"turn = { rate = 1 }\n", "", "lacks 'axis'"},
             {"turn = { axis = [0, 0, 0], rate = 1 }\n", "", "'axis' must not be zero"},
             {"turn = { axis = [0, 0, 1] }\n", "", "lacks 'rate'"},
             {"turn = { axis = [0, 0, 1], rate = \"10 Hz\" }\n", "",
              "'rate' must be an angular velocity, but \"10 Hz\" is a frequency"},
             {"turn = { axis = [0, 0, 1], rate = 1, from = 1, over = 2, until = 2 }\n", "",
              "'until' is 2 s, but the turn has begun wholly at 3 s"},
             {"rotation = \"90 deg\"\n", "", "'rotation' is \"90 deg\"; write { axis"},
             {"scale = 0\n", "", "'scale' must be larger than 0"},
             {"", "[[mesh]]\nname = \"plate\"\nfile = \"plate.stl\"\n",
              "'name' \"plate\" is the name of another mesh; choose another"},
             {"", "[[mesh]]\nname = \"ball\"\nfile = \"plate.stl\"\n", "\"ball\" is the name of a species"},
             {"", "[[mesh]]\nname = \"left_wall\"\nfile = \"plate.stl\"\n",
              "\"left_wall\" is the name of a face"},
             {"", "[[mesh]]\nname = \"wall\"\nfile = \"plate.stl\"\n", "\"wall\" is the name of a face"},
             {"",
              "[[mesh]]\nname = \"chute\"\nfile = \"plate.stl\"\n[[wall]]\nname = \"chute\"\npoint = [0, 0, "
              "-1]\nnormal = [0, 0, 1]\n",
              "\"chute\" is the name of a plane"},
             {"", "[[mesh]]\nname = \" \"\nfile = \"plate.stl\"\n", "'name' must not be empty"},
             {"", "[[contact.pair]]\nbetween = [\"plate\", \"wall\"]\n", "'between' names two walls"},
             {"", "[[contact.pair]]\nbetween = [\"disc\", \"ball\"]\n",
              "names \"disc\", which is no species and no mesh; there are ball, plate, and wall"},
             {"", "[[exit]]\nlow = [0, 0, 0]\nhigh = [1, 1, 0]\n", "'low' must lie below 'high'"},
             {"", "[[exit]]\nlow = [0, 0, 0]\n", "[[exit]] lacks 'high'"},
             {"", "[exit]\nlow = [0, 0, 0]\nhigh = [1, 1, 1]\n",
              "'exit' must be a list of tables; write [[exit]]"},
             {"", "[start]\nregion = { low = [0, 0, 0], high = [1, 1, 1] }\n", "'region' is of no use here"},
         }) {
        EXPECT_THAT(complaint(keys, more), HasSubstr(says)) << keys << more;
    }
    files.write("path.csv", "t,x,y,z\n0,0,0,0\n0.01,0,0,0\n0.02,0,0,0\n0.1,0,0,0\n");
    EXPECT_THAT(complaint("path = \"path.csv\"\n"),
                tells({"'path'", "0.1 s", "0.2 s", "run.duration", "add rows", "path.csv"}));
    EXPECT_THAT(files.complaint(with(ball_on_plate, "[[grain]]\nposition = [0, 0, \"7 mm\"]\n", ""),
                                {{"species.ball.count=3"}}),
                tells({"nothing holds layers", "start.region"}));
}

TEST_F(MeshScene, RefusesWhatAVesselHasNot) {
    struct Case {
        const char *keys, *says;
    };
    for (const auto& [keys, says] : std::initializer_list<Case>{
             {"height = 1\n",
              "'height' is of no use here: the mesh that 'mesh' names says the container's whole shape"},
             {"width = 1\n", "'width' is of no use here"},
             {"diameter = 1\n", "'diameter' is of no use here"},
             {"half_angle = 1\n", "'half_angle' is of no use here"},
             {"top = \"lid\"\n", "'top' is of no use here"},
             {"outlet = { width = 0.01 }\n", "'outlet' is of no use here: a mesh has no floor of its own"},
             {"tray = { depth = 0.01 }\n", "'tray' is of no use here"},
             {"wall_grains = { faces = [\"floor\"] }\n",
              "'wall_grains' is of no use here: grains can be glued to no mesh"},
             {"periodic_depth = true\n", "'periodic_depth' is of no use here"},
             {"turn = { axis = [0, 0, 1], rate = 1 }\n",
              "'turn' is of no use here: a mesh is turned by the 'turn' of its own [[mesh]]"},
         })
        EXPECT_THAT(
            files.complaint(with(in_vessel, "mesh = \"tank\"\n", std::string("mesh = \"tank\"\n") + keys)),
            HasSubstr(says))
            << keys;
    EXPECT_THAT(files.complaint(with(in_vessel, "mesh = \"tank\"\n", "")),
                HasSubstr("[container] lacks 'mesh'"));
    EXPECT_THAT(files.complaint(with(in_vessel, "mesh = \"tank\"\n", "mesh = \"tub\"\n")),
                tells({"'mesh'", "\"tub\"", "no [[mesh]]", "\"tank\""}));
    EXPECT_THAT(files.complaint(with(in_vessel, "tank.stl", "plate.stl")),
                tells({"'mesh'", "\"tank\"", "encloses nothing"}));
    EXPECT_THAT(files.complaint(in_vessel + driven + "moves = \"floor\"\n"),
                tells({"'moves'", "\"floor\"", "mesh", "no floor"}));
    EXPECT_THAT(files.complaint(with(in_vessel, "diameter = \"10 mm\"", "diameter = \"9 cm\"")),
                tells({"0.09 m", "not fit", "mesh \"tank\""}));
    EXPECT_THAT(files.complaint(in_vessel, {{"species.small.count=30000"}}),
                HasSubstr("of the container's 0.0008 m3"));
    EXPECT_THAT(files.complaint(
                    with(in_vessel, "file = \"tank.stl\"\n", "file = \"tank.stl\"\nposition = [0, 0, -1]\n")),
                HasSubstr("below z = 0"));
    EXPECT_THAT(files.complaint(in_vessel + "[start]\nregion = { low = [1, 1, 1], high = [2, 2, 2] }\n"),
                tells({"'region'", "no room"}));
}

const std::string in_box =
    with(in_vessel, "shape = \"mesh\"\nmesh = \"tank\"\n[[mesh]]\nname = \"tank\"\nfile = \"tank.stl\"\n",
         "shape = \"box\"\nwidth = 0.1\ndepth = 0.1\nheight = 0.1\n#more\n");
const std::string turning_box = with(in_box, "#more\n", "turn = { axis = [0, 1, 0], rate = 1 }\n#more\n");
const std::string turning_cylinder = with(with(turning_box, "shape = \"box\"\nwidth = 0.1\ndepth = 0.1\n",
                                               "shape = \"cylinder\"\ndiameter = 0.1\n"),
                                          "axis = [0, 1, 0]", "axis = [0, 0, 2]");

TEST_F(MeshScene, ContainersTurn) {
    EXPECT_EQ(files.read(turning_box).container.turn->axis, Vec3(0, 1, 0));
    EXPECT_EQ(files.read(turning_cylinder).container.turn->axis, Vec3(0, 0, 1));
    const std::pair<const char*, const char*> company[] = {
        {"outlet = { width = 0.03 }\n", "'turn' cannot stand beside 'outlet'"},
        {"wall_grains = { faces = [\"floor\"] }\n", "'turn' cannot stand beside 'wall_grains'"},
        {"periodic_depth = true\n", "'turn' cannot stand beside 'periodic_depth'"}};
    for (const auto& [keys, says] : company)
        EXPECT_THAT(files.complaint(with(turning_box, "#more\n", keys)), HasSubstr(says));
    EXPECT_THAT(files.complaint(turning_box + driven + "moves = \"floor\"\n"),
                tells({"'turn'", "cannot stand", "drive.moves = \"floor\""}));
    EXPECT_THAT(files.complaint(with(turning_cylinder, "axis = [0, 0, 2]", "axis = [1, 0, 0]")),
                tells({"'axis'", "cylinder's own axis", "drum"}));
    EXPECT_THAT(files.complaint(
                    with(turning_cylinder, "axis = [0, 0, 2]", "axis = [0, 0, 1], through = [0.01, 0, 0]")),
                tells({"'through'", "cylinder's own axis"}));
    EXPECT_THAT(files.complaint(with(in_box, "#more\n", "periodic_depth = true\n") +
                                "[[mesh]]\nfile = \"plate.stl\"\nscale = 0.1\n"),
                tells({"'periodic_depth'", "cannot stand", "[[mesh]]"}));
    EXPECT_THAT(files.complaint(with(in_box, "#more\n", "mesh = \"tank\"\n")),
                tells({"'mesh'", "of no use", "shape = \"mesh\""}));
}

TEST_F(MeshScene, HintsAtMillimetres) {
    files.write("plate.stl", plate(200));
    const Scene scene = files.read(ball_on_plate);
    ASSERT_EQ(scene.notes.size(), 1u);
    EXPECT_THAT(scene.notes[0], tells({"mesh \"plate\"", "200 m", "0.01 m", "scale = 0.001"}));
    files.write("plate.stl", plate(0.002));
    EXPECT_THAT(files.read(ball_on_plate).notes.at(0), HasSubstr("smaller than the smallest grain"));
}

TEST_F(MeshScene, TellsWhatWasMended) {
    MeshByHand twice = plate(0.2);
    twice.push_back(twice.front());
    files.write("plate.stl", twice);
    ASSERT_EQ(files.read(ball_on_plate).notes.size(), 1u);
    EXPECT_THAT(files.read(ball_on_plate).notes[0], HasSubstr("scene.toml:12:1: mesh \"plate\": "));
}

// A seam costs (1 - e^2) sin^2 of its turn.
TEST_F(MeshScene, TellsWhatSeamsOfARoundWallCost) {
    const auto warning = [&](int facets, double e) {
        MeshByHand pipe;
        const auto corner = [&](int k, double x) {
            return Vec3(x, 0.05 * std::cos(2 * pi * k / facets), 0.05 * std::sin(2 * pi * k / facets));
        };
        for (int k = 0; k < facets; ++k)
            add_quad(pipe, corner(k, -0.02), corner(k, 0.02), corner(k + 1, 0.02), corner(k + 1, -0.02));
        files.write("plate.stl", pipe);
        const Scene scene = files.read(
            std::string(ball_on_plate) +
            fmt::format("[[contact.pair]]\nbetween = [\"ball\", \"plate\"]\nrestitution = {}\n", e));
        for (const std::string& line : make_plan(scene).warnings)
            if (line.find("seam") != std::string::npos) return line;
        return std::string();
    };
    const double sine = std::sin(2 * pi / 36);
    EXPECT_THAT(warning(36, 0.5),
                tells({"\"plate\"", "10 degrees", fmt::format("{:.2g} %", 75 * sine * sine), "more facets"}));
    EXPECT_EQ(warning(36, 0.95), "");  // 0.3 %
    EXPECT_NE(warning(72, 0.5), "");   // 0.57 %
    EXPECT_EQ(warning(72, 0.6), "");   // 0.49 %
    EXPECT_EQ(warning(8, 0.5), "");    // eight walls that meet at edges
    EXPECT_THAT(warning(24, 0.5), tells({"15 degrees", "too far to be one wall", "5 %", "more facets"}));
    EXPECT_THAT(warning(34, 0.5), tells({"11 degrees", "too far to be one wall"}));
    EXPECT_NE(warning(12, 0.5), "");
}

}  // namespace
}  // namespace grainreel
