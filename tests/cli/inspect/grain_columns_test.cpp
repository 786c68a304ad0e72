// Tests of the quantities of a grain, each against a formula or against the film's value for the same grain.
#include "engine/questions/expressions/grain_columns.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "engine/base/error.hpp"
#include "engine/questions/contact_questions.hpp"
#include "engine/questions/questions.hpp"
#include "engine/questions/snapshot.hpp"
#include "render/film/answers/pictured_answer.hpp"
#include "render/picture/grains/shown_grains.hpp"
#include "render/scene/filmed_scene.hpp"
#include "render/scene/shown_values.hpp"
#include "tests/support/small_scene.hpp"
#include "tests/support/tells.hpp"

namespace grainreel {
namespace {

using test::tells;
using testing::HasSubstr;

constexpr double d = 0.004, r = d / 2;  // m

// A cube of 5 x 5 x 5 grains that touch, in a box as wide as the cube. Layer k rises at k cm/s. Grain 62, in
// the middle, is of the other species.
struct Cube {
    FilmedScene scene = read_filmed_scene_text(test::SmallScene()
                                                   .beads(124, "small", "4 mm", "2.5 g/cm3")
                                                   .beads(1, "other", "4 mm", "2.5 g/cm3")
                                                   .box("20 mm", "20 mm", "60 mm")
                                                   .shaken("20 Hz", "2")
                                                   .lasts("1 s")
                                                   .text(),
                                               "cube.toml");
    Snapshot snapshot{scene, grains(), true, grains()};

    static State grains() {
        State frame;
        for (int i = 0; i < 125; ++i) {
            const int layer = i / 25;
            frame.id.push_back(i);
            frame.species.push_back(i == 62);
            frame.radius.push_back(r);
            frame.position.push_back(d * Vec3(i % 5 - 2, i / 5 % 5 - 2, layer + 0.5));
            frame.velocity.emplace_back(0, 0, 0.01 * layer);
            frame.spin.emplace_back(3, 4, 0);
        }
        return frame;
    }
    std::vector<double> column(const std::string& name) const {
        return values_of(snapshot, GrainVocabulary(snapshot).find(name)->column);
    }
    double of(const std::string& name, std::size_t grain) const {
        const int number = GrainVocabulary(snapshot).find(name)->column;
        const double alone = values_of(snapshot, number, {grain}).front();
        EXPECT_NEAR(alone, values_of(snapshot, number)[grain], 1e-12 * (1 + std::abs(alone))) << name;
        return alone;
    }
};

// Grain 31 is inside the second layer, 62 is the middle of the cube, and 0 is a corner at the floor.
TEST(GrainColumns, SayHowAGrainLiesInTheBed) {
    const Cube cube;
    EXPECT_EQ(cube.of("neighbours", 62), 6);
    EXPECT_EQ(cube.of("neighbours", 0), 3);
    EXPECT_EQ(cube.of("unlike_share", 62), 1);
    EXPECT_NEAR(cube.of("unlike_share", 61), 1.0 / 6, 1e-12);
    EXPECT_EQ(cube.of("unlike_share", 0), 0);
    EXPECT_NEAR(cube.of("wall_gap", 62), 2 * d, 1e-12);
    EXPECT_NEAR(cube.of("wall_gap", 12), 0, 1e-12);  // on the floor, in the middle of it
    EXPECT_NEAR(cube.of("side_gap", 12), 2 * d, 1e-12);
    EXPECT_NEAR(cube.of("side_gap", 10), 2 * d, 1e-12);  // at the back, which is no side
    EXPECT_NEAR(cube.of("side_gap", 2), 0, 1e-12);
    EXPECT_NEAR(cube.of("depth", 62), 2.5 * d, 1e-12);  // the surface is the top of the fifth layer
    EXPECT_NEAR(cube.of("r", 0), std::sqrt(8) * d, 1e-12);
    EXPECT_NEAR(cube.of("fluctuation", 62), 0, 1e-12);         // as many below as above
    EXPECT_NEAR(cube.of("fluctuation", 12), 0.01 / 6, 1e-12);  // five at rest, one at 1 cm/s
    EXPECT_NEAR(cube.of("rotational_energy", 0), 0.5 * 0.4 * cube.of("mass", 0) * r * r * 25, 1e-20);
    EXPECT_NEAR(cube.of("potential_energy", 62), cube.of("mass", 0) * 9.81 * 2.5 * d, 1e-15);
}

TEST(GrainColumns, SideGapsFollowAContainerThatMoves) {
    Cube cube;
    cube.snapshot.frame.container().place = Vec3(0, 0.001, 0);
    EXPECT_NEAR(cube.of("side_gap", 2), -0.001, 1e-12);  // at the left, y = -2 d
}

DetailedContact push(std::int32_t first, std::int32_t second, const Vec3& normal, double force,
                     const Vec3& tangential, double overlap) {
    return {first,        second,       normal, overlap,   force, tangential,
            {1e-6, 0, 0}, {0, 1e-6, 0}, 0.5,    {0, 0, 0}, r,     2e-7};
}

// Grain 62 is pressed from above and below by 2 N, and a wall pushes it by 1 N along x.
struct Squeezed : Cube {
    Squeezed() {
        snapshot.forces.emplace();
        snapshot.forces->contacts = {push(37, 62, Vec3::UnitZ(), 2, {0, 0.5, 0}, 1e-5),
                                     push(62, 87, Vec3::UnitZ(), 2, {0, 1, 0}, 2e-5),
                                     push(62, -4, -Vec3::UnitX(), 1, {0, 0, 0}, 0)};
        snapshot.touches = {{37, 62, 2}, {62, 87, 2}, {62, -4, 1}};
    }
};

TEST(GrainColumns, SayWhatContactsDo) {
    const Squeezed cube;
    EXPECT_EQ(cube.of("contacts", 62), 3);
    EXPECT_EQ(cube.of("coordination", 87), 1);
    EXPECT_EQ(cube.of("contact_force", 62), 5);
    EXPECT_NEAR(cube.of("fx", 62), 1, 1e-12);
    EXPECT_NEAR(cube.of("fy", 62), 0.5 - 1, 1e-12);
    EXPECT_NEAR(cube.of("fz", 62), 0, 1e-12);
    EXPECT_NEAR(cube.of("force", 62), std::sqrt(1.25), 1e-12);
    EXPECT_NEAR(cube.of("torque", 62), std::sqrt(5) * 1e-6,
                1e-15);  // it is the first body of two contacts and the second of one
    EXPECT_EQ(cube.of("sliding", 62), 1);
    EXPECT_NEAR(cube.of("largest_overlap", 62), 2e-5 / r, 1e-12);
    EXPECT_NEAR(cube.of("elastic_energy", 62), 2e-7 * (0.5 + 0.5 + 1), 1e-18);
    // p = sum(r f) / (3 V)
    const double sum = (r - 0.5e-5) * 2 + (r - 1e-5) * 2 + r * 1;
    EXPECT_NEAR(cube.of("pressure", 62), sum / (4 * std::numbers::pi * r * r * r), 1e-6);
    EXPECT_EQ(cube.of("pressure", 0), 0);
}

TEST(GrainColumns, TellWhatTheyLack) {
    Cube cube;
    const auto mistake = [&](const std::string& text) {
        try {
            grains_where(cube.snapshot, Expression(text, GrainVocabulary(cube.snapshot)));
        } catch (const UserError& error) {
            return std::string(error.what());
        }
        return std::string("none");
    };
    EXPECT_THAT(mistake("pressure > 1 kPa"), tells({"'pressure'", "only", "brought back"}));
    EXPECT_THAT(mistake("period_rise > 1 mm"), tells({"'period_rise'", "one period"}));
    EXPECT_EQ(mistake("contacts == 0"), "none");
    cube.snapshot.contacts = false;
    EXPECT_THAT(mistake("coordination == 0"), HasSubstr("'coordination' needs contacts"));
    EXPECT_EQ(needs_of("pressure > 1 kPa and fx > 0 N or displacement > 1 mm"),
              (std::vector<Needs>{Needs::forces, Needs::period}));
    EXPECT_EQ(needs_of("x > 1 pressures"), std::vector<Needs>{Needs::nothing});
}

// Each quantity that can colour a grain is also a column, with the same numbers.
TEST(GrainColumns, HaveAllColoursOfTheFilm) {
    Squeezed cube;
    State before = cube.snapshot.frame;
    for (Vec3& place : before.position) place -= Vec3(0.001, 0, 0.002);
    cube.snapshot.displacement = displacement_since(before, cube.snapshot.frame, 1, 0);
    Shot shot = cube.snapshot.frame;
    shot.displacement = cube.snapshot.displacement;
    shot.touches = cube.snapshot.touches;
    for (const auto& [colour, value] : grain_value_words) {
        const std::string& word = colour;
        const auto& all = grain_columns();
        const auto column = std::find_if(all.begin(), all.end(),
                                         [&](const GrainColumn& one) { return one.coloured_as == word; });
        ASSERT_NE(column, all.end()) << word;
        if (value == GrainValue::species) continue;
        EXPECT_EQ(column->dimension, dimension_of(value)) << word;
        Quantities colours(cube.scene, value);
        colours.start_from(cube.snapshot.start);
        EXPECT_THAT(cube.column(column->name), testing::Pointwise(testing::DoubleEq(), colours.of(shot)))
            << word;
    }
}

// The arrows of a grain end on its surface, and their sum is the force on the grain.
TEST(AnswerForces, AreThoseOfAllContactsOnTheGrain) {
    const Squeezed cube;
    const AnswerForces answer = forces_on_grain(cube.snapshot, 62);
    ASSERT_EQ(answer.forces.size(), 3u);
    const Vec3 centre = cube.snapshot.frame.position[62];
    EXPECT_LT((answer.forces[0].at - (centre - (r - 0.5e-5) * Vec3::UnitZ())).norm(), 1e-12);
    EXPECT_LT((answer.forces[1].at - (centre + (r - 1e-5) * Vec3::UnitZ())).norm(), 1e-12);
    EXPECT_LT((answer.forces[2].at - (centre - r * Vec3::UnitX())).norm(), 1e-12);  // a wall
    Vec3 sum(0, 0, 0);
    for (const PointForce& one : answer.forces) sum += one.force;
    EXPECT_LT((sum - Vec3(1, -0.5, 0)).norm(), 1e-12);
    EXPECT_EQ(answer.grains, std::vector<std::int32_t>{62});
    EXPECT_THAT(answer.words, HasSubstr("3 contacts\nlongest arrow 2.24\u00a0N"));  // sqrt(2^2 + 1^2)
    const AnswerForces flying = forces_on_grain(cube.snapshot, 0);
    EXPECT_EQ(flying.forces.size(), 0u);
    EXPECT_THAT(flying.words, HasSubstr("nothing touches grain 0"));
    const Cube kept;
    EXPECT_THAT(forces_on_grain(kept.snapshot, 0).words, HasSubstr("are not known"));
}

TEST(AnswerForces, OfAWallAreThoseOnTheWall) {
    const Squeezed cube;
    const std::string name = name_of_body(cube.snapshot, -4);
    const AnswerForces answer = forces_on_wall(cube.snapshot, name);
    ASSERT_EQ(answer.forces.size(), 1u);
    EXPECT_LT((answer.forces[0].force - Vec3(-1, 0, 0)).norm(), 1e-12);
    EXPECT_EQ(answer.grains, std::vector<std::int32_t>{62});
    EXPECT_THAT(answer.words, HasSubstr("forces on " + name + "\n1 contact\n"));
    EXPECT_THAT(forces_on_wall(cube.snapshot, "floor").words, HasSubstr("no grain touches floor"));
    EXPECT_THROW(forces_on_wall(cube.snapshot, "roof"), UserError);
}

TEST(GrainColumns, ThePictureRingsGrainsThatTheListLeavesOut) {
    const Cube cube;
    const Answer answer = where_answer(cube.snapshot, "species == small", 3);
    ASSERT_EQ(answer.tables.back().rows.size(), 3u);
    EXPECT_EQ(grains_in(answer).size(), 124u);
    EXPECT_EQ(grains_in(slice_answer(cube.snapshot, "z = 2 mm", 3)).size(), 25u);
}

}  // namespace
}  // namespace grainreel
