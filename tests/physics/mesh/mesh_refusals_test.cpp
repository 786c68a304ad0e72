// Tests of scenes with meshes that are refused before they run, with the line that is wrong.
#include <gmock/gmock.h>

#include "engine/plan/plan.hpp"
#include "engine/run/simulation/simulated_bed.hpp"
#include "tests/physics/mesh/mesh_files.hpp"
#include "tests/support/small_scene.hpp"
#include "tests/support/tells.hpp"

namespace grainreel {
namespace {

using test::tells;
using testing::AllOf;
using testing::HasSubstr;

const std::string kHead = test::SmallScene()
                              .beads(20, "beads", "4 mm", "2.5 g/cm3")
                              .contacts("0.6", "0.4")
                              .lasts("0.5 s")
                              .more("threads = 1\n")
                              .text();
const char* const kBox = R"([container]
shape = "box"
width = "100 mm"
depth = "200 mm"
height = "100 mm"
)";

class MeshRefusals : public MeshFiles {
  protected:
    // The message when the scene is read and planned and its grains are taken, or "".
    std::string said(const std::string& text) const {
        try {
            const Scene scene = read(text);
            check_start(scene, make_plan(scene));
        } catch (const UserError& error) {
            return error.what();
        }
        return "";
    }
    // The beginning of a message: the place of the scene's line that holds `part`.
    static std::string at(const std::string& text, const std::string& part) {
        return fmt::format("scene.toml:{}:", line_of(text, part));
    }
};

std::string mesh(const std::string& name, const std::string& more = "") {
    return "[[mesh]]\nname = \"" + name + "\"\nfile = \"" + name + ".stl\"\n" + more;
}

std::string listed(const Vec3& place) {
    return fmt::format("[[grain]]\nposition = [{}, {}, {}]\n", place.x(), place.y(), place.z());
}

const std::string kListed = test::SmallScene()
                                .beads(0, "beads", "4 mm", "2.5 g/cm3")
                                .more("[contact]\nrestitution = 0.6\n[start]\nmethod = \"grains\"\n")
                                .text();

TEST_F(MeshRefusals, AGrainInsideAWallIsRefused) {
    write("block.stl", box_of_triangles(Vec3(-0.02, -0.02, 0.01), Vec3(0.02, 0.02, 0.05)));
    const std::string head = std::string(kListed) + kBox + mesh("block");
    const std::string deep = head + listed(Vec3(0.05, 0, 0.05)) + listed(Vec3(0, 0, 0.03));
    EXPECT_THAT(said(deep), AllOf(HasSubstr(at(deep, "[[grain]]\nposition = [0, 0, 0.03]")),
                                  HasSubstr("inside the mesh \"block\"")));
    // The centre is 1 mm above its upper side, so the grain is inside by half a radius.
    const std::string close = head + listed(Vec3(0.01, 0, 0.051));
    EXPECT_THAT(said(close), tells({"overlaps", "mesh \"block\"", "0.50 of its radius"}));
    EXPECT_EQ(said(head + listed(Vec3(0.01, 0, 0.0515))), "");
}

TEST_F(MeshRefusals, AGrainOutsideAClosedVesselIsRefused) {
    write("vessel.stl", box_of_triangles(Vec3(-0.02, -0.02, 0), Vec3(0.02, 0.02, 0.05)));
    const std::string head =
        std::string(kListed) + "[container]\nshape = \"mesh\"\nmesh = \"vessel\"\n" + mesh("vessel");
    EXPECT_EQ(said(head + listed(Vec3(0, 0, 0.02))), "");
    EXPECT_THAT(said(head + listed(Vec3(0, 0, 0.06))), HasSubstr("outside the vessel \"vessel\""));
    // If the box is open above, the grain may fall into it.
    write("vessel.stl", box_of_triangles(Vec3(-0.02, -0.02, 0), Vec3(0.02, 0.02, 0.05), true));
    EXPECT_EQ(said(head + listed(Vec3(0, 0, 0.06))), "");
}

TEST_F(MeshRefusals, AMeshFarFromAllGrainsIsRefused) {
    write("vane.stl", box_of_triangles(Vec3(-0.02, -0.002, 0.02), Vec3(0.02, 0.002, 0.05)));
    const std::string head = std::string(kHead) + kBox;
    EXPECT_EQ(said(head + mesh("vane")), "");
    const std::string away = head + mesh("vane", "position = [3, 0, 0]\n");
    EXPECT_THAT(said(away),
                AllOf(HasSubstr(at(away, "file = \"vane.stl\"")), HasSubstr("far from all grains")));
    // If the file is in millimetres, its sides are 20 m away.
    write("drum.stl", pipe(200, -100, 100, 36));
    const std::string large = std::string(kHead) + R"([container]
shape = "none"
[start]
region = { low = [-0.05, -0.05, -0.05], high = [0.05, 0.05, 0.05] }
)" + mesh("drum");
    EXPECT_THAT(said(large), AllOf(HasSubstr("far from all grains"), HasSubstr("scale = 0.001")));
}

// A bar of 180 mm along x in a box of 200 mm x 100 mm turns about z.
TEST_F(MeshRefusals, AMeshThatTurnsIntoAFaceIsRefused) {
    write("bar.stl", box_of_triangles(Vec3(-0.09, -0.002, 0.02), Vec3(0.09, 0.002, 0.05)));
    const std::string turn = "turn = { axis = [0, 0, 1], rate = \"60 rpm\" }\n";
    const std::string bar = std::string(kHead) + kBox + mesh("bar", turn);
    EXPECT_THAT(said(bar), AllOf(HasSubstr(at(bar, "turn = {")), HasSubstr("moves into the"),
                                 HasSubstr("wall"), HasSubstr("turned by")));
    EXPECT_EQ(said(std::string(kHead) + kBox + mesh("bar", "scale = 0.5\n" + turn)), "");
    // This turn is too slow to reach the face: 0.5 s at 6 rpm are 18 degrees.
    EXPECT_EQ(
        said(std::string(kHead) + kBox + mesh("bar", "turn = { axis = [0, 0, 1], rate = \"6 rpm\" }\n")), "");
}

TEST_F(MeshRefusals, AMeshThatTurnsIntoAnotherIsRefused) {
    write("bar.stl", box_of_triangles(Vec3(-0.09, -0.002, 0.02), Vec3(0.09, 0.002, 0.05)));
    write("post.stl", box_of_triangles(Vec3(-0.005, 0.05, 0.01), Vec3(0.005, 0.06, 0.06)));
    const std::string text = std::string(kHead) + R"([container]
shape = "none"
[start]
region = { low = [-0.08, -0.08, 0.06], high = [0.08, 0.08, 0.1] }
)" + mesh("bar", "turn = { axis = [0, 0, 1], rate = \"60 rpm\" }\n") +
                             mesh("post");
    EXPECT_THAT(said(text), AllOf(HasSubstr(at(text, "turn = {")), HasSubstr("\"bar\" moves into \"post\"")));
    // Here the face is out of its way.
    std::string clear = text;
    EXPECT_EQ(said(clear + "position = [0, 0.1, 0]\n"), "");
}

// A drum turns between two discs that stand still and are deliberately as wide as it or wider.
TEST_F(MeshRefusals, MeshesThatTouchAtRestMayMove) {
    write("drum.stl", pipe(0.05, -0.03, 0.03, 36));
    for (const double width : {0.05, 0.07}) {
        write("left.stl", disc(width, -0.03, 36));
        write("right.stl", disc(width, 0.03, 36));
        const std::string text = std::string(kHead) + R"(gravity = [0, -9.81, 0]
[container]
shape = "none"
[start]
region = { low = [-0.02, -0.02, -0.02], high = [0.02, 0.02, 0.02] }
)" + mesh("drum", "turn = { axis = [0, 0, 1], rate = \"60 rpm\" }\n") +
                                 mesh("left") + mesh("right");
        std::string moved = text;
        moved.erase(moved.find("gravity"), std::string("gravity = [0, -9.81, 0]\n").size());
        EXPECT_EQ(said("gravity = [0, -9.81, 0]\n" + moved), "") << width;
    }
}

// A shaft passes through the walls in which it turns.
TEST_F(MeshRefusals, MeshesThatCrossAtRestMayTurn) {
    write("shaft.stl", pipe(0.005, -0.05, 0.2, 24));
    write("vessel.stl", box_of_triangles(Vec3(-0.05, -0.05, 0), Vec3(0.05, 0.05, 0.1)));
    const std::string text = std::string(kHead) + "[container]\nshape = \"mesh\"\nmesh = \"vessel\"\n" +
                             mesh("vessel") +
                             mesh("shaft", "turn = { axis = [0, 0, 1], rate = \"60 rpm\" }\n");
    EXPECT_EQ(said(text), "");
}

// A rim of 20 mm at 100,000 rpm moves at 209 m/s.
TEST_F(MeshRefusals, ARimThatIsTooFastIsRefused) {
    write("vane.stl", box_of_triangles(Vec3(-0.02, -0.002, 0.02), Vec3(0.02, 0.002, 0.05)));
    const std::string head = std::string(kHead) + kBox;
    const auto turning = [&](const char* rate) {
        return head + mesh("vane", std::string("turn = { axis = [0, 0, 1], rate = \"") + rate + "\" }\n");
    };
    EXPECT_EQ(said(turning("600 rpm")), "");
    const std::string fast = turning("100000 rpm");
    EXPECT_THAT(said(fast), AllOf(HasSubstr(at(fast, "turn = {")), HasSubstr("of the smallest grain"),
                                  HasSubstr("times slower")));
    const std::string drum = std::string(kHead) + R"([container]
shape = "cylinder"
diameter = "100 mm"
height = "50 mm"
turn = { axis = [0, 0, 1], rate = "100000 rpm" }
)";
    EXPECT_THAT(said(drum), AllOf(HasSubstr(at(drum, "turn = {")), HasSubstr("container")));
}

TEST_F(MeshRefusals, AFeedInAMeshIsRefused) {
    write("block.stl", box_of_triangles(Vec3(-0.02, -0.02, 0.01), Vec3(0.02, 0.02, 0.05)));
    const std::string head = std::string(kHead) + kBox + mesh("block");
    const auto fed = [&](double low) {
        return head + fmt::format(
                          "[[feed]]\nrate = 100\nlow = [-0.01, -0.01, {}]\nhigh = [0.01, 0.01, 0.09]\n", low);
    };
    EXPECT_EQ(said(fed(0.055)), "");
    EXPECT_THAT(said(fed(0.04)), AllOf(HasSubstr(at(fed(0.04), "low = [-0.01")), HasSubstr("\"block\"")));
}

}  // namespace
}  // namespace grainreel
