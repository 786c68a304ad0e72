// Tests of runs that continue from a checkpoint. They do so only in the scene of the checkpoint, apart from
// keys that decide nothing. No number in a checkpoint is believed, even if its checksum is right.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <xxhash.h>

#include <cstring>
#include <filesystem>
#include <fstream>

#include "engine/base/error.hpp"
#include "engine/base/random.hpp"
#include "engine/grain_table.hpp"
#include "engine/plan/resolved_scene.hpp"
#include "engine/run/simulation/simulated_bed.hpp"
#include "engine/scene/keys/keys.hpp"
#include "engine/scene/scene_file.hpp"
#include "engine/start/restart.hpp"
#include "tests/physics/world.hpp"
#include "tests/support/small_scene.hpp"
#include "tests/support/tells.hpp"
#include "tests/support/temporary_folder.hpp"

namespace grainreel {
namespace {

namespace fs = std::filesystem;
using test::tells;
using testing::HasSubstr;

class Continuation : public testing::Test {
  protected:
    static Scene scene_of(std::vector<std::string> sets = {}, const std::string& more = "") {
        sets.insert(sets.begin(), {kStiffness, "start.settle_limit=0.02 s", "run.threads=1"});
        return read_scene_text(test::small_scene_text + more, "fifty.toml", with_tested_precision(sets));
    }
    // The same scene, which continues from the end of the first run.
    Scene next_of(std::vector<std::string> sets = {}, const std::string& more = "", bool keep_clock = true,
                  const char* file = "first.grs") const {
        sets.insert(sets.begin(), {kStiffness, "start.method=file", "start.file=" + (here / file).string(),
                                   keep_clock ? "start.keep_clock=true" : "start.keep_clock=false"});
        return read_scene_text(test::small_scene_text + more, "fifty.toml", with_tested_precision(sets));
    }
    // For falling grains the plan would choose another stiffness than for those of a file.
    static constexpr const char* kStiffness = "contact.stiffness=700 N/m";

    static std::int64_t steps_of(const Scene& scene) { return make_plan(scene).clock.steps_per_period; }

    // Runs a period of the small scene.
    std::string first(const Scene& scene) const {
        SimulatedBed run(scene, make_plan(scene), 1);
        run.pack();
        run.advance(steps_of(scene));
        run.save_checkpoint(here / "first.grs");
        write_grain_table(here / "final.csv", run.frame());
        return test::text_of(here / "first.grs");
    }
    static std::string refusal(const Scene& scene) {
        try {
            SimulatedBed run(scene, make_plan(scene), 1);
            run.pack();
            run.advance(run.step() + 20);
            return "accepted";
        } catch (const UserError& mistake) {
            return mistake.what();
        }
    }

    test::TemporaryFolder here;
};

struct Change {
    const char* assignment;
    const char* says;  // in the message; "accepted" where the run goes on
};

TEST_F(Continuation, GoesOnOnlyInTheSceneItIsFrom) {
    first(scene_of());
    const Change changes[] = {
        {"title=Other", "accepted"},
        {"film.rotation=true", "accepted"},
        {"film.colour.by=speed", "accepted"},
        {"film.size=320x240", "accepted"},
        {"output.orientation=true", "accepted"},
        {"output.trajectory=false", "accepted"},
        {"output.measures_interval=1 ms", "accepted"},
        {"run.duration=0.3 s", "accepted"},
        {"run.threads=2", "accepted"},
        {"species.small.colour=green", "accepted"},
        {"run.duration=0.01 s", "--set run.duration: the start is at step"},
        {"run.seed=2", "--set run.seed: 'run.seed' is 2, but it was 1 in the run"},
        {"gravity=9.7", "--set gravity: 'gravity' is [0.0, 0.0, -9.7], but it was [0.0, 0.0, -9.81]"},
        {"species.small.density=2600", "'species[0].density' is 2600.0, but it was 2"},
        {"species.big.diameter=6.5 mm", "'species[1].diameter' is 0.0065, but it was 0.006"},
        {"species.small.count=41", "'species[0].count' is 41, but it was 40"},
        {"species.big.name=large", "'species[1].name' is \"large\", but it was \"big\""},
        {"container.width=31 mm", "'container.width' is 0.031, but it was 0.03"},
        {"container.top=open", "'container.top' is \"open\", but it was \"lid\""},
        {"container.depth=21 mm", "'container.depth' is 0.021, but it was 0.02"},
        {"contact.friction=0.1",
         "--set contact.friction: 'contact.pair[0].friction' of [\"small\", \"small\"] is 0.1, but it was "
         "0.4"},
        {"contact.wall.friction=0.1",
         "--set contact.wall.friction: 'contact.pair[2].friction' of [\"small\", \"wall\"] is 0.1"},
        {"contact.law=spring-dashpot",
         "--set contact.law: 'contact.pair[0].law' of [\"small\", \"small\"] is \"spring-dashpot\""},
        {"contact.arms=radius", "'contact.arms' is \"radius\", but it was \"contact-plane\""},
        {"drive.direction=[1, 0, 0]",
         "--set drive.direction: 'drive.direction' is [1.0, 0.0, 0.0], but it was [0.0, 0.0, 1.0]"},
        {"drive.g_level=2.1", "--set drive.g_level: 'drive.amplitude' is "},
        {"drive.phase=0.25", "'drive.phase' is 0.25, but it was 0.0"},
        {"drive.moves=floor", "'drive.moves' is \"floor\", but it was \"container\""},
        {"run.overlap=0.04", "--set run.overlap: 'run.overlap' is 0.04, but it was 0.05"},
        {"run.step=1 us", "--set run.step: 'run.step' is "},
        {"run.integrator=gear", "'run.integrator' is \"gear\", but it was \"velocity-verlet\""},
    };
    for (const auto& [assignment, says] : changes)
        EXPECT_THAT(refusal(next_of({assignment})), HasSubstr(says)) << assignment;
    EXPECT_THAT(refusal(next_of({}, "[[wall]]\npoint = [0, 0, \"5 mm\"]\nnormal = [0, 0, 1]\n")),
                tells({":32:1: 'wall[0].point'", "[0.0, 0.0, 0.005]", "not there"}));
}

// A scene without a stiffness of its own gets that of the file. Whatever its plan chooses differently is in
// the scene of the run.
TEST_F(Continuation, WhatThePlanChoseIsInTheSceneOfTheRun) {
    const auto read = [](const std::string& text, const std::vector<std::string>& sets) {
        return read_scene_text(text, "fifty.toml", with_tested_precision(sets));
    };
    const Scene scene = read(test::small_scene_text, {"start.settle_limit=0.02 s"});
    first(scene);
    std::vector<std::string> sets = {"start.method=file", "start.file=" + (here / "first.grs").string(),
                                     "start.keep_clock=true"};
    EXPECT_EQ(refusal(read(test::small_scene_text, sets)), "accepted");
    EXPECT_EQ(refusal(read(resolved_scene(scene, make_plan(scene)), sets)), "accepted");
    sets.push_back("run.steps_per_contact=30");
    EXPECT_THAT(refusal(read(test::small_scene_text, sets)), HasSubstr("scene.toml of that run"));
}

TEST_F(Continuation, ContainersOfOtherShapesAreRefused) {
    first(scene_of());
    const auto with_container = [&](const std::string& lines) {
        std::string text = test::small_scene_text;
        const auto at = text.find("shape = \"box\""), end = text.find("[drive]");
        text.replace(at, end - at, lines);
        text += "[start]\nmethod = \"file\"\nfile = \"" + (here / "first.grs").string() +
                "\"\nkeep_clock = true\n";
        return refusal(read_scene_text(text, "fifty.toml", with_tested_precision({kStiffness})));
    };
    const std::string says = "'container.shape' is \"";
    EXPECT_THAT(with_container("shape = \"none\"\n"), HasSubstr(says + "none\", but it was \"box\""));
    EXPECT_THAT(with_container("shape = \"cylinder\"\ndiameter = \"40 mm\"\nheight = \"40 mm\"\n"),
                HasSubstr(says + "cylinder\", but it was \"box\""));
}

// Every key of the list decides something or is written down as deciding nothing. A key that the writer left
// out could change unseen.
TEST_F(Continuation, EveryKeyThatDecidesIsCompared) {
    const std::string walton = test::small_scene_text;
    std::string all = scene_to_keep(scene_of(), make_plan(scene_of()));
    const auto take = [&](const std::string& text) {
        const Scene scene = read_scene_text(text, "all.toml");
        all += scene_to_keep(scene, make_plan(scene));
    };
    const auto changed = [&](const std::string& from, const std::string& to) {
        std::string text = walton;
        return text.replace(text.find(from), from.size(), to);
    };
    take(changed(
        "shape = \"box\"\nwidth = \"30 mm\"\n",
        "shape = \"wedge\"\nhalf_angle = \"20 deg\"\nslant_height = \"10 mm\"\nhalf_width = \"20 mm\"\n"));
    take(changed("shape = \"box\"\nwidth = \"30 mm\"\ndepth = \"20 mm\"\n",
                 "shape = \"cylinder\"\ndiameter = \"40 mm\"\n"));
    take(changed("restitution = 0.7", "law = \"hertz\"\nrestitution = 0.7"));
    take(changed("restitution = 0.7", "restitution = 0.7\nrestitution_speed = 1"));
    take(changed("restitution = 0.7", "restitution_table = [[0.1, 0.9], [1, 0.8]]"));
    take(changed("restitution = 0.7",
                 "law = \"spring-dashpot\"\nnormal_damping = 100\ntangential_damping = 50"));
    take(walton + "[[wall]]\npoint = [0, 0, 0]\nnormal = [0, 0, 1]\n");
    take(walton + "[[feed]]\nrate = 5\ncount = 3\nuntil = 1\n");
    take(walton + "[[drive.stage]]\nfrom = 0\nkind = \"taps\"\ninterval = 0.1\n");
    take(changed("height = \"40 mm\"\n",
                 "height = \"40 mm\"\noutlet = { width = \"12 mm\" }\ntray = { depth = \"30 mm\" }\n"
                 "wall_grains = { species = \"big\", faces = [\"left_wall\"] }\n"));
    take(
        changed("height = \"40 mm\"\n",
                "height = \"40 mm\"\nwall_grains = { faces = [\"floor\"] }\n[contact.wall]\nlaw = \"hertz\"\n"
                "[[contact.pair]]\nbetween = [\"small\", \"small\"]\nlaw = \"hertz\"\n"));

    const auto with_mesh = [&](const std::string& motion) {
        take(walton +
             "[[mesh]]\nname = \"vane\"\nfile = \"shipped:gate.stl\"\nscale = 0.05\n"
             "position = [0, 0, 0.03]\nrotation = { axis = [0, 0, 1], angle = \"10 deg\" }\n" +
             motion);
    };
    std::ofstream(here / "path.csv") << "t,x,y,z\n0,0,0,0\n5,0,0,0.001\n10,0,0,0\n20,0,0,0\n";
    with_mesh("turn = { axis = [0, 0, 1], through = [0, 0, 0.03], rate = \"10 rpm\" }\n");
    with_mesh("velocity = [0, 0, 1e-6]\n");
    with_mesh("driven = true\n");
    with_mesh("path = \"" + (here / "path.csv").string() + "\"\n");
    take(walton + "[[exit]]\nlow = [-1, -1, -1]\nhigh = [1, 1, -0.5]\noutside = true\n");
    take(changed("height = \"40 mm\"\n",
                 "height = \"40 mm\"\nturn = { axis = [1, 0, 0], through = [0, 0, 0], rate = \"1 rpm\" }\n"));
    take(changed("shape = \"box\"\nwidth = \"30 mm\"\ndepth = \"20 mm\"\nheight = \"40 mm\"\n",
                 "shape = \"mesh\"\nmesh = \"drum\"\n[[mesh]]\nname = \"drum\"\nfile = "
                 "\"shipped:drum.stl\"\n"));

    const auto compared = deciding_differences("", all);
    const auto is_compared = [&](const std::string& key) {
        return std::any_of(compared.begin(), compared.end(), [&](const KeyDifference& d) {
            return find_key(d.key) != nullptr && find_key(d.key)->path == key;
        });
    };
    // The plan or the reader turns these keys into other keys.
    const std::vector<std::string> turned = {"drive.g_level", "drive.stage[].g_level", "species[].mass",
                                             "run.steps_per_contact", "container.floor_width"};
    for (const Key& key : scene_keys()) {
        if (!decides_future(key.path)) continue;
        if (find_key(key.path.substr(0, key.path.rfind('.'))) != nullptr) continue;  // a part of a value
        if (std::find(turned.begin(), turned.end(), key.path) != turned.end()) continue;
        const std::string name = key.path.substr(key.path.rfind('.') + 1);
        const bool of_pair = find_key("contact.pair[]." + name) != nullptr;
        const bool general = key.path == "contact." + name || key.path == "contact.wall." + name;
        EXPECT_TRUE(is_compared(of_pair && general ? "contact.pair[]." + name : key.path)) << key.path;
    }
}

// This also holds where the floor has moved farther than the lists reach since they were renewed.
TEST_F(Continuation, IsBitForBitWhereverTheFloorIs) {
    const Scene scene = scene_of({"drive.g_level=5", "run.duration=0.5 s"});
    const Plan plan = make_plan(scene);
    SimulatedBed whole(scene, plan, 1);
    whole.pack();
    for (int eighth = 1; eighth <= 24; ++eighth) {
        const std::int64_t step = eighth * plan.clock.steps_per_period / 8 + 3;
        whole.advance(step);
        whole.save_checkpoint(here / "first.grs");
        whole.advance(step + 40);
        const Scene next = next_of({"drive.g_level=5", "run.duration=0.5 s"});
        SimulatedBed taken_up(next, make_plan(next), 1);
        taken_up.advance(step + 40);
        EXPECT_EQ(taken_up.state_hash(), whole.state_hash()) << "step " << step;
    }
}

TEST_F(Continuation, RotationMayBeginOrEnd) {
    first(scene_of());
    Scene scene = next_of();
    scene.wishes.orientation = true;  // as for a film that shows how grains turn
    SimulatedBed turning(scene, make_plan(scene), 1);
    const std::int64_t end = turning.step() + 200;
    turning.advance(end);
    EXPECT_EQ(turning.frame().orientation.size(), turning.grains());
    turning.save_checkpoint(here / "turning.grs");
    scene = next_of({}, "", true, "turning.grs");
    SimulatedBed again(scene, make_plan(scene), 2);
    EXPECT_TRUE(again.frame().orientation.empty());
    scene = next_of();
    SimulatedBed straight(scene, make_plan(scene), 1);
    straight.advance(end + 300);
    again.advance(end + 300);
    EXPECT_EQ(again.state_hash(), straight.state_hash());
}

// The first step of the checkpoint's run was still to come, and its drive starts at once.
TEST_F(Continuation, FromBeforeTheFirstStep) {
    for (const char* integrator : {"velocity-verlet", "gear"}) {
        first(scene_of());
        const std::vector<std::string> sets = {"drive.ramp=0", "drive.phase=0.25",
                                               std::string("run.integrator=") + integrator};
        Scene scene = next_of(sets, "", false);
        SimulatedBed whole(scene, make_plan(scene), 1);
        whole.pack();
        whole.save_checkpoint(here / "start.grs");
        scene = next_of(sets, "", true, "start.grs");
        SimulatedBed next(scene, make_plan(scene), 2);
        next.pack();
        whole.advance(300);
        next.advance(300);
        EXPECT_EQ(next.state_hash(), whole.state_hash()) << integrator;
    }
}

TEST_F(Continuation, AnewTheMassesAreThoseOfTheScene) {
    first(scene_of());
    for (const char* file : {"first.grs", "final.csv"}) {
        const Scene dense =
            next_of({"species.small.density=5000", "species.big.density=5000"}, "", false, file);
        const Scene same = next_of({}, "", false, file);
        SimulatedBed heavy(dense, make_plan(dense), 1), light(same, make_plan(same), 1);
        heavy.pack(), light.pack();
        EXPECT_NEAR(heavy.measure("kinetic_J") / light.measure("kinetic_J"), 2, 1e-9) << file;
    }
}

TEST_F(Continuation, AnewGrainsMustFitTheScene) {
    first(scene_of());
    const auto plane = [](const char* height) {
        return std::string("[[wall]]\npoint = [0, 0, \"") + height + "\"]\nnormal = [0, 0, 1]\n";
    };
    for (const char* file : {"first.grs", "final.csv"}) {
        const auto anew = [&](const std::vector<std::string>& sets, const std::string& more = "") {
            return refusal(next_of(sets, more, false, file));
        };
        EXPECT_EQ(anew({}), "accepted");
        EXPECT_EQ(anew({"film.rotation=true"}), "accepted");
        EXPECT_THAT(anew({"container.width=20 mm"}), tells({"outside the container", "beyond the"}));
        EXPECT_THAT(anew({}, plane("8 mm")), tells({"outside the container", "beyond the wall 1"}));
        EXPECT_THAT(anew({}, plane("1.2 mm")), tells({"overlapping", "wall 1", "0."}));
        EXPECT_THAT(anew({"species.small.count=39"}), HasSubstr("has 40 grains of \"small\""));
        EXPECT_THAT(anew({"species.big.diameter=5 mm"}), HasSubstr("diameter of 0.006 m"));
    }
    Scene one = scene_of({}, "");
    one = next_of({}, "", false);
    one.species.pop_back();
    EXPECT_THAT(refusal(one), tells({"species 2", "only 1"}));
}

TEST_F(Continuation, TablesAreNotBelieved) {
    first(scene_of());
    const std::string table = test::text_of(here / "final.csv");
    const auto with_last_row = [&](const std::string& row) {
        const auto at = table.rfind('\n', table.size() - 2) + 1;
        test::write_text(here / "final.csv", table.substr(0, at) + row + "\n");
        return refusal(next_of({}, "", false, "final.csv"));
    };
    const std::string still = ",0,0,0,0,0,0";
    EXPECT_THAT(with_last_row("49,3,0.003,0,0,0.03" + still), HasSubstr("has grains of species 3"));
    EXPECT_THAT(with_last_row("49,2,0.003,0,0,1e300" + still), HasSubstr("so far out"));
}

// A run that grains have left writes such a table: those that stayed keep their order and get new numbers.
TEST_F(Continuation, AnewATableMayHaveGaps) {
    first(scene_of());
    State frame = read_grain_table(here / "final.csv");
    const State whole = frame;
    const auto leave_out = [&](auto& values) {
        for (const std::size_t gone : {41, 17, 3}) values.erase(values.begin() + static_cast<int>(gone));
    };
    leave_out(frame.id), leave_out(frame.species), leave_out(frame.radius);
    leave_out(frame.position), leave_out(frame.velocity), leave_out(frame.spin);
    write_grain_table(here / "final.csv", frame);
    const Scene scene = next_of({"species.small.count=38", "species.big.count=9"}, "", false, "final.csv");
    SimulatedBed run(scene, make_plan(scene), 1);
    const State start = run.frame();
    ASSERT_EQ(start.size(), whole.size() - 3);
    for (std::size_t i = 0; i < start.size(); ++i) {
        EXPECT_EQ(start.id[i], static_cast<std::int32_t>(i));
        EXPECT_EQ(start.position[i], frame.position[i]) << i;
    }
}

// A checkpoint whose checksum is right although its content is wrong.
class ForgedCheckpoint : public Continuation {
  protected:
    static constexpr std::size_t kBody = 16;  // bytes of name, version and checksum before the body

    void forge(std::string bytes) const {
        const std::uint64_t sum = XXH64(bytes.data() + kBody, bytes.size() - kBody, 0);
        std::memcpy(bytes.data() + 8, &sum, sizeof sum);
        test::write_text(here / "first.grs", bytes);
    }
};

// Whatever the checkpoint holds, the answer is a message or a run, and never an access out of range, which
// sanitizers would see.
TEST_F(ForgedCheckpoint, NeverCrashes) {
    const std::string good = first(scene_of());
    const Scene keeps = next_of(), anew = next_of({}, "", false);
    const Plan plan = make_plan(keeps), plan_anew = make_plan(anew);
    ASSERT_TRUE(plan_anew.start.keeps_histories);
    Random random(1, Stream::centres);
    int refused = 0;
    constexpr int kForged = 600;
    for (int k = 0; k < kForged; ++k) {
        std::string bytes = good;
        const std::int32_t values[] = {-1, 50, 51, 1 << 20, 0x7fffffff, -0x7fffffff - 1, 0x7ff00000, k};
        const std::int32_t value = values[static_cast<int>(random.between(0, 8))];
        const std::size_t body = good.size() - kBody - sizeof value;
        const auto at =
            kBody + static_cast<std::size_t>(random.between(0, 1) * static_cast<double>(body)) / 4 * 4;
        std::memcpy(bytes.data() + at, &value, sizeof value);
        if (k % 16 == 0) bytes.resize(at);
        forge(bytes);
        try {
            const bool begins = k % 8 == 1;
            SimulatedBed run(begins ? anew : keeps, begins ? plan_anew : plan, 1 + k % 2);
            run.pack();
            run.advance(run.step() + 3);
        } catch (const UserError& mistake) {
            EXPECT_THAT(mistake.what(), HasSubstr("first.grs"));
            ++refused;
        } catch (const RunError&) {
        }
    }
    EXPECT_GT(refused, kForged / 8);
}

TEST_F(ForgedCheckpoint, OfAnotherVersionIsRefused) {
    std::string bytes = first(scene_of());
    bytes[7] = '8';
    forge(bytes);
    for (const bool keep_clock : {true, false})
        EXPECT_THAT(refusal(next_of({}, "", keep_clock)), tells({"another version", "final.csv"}));
}

TEST_F(ForgedCheckpoint, WithAnotherMassIsRefused) {
    const Scene scene = scene_of();
    const std::string good = first(scene);
    Grains one;
    one.add(0, 0, Vec3::Zero(), 0.5 * scene.species[0].diameter.mean, scene.species[0].density);
    std::string bytes = good;
    const double mass = one.motion[0].inverse_mass, other = 2 * mass;
    const auto at = bytes.find(std::string(reinterpret_cast<const char*>(&mass), sizeof mass));
    ASSERT_NE(at, std::string::npos);
    std::memcpy(bytes.data() + at, &other, sizeof other);
    forge(bytes);
    EXPECT_THAT(refusal(next_of()), tells({"another mass", "species"}));
}

}  // namespace
}  // namespace grainreel
