// Tests of the scenes that come with the program: they are listed, copied and run by name.
#include "engine/scene/shipped/shipped_scenes.hpp"
#include "engine/measure/columns.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <set>
#include <sstream>

#include "render/scene/filmed_scene.hpp"
#include "tests/cli/program.hpp"
#include "tests/support/tells.hpp"
#include "tests/support/temporary_folder.hpp"

namespace grainreel {
namespace {

using namespace test;
using testing::HasSubstr;
namespace fs = std::filesystem;

std::string text_of(const fs::path& file) {
    std::ostringstream text;
    text << std::ifstream(file, std::ios::binary).rdbuf();
    return text.str();
}

TEST(ShippedScenes, AreTheFilesOfTheFolderScenes) {
    std::set<std::string> files, names;
    for (const auto& entry : fs::directory_iterator(GRAINREEL_SOURCE "/scenes"))
        if (entry.path().extension() == ".toml") files.insert(entry.path().stem());
    for (const ShippedScene& scene : shipped_scenes()) {
        names.insert(scene.name);
        EXPECT_EQ(scene.text, text_of(fs::path(GRAINREEL_SOURCE "/scenes") / (scene.name + ".toml")));
        EXPECT_THAT(scene.about(), testing::Not(testing::IsEmpty())) << scene.name;
        EXPECT_EQ(scene.about().find('\n'), std::string::npos);
    }
    EXPECT_EQ(names, files);
}

TEST(ShippedScenes, AreFoundByNameAndByWordsOfIt) {
    EXPECT_EQ(shipped_scene("gravel")->name, "gravel");
    EXPECT_EQ(shipped_scene("wedge-mixing.toml")->name, "wedge_mixing");
    EXPECT_EQ(shipped_scene("brazil-nut"), nullptr);
    EXPECT_EQ(shipped_scene_like("brazil-nut")->name, "teaching_brazil_nut");
    EXPECT_EQ(shipped_scene_like("wedge"), nullptr) << "there are several";
    EXPECT_EQ(nearest_shipped_scene("gravle"), "gravel");
    EXPECT_EQ(nearest_shipped_scene("brazil-nuts"), "teaching_brazil_nut");
    EXPECT_EQ(nearest_shipped_scene("convektion-box"), "convection_box");
    EXPECT_EQ(nearest_shipped_scene("/nowhere"), std::nullopt);
}

// In an installed program there is no folder scenes/studies.
TEST(ShippedStudies, AreFoundByNameWithTheirSceneAndPoints) {
    std::size_t files = 0;
    for (const auto& entry : fs::directory_iterator(GRAINREEL_SOURCE "/scenes/studies")) {
        const std::string name = entry.path().stem().string();
        if (entry.path().extension() != ".toml") continue;
        ++files;
        ASSERT_NE(shipped_scene(name, shipped_studies()), nullptr) << name;
        EXPECT_EQ(shipped_scene(name, shipped_studies())->text, text_of(entry.path()));
    }
    EXPECT_EQ(files, shipped_studies().size());
    const TemporaryFolder folder;
    const auto study = [&](const char* name, const char* how) {
        return run_program({"study", name, how}, {.folder = folder.path()});
    };
    const Ended flight = study("bed-flight", "--dry-run");
    EXPECT_EQ(flight.status, 0) << flight.err;
    EXPECT_THAT(flight.out, tells({"study", "bed_flight.toml"}));
    EXPECT_THAT(flight.out, tells({"folder", "output/bed_flight"}));
    EXPECT_EQ(study("surface_waves_fine", "--collect").status, 0) << "its points are in the program too";
    EXPECT_TRUE(fs::exists(folder / "output/surface_waves_fine/study.toml"));
    const Ended again = run_program({"study", "output/surface_waves_fine/study.toml", "--dry-run"},
                                    {.folder = folder.path()});
    EXPECT_EQ(again.status, 0) << again.err;
    EXPECT_THAT(study("janssens", "--dry-run").err, tells({"janssens", "no such file", "'janssen'?"}));
    EXPECT_THAT(study("intruder", "--dry-run").err, tells({"several", "intruder_shaking, intruder_size"}));
    EXPECT_THAT(run_program({"scenes"}, {.folder = folder.path()}).out, tells({"brazil_nut_shaking"}));
}

// The first sentence is shown; a full stop inside a number does not end it.
TEST(ShippedScenes, AreToldByTheFirstSentenceOfTheirComment) {
    EXPECT_EQ((ShippedScene{"a", "# Grains of 0.5 mm\n#   fall. They rest.\n\ntitle = 1\n"}.about()),
              "Grains of 0.5 mm fall");
    EXPECT_EQ((ShippedScene{"a", "# Why do they rise? Look.\n"}.about()), "Why do they rise?");
    EXPECT_EQ((ShippedScene{"a", "title = 1\n"}.about()), "");
}

TEST(ShippedScenes, AreReadByNameWhereThereIsNoSuchFile) {
    const FilmedScene by_name = read_filmed_scene("oblique_impact");
    const FilmedScene by_file = read_filmed_scene(GRAINREEL_SOURCE "/scenes/oblique_impact.toml");
    EXPECT_EQ(by_name.name, by_file.name);
    EXPECT_EQ(by_name.run.duration, by_file.run.duration);
    const TemporaryFolder folder;
    const Ended ended = run_program({"check", "gravle"}, {.folder = folder.path()});
    EXPECT_EQ(ended.status, 2);
    EXPECT_THAT(ended.err, tells({"gravle", "no such file", "'gravel'?"}));
    EXPECT_EQ(read_filmed_scene("brazil-nut", {}, measurable_in).name, "teaching_brazil_nut");
    EXPECT_THAT(run_program({"check", "hopper"}, {.folder = folder.path()}).err,
                tells({"several", "cone_hopper, hopper_discharge, hopper_mixture"}));
    EXPECT_THAT(run_program({"movie"}, {.folder = folder.path()}).err,
                tells({"needs a scene", "movie wedge_segregation"}));
}

TEST(NewScene, IsACopyThatCanBeRead) {
    const TemporaryFolder folder;
    const Ended ended = run_program({"new"}, {.folder = folder.path()});
    EXPECT_EQ(ended.status, 0) << ended.err;
    EXPECT_EQ(ended.out, "gravel.toml\n");
    EXPECT_EQ(text_of(folder.path() / "gravel.toml"),
              "#:schema ./grainreel.schema.json\n" + std::string(shipped_scene("gravel")->text));
    EXPECT_EQ(text_of(folder.path() / "grainreel.schema.json"), run_program({"schema"}, {}).out);
    std::ofstream(folder.path() / "grainreel.schema.json") << "mine";
    EXPECT_EQ(run_program({"new", "mine", "--from", "brazil-nut"}, {.folder = folder.path()}).out,
              "mine.toml\n");
    const auto title_of = [](const fs::path& scene) {
        return read_filmed_scene(scene, {}, measurable_in).title;
    };
    EXPECT_EQ(title_of(folder.path() / "mine.toml"), title_of("teaching_brazil_nut"));
    EXPECT_EQ(text_of(folder.path() / "grainreel.schema.json"), "mine") << "nothing is overwritten";
}

TEST(NewScene, OverwritesNothing) {
    const TemporaryFolder folder;
    std::ofstream(folder.path() / "gravel.toml") << "precious";
    const Ended ended = run_program({"new"}, {.folder = folder.path()});
    EXPECT_EQ(ended.status, 2);
    EXPECT_THAT(ended.err, tells_only({"error: gravel.toml", "already", "another name"}));
    EXPECT_EQ(text_of(folder.path() / "gravel.toml"), "precious");
    const Ended unknown = run_program({"new", "x", "--from", "wedge"}, {.folder = folder.path()});
    EXPECT_EQ(unknown.status, 2);
    EXPECT_THAT(unknown.err, tells({"--from", "no single scene", "'wedge'"}));
    EXPECT_FALSE(fs::exists(folder.path() / "x.toml"));
    EXPECT_THAT(run_program({"new", "no/such"}, {.folder = folder.path()}).err,
                tells_only({"error: no: ", "no such folder", "make it"}));
}

TEST(Doctor, FindsWhatFilmsNeed) {
    const Ended ended = run_program({"doctor"}, {});
    EXPECT_EQ(ended.err, "") << "encoders that are tried say nothing";
    EXPECT_EQ(ended.status, 0) << ended.out << ended.err;
    for (const char* words : {"ok       processors", "M grain-steps/s on one thread", "ok       OpenGL by",
                              "H.264 in MP4", "Films can be made here."})
        EXPECT_THAT(ended.out, HasSubstr(words));
}

}  // namespace
}  // namespace grainreel
