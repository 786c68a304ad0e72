// Tests of the writer of scenes: a scene that is written and read again is the same.
#include "engine/mesh/room.hpp"
#include "engine/plan/resolved_scene.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <sstream>

#include "render/scene/filmed_scene.hpp"
#include "tests/scene/meshes_by_hand.hpp"
#include "tests/scene/scene_text.hpp"

namespace grainreel {
namespace {

// The writer promises to keep this: the scene with the plan's choices filled in.
FilmedScene filled_in(FilmedScene scene, const Plan& plan) {
    const std::size_t count = scene.species.size();
    const auto stiffness = [](const PairPlan& pair) {
        return pair.modulus > 0 ? pair.modulus : pair.loading_stiffness;
    };
    for (std::size_t i = 0; i < count * count; ++i)
        scene.contact.grain[i].stiffness = stiffness(plan.grain[i]);
    for (std::size_t i = 0; i < count; ++i) scene.contact.wall[i].stiffness = stiffness(plan.wall[i]);
    for (std::size_t i = 0; i < plan.mesh.size(); ++i)
        scene.contact.mesh[i].stiffness = stiffness(plan.mesh[i]);
    for (std::size_t i = 0; i < plan.glued.size(); ++i) {
        const std::size_t glued = scene.container.wall_grains->species;
        scene.contact.grain[i * count + glued].glued_stiffness = stiffness(plan.glued[i]);
        scene.contact.grain[glued * count + i].glued_stiffness = stiffness(plan.glued[i]);
    }
    scene.run.step = plan.clock.step;
    scene.output.instruments = scene.instruments();
    scene.run.steps_per_contact.reset();
    // If the drive changes, records follow its periods, which no interval can express.
    if (scene.output.trajectory && plan.trajectory_periods == 0)
        scene.output.trajectory_interval = static_cast<double>(plan.trajectory_every) * plan.clock.step;
    if (plan.measures_periods == 0)
        scene.output.measures_interval = static_cast<double>(plan.measures_every) * plan.clock.step;
    return scene;
}

std::string scene_without_remarks(const FilmedScene& scene, const Plan& plan) {
    std::istringstream lines(resolved_scene(scene, plan));
    std::string text;
    for (std::string line; std::getline(lines, line);)
        if (!line.starts_with('#')) text += line + "\n";
    return text;
}

// Compares bit by bit, except for the words about who chose the stiffness.
void expect_equal(std::vector<PairPlan> again, std::vector<PairPlan> plan) {
    ASSERT_EQ(again.size(), plan.size());
    for (std::size_t i = 0; i < plan.size(); ++i) {
        again[i].stiffness_reason = plan[i].stiffness_reason = "";
        EXPECT_EQ(again[i].loading_stiffness, plan[i].loading_stiffness) << i;
        EXPECT_TRUE(again[i] == plan[i]) << i;
    }
}

void expect_round_trip(const FilmedScene& original, const std::filesystem::path& folder = {}) {
    const Plan plan = make_plan(original);
    const std::string text = resolved_scene(original, plan);
    const FilmedScene back = read_filmed_scene_text(text, folder / "scene.toml", {}, measurable_in);
    const FilmedScene expected = filled_in(original, plan);
    EXPECT_EQ(back.title, expected.title);
    EXPECT_EQ(back.species, expected.species);
    EXPECT_EQ(back.contact, expected.contact);
    EXPECT_EQ(back.container, expected.container);
    EXPECT_EQ(back.walls, expected.walls);
    EXPECT_EQ(back.meshes, expected.meshes);
    EXPECT_EQ(back.exits, expected.exits);
    EXPECT_EQ(back.gravity, expected.gravity);
    EXPECT_EQ(back.drive, expected.drive);
    EXPECT_EQ(back.start, expected.start);
    EXPECT_EQ(back.run, expected.run);
    EXPECT_EQ(back.output, expected.output);
    EXPECT_EQ(back.film, expected.film);

    const Plan again = make_plan(back);
    EXPECT_EQ(again.clock.step, plan.clock.step);
    EXPECT_EQ(again.clock.steps_per_period, plan.clock.steps_per_period);
    EXPECT_EQ(again.steps, plan.steps);
    EXPECT_EQ(again.trajectory_every, plan.trajectory_every);
    EXPECT_EQ(again.measures_every, plan.measures_every);
    EXPECT_EQ(again.settle_steps_limit, plan.settle_steps_limit);
    expect_equal(again.grain, plan.grain);
    expect_equal(again.wall, plan.wall);
    expect_equal(again.mesh, plan.mesh);
    expect_equal(again.glued, plan.glued);
    EXPECT_EQ(scene_without_remarks(back, again), scene_without_remarks(original, plan));
}

// Keys of [film] that stood after [film.cut] once belonged to that table, and a run with a cut could not be
// drawn again.
TEST(Writer, ACutAndWhatTheFilmShowsReadBack) {
    expect_round_trip(read_text(wedge_text +
                                "[film]\nhide = [\"big\"]\nforce_chains = true\nhighlight = [3]\n" +
                                "[film.cut]\nat = \"1 mm\"\nthickness = \"5 mm\"\n"));
}

TEST(Writer, ResolvedScenesReadBackBitByBit) {
    expect_round_trip(read_text(wedge_text));
    expect_round_trip(read_text(box_text));
    expect_round_trip(read_text(exact_text));
    expect_round_trip(read_text(wedge_text +
                                "[[wall]]\nname = \"chute\"\npoint = [0, 0, 0.1]\nnormal = [0, 1, 2]\n"
                                "moves = true\n"));
    expect_round_trip(read_text(
        wedge_text, {"contact.law=hertz", "contact.wall.law=spring-dashpot", "contact.attraction=true",
                     "contact.rolling_friction=0.01", "contact.wall.rolling_friction=0"}));
    expect_round_trip(read_text(wedge_text, {"contact.restitution_table=[[\"10 cm/s\", 0.95], [2, 0.7]]"}));
    expect_round_trip(read_text(
        wedge_text,
        {"drive.frequency=33.3", "drive.direction=[1, 2, 3]", "drive.phase=1007 deg", "run.seed=123456789",
         "contact.friction_law=linear-spring", "container.half_angle=17.3 deg", "run.steps_per_contact=31",
         "title=say \"hello\" to C:\\grains\tnow"}));
    expect_round_trip(
        read_text(wedge_text, {"contact.friction=0", "contact.arms=radius", "output.trajectory=false"}));
    expect_round_trip(
        read_text(wedge_text, {"contact.wall.friction=inf", "species.small.mass=0.17 g",
                               "species.big.diameter={min=0.009, max=0.0111}", "run.duration=0.37"}));
    expect_round_trip(
        read_text(box_text, {"species.a.diameter={mean=0.0011, deviation=0.00013}",
                             "contact.wall.restitution=0.77", "contact.tangential_damping=12.3"}));
    expect_round_trip(read_text(
        wedge_text, {"container.floor_width=57.3 mm", "container.outlet={width=\"21.7 mm\", opens=0.317}"}));
    expect_round_trip(read_text(box_text, {"container.outlet={diameter=\"7.3 mm\", exit_depth=\"1 cm\"}"}));
    expect_round_trip(
        read_text(box_text, {"container.outlet={width=\"7.3 mm\"}", "container.tray={depth=0.0123}"}));
    expect_round_trip(read_text(wedge_text, {"container.wall_grains={species=\"small\", spacing=0.0071, "
                                             "faces=[\"left_slant\", \"floor\"], disorder=0.13}"}));
}

// The scenes are in a folder with the copies that they name.
TEST(Writer, ScenesWithMeshesReadBackBitByBit) {
    const MeshScenes files;
    files.write("meshes/plate.stl", plate(0.2));
    files.write("meshes/tank.stl", box_of_sheets(0.1, 0.08));
    const auto read = [&](std::string text) {
        for (const char* name : {"plate.stl", "tank.stl"})
            if (const auto at = text.find(name); at != std::string::npos) text.insert(at, "meshes/");
        return read_filmed_scene_text(text, files.path() / "scene.toml", {}, measurable_in);
    };
    expect_round_trip(read(ball_on_plate), files.path());
    expect_round_trip(read(with(ball_on_plate, "plate.stl\"\n",
                                "plate.stl\"\nturn = { axis = [1, 2, 3], rate = \"30 "
                                "rpm\", over = 0.1 }\n")),
                      files.path());
    expect_round_trip(read(in_vessel + "[drive]\nfrequency = 20\namplitude = 0.001\n[[contact.pair]]\n"
                                       "between = [\"tank\", \"big\"]\nlaw = \"hertz\"\nfriction = 0.7\n"),
                      files.path());
}

const std::string glued_text = with(wedge_text, "height = \"180 mm\"\n",
                                    "height = \"180 mm\"\n"
                                    "wall_grains = { species = \"small\", faces = [\"floor\"] }\n");

// The plan chooses the stiffness of contacts with glued grains beside that of the pair. An impact on a wall's
// mass has the effective mass of the free grain, which for equal grains is twice that of the pair.
TEST(Writer, ContactsWithGluedGrainsKeepTheirStiffness) {
    const Plan plan = make_plan(read_text(glued_text));
    ASSERT_EQ(plan.between(0, 0).stiffness_reason, "impact");
    EXPECT_DOUBLE_EQ(plan.glued[0].loading_stiffness, 2 * plan.between(0, 0).loading_stiffness);
    for (const Assignments& law : std::vector<Assignments>{
             {"contact.law=walton-braun"},
             {"contact.law=spring-dashpot"},
             {"contact.law=hertz"},
             {"contact.restitution_speed=0.3"},
             {"contact.restitution_table=[[0.1, 0.95], [2, 0.7]]"},
             {"contact.law=hertz", "contact.wall.law=spring-dashpot", "contact.attraction=true"},
             {"contact.friction_law=linear-spring"},
             {"contact.glued_stiffness=54321.1"},
             {"contact.stiffness=7777.7"},
             {"contact.law=hertz", "contact.modulus=12.3 MPa"}}) {
        SCOPED_TRACE(law[0].text);
        Assignments sets = law;
        expect_round_trip(read_text(glued_text, sets));
        for (const char* spread :
             {"species.small.diameter={min=0.0041, max=0.0057}",
              "species.big.diameter={mean=0.0093, deviation=0.0007}", "container.wall_grains.species=big"})
            sets.push_back(spread);
        expect_round_trip(read_text(glued_text, sets));
    }
    expect_round_trip(read_text(glued_text +
                                "[[contact.pair]]\nbetween = [\"big\", \"small\"]\nlaw = \"hertz\"\n"
                                "[[contact.pair]]\nbetween = [\"small\", \"small\"]\nstiffness = 3e4\n"));
}

TEST(Writer, WhatTheFilmShowsReadsBackBitByBit) {
    for (const char* by : {"speed", "vertical-velocity", "start-height", "displacement", "rise", "spin",
                           "kinetic-energy", "coordination", "contact-force"})
        expect_round_trip(read_text(wedge_text, {std::string("film.colour.by=") + by}));
    expect_round_trip(
        read_text(wedge_text, {"film.colour.by=speed", "film.colour.range=[\"1 cm/s\", \"31.7 cm/s\"]",
                               "film.colour.unit=mm/s", "film.colour.map=cividis", "film.hide=[\"big\"]",
                               "film.highlight=[3, 14]", "film.highlight_if=\"spin > 3 rad/s\""}));
    expect_round_trip(read_text(wedge_text +
                                    "[[film.plot]]\ny = \"lacey\"\nlabel = \"mixing\"\nrange = [0, 1]\n"
                                    "[[film.plot]]\ny = \"kinetic\"\n[film.arrows]\ngrid = 9\n[film.trails]\n"
                                    "species = [\"big\"]\ngrains = [1, 2]\nduration = \"0.3 s\"\n",
                                {"film.force_chains=true"}));
    expect_round_trip(
        read_text(wedge_text, {"film.arrows.grid=5", "film.arrows.of=now", "film.arrows.speed=1 cm/s"}));
}

TEST(Writer, GhostsAndSpansReadBackBitByBit) {
    expect_round_trip(read_text(
        wedge_text, {"film.ghost=[\"big\"]", "film.text=\"{lacey}\\n{kinetic:mJ} \\\"so\\\"\"",
                     "film.segment=[{kind=\"locked\", average=3, duration=0.5}, {exposure=\"33.3 ms\"}]"}));
    const FilmedScene scene = read_text(
        wedge_text, {"film.segment=[{kind=\"locked\", average=3, duration=0.5}, {exposure=\"40 ms\", "
                     "exposures=7}]"});
    EXPECT_EQ(scene.film.segments[0].average, 3);
    EXPECT_EQ(scene.film.segments[1].exposure, 0.04);
    EXPECT_EQ(scene.film.segments[1].exposures, 7);
}

TEST(Writer, ShippedScenesReadBackBitByBit) {
    for (const auto& entry : std::filesystem::directory_iterator(GRAINREEL_SOURCE "/scenes")) {
        if (entry.path().extension() != ".toml") continue;
        SCOPED_TRACE(entry.path());
        expect_round_trip(read_filmed_scene(entry.path(), {}, measurable_in));
    }
}

TEST(Writer, PairsOfDifferentLawsKeepApart) {
    expect_round_trip(
        read_text(with(box_text, "normal_damping = 2634\n", "restitution = 0.71\n") +
                  "[[contact.pair]]\nbetween = [\"a\", \"b\"]\nnormal_damping = 100\n"
                  "[[contact.pair]]\nbetween = [\"b\", \"wall\"]\nfriction = 0\nstiffness = 777\n"));
}

}  // namespace
}  // namespace grainreel
