// Questions to a moment of a run: expressions, tables, and the verb.
#include "engine/inspect/questions.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "engine/base/error.hpp"
#include "engine/inspect/expression.hpp"
#include "engine/inspect/grain_columns.hpp"
#include "engine/scene/text/reader.hpp"
#include "tests/cli/program.hpp"
#include "tests/cli/temporary_folder.hpp"

namespace grainreel {
namespace {

using namespace test;
using testing::HasSubstr;

constexpr double d = 0.004;  // m, diameter

Scene two_species() {
    return read_scene_text(R"(
[[species]]
name = "small"
count = 63
diameter = "4 mm"
density = "2.5 g/cm3"
[[species]]
name = "big beads"
count = 1
diameter = "4 mm"
density = "2.5 g/cm3"
[container]
shape = "box"
width = "16 mm"
depth = "16 mm"
height = "40 mm"
[drive]
frequency = "20 Hz"
g_level = 2
[run]
duration = "1 s"
)",
                           "two.toml");
}

// A cubic lattice of 4 x 4 x 4 grains that touch, from the floor up; grain 63, the one far up in a corner, is
// of the other species. Layer k moves upwards at k cm/s.
Frame lattice() {
    Frame frame;
    for (int i = 0; i < 64; ++i) {
        const int layer = i / 16;
        frame.id.push_back(i);
        frame.species.push_back(i == 63);
        frame.radius.push_back(d / 2);
        frame.position.push_back(d * Vec3(i % 4 - 1.5, i / 4 % 4 - 1.5, layer + 0.5));
        frame.velocity.emplace_back(0, 0, 0.01 * layer);
        frame.spin.emplace_back(0, 0, 0);
    }
    return frame;
}

struct Bed {
    Scene scene = two_species();
    Snapshot snapshot{scene, lattice(), false, lattice()};

    std::size_t count(const std::string& condition) const { return grains_where(snapshot, condition).size(); }
    std::string mistake(const std::string& condition) const {
        try {
            count(condition);
        } catch (const UserError& error) {
            return error.what();
        }
        return "none";
    }
};

TEST(Expressions, CountTheGrainsOfALattice) {
    const Bed bed;
    EXPECT_EQ(bed.count("height > 0"), 64u);
    EXPECT_EQ(bed.count("height < 1 cm"), 32u);  // centres at 2, 6, 10 and 14 mm
    EXPECT_EQ(bed.count("height <= 10 mm"), 48u);
    EXPECT_EQ(bed.count("vz = 1 cm/s"), 16u);
    EXPECT_EQ(bed.count("speed > 5 mm/s and not height > 8 mm"), 16u);
    EXPECT_EQ(bed.count("id < 3 or id >= 62"), 5u);
    EXPECT_EQ(bed.count("species == small"), 63u);
    EXPECT_EQ(bed.count("species != 'big beads' && y > 0"), 31u);
    EXPECT_EQ(bed.count("4 mm < height < 8 mm"), 16u);
    EXPECT_EQ(bed.count("sqrt(x^2 + y^2) < 3 mm"),
              16u);  // the inner four of each layer, 2.83 mm from the axis
    EXPECT_EQ(bed.count("max(abs(x), abs(y)) < 3 mm"), 16u);
    EXPECT_EQ(bed.count("kinetic_energy > 0.5 * mass * (15 mm/s)^2"), 32u);
    EXPECT_EQ(bed.count("-vz <= -0.02 m/s"), 32u);
    EXPECT_EQ(bed.count("!(id >= 10)"), 10u);
    EXPECT_EQ(bed.count("rise == 0 mm"), 64u);
}

TEST(Expressions, TellWhatIsWrongAndWhere) {
    const Bed bed;
    EXPECT_EQ(bed.mistake("hight > 2 cm"), "character 1: 'hight' is not known; did you mean 'height'?");
    EXPECT_EQ(bed.mistake("height > 2 s"), "character 1: a length and a time do not go together");
    EXPECT_EQ(bed.mistake("height > 2"),
              "character 1: a length and a plain number do not go together; write a unit after the number");
    EXPECT_EQ(bed.mistake("spin > 3 Hz"),
              "character 1: an angular velocity and a frequency do not go together");
    EXPECT_EQ(bed.mistake("height > 2 cm and"), "character 18: something is missing at the end");
    EXPECT_EQ(bed.mistake("height + mass > 2 cm"), "character 1: a length and a mass do not go together");
    EXPECT_EQ(bed.mistake("(height > 2 cm"), "character 15: a ')' is missing");
    EXPECT_EQ(bed.mistake("height > 2 cm) or id = 1"), "character 14: ') or id = 1' is not expected here");
    EXPECT_EQ(bed.mistake("height > 2 furlongz"), "character 12: 'furlongz' is no unit");
    EXPECT_EQ(bed.mistake("species > small"),
              "character 1: species have no order; compare them with == or !=");
    EXPECT_EQ(bed.mistake("species == 1"), "character 1: a species and a plain number do not go together");
    EXPECT_THAT(bed.mistake("height"), HasSubstr("this is a value and no condition"));
    EXPECT_THAT(bed.mistake(" "), HasSubstr("nothing is asked"));
    EXPECT_THAT(bed.mistake("contacts > 3"), HasSubstr("run it with output.contacts = true"));
    EXPECT_THAT(bed.mistake("height and id = 1"), HasSubstr("this is a length, and a condition is wanted"));
    EXPECT_THAT(bed.mistake(std::string(500, '(') + "1"), HasSubstr("is nested too deeply"));
    EXPECT_THAT(bed.mistake(std::string(500, '-') + "1"), HasSubstr("is nested too deeply"));
    EXPECT_THAT(bed.mistake(std::string(5000, ' ') + "1"), HasSubstr("is longer than 4096 characters"));
    EXPECT_THAT(bed.mistake("x^99 > 1"), HasSubstr("from -9 to 9"));
}

double number(const AnswerCell& cell) {
    if (const auto* count = std::get_if<std::int64_t>(&cell)) return static_cast<double>(*count);
    return std::get<double>(cell);
}

TEST(Questions, AProfileCountsTheLayers) {
    const Bed bed;
    const AnswerTable table = profile_answer(bed.snapshot, "height").tables[0];
    ASSERT_EQ(table.rows.size(), 4u);  // bins as wide as a grain, from the floor
    for (std::size_t k = 0; k < 4; ++k) {
        EXPECT_NEAR(number(table.rows[k][0]), static_cast<double>(k) * d, 1e-15);
        EXPECT_EQ(number(table.rows[k][2]), 16);
        EXPECT_NEAR(number(table.rows[k][4]), 0.01 * static_cast<double>(k), 1e-15);
        EXPECT_NEAR(number(table.rows[k][6]), k == 3 ? 1.0 / 16 : 0, 1e-15);  // share of the big beads
    }
    EXPECT_THROW(profile_answer(bed.snapshot, "speed"), UserError);
}

TEST(Questions, AHistogramHasEveryGrainOnce) {
    const Bed bed;
    const AnswerTable table = histogram_answer(bed.snapshot, "vz", 4).tables[0];
    ASSERT_EQ(table.rows.size(), 4u);
    EXPECT_EQ(number(table.rows[3][1]), 0.03);
    double all = 0;
    for (const auto& row : table.rows) all += number(row[2]) + number(row[3]);
    EXPECT_EQ(all, 64);
    for (const auto& row : table.rows) EXPECT_EQ(number(row[2]) + number(row[3]), 16);
}

// Of a cubic lattice of spacing d: partners at d (6), d sqrt 2 (12), d sqrt 3 (8), 2 d (6) ..., none between.
TEST(Questions, ThePairDistributionOfALatticeHasItsShells) {
    Bed bed;
    Frame& frame = bed.snapshot.frame;
    frame = Frame();
    const int side = 12;
    for (int i = 0; i < side * side * side; ++i) {
        frame.id.push_back(i);
        frame.species.push_back(0);
        frame.radius.push_back(d / 2);
        frame.position.push_back(d * Vec3(i % side, i / side % side, i / side / side + 0.5));
    }
    frame.velocity.assign(frame.id.size(), Vec3(0, 0, 0));
    frame.spin = frame.velocity;
    const AnswerTable table = pair_distribution_answer(bed.snapshot).tables[0];
    const double density = std::pow(side, 3) / std::pow((side - 1) * d, 3);  // in the box about the centres
    double partners = 0;
    for (const auto& row : table.rows) {
        const double from = number(row[0]), to = number(row[1]);
        if (std::holds_alternative<std::monostate>(row[2]) || to > 1.9 * d) break;
        const double here =
            number(row[2]) * density * 4.0 / 3.0 * 3.141592653589793 * (std::pow(to, 3) - std::pow(from, 3));
        if (to < 0.99 * d) {
            EXPECT_EQ(here, 0);
        }
        partners += here;
    }
    EXPECT_NEAR(partners, 6 + 12 + 8, 1e-9);
}

TEST(Questions, ComparingMomentsIsDoneInTheContainersFrame) {
    Bed bed;
    Bed later;
    for (Vec3& place : later.snapshot.frame.position) place += Vec3(0, 0, 0.001);
    later.snapshot.frame.container().place = Vec3(0, 0, 0.001);
    later.snapshot.frame.position[20] += Vec3(0, 0.002, 0);
    const Answer answer = compare_answer(bed.snapshot, later.snapshot, 1);
    ASSERT_EQ(answer.tables.size(), 2u);
    EXPECT_EQ(number(answer.tables[1].rows[0][0]), 20);
    EXPECT_NEAR(number(answer.tables[1].rows[0][2]), 0.002, 1e-15);
    EXPECT_NEAR(number(answer.tables[0].rows[1][2]), 0, 1e-15);  // the big bead has not moved
}

TEST(Questions, AGrainTellsItsContacts) {
    Bed bed;
    bed.snapshot.contacts = true;
    bed.snapshot.frame.touches = {{5, 21, 0.5}, {5, -1, 0.25}, {6, 7, 1}};
    const Answer answer = grain_answer(bed.snapshot, 5);
    ASSERT_EQ(answer.tables.size(), 2u);
    ASSERT_EQ(answer.tables[1].rows.size(), 2u);
    EXPECT_EQ(number(answer.tables[1].rows[0][0]), 21);
    EXPECT_EQ(std::get<std::string>(answer.tables[1].rows[1][1]), "floor");
    EXPECT_EQ(bed.count("contacts == 2"), 1u);
    EXPECT_EQ(bed.count("contact_force > 0.7 N"), 3u);  // grains 5, 6 and 7
    EXPECT_THROW(grain_answer(bed.snapshot, 64), UserError);
}

TEST(InspectProgram, AnswersFromARunOnDisk) {
    const TemporaryFolder folder;
    const Ended run = run_program({"movie", "oblique_impact", "--no-film", "--out", "run", "--quiet"},
                                  {.folder = folder.path()});
    ASSERT_EQ(run.status, 0) << run.err;
    // A ball of 5 mm leaves the plate upwards at e times its speed: 0.98 * 3.334 m/s.
    const Ended where =
        run_program({"inspect", "run", "--where", "vz > 3.2 m/s and vz < 3.3 m/s", "--json", "--quiet"},
                    {.folder = folder.path()});
    ASSERT_EQ(where.status, 0) << where.err;
    const auto answer = nlohmann::json::parse(where.out);
    EXPECT_EQ(answer["tables"]["count"]["rows"][0][1], 1);
    const Ended overview = run_program({"inspect", "run"}, {.folder = folder.path()});
    EXPECT_THAT(overview.out, HasSubstr("alumina"));
    EXPECT_THAT(
        run_program({"inspect", "run", "--grain", "0", "--at", "0s", "--csv"}, {.folder = folder.path()}).out,
        HasSubstr("id,species,x (m)"));
    const Ended late = run_program({"inspect", "run", "--at", "9s"}, {.folder = folder.path()});
    EXPECT_EQ(late.status, 2);
    EXPECT_THAT(late.err, HasSubstr("--at: 9 s is outside the run"));
    EXPECT_EQ(run_program({"inspect", "run", "--grain", "7"}, {.folder = folder.path()}).status, 2);
    EXPECT_EQ(run_program({"inspect", "nowhere"}, {.folder = folder.path()}).status, 2);
}

}  // namespace
}  // namespace grainreel
