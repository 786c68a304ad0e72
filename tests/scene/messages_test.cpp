// Tests of every message of the reader, word for word.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "engine/base/error.hpp"
#include "engine/plan/plan.hpp"
#include "render/scene/filmed_scene.hpp"
#include "tests/scene/scene_text.hpp"

namespace grainreel {
namespace {

std::string complaint(const std::string& text, const Assignments& sets = {}) {
    try {
        make_plan(read_text(text, sets));
    } catch (const UserError& error) {
        return error.what();
    }
    return "none";
}

TEST(Messages, Files) {
    const auto of = [](const char* path) -> std::string {
        try {
            read_filmed_scene(path, {}, measurable_in);
        } catch (const UserError& error) {
            return error.what();
        }
        return "none";
    };
    EXPECT_EQ(of("/nowhere/scene.toml"),
              "/nowhere/scene.toml: there is no such file; give the path of a scene file (.toml)");
    EXPECT_EQ(of("/"), "/: this is a folder; give the path of a scene file (.toml)");
}

TEST(Messages, NotToml) {
    EXPECT_EQ(complaint("title = \"x\"\ndiameter = 5 mm\n"),
              "test.toml:2:14: this is not TOML (Error while parsing key-value pair: expected a comment or "
              "whitespace, saw "
              "'m'); text and quantities with units want quotes");
    EXPECT_EQ(complaint(""),
              "test.toml:1:1: there are no grains; write [[species]] and below it name, count, diameter and "
              "density");
}

struct Case {
    const char* from;     // text of the wedge scene
    const char* to;       // what it becomes
    const char* message;  // after "test.toml:"
};

class MessagesOfEdits : public testing::TestWithParam<Case> {};

TEST_P(MessagesOfEdits, WordForWord) {
    EXPECT_EQ(complaint(with(wedge_text, GetParam().from, GetParam().to)),
              std::string("test.toml:") + GetParam().message);
}

INSTANTIATE_TEST_SUITE_P(
    Keys, MessagesOfEdits,
    testing::Values(
        Case{"frequency =", "frequenzy =",
             "24:1: unknown key 'frequenzy' in [drive]; did you mean 'frequency'?"},
        Case{"title =", "titel =", "1:1: unknown key 'titel' at the top level; did you mean 'title'?"},
        Case{"count = 10\n", "cuont = 10\n",
             "10:1: unknown key 'cuont' in [[species]]; did you mean 'count'?"},
        Case{"[run]\n", "[run]\nfrequency = 3\n",
             "27:1: unknown key 'frequency' in [run]; it belongs in [drive]"},
        Case{"[run]\n", "[run]\nwhatever = 3\n",
             "27:1: unknown key 'whatever' in [run]; the keys there are duration, seed, threads, accuracy, "
             "step, overlap, "
             "integrator, precision, contact_corrections, steps_per_contact"},
        Case{"[drive]\n", "[[drive]]\n", "23:3: 'drive' must be a table; write [drive] above its keys"},
        Case{"g_level = 3\n", "", "23:2: [drive] lacks 'g_level'; write for example g_level = 0.5"},
        Case{"count = 100\n", "", "3:1: [[species]] lacks 'count'; write for example count = 100"},
        Case{"half_angle = \"20 deg\"\n", "",
             "16:2: [container] lacks 'half_angle'; write for example half_angle = \"20 deg\""}));

INSTANTIATE_TEST_SUITE_P(
    NoUse, MessagesOfEdits,
    testing::Values(
        Case{"g_level = 3", "g_level = 3\namplitude = 0.001",
             "25:1: 'g_level' is of no use here: 'amplitude' is given; remove it"},
        Case{"friction = 0.3", "friction = 0.3\nnormal_damping = 5",
             "16:1: 'normal_damping' is of no use here: the law walton-braun has no damping; remove it"},
        Case{"friction = 0.3", "friction = 0.3\nlaw = \"spring-dashpot\"\nrestitution_speed = \"1 m/s\"",
             "17:1: 'restitution_speed' is of no use here: only the law walton-braun has it; remove it"},
        Case{"friction = 0.3", "friction = 0.3\nrestitution_speed = \"1 m\"",
             "16:1: 'restitution_speed' must be a speed, but \"1 m\" is a length; write for example \"0.5 "
             "m/s\""},
        Case{"restitution = 0.8", "law = \"spring-dashpot\"\nnormal_damping = 5\nrestitution = 0.8",
             "16:1: 'restitution' is of no use here: 'normal_damping' is given, and the restitution follows "
             "from it; "
             "remove it"},
        Case{"friction = 0.3", "friction = 0.3\nfriction_law = \"none\"",
             "15:1: 'friction' is of no use here: 'friction_law' is \"none\"; remove it"},
        Case{"shape = \"wedge\"", "shape = \"box\"",
             "18:1: 'half_angle' is of no use here: only a wedge has slanted walls; remove it"},
        Case{"density = 2500", "density = 2500\nmass = 1e-4",
             "7:1: 'density' is of no use here: 'mass' is given; remove it"},
        Case{"[run]\n", "[start]\nkeep_clock = true\n[run]\n",
             "27:1: 'keep_clock' is of no use here: the start is not from a file; remove it"},
        Case{"[run]\n", "[[film.segment]]\nphase = 0.5\n[run]\n",
             "27:1: 'phase' is of no use here: a segment in motion shows every phase; remove it"}));

INSTANTIATE_TEST_SUITE_P(
    Values, MessagesOfEdits,
    testing::Values(
        Case{"\"20 Hz\"", "\"2 mm\"",
             "24:1: 'frequency' must be a frequency, but \"2 mm\" is a length; write for example \"25 Hz\""},
        Case{"\"20 deg\"", "\"20 Hz\"",
             "18:1: 'half_angle' must be an angle, but \"20 Hz\" is a frequency; write for example \"20 "
             "deg\""},
        Case{"\"20 Hz\"", "nan",
             "24:1: 'frequency' must be a frequency, but is nan; write for example \"25 Hz\""},
        Case{"\"20 Hz\"", "true",
             "24:1: 'frequency' must be a frequency, but is true; write for example \"25 Hz\""},
        Case{"\"5 mm\"", "\"-5 mm\"",
             "6:1: 'diameter' must be larger than 0, but is \"-5 mm\"; write for example \"5 mm\""},
        Case{"\"5 mm\"", "0", "6:1: 'diameter' must be larger than 0, but is 0; write for example \"5 mm\""},
        Case{"\"5 mm\"", "{ min = 0.006, max = 0.005 }",
             "6:14: 'min' must be smaller than 'max'; exchange the two"},
        Case{"\"5 mm\"", "{ mean = 0.005, deviation = 0.003 }",
             "6:28: 'deviation' must be less than half of the mean, at which the smallest grains vanish"},
        Case{"count = 100\n", "count = 0\n",
             "5:1: 'count' must be a whole number from 1 to 2147483647, but is 0; write for example 100"},
        Case{"count = 100\n", "count = 10.5\n",
             "5:1: 'count' must be a whole number from 1 to 2147483647, but is 10.5; write for example 100"},
        Case{"restitution = 0.8", "restitution = 0",
             "14:1: 'restitution' must be larger than 0 and at most 1, but is 0; write for example 0.9"},
        Case{"restitution = 0.8", "restitution = 1.01",
             "14:1: 'restitution' must be larger than 0 and at most 1, but is 1.01; write for example 0.9"},
        Case{"\"2 s\"", "0", "27:1: 'duration' must be larger than 0, but is 0; write for example \"10 s\""},
        Case{"\"2 s\"", "inf", "27:1: 'duration' must be finite, but is inf; write for example \"10 s\""},
        Case{"\"wedge\"", "\"cone\"",
             "17:1: 'shape' must be \"wedge\" or \"box\" or \"cylinder\" or \"mesh\" or \"none\", but is "
             "\"cone\""},
        Case{"name = \"small\"", "name = 3",
             "4:1: 'name' must be text, but is 3; write for example \"small\""},
        Case{"name = \"small\"", "name = \"wall\"",
             "4:1: 'name' must not be \"wall\", which stands for the container; choose another"},
        Case{"name = \"small\"", "name = \"big\"", "9:1: 'name' \"big\" is taken; choose another"},
        Case{"g_level = 3", "g_level = 3\nramp = 2",
             "26:1: 'ramp' must be 0 or at least 3 periods, but is 2"},
        Case{"g_level = 3", "g_level = 3\nphase = 90",
             "26:1: 'phase' is in turns without a unit, and must be from -1 to 1 then, but is 90; write for "
             "example \"90 deg\""},
        Case{
            "[run]\n", "[[film.segment]]\nkind = \"locked\"\nphase = -1.5\n[run]\n",
            "28:1: 'phase' is in turns without a unit, and must be from -1 to 1 then, but is -1.5; write for "
            "example \"-1.5 deg\""},
        Case{"g_level = 3", "g_level = 3\nphase = inf",
             "26:1: 'phase' must be finite, but is inf; write for example 0"},
        Case{
            "[run]\n", "[film]\nsize = 641\n[run]\n",
            "27:1: 'size' must be width x height, each from 64 to 8192 pixels, but is 641; write for example "
            "\"1920x1080\""},
        Case{"[run]\n", "[[film.segment]]\nkind = \"locked\"\nevery = 3\n[run]\n",
             "28:1: 'every' must be 1, 2 or 4, but is 3; write 2 or 4"},
        Case{"g_level = 3", "g_level = 3\ndirection = [0, 0, 0]",
             "26:1: 'direction' must not be zero; write for example [0, 0, 1]"},
        Case{"gravity = 10.0", "gravity = 0",
             "25:1: 'g_level' means nothing without gravity; give 'amplitude' instead"},
        Case{"height = \"180 mm\"", "height = \"180 mm\"\noutlet = \"open\"",
             "23:1: 'outlet' is \"open\"; write { width = \"20 mm\" } for a slot, { diameter = \"20 mm\" } "
             "for "
             "a round hole, or \"closed\""},
        Case{"height = \"180 mm\"", "height = \"180 mm\"\noutlet = { opens = 1 }",
             "23:1: 'outlet' has no size; write width = \"20 mm\" for a slot, or diameter = \"20 mm\" for a "
             "round "
             "hole"},
        Case{"height = \"180 mm\"", "height = \"180 mm\"\noutlet = { width = 0.02, diameter = 0.02 }",
             "23:26: 'diameter' is of no use here: 'width' says how wide the slot is; remove it"},
        Case{"height = \"180 mm\"", "height = \"180 mm\"\noutlet = { diameter = 0.02 }",
             "23:12: 'diameter' is that of a round hole, but a wedge has a slot; write 'width'"},
        Case{"height = \"180 mm\"", "height = \"180 mm\"\noutlet = { width = 0.1 }",
             "23:12: 'width' of 0.1 m is wider than the floor, 0.0590442 m; narrow the outlet"},
        Case{"height = \"180 mm\"", "height = \"180 mm\"\noutlet = { width = 0.009 }",
             "23:12: 'width' of 0.009 m lets no grain of \"big\" pass, which is up to 0.01 m wide; widen the "
             "outlet"},
        Case{"height = \"180 mm\"", "height = \"180 mm\"\noutlet = { width = 0.02, exit_depth = 0.001 }",
             "23:26: 'exit_depth' is 0.001 m, where a grain of \"big\" may still touch the floor; make it at "
             "least "
             "0.00879954 m"},
        Case{"height = \"180 mm\"", "height = \"180 mm\"\noutlet = { width = 0.02, opens = \"1000 s\" }",
             "23:26: the outlet opens at 1000 s, but the run ends at 2 s; open it earlier or lengthen "
             "run.duration"},
        Case{"height = \"180 mm\"", "height = \"180 mm\"\ntray = { depth = 0.1 }",
             "23:1: 'tray' is of no use below a closed floor; add 'outlet', or remove it"},
        Case{"height = \"180 mm\"", "height = \"180 mm\"\noutlet = { width = 0.02 }\ntray = { width = 0.05 }",
             "24:10: 'width' of 0.05 m is less than that of the container's floor, 0.0590442 m; widen it"},
        Case{"height = \"180 mm\"",
             "height = \"180 mm\"\noutlet = { width = 0.02 }\ntray = { depth = 0.011 }",
             "24:10: 'depth' of 0.011 m leaves 0.00720046 m below the floor where that is lowest, less than "
             "the "
             "largest grain, 0.01 m; deepen it"},
        Case{"height = \"180 mm\"", "height = \"180 mm\"\nwall_grains = { species = \"big\", faces = [] }",
             "23:34: 'faces' names no face; write for example [\"floor\"]"},
        Case{"height = \"180 mm\"",
             "height = \"180 mm\"\nwall_grains = { species = \"big\", faces = [\"wall\"] }",
             "23:34: 'faces' names \"wall\", which is no face of this container; there is floor, lid, "
             "left_wall, right_wall, left_slant, right_slant, back, front"},
        Case{"height = \"180 mm\"",
             "height = \"180 mm\"\nwall_grains = { faces = [\"floor\"], spacing = 1e-6 }",
             "23:36: 'spacing' of 1e-06 m makes up to 2.3e+10 glued grains, more than 1e+06; widen it"},
        Case{"slant_height =", "floor_width = \"20 mm\"\nslant_height =",
             "19:1: 'floor_width' is of no use here: 'slant_height' is given; remove it"}));

INSTANTIATE_TEST_SUITE_P(
    Together, MessagesOfEdits,
    testing::Values(
        Case{"\"10 mm\"", "\"46 mm\"",
             "11:1: 'diameter' of 0.046 m does not fit in the container, 0.045 m across (container.depth); "
             "use smaller "
             "grains or a larger container"},
        Case{"half_width = \"55 mm\"", "half_width = \"20 mm\"",
             "20:1: 'half_width' is 0.02 m, but the slanted walls take 0.0254779 m on each side and would "
             "cross; widen it, "
             "or reduce half_angle or slant_height"},
        Case{"slant_height = \"70 mm\"", "slant_height = \"190 mm\"",
             "19:1: 'slant_height' is 0.19 m, more than the height of the container, 0.18 m; lower it or "
             "raise the height"},
        Case{"\"20 deg\"", "\"95 deg\"", "18:1: 'half_angle' must be less than 90 deg, but is 95 deg"},
        Case{
            "\"20 deg\"", "20",
            "18:1: 'half_angle' must be less than 90 deg, but is 1145.92 deg; a bare number is in rad, write "
            "\"20 deg\""},
        Case{
            "depth = \"45 mm\"", "depth = \"24 mm\"\nperiodic_depth = true",
            "21:1: 'depth' of 0.024 m is too short to be periodic, less than 2.5 diameters of \"big\", 0.025 "
            "m; lengthen it"},
        Case{"count = 100\n", "count = 10000\n",
             "3:3: 10010 grains of 0.0006597 m3 fill 81.4 % of the container's 0.0008107 m3, more than the "
             "55 % that can be "
             "packed; use fewer or smaller grains, or a larger container"},
        Case{"\"2 s\"", "1e11\nstep = 1e-5",
             "27:1: 1e+11 s in steps of 1e-05 s make 1e+16 steps, and the most are 9e+15; shorten "
             "it or lengthen "
             "run.step"},
        Case{"\"2 s\"", "1e-9\nstep = 1e-5",
             "27:1: 'duration' of 1e-09 s is shorter than half a step of 1e-05 s; lengthen it"},
        Case{"[run]\n", "[[film.segment]]\nduration = 3\n[run]\n",
             "26:8: 'segment' shows 3 s, but the run has 2 s; shorten the segments or lengthen run.duration"},
        Case{"[run]\n", "[[film.segment]]\n[[film.segment]]\n[run]\n",
             "27:1: 'duration' is missing, and of an earlier segment too; only one may take what the others "
             "leave"},
        Case{"[run]\n", "[start]\nmethod = \"file\"\nfile = \"/nowhere/final.csv\"\n[run]\n",
             "28:1: 'file' names /nowhere/final.csv, which does not exist; give a checkpoint or final.csv"},
        Case{"[run]\n", "[start]\nmethod = \"file\"\nfile = \"/dev/zero\"\n[run]\n",
             "28:1: 'file' names /dev/zero, which is no file; give a checkpoint or final.csv"},
        Case{"[run]\n", "[[contact.pair]]\nbetween = [\"big\", \"nut\"]\n[run]\n",
             "27:1: 'between' names \"nut\", which is no species; there are small, big, and wall"}));

TEST(Messages, LockedFilmWithoutADrive) {
    EXPECT_EQ(
        complaint(box_text + "[[film.segment]]\nkind = \"locked\"\n"),
        "test.toml:26:1: 'kind' is \"locked\", but nothing oscillates; add [drive] or write \"motion\"");
}

TEST(Messages, NothingToChooseTheStiffnessBy) {
    EXPECT_EQ(complaint(with(box_text, "stiffness = 1000\n", "")),
              "test.toml:12:2: 'stiffness' is missing between \"a\" and \"a\", and with neither drive nor "
              "gravity nothing "
              "says how large it must be; write for example stiffness = \"2e4 N/m\"");
}

TEST(Messages, DampingBeyondTheCritical) {
    // The critical damping is 2 sqrt(k / m) for the pair of the largest effective mass; for a-a that is half
    // the mass of a 1 mm grain.
    EXPECT_EQ(complaint(box_text, {"contact.normal_damping=1e5", "contact.attraction=true"}),
              "--set contact.normal_damping: 'normal_damping' of 100000 1/s between \"a\" and \"a\" is not "
              "below the "
              "critical 78176.4 1/s, so "
              "that nothing rebounds; reduce it or raise the stiffness");
}

TEST(Messages, ExactScenes) {
    const auto edit = [](const char* from, const char* to) { return complaint(with(exact_text, from, to)); };
    EXPECT_EQ(complaint(exact_text), "none");
    EXPECT_EQ(edit("position = [0, 0, 0]\n", ""),
              "test.toml:15:1: [[grain]] lacks 'position'; write for example position = [\"5 mm\", 0, 0]");
    EXPECT_EQ(edit("species = \"ball\"", "species = \"bell\""),
              "test.toml:20:1: 'species' names \"bell\", which is no species; name one of [[species]]");
    EXPECT_EQ(
        edit("species = \"ball\"", "diameter = 0.005"),
        "test.toml:20:1: 'diameter' of 0.005 m is outside its species' 0.004 to 0.004 m; widen the spread");
    EXPECT_EQ(edit("[0, 0, 2]", "[0, 0, 0]"),
              "test.toml:13:1: 'normal' must not be zero; write for example [0, 0, 1]");
    EXPECT_EQ(edit("velocity = [0, 0, \"10 cm/s\"]", "moves = true"),
              "test.toml:14:1: 'moves' follows a drive, but there is none; add [drive] or remove it");
    EXPECT_EQ(edit("\"60 rad/s\"", "\"60 Hz\""),
              "test.toml:18:1: 'spin' must be an angular velocity, but \"60 Hz\" is a frequency; write for "
              "example \"10 rad/s\"");
    EXPECT_EQ(edit("diameter = \"4 mm\"", "diameter = \"4 mm\"\ncount = 2"),
              "test.toml:5:1: 'count' is of no use here: the grains are listed one by one; remove it");
    EXPECT_EQ(edit("shape = \"none\"", "shape = \"none\"\nheight = 1"),
              "test.toml:11:1: 'height' is of no use here: there is no container; remove it");
    EXPECT_EQ(
        complaint(exact_text + "[start]\nmethod = \"layers\"\n"),
        "test.toml:25:1: 'method' must be \"grains\" where grains are listed; remove it or the [[grain]]s");
    EXPECT_EQ(
        complaint(exact_text + "[start]\nsettle_limit = 1\n"),
        "test.toml:25:1: 'settle_limit' is of no use here: grains placed by hand do not settle; remove it");
    EXPECT_EQ(complaint(with(wedge_text, "[drive]", "[start]\nmethod = \"grains\"\n[drive]")),
              "test.toml:24:1: 'method' is \"grains\", but none is listed; write [[grain]] and its position");
}

TEST(Messages, LawsThatDoNotGoTogether) {
    const auto set = [](std::vector<std::string> sets) { return complaint(wedge_text, sets); };
    EXPECT_EQ(set({"contact.friction_law=mindlin"}),
              "--set contact.friction_law: 'friction_law' puts mindlin with a linear normal law, but its "
              "stiffness follows from Hertz' contact radius; write law = \"hertz\", or another friction_law");
    EXPECT_EQ(
        set({"contact.law=hertz", "contact.friction_law=linear-spring"}),
        "--set contact.friction_law: 'friction_law' puts hertz with a tangential spring of constant "
        "stiffness, while its own grows with the overlap; write friction_law = \"mindlin\" or \"none\"");
    EXPECT_EQ(set({"contact.law=hertz", "contact.stiffness=1e4"}),
              "--set contact.stiffness: 'stiffness' is of no use here: hertz has a 'modulus'; remove it");
    EXPECT_EQ(set({"contact.modulus=1 GPa"}),
              "--set contact.modulus: 'modulus' is of no use here: only the law hertz has it; remove it");
    EXPECT_EQ(
        set({"contact.attraction=true"}),
        "--set contact.attraction: 'attraction' is of no use here: the law walton-braun has no damping; "
        "remove it");
    EXPECT_EQ(complaint(with(wedge_text, "restitution = 0.8",
                             "restitution = 0.8\nrestitution_table = [[1, 0.9], [2, 0.8]]")),
              "test.toml:14:1: 'restitution' is of no use here: 'restitution_table' is given; remove it");
    EXPECT_EQ(complaint(with(wedge_text, "restitution = 0.8", "restitution_table = [[1, 0.9], [0.5, 0.8]]")),
              "test.toml:14:1: 'restitution_table' must have rising speeds, none below 0; sort its rows");
    EXPECT_EQ(
        complaint(with(wedge_text, "restitution = 0.8", "restitution_table = [[1, 1.9]]")),
        "test.toml:14:1: 'restitution_table' has a restitution of 1.9; it must be larger than 0, at most 1");
    EXPECT_EQ(complaint(with(wedge_text, "restitution = 0.8", "restitution_table = [1, 2]")),
              "test.toml:14:1: 'restitution_table' must be rows of a speed and a number, at most 8, but is "
              "[ 1, 2 ]; write for example [[\"0.1 m/s\", 0.95], [\"2 m/s\", 0.8]]");
}

TEST(Messages, TwoSetKeysThatExcludeEachOther) {
    EXPECT_EQ(
        complaint(wedge_text, {"drive.g_level=2", "drive.amplitude=1 mm"}),
        "--set drive.amplitude: 'drive.amplitude' and 'drive.g_level' exclude each other, and both are set "
        "(--set drive.g_level); leave out one");
    // The same without --set: a key of the file gives way, and so does one that is set twice.
    EXPECT_EQ(read_text(wedge_text, {"drive.amplitude=1 mm", "drive.amplitude=2 mm"}).drive.amplitude, 0.002);
}

TEST(Messages, AlwaysHaveALine) {
    const std::string species = "[[species]]\nname = \"a\"\ncount = 3\ndiameter = 0.005\ndensity = 2500\n";
    EXPECT_EQ(complaint(species),
              "test.toml:1:1: [container] lacks 'shape'; write for example shape = \"wedge\"");
    EXPECT_EQ(complaint(species + "[container]\n"),
              "test.toml:6:2: [container] lacks 'shape'; write for example shape = \"wedge\"");
}

TEST(Messages, EchoNoMoreThanSixtyCharacters) {
    const std::string x(160'000, 'x'), shown = std::string(60, 'x') + "...";
    EXPECT_EQ(complaint(wedge_text, {Assignment("drive.frequency=" + x)}),
              "--set drive.frequency: 'frequency' must be a frequency, but \"" + shown +
                  "\" does not begin with a number; write for example \"25 Hz\"");
    const std::vector<std::string> sets = {"drive.frequency=3 " + x,
                                           "container.shape=" + x,
                                           "film.size=" + x,
                                           "film.background=" + x,
                                           "species.big.colour=" + x,
                                           "film.max_size=" + x,
                                           "film.highlight_if=" + x,
                                           "film.text={" + x + "}",
                                           "film.plot=[{y=\"" + x + "\"}]",
                                           "film.hide=[\"" + x + "\"]",
                                           "film." + x + "=3",
                                           x + ".a.b=3",
                                           "run.duration." + x + "=3",
                                           "species." + x + ".count=3",
                                           x,
                                           "contact.restitution=[" + x,
                                           "run.seed=[\"" + x + "\"]",
                                           "container.outlet=" + x,
                                           "contact.pair=[{between=[\"small\", \"" + x + "\"]}]",
                                           "film.colour.by=speed\x01" + x};
    for (const std::string& set : sets) {
        const std::string said = complaint(wedge_text, {Assignment(set)});
        EXPECT_NE(said, "none") << set.substr(0, 40);
        EXPECT_LT(said.size(), 1000u) << said.substr(0, 200);
    }
    EXPECT_LT(complaint("title = " + x).size(), 1000u);
    EXPECT_LT(complaint("a = 1\n" + x + " = 1\n" + x + " = 2\n").size(), 1000u);
    EXPECT_LT(complaint(with(wedge_text, "\"small\"", "\"" + x + "\"") +
                        "[[contact.pair]]\nbetween = [\"y\", \"wall\"]\n")
                  .size(),
              1000u);
}

// Absurd values are refused where they are read. Later, products of such values would overflow, and the
// message would name the duration.
TEST(Messages, AbsurdSizesAreRefusedAtTheirKey) {
    const auto of = [](const std::string& set) { return complaint(wedge_text, {Assignment(set)}); };
    EXPECT_EQ(
        of("gravity=2000000"),
        "--set gravity: 'gravity' must be from 0 to 1000000 m/s2, but is 2000000; write for example 9.81");
    EXPECT_EQ(of("container.height=2000000"),
              "--set container.height: 'height' must be from 1e-12 to 1000000 m, but is 2000000; write for "
              "example \"5 mm\"");
    EXPECT_EQ(of("film.camera.position=[\"1e39 m\", 0, 0]"),
              "--set film.camera.position: 'position' must be from -1000000 to 1000000 m, but is \"1e39 m\"; "
              "write for example [\"5 mm\", 0, 0]");
    for (const char* set : {"gravity=1e300", "container.height=1e300", "species.big.diameter=1e-39 m",
                            "species.big.density=1e300", "species.big.mass=1e300", "species.big.mass=1e12",
                            "contact.tangential_ratio=1e300", "drive.g_level=1e300", "drive.frequency=1e300",
                            "contact.stiffness=1e300", "film.camera.zoom=1e300",
                            "film.camera.key=[{time=0,target=[0,\"1e39 m\",0]},{time=1,target=[0,0,0]}]"}) {
        const std::string key = std::string(set).substr(0, std::string(set).find('='));
        EXPECT_THAT(of(set), testing::StartsWith("--set " + key + ": '")) << set;
    }
    for (const char* place : {"[\"1e39 m\", 0, 0]", "[0, 0, -1e39]"})
        EXPECT_THAT(complaint(with(exact_text, "position = [0, 0, 0]", std::string("position = ") + place)),
                    testing::HasSubstr("'position' must be from -1000000 to 1000000 m"));
}

TEST(Messages, NameTheOptionThatWasTyped) {
    const auto of = [](const char* option, const char* set) {
        return complaint(wedge_text, {{set, option}});
    };
    EXPECT_EQ(of("--size", "film.size=1x1"),
              "--size: 'size' must be width x height, each from 64 to 8192 pixels, but is \"1x1\"; write for "
              "example \"1920x1080\"");
    EXPECT_EQ(of("--duration", "run.duration=3 m"),
              "--duration: 'duration' must be a time, but \"3 m\" is a length; write for example \"10 s\"");
    EXPECT_EQ(
        of("--max-size", "film.max_size=10"),
        "--max-size: 'max_size' must be a size in kB, MB, GB, KiB, MiB or GiB, but is \"10\"; write for "
        "example \"10 MB\"");
}

TEST(Messages, GluedGrainsLargerThanTheRoom) {
    EXPECT_EQ(
        complaint(wedge_text, {"species.big.diameter=30 mm",
                               "container.wall_grains={species=\"big\", faces=[\"back\", \"front\"]}"}),
        "--set container.wall_grains: 'species' glues grains of up to 0.03 m, larger than the room: they "
        "leave 0.015 m along container.depth, less than the largest grain, 0.03 m; use smaller ones, or a "
        "larger container");
}

TEST(Messages, AStiffnessOfGluedGrainsThatAreNotThere) {
    EXPECT_EQ(complaint(wedge_text, {"contact.glued_stiffness=1e4"}),
              "--set contact.glued_stiffness: 'glued_stiffness' is of no use here: no grains are glued to "
              "walls; remove it");
    EXPECT_THAT(complaint(wedge_text, {"contact.wall.glued_stiffness=1e4"}),
                testing::HasSubstr("unknown key 'glued_stiffness' in [contact.wall]"));
    const auto of_pair = [&](const std::string& between, const char* law) {
        return complaint(wedge_text + "[[contact.pair]]\nbetween = " + between + "\nglued_stiffness = 1e4\n",
                         {"container.wall_grains={species=\"big\", faces=[\"floor\"]}", law});
    };
    EXPECT_THAT(of_pair(R"(["small", "small"])", "contact.friction=0.3"),
                testing::HasSubstr("'glued_stiffness' is of no use here: 'container.wall_grains' glues "
                                   "grains of neither species; remove it"));
    EXPECT_THAT(of_pair(R"(["small", "wall"])", "contact.friction=0.3"),
                testing::HasSubstr("'glued_stiffness' is of no use here: a wall itself is smooth; name the "
                                   "two species; remove it"));
    EXPECT_THAT(of_pair(R"(["small", "big"])", "contact.law=hertz"),
                testing::HasSubstr("'glued_stiffness' is of no use here: hertz has a 'modulus'; remove it"));
    EXPECT_EQ(of_pair(R"(["small", "big"])", "contact.friction=0.3"), "none");
}

TEST(Messages, CommandLine) {
    EXPECT_EQ(complaint(wedge_text, {"drive.frequenzy=3"}),
              "--set drive.frequenzy: unknown key 'frequenzy' in [drive]; did you mean 'frequency'?");
    EXPECT_EQ(complaint(wedge_text, {"foo.bar=3"}),
              "--set foo.bar: unknown key 'foo' at the top level; the keys there are title, gravity, "
              "species, contact, "
              "container, wall, mesh, exit, grain, drive, start, run, output, film, feed");
    EXPECT_EQ(complaint(wedge_text, {"drive.frequency"}),
              "--set drive.frequency: no assignment; write --set drive.frequency=\"30 Hz\"");
    EXPECT_EQ(complaint(wedge_text, {"species[2].count=3"}),
              "--set species[2].count: there is no '2' among the 2 entries; they count from 0");
    EXPECT_EQ(complaint(wedge_text, {"species.huge.count=3"}),
              "--set species.huge.count: there is no 'huge'; there are small, big");
    EXPECT_EQ(complaint(wedge_text, {"species.bigg.count=3"}),
              "--set species.bigg.count: there is no 'bigg'; did you mean 'big'? there are small, big");
    EXPECT_EQ(complaint(wedge_text, {"run.duration.more=3"}),
              "--set run.duration.more: 'run.duration' is not a table; name one of its own keys");
    EXPECT_EQ(complaint(wedge_text, {"run.duration.more.and.more=3"}),
              "--set run.duration.more.and.more: 'run.duration' is not a table; name one of its own keys");
    const std::string size =
        "--set film.size: 'size' must be width x height, each from 64 to 8192 pixels, but is ";
    for (const char* wrong : {"641", "0x0", "640x", "1920x1080p", "99999999999999999999x100"})
        EXPECT_EQ(complaint(wedge_text, {std::string("film.size=") + wrong}),
                  size + "\"" + wrong + "\"; write for example \"1920x1080\"");
    EXPECT_EQ(complaint(wedge_text, {"film.size=[640, 9999]"}),
              size + "[ 640, 9999 ]; write for example \"1920x1080\"");
    EXPECT_EQ(
        complaint(wedge_text, {"film.rate=x"}),
        "--set film.rate: 'rate' must be a plain number, but \"x\" does not begin with a number; write for "
        "example 30");
    EXPECT_EQ(
        complaint(wedge_text, {"run.seed=-1"}),
        "--set run.seed: 'seed' must be a whole number from 0 to 9007199254740992, but is -1; write for "
        "example 1");
    EXPECT_EQ(complaint(wedge_text, {"drive.frequency=25 hz"}),
              "--set drive.frequency: 'frequency' must be a frequency, but \"25 hz\" has the unknown unit "
              "\"hz\"; write for "
              "example \"25 Hz\"");
}

}  // namespace
}  // namespace grainreel
