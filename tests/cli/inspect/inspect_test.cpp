// Tests of questions about a moment of a run: expressions, tables, and the verb `inspect`.
#include "engine/questions/questions.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <numbers>

#include "engine/base/error.hpp"
#include "engine/questions/answer.hpp"
#include "engine/questions/expressions/expression.hpp"
#include "engine/questions/expressions/grain_columns.hpp"
#include "render/scene/filmed_scene.hpp"
#include "tests/cli/program.hpp"
#include "tests/support/small_scene.hpp"
#include "tests/support/tells.hpp"
#include "tests/support/temporary_folder.hpp"

namespace grainreel {
namespace {

using namespace test;
using testing::HasSubstr;

constexpr double d = 0.004;  // m, diameter

FilmedScene two_species() {
    return read_filmed_scene_text(SmallScene()
                                      .beads(63, "small", "4 mm", "2.5 g/cm3")
                                      .beads(1, "big beads", "4 mm", "2.5 g/cm3")
                                      .box("16 mm", "16 mm", "40 mm")
                                      .shaken("20 Hz", "2")
                                      .lasts("1 s")
                                      .text(),
                                  "two.toml");
}

// A cubic lattice of 4 x 4 x 4 grains that touch, from the floor up. Grain 63, in an upper corner, is of the
// other species. Layer k moves upwards at k cm/s.
State lattice() {
    State frame;
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
    FilmedScene scene = two_species();
    Snapshot snapshot{scene, lattice(), false, lattice()};

    std::size_t count(const std::string& condition) const {
        return grains_where(snapshot, Expression(condition, GrainVocabulary(snapshot))).size();
    }
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
              16u);  // four grains in the middle of each layer, 2.83 mm from the axis
    EXPECT_EQ(bed.count("max(abs(x), abs(y)) < 3 mm"), 16u);
    EXPECT_EQ(bed.count("kinetic_energy > 0.5 * mass * (15 mm/s)^2"), 32u);
    EXPECT_EQ(bed.count("-vz <= -0.02 m/s"), 32u);
    EXPECT_EQ(bed.count("!(id >= 10)"), 10u);
    EXPECT_EQ(bed.count("rise == 0 mm"), 64u);
}

TEST(Expressions, TellWhatIsWrongAndWhere) {
    const Bed bed;
    EXPECT_THAT(bed.mistake("hight > 2 cm"),
                tells_only({"character 1: ", "'hight'", "not known", "'height'?"}));
    EXPECT_THAT(bed.mistake("height > 2 s"),
                tells_only({"character 1: ", "a length", "a time", "not go together"}));
    EXPECT_THAT(bed.mistake("height > 2"),
                tells_only({"character 1: ", "a length", "a plain number", "write a unit"}));
    EXPECT_THAT(bed.mistake("spin > 3 Hz"),
                tells_only({"character 1: ", "angular velocity", "frequency", "not go together"}));
    EXPECT_THAT(bed.mistake("height > 2 cm and"), tells_only({"character 18: ", "missing", "end"}));
    EXPECT_THAT(bed.mistake("height + mass > 2 cm"),
                tells_only({"character 1: ", "a length", "a mass", "not go together"}));
    EXPECT_EQ(bed.mistake("(height > 2 cm"), "character 15: a ')' is missing");
    EXPECT_THAT(bed.mistake("height > 2 cm) or id = 1"),
                tells_only({"character 14: ", "') or id = 1'", "not expected"}));
    EXPECT_EQ(bed.mistake("height > 2 furlongz"), "character 12: 'furlongz' is no unit");
    EXPECT_THAT(bed.mistake("species > small"),
                tells_only({"character 1: ", "species", "no order", "== or !="}));
    EXPECT_THAT(bed.mistake("species == 1"),
                tells_only({"character 1: ", "a species", "a plain number", "not go together"}));
    EXPECT_THAT(bed.mistake("height"), tells({"a value", "no condition"}));
    EXPECT_THAT(bed.mistake(" "), HasSubstr("nothing is asked"));
    EXPECT_THAT(bed.mistake("contacts > 3"), HasSubstr("output.contacts = true"));
    EXPECT_THAT(bed.mistake("height and id = 1"), tells({"a length", "condition is wanted"}));
    EXPECT_THAT(bed.mistake(std::string(500, '(') + "1"), HasSubstr("is nested too deeply"));
    EXPECT_THAT(bed.mistake(std::string(500, '-') + "1"), HasSubstr("is nested too deeply"));
    EXPECT_THAT(bed.mistake(std::string(5000, ' ') + "1"), HasSubstr("is longer than 4096 characters"));
    EXPECT_THAT(bed.mistake("x^99 > 1"), HasSubstr("from -9 to 9"));
}

double number(const AnswerCell& cell) {
    if (const auto* count = std::get_if<std::int64_t>(&cell)) return static_cast<double>(*count);
    return std::get<double>(cell);
}

// Grain 63 is lifted out of the lattice: it is the highest grain, and a grain of the layer below it is the
// tip.
TEST(Questions, TheTipOfTheBedIsNotInFlight) {
    Bed bed;
    bed.snapshot.frame.position[63].z() += 3 * d;
    bed.snapshot.frame.position[50].z() += 0.01 * d;
    for (const AnswerTable& table : overview_of(bed.snapshot).tables)
        if (table.name == "extremes") {
            EXPECT_EQ(std::get<std::int64_t>(table.rows[0][1]), 63);
            EXPECT_EQ(std::get<std::string>(table.rows[1][0]), "tip of the bed");
            EXPECT_EQ(std::get<std::int64_t>(table.rows[1][1]), 50);
            return;
        }
    ADD_FAILURE() << "no table of extremes";
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

const AnswerCell& cell_of(const AnswerTable& table, std::size_t row, const std::string& column) {
    for (std::size_t k = 0; k < table.columns.size(); ++k)
        if (table.columns[k].name == column) return table.rows.at(row).at(k);
    throw UserError("no column " + column);
}

// A simple cubic lattice that fills a box has a solid fraction of pi / 6 in each layer.
TEST(Questions, AProfileHasTheSolidFraction) {
    Bed bed;
    const AnswerTable box = profile_answer(bed.snapshot, "height").tables[0];
    for (std::size_t k = 0; k < 4; ++k)
        EXPECT_NEAR(number(cell_of(box, k, "solid_fraction")), std::numbers::pi / 6, 1e-12);
    EXPECT_EQ(box.columns[box.columns.size() - 2].unit, "m3");
    // The same fraction is found in a wedge and in a cylinder, with their volumes between the heights k d and
    // (k + 1) d.
    Container& c = bed.scene.container;
    const double layer = 16 * std::numbers::pi / 6 * d * d * d;
    c.shape = Container::Shape::wedge;
    c.half_width = 0.02, c.half_angle = 0.5, c.slant_height = 0.01;
    const AnswerTable wedge = profile_answer(bed.snapshot, "height").tables[0];
    const auto width = [&](double z) { return 2 * (0.02 - std::max(0.0, 0.01 - z) * std::tan(0.5)); };
    for (std::size_t k = 0; k < 4; ++k) {
        const double low = static_cast<double>(k) * d, high = low + d, edge = std::clamp(0.01, low, high);
        const double across = 0.5 * (width(low) + width(edge)) * (edge - low) + width(high) * (high - edge);
        EXPECT_NEAR(number(cell_of(wedge, k, "solid_fraction")), layer / (c.depth * across), 1e-12) << k;
    }
    c.shape = Container::Shape::cylinder;
    const AnswerTable round = profile_answer(bed.snapshot, "z").tables[0];
    EXPECT_NEAR(number(cell_of(round, 2, "solid_fraction")), layer / (std::numbers::pi * 0.02 * 0.02 * d),
                1e-12);
    // Half a layer lies above the rim, and its grains do not count there.
    c.height = 3.5 * d;
    const AnswerTable open = profile_answer(bed.snapshot, "height").tables[0];
    EXPECT_NEAR(number(cell_of(open, 3, "solid_fraction")), layer / (std::numbers::pi * 0.02 * 0.02 * d),
                1e-12);
    c.shape = Container::Shape::none;
    EXPECT_THROW(cell_of(profile_answer(bed.snapshot, "height").tables[0], 0, "solid_fraction"), UserError);
}

// A grain that is half a diameter up lies half in each of two bins. If the floor moves, heights are above it.
TEST(Questions, TheSolidFractionCutsGrainsAtTheEdges) {
    Bed bed;
    State& frame = bed.snapshot.frame;
    frame = State();
    frame.id = {0}, frame.species = {0}, frame.radius = {d / 2};
    frame.position = {Vec3(0, 0, d)}, frame.velocity = frame.spin = {Vec3(0, 0, 0)};
    const double half = std::numbers::pi / 12 * d * d * d, room = 0.016 * 0.016 * d;
    const AnswerTable table = profile_answer(bed.snapshot, "height").tables[0];
    ASSERT_EQ(table.rows.size(), 2u);
    for (std::size_t k = 0; k < 2; ++k)
        EXPECT_NEAR(number(cell_of(table, k, "solid_fraction")), half / room, 1e-12);
    frame.floor().place = Vec3(0, 0, d / 2);
    EXPECT_NEAR(number(cell_of(profile_answer(bed.snapshot, "height").tables[0], 0, "solid_fraction")),
                2 * half / room, 1e-12);
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

// The plane is half a radius above the centres of the lowest layer.
TEST(Questions, ASliceHasTheCirclesOfALayer) {
    const Bed bed;
    const Answer answer = slice_answer(bed.snapshot, "z = 3 mm", 100);
    ASSERT_EQ(answer.tables[1].rows.size(), 16u);
    EXPECT_EQ(number(answer.tables[0].rows[0][1]), 16);
    EXPECT_NEAR(number(answer.tables[1].rows[7][6]), std::sqrt(3) / 2 * d / 2, 1e-15);
    EXPECT_EQ(slice_answer(bed.snapshot, "y=0", 100).tables[1].rows.size(),
              0u);  // between two rows that touch it
    EXPECT_THROW(slice_answer(bed.snapshot, "w=0", 100), UserError);
    EXPECT_THROW(slice_answer(bed.snapshot, "y = 2 s", 100), UserError);
}

// A cubic lattice of spacing d has partners at d (6), d sqrt 2 (12), d sqrt 3 (8), 2 d (6) ..., and none
// between.
TEST(Questions, ThePairDistributionOfALatticeHasItsShells) {
    Bed bed;
    State& frame = bed.snapshot.frame;
    frame = State();
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
    const double density = std::pow(side, 3) / std::pow((side - 1) * d, 3);  // in the box around the centres
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

// The contacts are those of contacts.nc.
TEST(Questions, WallsOfAKeptMomentHaveTheirContacts) {
    Bed bed;
    bed.snapshot.contacts = true;
    bed.snapshot.touches = {{5, 21, 0.5}, {5, -1, 0.25}, {6, -1, 1}, {7, -3, 2}};
    for (const AnswerTable& table : overview_of(bed.snapshot).tables) {
        if (table.name == "moment") {
            EXPECT_EQ(number(cell_of(table, 0, "contacts")), 4);
        }
        if (table.name != "walls") continue;
        EXPECT_EQ(number(cell_of(table, 0, "contacts")), 2);
        EXPECT_EQ(number(cell_of(table, 0, "normal_force")), 1.25);
        EXPECT_EQ(number(cell_of(table, 1, "contacts")), 0);
        EXPECT_EQ(number(cell_of(table, 2, "normal_force")), 2);
        EXPECT_TRUE(std::holds_alternative<std::monostate>(cell_of(table, 0, "force_z")));
    }
}

TEST(Questions, AGrainTellsItsContacts) {
    Bed bed;
    bed.snapshot.contacts = true;
    bed.snapshot.touches = {{5, 21, 0.5}, {5, -1, 0.25}, {6, 7, 1}};
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
    EXPECT_THAT(late.err, tells({"--at", "9 s", "outside the run"}));
    const Ended timeless = run_program({"inspect", "run/final.csv", "--at", "9s"}, {.folder = folder.path()});
    EXPECT_EQ(timeless.status, 2);
    EXPECT_THAT(timeless.err, tells({"--at", "run/final.csv", "not known"}));
    const Ended before =
        run_program({"inspect", "run", "--film-time=-1s", "--png", "no.png"}, {.folder = folder.path()});
    EXPECT_EQ(before.status, 2);
    EXPECT_THAT(before.err, tells({"--film-time", "at least 0 s"}));
    EXPECT_EQ(run_program({"inspect", "run", "--grain", "7"}, {.folder = folder.path()}).status, 2);
    EXPECT_EQ(run_program({"inspect", "nowhere"}, {.folder = folder.path()}).status, 2);
}

// By hand, (1 * 4 + 3 * 8) / 4 = 7; a row that one of two moments lacks counts as 0 there.
TEST(MeanAnswer, WeighsMeansAndHalvesWhatIsThereHalfTheTime) {
    const auto moment = [](std::vector<std::vector<AnswerCell>> rows) {
        const AnswerTable table{"bins",
                                "Bins",
                                {{"from", Dimension::length, "", AnswerColumn::kKey},
                                 {"grains", Dimension::number},
                                 {"speed", Dimension::speed, "", "grains"}},
                                std::move(rows),
                                true};
        return Answer{{table, {"list", "A list", {{"id", Dimension::number}}, {{AnswerCell(1.0)}}}}, {}};
    };
    MeanAnswer mean(10);
    mean.add(moment({{0.0, std::int64_t{1}, 4.0}, {0.1, std::int64_t{2}, 5.0}}), 1);
    mean.add(moment({{0.0, std::int64_t{3}, 8.0}}), 2);
    const Answer answer = mean.mean();
    ASSERT_EQ(answer.tables.size(), 1u);
    const auto& rows = answer.tables[0].rows;
    ASSERT_EQ(rows.size(), 2u);
    EXPECT_EQ(rows[0], (std::vector<AnswerCell>{0.0, 2.0, 7.0}));
    EXPECT_EQ(rows[1], (std::vector<AnswerCell>{0.1, 1.0, 5.0}));
}

// Words keep their order. A value that a moment lacks does not count, and a value that no moment has stays
// empty. Lists give the largest values of all moments with their times.
TEST(MeanAnswer, KeepsOrderAndTheLargestOfAllMoments) {
    const auto moment = [](std::vector<std::vector<AnswerCell>> rows, double most) {
        AnswerTable list{"list", "A list", {{"size", Dimension::length}}, {{most}, {most / 2}}};
        list.most_of = "size";
        const AnswerTable table{"walls",
                                "Walls",
                                {{"wall", Dimension::number, "", AnswerColumn::kKey},
                                 {"value", Dimension::number, "", AnswerColumn::kThere},
                                 {"force", Dimension::force}},
                                std::move(rows),
                                true};
        return Answer{{table, list}, {}};
    };
    const AnswerCell none;
    MeanAnswer mean(2);
    mean.add(moment({{"slant", 1.0, none}, {"back", none, none}}, 8), 0.5);
    mean.add(moment({{"slant", 4.0, none}, {"back", 6.0, none}}, 6), 0.75);
    const Answer answer = mean.mean();
    ASSERT_EQ(answer.tables.size(), 2u);
    EXPECT_EQ(answer.tables[0].rows[0], (std::vector<AnswerCell>{"slant", 2.5, none}));
    EXPECT_EQ(answer.tables[0].rows[1], (std::vector<AnswerCell>{"back", 6.0, none}));
    EXPECT_EQ(answer.tables[1].rows, (std::vector<std::vector<AnswerCell>>{{8.0, 0.5}, {6.0, 0.75}}));
}

// A run of fifty grains with a film, in the folder run/.
class InspectedMoment : public testing::Test {
  protected:
    void SetUp() override {
        write_small_scene(folder.path());
        const Ended run = run_program({"movie", "fifty.toml", "--out", "run", "--duration", "0.12 s", "--set",
                                       "start.settle_limit=0.02 s", "--set", "run.contact_corrections=false"},
                                      {.folder = folder.path()});
        ASSERT_EQ(run.status, 0) << run.err;
    }
    Ended inspect(std::vector<std::string> words) const {
        words.insert(words.begin(), {"inspect", "run"});
        return run_program(words, {.folder = folder.path()});
    }
    nlohmann::json answer(std::vector<std::string> words) const {
        words.push_back("--json");
        const Ended ended = inspect(words);
        EXPECT_EQ(ended.status, 0) << ended.err;
        return nlohmann::json::parse(ended.out);
    }
    std::string refusal(const std::vector<std::string>& words) const {
        const Ended ended = inspect(words);
        EXPECT_EQ(ended.status, 2) << ended.out;
        EXPECT_EQ(ended.out, "");
        return ended.err;
    }

    TemporaryFolder folder;
};

// Newton's second law is checked for each grain, at a moment that the run did not keep.
TEST_F(InspectedMoment, TheForcesOnAGrainAddUpToItsAcceleration) {
    for (const char* id : {"0", "17", "45"}) {
        const auto told = answer({"--at", "0.0731 s", "--grain", id})["tables"];
        const auto& rows = told["forces"]["rows"];
        ASSERT_EQ(rows.size(), 4u);
        const double scale = std::max(rows[0][4].get<double>(), rows[1][4].get<double>());
        for (int axis = 1; axis <= 3; ++axis) {
            const auto at = [&](int row) { return rows[row][axis].get<double>(); };
            EXPECT_NEAR(at(2), at(0) + at(1), 1e-12 * scale);
            EXPECT_NEAR(at(3), at(2), 1e-6 * scale) << id;
        }
        EXPECT_EQ(told["grain"]["rows"].size(), 1u);
    }
}

TEST_F(InspectedMoment, AWallTellsWhoTouchesIt) {
    const auto told = answer({"--at", "0.1 s", "--wall", "floor", "--limit", "1000"})["tables"];
    const auto& sum = told["wall"]["rows"][0];
    double normal = 0;
    for (const auto& one : told["touching"]["rows"]) normal += one[4].get<double>();
    EXPECT_EQ(told["touching"]["rows"].size(), sum[0].get<std::size_t>());
    EXPECT_NEAR(normal, sum[4].get<double>(), 1e-9 * normal);
    EXPECT_NEAR(-sum[3].get<double>(), normal,
                1e-9 * normal);  // the floor is level, and friction acts along it
    // The pressure on a wall at rest is its force divided by width and height of a bin.
    int bins = 0;
    for (const auto& [name, width] : std::map<std::string, double>{
             {"left wall", 0.02}, {"right wall", 0.02}, {"front", 0.03}, {"back", 0.03}}) {
        const auto side = answer({"--at", "0.05 s", "--wall", name})["tables"];
        if (!side.contains("by_height")) continue;  // nothing touches this wall
        for (const auto& bin : side["by_height"]["rows"]) {
            const double area = width * (std::min(bin[1].get<double>(), 0.040) - bin[0].get<double>());
            EXPECT_NEAR(bin[4].get<double>(), bin[3].get<double>() / area, 1e-9 * bin[4].get<double>());
            ++bins;
        }
    }
    EXPECT_GT(bins, 0);
    EXPECT_TRUE(told["by_height"]["rows"][0][4].is_null());
    EXPECT_THAT(refusal({"--bins", "5"}), HasSubstr("--bins requires --histogram"));
    EXPECT_THAT(refusal({"--wall", "roof"}), tells({"--wall", "'roof'", "no wall", "floor"}));
}

TEST_F(InspectedMoment, AFrameOfTheFilmHasTheMomentOfItsPicture) {
    const auto moment = [&](const std::string& frame) {
        return answer({"--frame", frame})["tables"]["moment"]["rows"][0][0].get<double>();
    };
    EXPECT_NEAR(moment("0"), 0, 1e-12);
    EXPECT_NEAR(moment("5"), 5 * 0.5 / 30, 1e-4);  // playback divided by rate, to the nearest step
    EXPECT_THAT(refusal({"--frame", "1000"}), tells({"--frame", "frames 0 to"}));
    std::filesystem::remove(folder / "run/film_moments.nc");
    EXPECT_THAT(refusal({"--frame", "1"}), HasSubstr("has no film_moments.nc"));
}

TEST_F(InspectedMoment, WhatCannotComeBackIsToldInOneLine) {
    const auto kept = answer({"--at", "0.0731 s", "--no-replay"});
    EXPECT_THAT(kept["notes"].dump(), tells({" s was not kept", "nearest kept moment"}));
    EXPECT_THAT(refusal({"--at", "0.2 s"}), tells({"--at", "0.2 s", "outside the run", "0 to 0.12"}));
    EXPECT_THAT(refusal({"--no-replay", "--wall", "floor"}), HasSubstr("--no-replay: forces on walls"));
    std::filesystem::remove_all(folder / "run/checkpoints");
    EXPECT_THAT(refusal({"--at", "0.0731 s"}), HasSubstr("has no checkpoint of 0.0731"));
    std::filesystem::remove(folder / "run/checkpoint.grs");
    EXPECT_THAT(refusal({"--at", "0.0731 s"}), HasSubstr("has no checkpoints"));
    EXPECT_EQ(answer({"--grain", "3"})["tables"].contains("forces"), false);
}

// At each moment of a whole period every grain is in some bin, so the mean over bins, weighted by grains, is
// the mean over all grains.
TEST_F(InspectedMoment, TheMeanOverAPeriodHasAllGrainsAndTheirMeanSpeed) {
    const auto told = answer({"--at", "0.1 s", "--average", "1", "--profile", "height"})["tables"];
    double grains = 0, speed = 0, expected = 0;
    for (const auto& row : told["profile"]["rows"]) {
        grains += row[2].get<double>();
        if (!row[3].is_null()) speed += row[2].get<double>() * row[3].get<double>();
    }
    EXPECT_NEAR(grains, 50, 1e-9);
    for (int k = 0; k < 20; ++k) {  // the period of 20 Hz in steps of 2.5 ms
        const std::string at = fmt::format("{} s", 0.1 - 0.0025 * k);
        const auto all = answer({"--at", at, "--where", "speed >= 0"})["tables"]["statistics"]["rows"];
        for (const auto& row : all)
            if (row[0] == "speed") expected += row[1].get<double>() / 20;
    }
    EXPECT_NEAR(speed / 50, expected, 1e-9 * expected);
    EXPECT_THAT(refusal({"--at", "0.1 s", "--average", "3", "--profile", "height"}),
                tells({"--average", "3 periods", "before 0.1 s", "first moment"}));
    EXPECT_THAT(refusal({"--average", "1", "--compare", "0.05 s"}),
                HasSubstr("--average: --compare is between"));
    EXPECT_THAT(refusal({"--average", "1", "--pixel", "9,9"}),
                tells({"--average", "--pixel", "one picture"}));
}

// The mean of each answer is the mean of the answers.
TEST_F(InspectedMoment, EveryAnswerHasItsMean) {
    double grains = 0, height = 0, floor = 0, largest = 0, touching = 0;
    for (int k = 0; k < 5; ++k) {  // a quarter of a period of 20 Hz, in steps of 2.5 ms
        const std::string at = fmt::format("{} s", 0.1 - 0.0025 * k);
        const auto overlaps = answer({"--at", at, "--largest-overlap", "--limit", "1"})["tables"];
        touching += overlaps["touching"]["rows"][0][0].get<double>() / 5;
        for (const auto& row : overlaps["overlaps"]["rows"])
            largest = std::max(largest, row[4].get<double>());
        height += answer({"--at", at, "--grain", "3"})["tables"]["grain"]["rows"][0][5].get<double>() / 5;
    }
    const auto mean = [&](std::vector<std::string> words) {
        words.insert(words.end(), {"--at", "0.1 s", "--average", "0.25"});
        return answer(words)["tables"];
    };
    const auto overlaps = mean({"--largest-overlap", "--limit", "3"});
    EXPECT_NEAR(overlaps["touching"]["rows"][0][0].get<double>(), touching, 1e-9 * touching);
    EXPECT_DOUBLE_EQ(overlaps["touching"]["rows"][0][4].get<double>(),
                     0.1);  // run.overlap is 0.05 of the diameter
    ASSERT_EQ(overlaps["overlaps"]["rows"].size(), 3u);
    EXPECT_EQ(overlaps["overlaps"]["rows"][0][4], largest);
    EXPECT_EQ(overlaps["overlaps"]["columns"][8]["name"], "time");
    const auto all = mean({}), histogram = mean({"--histogram", "speed"}), grain = mean({"--grain", "3"});
    for (const auto& row : all["species"]["rows"]) grains += row[1].get<double>();
    EXPECT_EQ(grains, 50);
    for (const auto& row : all["walls"]["rows"])
        if (row[0] == "floor") floor = row[5].get<double>();
    EXPECT_NEAR(floor, mean({"--wall", "floor"})["wall"]["rows"][0][4].get<double>(), 1e-12);
    double counted = 0;
    for (const auto& row : histogram["histogram"]["rows"])
        counted += row[2].get<double>() + row[3].get<double>();
    EXPECT_NEAR(counted, 50, 1e-9);
    EXPECT_EQ(grain["grain"]["columns"][5]["name"], "height");
    EXPECT_NEAR(grain["grain"]["rows"][0][5].get<double>(), height, 1e-9 * height);
    EXPECT_EQ(mean({"--slice", "z=2 mm"})["areas"]["rows"].size(), 2u);
}

// Grains that touch and grains that push are counted separately, and all answers have the same counts.
TEST_F(InspectedMoment, ContactsAreCountedOneWay) {
    const auto at = [&](std::vector<std::string> words) {
        words.insert(words.end(), {"--at", "0.0731 s"});
        return answer(words)["tables"];
    };
    const auto overview = at({}), overlaps = at({"--largest-overlap", "--limit", "1000"});
    const auto pairs = overlaps["overlaps"]["rows"];
    std::int64_t pushing = 0, on_walls = 0;
    for (const auto& row : pairs)
        pushing += row[6].get<double>() > 0, on_walls += row[2].is_null() && row[6] > 0;
    EXPECT_EQ(overlaps["touching"]["rows"][0][0], pairs.size());
    EXPECT_EQ(overlaps["touching"]["rows"][0][1], pushing);
    EXPECT_EQ(overview["moment"]["rows"][0][5], pushing);
    EXPECT_EQ(overview["moment"]["rows"][0][6], pairs.size());
    std::int64_t walls = 0;
    for (const auto& row : overview["walls"]["rows"]) walls += row[1].get<std::int64_t>();
    EXPECT_EQ(walls, on_walls);
}

TEST_F(InspectedMoment, WhatSaysHowAPictureIsDrawnNeedsOne) {
    EXPECT_THAT(refusal({"--set", "film.size=320x180"}), HasSubstr("add --png or --pixel"));
    EXPECT_THAT(refusal({"--film-time", "1 s"}), tells({"--film-time", "what a picture shows"}));
}

// Figures of the whole run: the mean by period of a column, and what is refused by name. 0.12 s are 2.4
// periods.
TEST_F(InspectedMoment, ColumnsOfTheWholeRunHaveMeans) {
    const auto table = answer({"--measure", "kinetic_J", "--by", "period"})["tables"]["by_period"];
    ASSERT_EQ(table["rows"].size(), 3u);
    EXPECT_EQ(table["rows"][2][0], 2);
    EXPECT_NEAR(table["rows"][2][1].get<double>(), 0.1, 1e-12);
    const auto mean =
        answer({"--measure", "kinetic_J,time_s", "--window", "0.05s..0.1s"})["tables"]["mean"]["rows"];
    ASSERT_EQ(mean.size(), 2u);
    EXPECT_NEAR(mean[1][2].get<double>(), 0.075, 0.002);
    const auto slope = answer({"--measure", "time_s", "--slope", "..0.1s"})["tables"]["slope"]["rows"][0];
    EXPECT_NEAR(slope[2].get<double>(), 1, 1e-9) << "time passes one second a second";
    EXPECT_THAT(answer({"--parameters"})["tables"]["parameters"]["rows"].dump(),
                tells({"[\"packing.settled\",\"0.", "run.step"}));
    EXPECT_THAT(refusal({"--window", "0s..1s"}), tells({"--window", "add --measure"}));
    EXPECT_THAT(refusal({"--measure", "kinetic"}), tells({"--measure", "'kinetic'"}));
    EXPECT_THAT(refusal({"--measure", "kinetic_J", "--window", "3s..4s"}), tells({"--measure", "no row"}));
    EXPECT_THAT(refusal({"--measure", "kinetic_J", "--slope", "1s"}), tells({"--slope", "two times"}));
    EXPECT_THAT(refusal({"--measure", "kinetic_J", "--at", "0.1 s"}), tells({"--measure", "whole run"}));
    EXPECT_THAT(refusal({"--discharge"}), tells({"--discharge", "outlet"}));
    const std::string of_mean = refusal({"--where", "id > 0", "--over-time", "--mean", "sped"});
    EXPECT_THAT(of_mean, tells({"--mean", "'sped'", "no quantity"}));
    EXPECT_EQ(of_mean.find("--where"), std::string::npos) << of_mean;
    EXPECT_THAT(refusal({"--fields", "rz"}), tells({"--fields", "fields.nc"}));
}

// A CSV table has no room for words, so they are printed to stderr.
TEST_F(InspectedMoment, ACsvHasItsMomentAndNotesBesideIt) {
    const Ended ended = inspect({"--at", "0.0731 s", "--no-replay", "--where", "id < 3", "--csv"});
    EXPECT_THAT(ended.out, testing::StartsWith("species,grains,of,share\n"));
    EXPECT_THAT(ended.err, HasSubstr("): kept as number "));
    EXPECT_THAT(ended.err, tells({" s was not kept", "nearest kept moment"}));
}

// A checkpoint alone has everything that the run has at that moment, and a table of grains has what its
// columns say.
TEST_F(InspectedMoment, AStateAloneAnswersToo) {
    const auto alone = [&](const std::string& file, std::vector<std::string> words) {
        words.insert(words.begin(), {"inspect", file, "--json"});
        const Ended ended = run_program(words, {.folder = folder.path()});
        EXPECT_EQ(ended.status, 0) << ended.err;
        return nlohmann::json::parse(ended.out)["tables"];
    };
    std::filesystem::create_directory(folder / "alone");
    for (const char* file : {"checkpoint.grs", "final.csv"})
        std::filesystem::copy(folder / "run" / file, folder / "alone" / file);
    const auto of_run = answer({"--at", "0.12 s", "--grain", "17"})["tables"];
    EXPECT_EQ(alone("alone/checkpoint.grs", {"--grain", "17"})["forces"], of_run["forces"]);
    const auto spread = [](const auto& tables, const char* column) {
        for (const auto& row : tables["statistics"]["rows"])
            if (row[0] == column) return row[1];
        return nlohmann::json();
    };
    const auto run_all = answer({"--at", "0.12 s", "--where", "id >= 0"})["tables"];
    const auto table_all = alone("alone/final.csv", {"--where", "id >= 0"});
    for (const char* column : {"z", "vz", "spin", "diameter"})
        EXPECT_EQ(spread(table_all, column), spread(run_all, column)) << column;
    EXPECT_TRUE(spread(table_all, "mass").is_null());  // a table has no densities
    EXPECT_EQ(table_all["count"]["rows"][1][0], "type 2");
    EXPECT_EQ(alone("run/final.csv", {"--where", "species == big"})["count"]["rows"][1][1], 10);
}

TEST_F(InspectedMoment, AFileThatIsNoStateIsToldInOneLine) {
    const auto refused = [&](const std::string& file, std::vector<std::string> words = {}) {
        words.insert(words.begin(), {"inspect", file});
        const Ended ended = run_program(words, {.folder = folder.path()});
        EXPECT_EQ(ended.status, 2) << ended.out;
        return ended.err;
    };
    EXPECT_THAT(refused("run/log.txt"),
                tells({"no frames", "read", "scene.toml and trajectory.nc", "trajectory.nc of a run"}));
    EXPECT_THAT(refused("run/final.csv", {"--wall", "floor"}), HasSubstr("has no checkpoints"));
    std::filesystem::resize_file(folder / "run/checkpoint.grs", 3000);
    EXPECT_THAT(refused("run/checkpoint.grs"), HasSubstr("checkpoint"));
}

// 0.12 s is no multiple of the interval at which moments are kept.
TEST_F(InspectedMoment, WithoutAMomentItIsTheEndOfTheRun) {
    const Ended run =
        run_program({"movie", "fifty.toml", "--out", "sparse", "--duration", "0.12 s", "--no-film", "--set",
                     "start.settle_limit=0.02 s", "--set", "output.trajectory_interval=0.05 s"},
                    {.folder = folder.path()});
    ASSERT_EQ(run.status, 0) << run.err;
    const auto told = [&](std::vector<std::string> words) {
        words.insert(words.begin(), {"inspect", "sparse", "--json"});
        const Ended ended = run_program(words, {.folder = folder.path()});
        EXPECT_EQ(ended.status, 0) << ended.err;
        return nlohmann::json::parse(ended.out);
    };
    for (const char* question : {"speed > 0 m/s", "contacts > 0"}) {
        const auto last = told({"--where", question})["moment"];
        EXPECT_NEAR(last["time"].get<double>(), 0.12, 1e-4);
        EXPECT_EQ(last["how"], "the run's last moment, brought back");
    }
    const auto kept = told({"--no-replay"});
    EXPECT_NEAR(kept["moment"]["time"].get<double>(), 0.1, 1e-4);
    EXPECT_THAT(kept["notes"].dump(), HasSubstr(" s was not kept"));
    const Ended text = run_program({"inspect", "sparse", "--at", "0.05 s"}, {.folder = folder.path()});
    EXPECT_THAT(text.out, testing::MatchesRegex("At 0.05.* s \\(step [0-9]+\\): kept as number 2 of 3\n.*"));
}

TEST_F(InspectedMoment, OverlapsHaveOneConvention) {
    const auto largest = answer({"--largest-overlap"})["tables"]["overlaps"]["rows"][0][5].get<double>();
    double measured = 0, of_grains = 0;
    const auto overview = answer({})["tables"], where = answer({"--where", "largest_overlap > 0"})["tables"];
    for (const auto& row : overview["measured"]["rows"])
        if (row[0] == "largest_overlap") measured = row[1].get<double>();
    for (const auto& row : where["statistics"]["rows"])
        if (row[0] == "largest_overlap") of_grains = row[4].get<double>();
    EXPECT_GT(largest, 0);
    EXPECT_DOUBLE_EQ(largest, measured);
    EXPECT_DOUBLE_EQ(largest, of_grains);
}

// The container is at the same place a period of 20 Hz earlier.
TEST_F(InspectedMoment, AskedForWaysOverAPeriodTheMomentBeforeComesBackToo) {
    const auto list = [&](std::vector<std::string> words) {
        words.insert(words.end(), {"--limit", "100"});
        std::map<int, double> heights;
        const auto told = answer(words)["tables"];
        for (const auto& row : told["grains"]["rows"]) heights[row[0].get<int>()] = row[4].get<double>();
        return heights;
    };
    const auto now = list({"--at", "0.11 s", "--where", "id >= 0"});
    const auto before = list({"--at", "0.06 s", "--where", "id >= 0"});
    std::vector<double> rises;
    for (const auto& [id, height] : now) rises.push_back(height - before.at(id));
    std::sort(rises.begin(), rises.end());
    const double limit = 0.5 * (rises[24] + rises[25]);  // of 50 grains
    const auto risen = list({"--at", "0.11 s", "--where", fmt::format("period_rise > {:.17g} m", limit)});
    EXPECT_EQ(risen.size(), 25u);
    for (const auto& [id, height] : now) EXPECT_EQ(risen.count(id), height - before.at(id) > limit) << id;
    EXPECT_THAT(refusal({"--at", "0.01 s", "--where", "period_rise > 0 mm"}),
                tells({"run", "not reach back"}));
    EXPECT_THAT(refusal({"--at", "0.1 s", "--no-replay", "--where", "fx > 0 N"}),
                tells({"'fx'", "only", "brought back"}));
}

// Each dimension has the same unit in all tables of an answer.
TEST_F(InspectedMoment, LengthsHaveOneUnit) {
    const auto touching = answer({"--wall", "floor", "--at", "0.1 s"})["tables"]["touching"]["rows"];
    const std::string id = std::to_string(touching[0][0].get<int>());
    const std::string text = inspect({"--grain", id, "--at", "0.1 s"}).out;
    for (const char* name : {"x", "y", "z", "height", "radius", "diameter", "moved", "wall_gap"})
        EXPECT_THAT(text, testing::ContainsRegex(fmt::format("\n  {} +-?[0-9.e-]+ mm ", name)));
    // A single contact is told in lines, several in a table.
    EXPECT_THAT(text, testing::ContainsRegex("overlap +(\\(mm\\)|[0-9.e-]+ mm)"));
    const std::string where = inspect({"--where", "id >= 0", "--at", "0.0731 s"}).out;
    for (const char* name : {"height (mm)", "diameter (mm)", "moved (mm)", "mass (mg)"})
        EXPECT_THAT(where, HasSubstr(fmt::format("\n  {} ", name)));
}

// A question about a wall can have a picture, and so can a question about a grain of a kept moment.
TEST_F(InspectedMoment, AWallHasItsPictureToo) {
    EXPECT_EQ(inspect({"--wall", "floor", "--at", "0.05 s", "--png", "floor.png"}).status, 0);
    EXPECT_TRUE(std::filesystem::exists(folder / "floor.png"));
    EXPECT_EQ(inspect({"--grain", "3", "--no-replay", "--png", "kept.png"}).status, 0);
    EXPECT_TRUE(std::filesystem::exists(folder / "kept.png"));
}

TEST_F(InspectedMoment, ThePictureIsDrawnOnce) {
    EXPECT_EQ(inspect({"--grain", "12", "--png", "grain.png"}).status, 0);
    EXPECT_TRUE(std::filesystem::exists(folder / "grain.png"));
    EXPECT_THAT(refusal({"--grain", "12", "--png", "grain.png"}),
                HasSubstr("--png grain.png: exists already"));
    EXPECT_THAT(refusal({"--grain", "12", "--png", "grain.jpg"}), HasSubstr("ends in .png"));
    EXPECT_THAT(refusal({"--grain", "12", "--png", ""}), HasSubstr("--png: is empty"));
}

}  // namespace
}  // namespace grainreel
