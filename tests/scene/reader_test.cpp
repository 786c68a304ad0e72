// Tests of the reader of scenes: values, defaults and places in the text.
#include "render/scene/filmed_scene.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <numbers>

#include "engine/base/error.hpp"
#include "engine/plan/plan.hpp"
#include "render/scene/film.hpp"
#include "tests/scene/scene_text.hpp"
#include "tests/support/temporary_folder.hpp"

namespace grainreel {
namespace {

using std::numbers::pi;

TEST(Reader, TakesValuesInSi) {
    const FilmedScene scene = read_text(wedge_text);
    EXPECT_EQ(scene.name, "test");
    ASSERT_EQ(scene.species.size(), 2u);
    EXPECT_EQ(scene.species[1].name, "big");
    EXPECT_EQ(scene.species[1].count, 10);
    EXPECT_EQ(scene.species[0].diameter.mean, 0.005);
    EXPECT_EQ(scene.species[0].diameter.smallest, 0.005);
    EXPECT_DOUBLE_EQ(scene.container.half_angle, 20 * pi / 180);
    EXPECT_EQ(scene.container.half_width, 0.055);
    EXPECT_TRUE(scene.container.lid);
    EXPECT_EQ(scene.gravity, Vec3(0, 0, -10));
    EXPECT_EQ(scene.run.duration, 2);
}

TEST(Reader, AmplitudeFollowsFromTheGLevel) {
    const FilmedScene scene = read_text(wedge_text);
    EXPECT_DOUBLE_EQ(scene.drive.amplitude, 3 * 10 / std::pow(2 * pi * 20, 2));
    EXPECT_DOUBLE_EQ(scene.drive.g_level(10), 3);
}

TEST(Reader, SpreadsAndMass) {
    const FilmedScene uniform = read_text(with(wedge_text, "\"5 mm\"", "{ min = \"4 mm\", max = \"6 mm\" }"));
    EXPECT_EQ(uniform.species[0].diameter.kind, SizeSpread::Kind::uniform);
    EXPECT_DOUBLE_EQ(uniform.species[0].diameter.mean, 0.005);
    const FilmedScene normal =
        read_text(with(wedge_text, "\"5 mm\"", "{ mean = \"5 mm\", deviation = \"0.5 mm\" }"));
    EXPECT_EQ(normal.species[0].diameter.kind, SizeSpread::Kind::normal);
    EXPECT_DOUBLE_EQ(normal.species[0].diameter.smallest, 0.004);
    EXPECT_DOUBLE_EQ(normal.species[0].diameter.largest, 0.006);
    const FilmedScene mass = read_text(with(wedge_text, "density = 2500", "mass = \"0.2 g\""));
    EXPECT_DOUBLE_EQ(mass.species[0].density, 0.0002 / (pi / 6 * std::pow(0.005, 3)));
}

TEST(Reader, WallsInheritAndPairsOverride) {
    const FilmedScene scene =
        read_text(wedge_text +
                  "[contact.wall]\nfriction = 0.1\n"
                  "[[contact.pair]]\nbetween = [\"big\", \"small\"]\nrestitution = 0.5\n"
                  "[[contact.pair]]\nbetween = [\"wall\", \"big\"]\nfriction = inf\n");
    EXPECT_EQ(scene.contact.wall[0].friction, 0.1);
    EXPECT_EQ(scene.contact.wall[0].restitution, 0.8);
    EXPECT_EQ(scene.between(0, 1).restitution, 0.5);
    EXPECT_EQ(scene.between(0, 1), scene.between(1, 0));
    EXPECT_EQ(scene.between(0, 1).friction, 0.3);
    EXPECT_EQ(scene.between(0, 0).restitution, 0.8);
    EXPECT_TRUE(std::isinf(scene.contact.wall[1].friction));
}

TEST(Reader, NoFrictionAnywhereLeavesOutTheTangentialLaw) {
    EXPECT_FALSE(read_text(with(wedge_text, "friction = 0.3", "friction = 0")).contact.rubs());
    const FilmedScene rough_wall =
        read_text(with(wedge_text, "friction = 0.3", "friction = 0") + "[contact.wall]\nfriction = 0.3\n");
    EXPECT_EQ(rough_wall.contact.grain[0].tangential, TangentialLaw::none);
    EXPECT_EQ(rough_wall.contact.wall[0].tangential, TangentialLaw::incremental_slip);
}

TEST(Reader, GravityMayBeAVector) {
    const FilmedScene scene = read_text(with(wedge_text, "gravity = 10.0", "gravity = [0, \"3 m/s2\", -4]"));
    EXPECT_EQ(scene.gravity, Vec3(0, 3, -4));
    EXPECT_DOUBLE_EQ(scene.drive.amplitude, 3 * 5 / std::pow(2 * pi * 20, 2));
}

TEST(Reader, SetsTakePrecedence) {
    const FilmedScene scene =
        read_text(wedge_text, {"species[1].count=30", "species.small.count = 50", "drive.frequency=30 Hz",
                               "run.duration=\"1 s\"", "start.settle_limit=2", "title=a b = c",
                               "contact.wall.friction=inf", "film.camera.zoom=1.5"});
    EXPECT_EQ(scene.species[1].count, 30);
    EXPECT_EQ(scene.species[0].count, 50);
    EXPECT_EQ(scene.drive.frequency, 30);
    EXPECT_EQ(scene.run.duration, 1);
    EXPECT_EQ(scene.start.settle_limit, 2);
    EXPECT_EQ(scene.title, "a b = c");
    EXPECT_TRUE(std::isinf(scene.contact.wall[0].friction));
    EXPECT_EQ(scene.film.camera.zoom, 1.5);
}

TEST(Reader, ASetTakesItsRivalOutOfTheFile) {
    EXPECT_EQ(read_text(wedge_text, {"drive.amplitude=2 mm"}).drive.amplitude, 0.002);
    EXPECT_NO_THROW(read_text(wedge_text, {"species.big.mass=1 g"}));
}

TEST(Reader, NumbersOfTheCommandLineNeedNoZeroBeforeTheirPoint) {
    EXPECT_EQ(read_text(wedge_text, {"contact.restitution=.5"}).contact.grain[0].restitution, 0.5);
    EXPECT_EQ(read_text(wedge_text, {"drive.g_level=2."}).drive.amplitude,
              read_text(wedge_text, {"drive.g_level=2"}).drive.amplitude);
    EXPECT_EQ(read_text(wedge_text, {"contact.friction=+.25"}).contact.grain[0].friction, 0.25);
    EXPECT_EQ(read_text(wedge_text, {"species.small.diameter=.5 cm"}).species[0].diameter.mean, 0.005);
    EXPECT_EQ(read_text(wedge_text, {"film.title=.5"}).film.title, ".5");
}

const std::string coloured = R"([film.colour]
by = "speed"
map = "cividis"
range = [0, 2]
unit = "cm/s"
[[film.plot]]
y = "lacey"
[[film.segment]]
kind = "locked"
every = 2
[film.trails]
grains = [3]
)";

TEST(Reader, AnotherColouringTakesBackWhatBelongedToTheOldOne) {
    const std::string text = wedge_text + coloured;
    const auto of = [&](const Assignments& sets) { return read_text(text, sets).film.shows.colour; };
    for (const char* by : {"coordination", "species", "displacement", "start-height"}) {
        const std::string set = std::string("film.colour.by=") + by;
        EXPECT_EQ(of({Assignment(set)}), read_text(wedge_text, {Assignment(set)}).film.shows.colour) << by;
    }
    EXPECT_EQ(of({"film.colour.by=speed"}), of({}));  // the film that is the default anyway
    const GrainColouring both = of({"film.colour.range=[0, 3]", "film.colour.by=vertical-velocity"});
    EXPECT_EQ(both.range[1], 3);
    EXPECT_EQ(both.map, ColourMap::vik);
    EXPECT_EQ(read_text(text, {"film.segment[0].kind=motion"}).film.segments[0].every, 1);
}

TEST(Reader, ListsAndTablesCanBeEmptiedFromTheCommandLine) {
    const Film film = read_text(wedge_text + coloured,
                                {"film.plot=[]", "film.segment=[]", "film.trails={}", "film.colour={}"})
                          .film;
    EXPECT_EQ(film, read_text(wedge_text).film);
    EXPECT_FALSE(read_text(wedge_text + coloured, {"film.trails.grains=[]"}).film.shows.trails.wanted());
    EXPECT_FALSE(read_text(wedge_text + "[film]\nhighlight_if = \"speed > 1 m/s\"\n", {"film.highlight_if="})
                     .film.shows.highlight_if.wanted());
    EXPECT_FALSE(read_text(wedge_text, {"drive={}"}).drive.present);
    try {
        read_text(wedge_text, {"species=[]"});
        FAIL() << "accepted";
    } catch (const UserError& error) {
        EXPECT_EQ(std::string(error.what()).substr(0, 36), "--set species: there are no grains; ");
    }
}

TEST(Reader, KnowsWhereEveryValueStands) {
    const FilmedScene scene = read_text(wedge_text, {"run.duration=1"});
    EXPECT_EQ(scene.where("species[1].count"), "test.toml:10:1");
    EXPECT_EQ(scene.where("drive.frequency"), "test.toml:24:1");
    EXPECT_EQ(scene.where("run.duration"), "--set run.duration");
    EXPECT_EQ(scene.where("drive.phase"),
              "test.toml:23:2");  // the key is not in the text, so its table is named
    EXPECT_EQ(scene.where("start.method"), "test.toml:1:1");
}

// The text of n more species without colours.
std::string species_text(std::size_t n) {
    std::string text;
    for (std::size_t i = 0; i < n; ++i)
        text += "[[species]]\nname = \"more" + std::to_string(i) +
                "\"\ncount = 1\ndiameter = \"5 mm\"\ndensity = 2500\n";
    return text;
}

TEST(Reader, DefaultColoursAreThoseThatOthersLeave) {
    const FilmedScene scene =
        read_text(wedge_text + species_text(2), {"species.big.colour=sky-blue", "species[2].colour=#009e73"});
    const char* expected[] = {"orange", "sky-blue", "green", "yellow"};
    for (std::size_t i = 0; i < 4; ++i) EXPECT_EQ(scene.colours[i], *parse_colour(expected[i])) << i;
}

TEST(Reader, MoreSpeciesThanColoursIsAWarning) {
    const FilmedScene eight = read_text(wedge_text + species_text(6));
    for (std::size_t i = 0; i < 8; ++i)
        for (std::size_t j = 0; j < i; ++j) EXPECT_NE(eight.colours[i], eight.colours[j]);
    EXPECT_TRUE(plan_with_film(eight).warnings.empty());
    const FilmedScene nine = read_text(wedge_text + species_text(7));
    EXPECT_EQ(nine.colours[8], nine.colours[0]);
    const std::string warning =
        ": \"small\" and \"more6\" look alike: there are more species than default colours; give one a "
        "colour "
        "of its own, such as colour = \"#8b4513\"";
    ASSERT_EQ(plan_with_film(nine).warnings.size(), 1u);
    EXPECT_EQ(plan_with_film(nine).warnings[0], nine.where("species[0]") + warning);
    EXPECT_TRUE(plan_with_film(read_text(wedge_text + species_text(7), {"species.more6.colour=#8b4513"}))
                    .warnings.empty());
}

TEST(Reader, StartFileCountsFromTheScenesFolder) {
    const test::TemporaryFolder folder;
    const auto file = folder.write("final.csv", "x");
    const auto text =
        folder.write("scene.toml", wedge_text + "[start]\nmethod = \"file\"\nfile = \"./final.csv\"\n");
    EXPECT_EQ(read_filmed_scene(text, {}, measurable_in).start.file, file.string());
}

TEST(Reader, DefaultFilmIsSlowAtBothEndsAndLockedBetween) {
    const FilmedScene scene = read_text(wedge_text, {"run.duration=10"});
    ASSERT_EQ(scene.film.segments.size(), 3u);
    EXPECT_EQ(scene.film.segments[0].kind, FilmSegment::Kind::motion);
    EXPECT_DOUBLE_EQ(*scene.film.segments[0].duration, 0.4);
    EXPECT_EQ(scene.film.segments[0].playback, 0.1);
    EXPECT_EQ(scene.film.segments[1].kind, FilmSegment::Kind::locked);
    EXPECT_FALSE(scene.film.segments[1].duration);
    EXPECT_EQ(scene.film.segments[2], scene.film.segments[0]);
    // A slow motion lasts a tenth of a short run; a fast drive has 8 frames a period; without a drive the
    // film plays in real time.
    EXPECT_DOUBLE_EQ(*read_text(wedge_text).film.segments[0].duration, 0.2);
    // The film has three periods a second, or 8 frames a period.
    EXPECT_EQ(read_text(wedge_text, {"drive.frequency=100"}).film.segments[0].playback, 3.0 / 100);
    EXPECT_EQ(read_text(wedge_text, {"drive.frequency=100", "film.rate=16"}).film.segments[0].playback,
              16.0 / 800);
    const Film still = read_text(box_text).film;
    ASSERT_EQ(still.segments.size(), 1u);
    EXPECT_EQ(still.segments[0], FilmSegment{});
}

const std::string three_segments =
    "[[film.segment]]\nduration = 0.5\n[[film.segment]]\nkind = \"locked\"\n[[film.segment]]\nduration = "
    "0.5\n";

TEST(Reader, ARunShortenedOnTheCommandLineShortensItsSegments) {
    const FilmedScene scene = read_text(wedge_text + three_segments, {"run.duration=0.4"});
    EXPECT_DOUBLE_EQ(*scene.film.segments[0].duration, 0.1);
    EXPECT_DOUBLE_EQ(*scene.film.segments[2].duration, 0.1);
    EXPECT_FALSE(scene.film.segments[1].duration);
    const FilmedScene all = read_text(wedge_text + "[[film.segment]]\nduration = 2\n", {"run.duration=0.4"});
    EXPECT_DOUBLE_EQ(*all.film.segments[0].duration, 0.4);
}

TEST(Reader, ShippedScenesAreRight) {
    for (const auto& entry : std::filesystem::directory_iterator(GRAINREEL_SOURCE "/scenes")) {
        if (entry.path().extension() != ".toml") continue;
        EXPECT_NO_THROW(plan_with_film(read_filmed_scene(entry.path(), {}, measurable_in))) << entry.path();
    }
    const FilmedScene scene =
        read_filmed_scene(GRAINREEL_SOURCE "/scenes/wedge_segregation.toml", {}, measurable_in);
    EXPECT_GE(scene.species[0].count, 1500);
    EXPECT_GE(scene.species[1].count, 40);
    EXPECT_EQ(scene.name, "wedge_segregation");
}

// "closed" and a table are two kinds of value of one key.
TEST(Reader, AnOutletIsSetByItsWidthWhateverTheSceneSays) {
    const std::string height = "height = \"180 mm\"\n";
    for (const char* says :
         {"", "outlet = \"closed\"\n", "outlet = { width = 0.03 }\n", "[container.outlet]\nwidth = 0.03\n"}) {
        std::string text = wedge_text;
        text.insert(text.find(height) + height.size(), says);
        const FilmedScene scene = read_filmed_scene_text(
            text, "test.toml", {"container.outlet.width=20 mm", "container.outlet.opens=0.5 s"});
        ASSERT_TRUE(scene.container.outlet) << says;
        EXPECT_EQ(scene.container.outlet->half_width, 0.01) << says;
        EXPECT_EQ(scene.container.outlet->opens, 0.5) << says;
    }
    EXPECT_FALSE(read_filmed_scene_text(wedge_text, "test.toml",
                                        {"container.outlet.width=20 mm", "container.outlet=closed"})
                     .container.outlet);
}

// A species may exist only for grains glued to walls.
TEST(Reader, ASpeciesOfGluedGrainsNeedsNoCount) {
    std::string text = wedge_text;
    text.insert(text.find("[contact]"), "[[species]]\nname = \"rough\"\ndiameter = \"4 mm\"\ndensity = 1\n");
    EXPECT_THROW(read_filmed_scene_text(text, "test.toml"), UserError);
    const FilmedScene scene = read_filmed_scene_text(
        text, "test.toml", {"container.wall_grains={species=\"rough\", faces=[\"floor\"]}"});
    EXPECT_EQ(scene.grains(), 110);
    ASSERT_TRUE(scene.container.wall_grains);
    EXPECT_EQ(scene.container.wall_grains->species, 2u);
    EXPECT_EQ(scene.container.wall_grains->spacing, 0.004);
}

}  // namespace
}  // namespace grainreel
