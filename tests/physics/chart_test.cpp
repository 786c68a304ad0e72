// Tests of the experiments and tools with which charts are made.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "engine/base/error.hpp"
#include "engine/lab/chart/accuracy/single_contact.hpp"
#include "engine/lab/chart/chart.hpp"
#include "engine/lab/chart/small_bed.hpp"
#include "tests/support/temporary_folder.hpp"

namespace grainreel {
namespace {

class ResultTableTest : public testing::Test {
  protected:
    std::string text() const { return test::text_of(path); }
    const test::TemporaryFolder folder;
    const std::filesystem::path path = folder / "table.csv";
};

TEST_F(ResultTableTest, GoesOnWhereItStopped) {
    {
        ResultTable table(path, "name,seed,value", 2);
        EXPECT_FALSE(table.has({"a", "1"}));
        table.add({"a", "1", "3.5"});
    }
    std::ofstream(path, std::ios::app) << "a,2,7";  // a kill cut this row short: it has no end of line
    ResultTable table(path, "name,seed,value", 2);
    EXPECT_TRUE(table.has({"a", "1"}));
    EXPECT_FALSE(table.has({"a", "2"}));
    table.add({"a", "2", "4"});
    EXPECT_EQ(text(), "name,seed,value\na,1,3.5\na,2,4\n");
    ASSERT_EQ(table.rows().size(), 2u);
    EXPECT_EQ(table.rows()[0][2], "3.5");
}

TEST_F(ResultTableTest, LeavesAnotherTableAlone) {
    std::ofstream(path) << "something else\n1\n";
    EXPECT_THROW(ResultTable(path, "name,seed,value", 2), UserError);
    EXPECT_EQ(text(), "something else\n1\n");
}

// The table of docs/reference/accuracy.md: plain Verlet at 12 steps a contact.
TEST(Charts, NormalErrorsAreThoseOfSectionSix) {
    const Method verlet{"verlet", Integrator::velocity_verlet, NormalForce::walton_braun,
                        TangentialLaw::incremental_slip};
    EXPECT_NEAR(normal_errors(verlet, 0.9, 12, 200).restitution, 0.0018, 0.00015);
    EXPECT_NEAR(normal_errors(verlet, 0.3, 12, 200).restitution, 0.0082, 0.0007);
    EXPECT_LT(oblique_errors(verlet, 0.9, 400).velocity, oblique_errors(verlet, 0.9, 20).velocity / 10);
    const double drift = bounce_drift(verlet, 100, 100);
    EXPECT_LT(drift, 0.001);
    EXPECT_GT(bounce_drift(verlet, 6, 100), 10 * drift);
    EXPECT_EQ((Method{"", Integrator::forest_ruth}).forces_a_step(), 4);
}

// Standard setting: with corrections the restitution is right for any number of steps, whole or not; plain
// Verlet gives it for whole numbers only.
TEST(Charts, CorrectionsKeepTheRestitutionAtFractionsOfAStepToo) {
    const Method corrected{"corrected", Integrator::velocity_verlet, NormalForce::walton_braun_corrected,
                           TangentialLaw::none};
    for (const double e : {0.1, 0.3, 0.5, 0.7, 0.9, 0.98}) {
        const double steps = std::max(12.0, 9.5 - 8 * std::log(e));
        for (const double more : {0.0, 0.25, 0.5, 0.75}) {
            const double error = normal_errors(corrected, e, steps + more, 50).restitution;
            EXPECT_LT(error, e >= 0.7 ? 0.002 : 0.005) << "e = " << e << ", " << steps + more << " steps";
        }
    }
    const Method plain{"plain", Integrator::velocity_verlet, NormalForce::walton_braun, TangentialLaw::none};
    EXPECT_GT(normal_errors(plain, 0.9, 12.5, 50).restitution, 0.005);
}

// The first force adds (w s)^4 / 4 to the energy of an elastic impact, where s is at most the step. That is
// why the plan leaves corrections out where hardly anything is lost (nearly_elastic).
TEST(Charts, CorrectionsGainTheFourthPowerOfTheStep) {
    const Method corrected{"corrected", Integrator::velocity_verlet, NormalForce::walton_braun_corrected,
                           TangentialLaw::none};
    for (const double steps : {12.0, 24.0}) {
        const double gain = std::pow(std::numbers::pi / steps, 4) / 4;
        EXPECT_NEAR(normal_errors(corrected, 1, steps, 200).restitution, gain / 2, 0.05 * gain) << steps;
    }
}

// A contact that lasts follows a linear spring to second order. So does an impact whose slip counts from the
// touch; otherwise the first increment begins in the middle of a step, and the error is of first order.
TEST(Charts, LinearSpringIsOfSecondOrderWithCorrections) {
    const Method plain{"", Integrator::velocity_verlet, NormalForce::walton_braun,
                       TangentialLaw::linear_spring};
    Method corrected = plain;
    corrected.normal = NormalForce::walton_braun_corrected;
    EXPECT_NEAR(std::log2(shear_error(plain, 32) / shear_error(plain, 64)), 2, 0.1);
    EXPECT_NEAR(
        std::log2(oblique_errors(plain, 0.9, 16).velocity / oblique_errors(plain, 0.9, 128).velocity) / 3, 1,
        0.2);
    EXPECT_NEAR(std::log2(oblique_errors(corrected, 0.9, 16).velocity /
                          oblique_errors(corrected, 0.9, 128).velocity) /
                    3,
                2, 0.2);
}

// Incremental slip has the stiffness of the step's middle. With that of its beginning the errors of the
// impact were 0.0083 and 0.0022, and the order of a contact that lasts was 1.3.
TEST(Charts, IncrementalSlipIsOfSecondOrder) {
    const Method corrected{"", Integrator::velocity_verlet, NormalForce::walton_braun_corrected,
                           TangentialLaw::incremental_slip};
    EXPECT_LT(oblique_errors(corrected, 0.9, 16).velocity, 0.003);
    EXPECT_LT(oblique_errors(corrected, 0.9, 128).velocity, 0.0003);
    EXPECT_NEAR(std::log10(shear_error(corrected, 16) / shear_error(corrected, 160)), 2, 0.2);
}

TEST(Charts, DifferencesAreOverTheSeedsScatter) {
    const auto row = [](const char* setting, double height, double cost) {
        return BedRow{setting, {height, 1, 1, 1, cost}};
    };
    const auto d = bed_differences(
        {row("reference", 1.0, 8), row("other", 1.3, 2), row("reference", 1.2, 8), row("other", 1.5, 2)});
    ASSERT_EQ(d.size(), 2u);
    EXPECT_EQ(d[1].setting, "other");
    EXPECT_EQ(d[1].seeds, 2);
    EXPECT_NEAR(d[1].height, 100 * (1.4 / 1.1 - 1), 1e-9);
    // Standard error of each mean: 0.2 / sqrt 2 / sqrt 2 = 0.1.
    EXPECT_NEAR(d[1].height_error, 100 * std::hypot(0.1, 0.1) / 1.1, 1e-6);
    EXPECT_NEAR(d[1].cost, 0.25, 1e-12);
}

}  // namespace
}  // namespace grainreel
