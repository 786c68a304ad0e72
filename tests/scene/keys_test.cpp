// Tests of the list of keys: the documentation, the reader, defaults and bounds agree.
#include "engine/scene/keys/keys.hpp"

#include <gtest/gtest.h>

#include <fmt/format.h>

#include <cmath>
#include <cstdlib>
#include <fstream>
#include <map>
#include <sstream>

#include "engine/base/error.hpp"
#include "engine/plan/resolved_scene.hpp"
#include "render/scene/filmed_scene.hpp"
#include "tests/scene/meshes_by_hand.hpp"
#include "tests/scene/scene_text.hpp"

namespace grainreel {
namespace {

const std::string page = GRAINREEL_SOURCE "/docs/reference/scenes.md";
const std::string begin_mark = "<!-- table of keys: generated from engine/scene/scene_file.cpp, begin -->\n";
const std::string end_mark = "<!-- table of keys: end -->\n";

std::string load(const std::string& path) {
    std::ifstream file(path);
    std::ostringstream text;
    text << file.rdbuf();
    return text.str();
}

TEST(Keys, DocsTellWhatTheReaderKnows) {
    std::string text = load(page);
    const auto begin = text.find(begin_mark);
    const auto end = text.find(end_mark);
    ASSERT_NE(begin, std::string::npos);
    ASSERT_NE(end, std::string::npos);
    const auto start = begin + begin_mark.size();
    if (std::getenv("GRAINREEL_WRITE_DOCS") != nullptr) {
        text.replace(start, end - start, key_table_markdown(filmed_scene_keys()));
        std::ofstream(page) << text;
        return;
    }
    EXPECT_EQ(text.substr(start, end - start), key_table_markdown(filmed_scene_keys()))
        << "docs/reference/scenes.md is not what engine/scene/scene_file.cpp says; write it anew with\n"
           "  GRAINREEL_WRITE_DOCS=1 test_scene --gtest_filter=Keys.DocsTellWhatTheReaderKnows";
}

// A documented default that is written into a scene changes nothing.
TEST(Keys, DocumentedDefaultsAreTheDefaults) {
    const std::string locked = wedge_text + "[[film.segment]]\nkind = \"locked\"\n";
    const std::string motion = wedge_text + "[[film.segment]]\nduration = 2\nexposure = 0.01\n";
    std::string box = box_text;
    for (const char* line :
         {"gravity = 0\n", "normal_damping = 2634\n", "friction = 0.5\n", "duration = 0.1\n"})
        box = with(box, line, "");
    const std::string from_file =
        wedge_text + "[start]\nmethod = \"file\"\nfile = \"" GRAINREEL_SOURCE "/docs/reference/scenes.md\"\n";
    std::string exact = exact_text;
    for (const char* line : {"gravity = 0\n", "velocity = [0, 0, \"10 cm/s\"]\n",
                             "velocity = [0, \"0.5 m/s\", 0]\n", "spin = [0, 0, \"60 rad/s\"]\n"})
        exact = with(exact, line, "");
    exact += "[drive]\nfrequency = 20\namplitude = 0.001\n";
    const std::string layers = wedge_text + "[film.colour]\nby = \"start-height\"\n";
    const std::string fields = wedge_text + "[output.fields]\ngrid = \"yz\"\n";
    const std::string outlet =
        with(wedge_text, "height = \"180 mm\"\n", "height = \"180 mm\"\noutlet = { width = \"20 mm\" }\n");
    const std::string rough = with(wedge_text, "height = \"180 mm\"\n",
                                   "height = \"180 mm\"\nwall_grains = { faces = [\"floor\"] }\n");
    const std::string fed = wedge_text + "[[feed]]\nrate = 10\n";
    const std::string staged = wedge_text + "[[drive.stage]]\nfrom = 1\n";
    const std::string captioned = wedge_text + "[[film.caption]]\nfrom = 1\ntext = \"a\"\n";
    const std::string plotted = wedge_text + "[[film.plot]]\ny = \"lacey\"\n";
    const std::string placed = wedge_text + "[film.gutters]\nplace = \"sides\"\n";
    const MeshScenes files;
    const std::string meshed = exact +
                               "[[exit]]\nlow = [-2, -2, -2]\nhigh = [2, 2, -1]\n[[mesh]]\nfile = \"" +
                               files.write("plate.stl", plate(0.02)).string() + "\"\n";
    const std::string turned = meshed + "turn = { axis = [0, 0, 1], rate = 1 }\n";
    const std::string turning = with(wedge_text, "height = \"180 mm\"\n",
                                     "height = \"180 mm\"\nturn = { axis = [1, 0, 0], rate = 1 }\n");
    MeshByHand shelf = plate(0.02);
    for (TriangleByHand& triangle : shelf)
        for (Vec3& corner : triangle) corner.z() = 0.1;
    const std::string shelved =
        wedge_text + "[[mesh]]\nfile = \"" + files.write("shelf.stl", shelf).string() + "\"\n";
    const std::string cases[] = {wedge_text, box,    locked,  motion,  from_file, exact,     layers,
                                 fields,     outlet, rough,   fed,     staged,    captioned, plotted,
                                 meshed,     turned, turning, shelved, placed};
    const auto resolved = [](const FilmedScene& scene) { return resolved_scene(scene, make_plan(scene)); };
    std::map<const std::string*, std::string> plain;
    for (const std::string& text : cases) plain[&text] = resolved(read_text(text));
    for (const Key& key : filmed_scene_keys()) {
        if (key.fallback.empty()) continue;
        std::string path = key.path;
        if (const auto at = path.find("[]"); at != std::string::npos) path.replace(at, 2, "[0]");
        bool tried = false;
        for (const std::string& text : cases) {
            const auto dot = path.rfind('.');
            const std::string name = path.substr(dot == std::string::npos ? 0 : dot + 1);
            if (text.find("\n" + name + " =") != std::string::npos) continue;  // the scene has another value
            if (path.rfind("film.segment", 0) == 0 && text.find("[[film.segment]]") == std::string::npos)
                continue;
            std::string with_default;
            try {
                with_default = resolved(read_text(text, {path + "=" + key.fallback}));
            } catch (const UserError&) {
                continue;  // the key is of no use in this scene
            }
            EXPECT_EQ(with_default, plain.at(&text)) << key.path;
            tried = true;
        }
        EXPECT_TRUE(tried) << key.path;
    }
}

// Advice is useless if its example is refused too.
TEST(Keys, ExamplesAreInsideTheirBounds) {
    for (const Key& key : filmed_scene_keys()) {
        if (key.kind != KeyKind::quantity && key.kind != KeyKind::integer) continue;
        std::string text = key.example();
        if (text.front() == '"') text = text.substr(1, text.size() - 2);
        const bool number = text.find_first_not_of("0123456789.e+-") == std::string::npos;
        const double value = number ? std::stod(text) : parse_quantity(text, key.dimension);
        EXPECT_TRUE(key.bounds().contains(value)) << key.path << " = " << key.example();
        if (key.kind == KeyKind::integer) {
            EXPECT_EQ(value, std::round(value)) << key.path;
        }
    }
}

TEST(Keys, DocsTellTheBoundsOfQuantities) {
    const std::string text = load(GRAINREEL_SOURCE "/docs/reference/scene_basics.md");
    for (int d = 0; d < static_cast<int>(Dimension::number); ++d) {
        const DimensionText& size = text_of(static_cast<Dimension>(d));
        const std::string row = fmt::format(
            "| {} | {} | {} | {:g} |\n", std::string(size.noun).substr(size.noun[1] == 'n' ? 3 : 2),
            size.unit, size.least > 0 ? fmt::format("{:g}", size.least) : "", size.most);
        EXPECT_NE(text.find(row), std::string::npos) << row;
    }
}

TEST(Keys, NearestKeyForgivesSwapsAndSlips) {
    EXPECT_EQ(advice_for_unknown_key("drive.freqeuncy", filmed_scene_keys()), "did you mean 'frequency'?");
    EXPECT_EQ(advice_for_unknown_key("species[3].color", filmed_scene_keys()), "did you mean 'colour'?");
    EXPECT_EQ(advice_for_unknown_key("container.slantheight", filmed_scene_keys()),
              "did you mean 'slant_height'?");
    EXPECT_EQ(advice_for_unknown_key("film.camera.quality", filmed_scene_keys()), "it belongs in [film]");
    EXPECT_EQ(advice_for_unknown_key("outlet", filmed_scene_keys()), "did you mean 'container.outlet'?");
    // The gamma of a contact is something else.
    for (const char* drive : {"drive", "drive.stage[0]"})
        for (const char* name : {"gamma", "Gamma", "Γ", "acceleration"})
            EXPECT_EQ(advice_for_unknown_key(fmt::format("{}.{}", drive, name), filmed_scene_keys()),
                      "did you mean 'g_level'?")
                << drive << " " << name;
    EXPECT_EQ(advice_for_unknown_key("species[0].gamma", filmed_scene_keys()), "it belongs in [contact]");
}

TEST(Keys, TablesAndArraysOfTables) {
    EXPECT_TRUE(is_table_path("drive", filmed_scene_keys()));
    EXPECT_TRUE(is_table_path("contact.wall", filmed_scene_keys()));
    EXPECT_TRUE(is_table_path("species[7]", filmed_scene_keys()));
    EXPECT_TRUE(is_table_array_path("species", filmed_scene_keys()));
    EXPECT_TRUE(is_table_array_path("film.segment", filmed_scene_keys()));
    EXPECT_FALSE(is_table_array_path("drive", filmed_scene_keys()));
    EXPECT_FALSE(is_table_path("driv", filmed_scene_keys()));
    EXPECT_EQ(find_key("species[12].count", filmed_scene_keys())->path, "species[].count");
    EXPECT_EQ(find_key("species[12]", filmed_scene_keys()), nullptr);
}

}  // namespace
}  // namespace grainreel
