// Tests of whether a run is steady: two statistical tests against closed forms, and the verb's answers for
// measures with known drift.
#include "engine/questions/steadiness.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>
#include <random>

#include "tests/cli/program.hpp"
#include "tests/support/small_scene.hpp"
#include "tests/support/tells.hpp"
#include "tests/support/temporary_folder.hpp"

namespace grainreel {
namespace {

using namespace test;
using testing::HasSubstr;
using Verdict = Steadiness::Verdict;

// Numbers between -1 and 1 without a trend: fractions of multiples of the golden ratio.
double noise(std::size_t i) {
    const double x = static_cast<double>(i + 1) * std::numbers::phi;
    return 2 * (x - std::floor(x)) - 1;
}

template <class Value>
Steadiness of(std::size_t rows, double interval, double period, const Value& value) {
    std::vector<double> times, values;
    for (std::size_t i = 0; i < rows; ++i) {
        times.push_back(static_cast<double>(i) * interval);
        values.push_back(value(times.back(), i));
    }
    return steadiness_of(times, values, period);
}

// If n values rise, S = n (n - 1) / 2 and its variance is n (n - 1) (2 n + 5) / 18. For n = 10 they are 45
// and 125, so z = 44 / sqrt(125).
TEST(MannKendallTest, OfARisingAndAFallingSeries) {
    std::vector<double> rising;
    for (int i = 0; i < 10; ++i) rising.push_back(i * i);
    const MannKendall up = mann_kendall(rising);
    EXPECT_EQ(up.s, 45);
    EXPECT_EQ(up.tau, 1);
    EXPECT_DOUBLE_EQ(up.z, 44 / std::sqrt(125.0));
    EXPECT_NEAR(up.p, std::erfc(44 / std::sqrt(250.0)), 1e-15);
    const MannKendall down = mann_kendall({rising.rbegin(), rising.rend()});
    EXPECT_EQ(down.s, -45);
    EXPECT_DOUBLE_EQ(down.p, up.p);
}

// There are two ties of five values each among ten: the variance is 125 - 2 * 5 * 4 * 15 / 18.
TEST(MannKendallTest, CountsTies) {
    const MannKendall test = mann_kendall({0, 0, 0, 0, 0, 1, 1, 1, 1, 1});
    EXPECT_EQ(test.s, 25);
    EXPECT_DOUBLE_EQ(test.z, 24 / std::sqrt(125 - 600.0 / 18));
    EXPECT_EQ(mann_kendall({3, 3, 3, 3}).p, 1);
}

// The series steps from 1 to 0 at the k-th of n values, and the k values before the step are dropped.
TEST(Mser, DropsTheTransient) {
    for (const std::size_t k : {0u, 3u, 10u}) {
        std::vector<double> means(40, 0);
        for (std::size_t i = 0; i < k; ++i) means[i] = 1;
        EXPECT_EQ(mser_truncation(means), k);
    }
}

// For a straight line the variance of the rest is (n^2 - 1) / 12, and divided by n it falls to the end, so
// nothing of the line is steady.
TEST(Mser, KeepsNothingOfALine) {
    std::vector<double> line;
    for (int i = 0; i < 40; ++i) line.push_back(i);
    EXPECT_EQ(mser_truncation(line), line.size());
}

// The series is a decay of 1 s and then noise. It is dropped up to the time when the decay is below the
// noise, and the mean is that of the rest.
TEST(Steady, AfterATransient) {
    const Steadiness found =
        of(2000, 0.01, 0, [](double t, std::size_t i) { return 5 + 3 * std::exp(-t) + 0.1 * noise(i); });
    EXPECT_EQ(found.verdict, Verdict::steady);
    EXPECT_GT(found.from, 1);
    EXPECT_LT(found.from, 10);
    EXPECT_NEAR(found.mean, 5, 0.01);
    EXPECT_GT(found.p, kSignificance);
    EXPECT_EQ(found.tested, kMostBatches);
}

// A drift of 0.02 a second lies under noise of 0.1; Sen's slope finds it.
TEST(Steady, NotWhereItDrifts) {
    const Steadiness found =
        of(2000, 0.01, 0, [](double t, std::size_t i) { return 0.02 * t + 2 * noise(i); });
    EXPECT_EQ(found.verdict, Verdict::drifts);
    EXPECT_NEAR(found.slope, 0.02, 0.005);
    EXPECT_LT(found.p, kSignificance);
}

// A sine of the drive's period is no drift, however large it is: the rows of a period make one mean.
TEST(Steady, WhateverThePhaseOfTheDrive) {
    const double period = 0.05;
    const Steadiness found = of(400, period / 8, period, [&](double t, std::size_t i) {
        return 1 + 100 * std::sin(2 * std::numbers::pi * t / period) + 0.01 * noise(i / 8);
    });
    EXPECT_EQ(found.verdict, Verdict::steady);
    EXPECT_EQ(found.batches, 49u);
    EXPECT_NEAR(found.mean, 1, 0.01);
}

TEST(Steady, OfAConstantAndOfTooFewRows) {
    const Steadiness constant = of(100, 0.01, 0, [](double, std::size_t) { return 7.0; });
    EXPECT_EQ(constant.verdict, Verdict::steady);
    EXPECT_EQ(constant.mean, 7);
    EXPECT_EQ(constant.half_width, 0);
    EXPECT_EQ(of(40, 0.01, 0, [](double, std::size_t) { return 7.0; }).verdict, Verdict::too_short);
    EXPECT_EQ(of(0, 0.01, 0, [](double, std::size_t) { return 7.0; }).batches, 0u);
    EXPECT_EQ(of(100, 0.01, 0, [](double, std::size_t) { return std::nan(""); }).batches, 0u);
}

// A slow wave under noise ten times as large: the rows are worth hundreds of independent values, but the
// means of batches follow the wave.
TEST(Steady, NotWhereMeansOfBatchesHangTogether) {
    const Steadiness found = of(2000, 0.01, 0, [](double t, std::size_t i) {
        return std::sin(2 * std::numbers::pi * t / 8) + 10 * noise(i);
    });
    EXPECT_EQ(found.verdict, Verdict::too_short);
    EXPECT_GT(found.independent, kLeastIndependent);
    EXPECT_GT(found.correlation, 0.5);
}

// Equal values hang together, and still nothing is unknown about their mean.
TEST(Steady, OfAConstantThatIsNoShortNumber) {
    const Steadiness constant = of(200, 0.01, 0, [](double, std::size_t) { return 0.1; });
    EXPECT_EQ(constant.verdict, Verdict::steady);
    EXPECT_LT(constant.half_width, 1e-15);
}

// n values of an autoregressive process with the correlation phi are worth n (1 - phi) / (1 + phi).
std::vector<double> autoregressive(std::size_t n, double phi, std::mt19937_64& random) {
    std::vector<double> values(n);
    const auto uniform = [&] { return (static_cast<double>(random() >> 11) + 0.5) / 0x1p53; };
    const auto normal = [&] {  // Box and Muller
        return std::sqrt(-2 * std::log(uniform())) * std::cos(2 * std::numbers::pi * uniform());
    };
    for (std::size_t i = 0; i < n; ++i)
        values[i] = i == 0 ? normal() : phi * values[i - 1] + std::sqrt(1 - phi * phi) * normal();
    return values;
}

TEST(IndependentValues, OfCorrelatedOnes) {
    std::mt19937_64 random(1);
    for (const double phi : {-0.5, 0.0, 0.5, 0.9})
        EXPECT_NEAR(independent_values(autoregressive(100'000, phi, random)) / 1e5, (1 - phi) / (1 + phi),
                    0.02)
            << phi;
    std::vector<double> line;  // a drift is no correlation
    for (std::size_t i = 0; i < 1000; ++i) line.push_back(static_cast<double>(i) + noise(i));
    EXPECT_GT(independent_values(line), 500);
}

// Each test asks about 200 stationary series whose mean is 0. Long series mostly get an interval, and it
// holds the mean. Short series hardly ever get one, whether they seem steady or seem to drift.
class SteadyOfCorrelatedRows : public testing::TestWithParam<int> {  // rows in a correlation time
  protected:
    struct Count {
        int given = 0, held = 0;
    };
    Count count(int correlation_times) const {
        std::mt19937_64 random(static_cast<std::uint64_t>(100 * GetParam() + correlation_times));
        Count all;
        for (int series = 0; series < 200; ++series) {
            const auto rows = autoregressive(static_cast<std::size_t>(correlation_times * GetParam()),
                                             std::exp(-1.0 / GetParam()), random);
            const Steadiness answer =
                of(rows.size(), 0.01, 0, [&](double, std::size_t i) { return rows[i]; });
            if (answer.verdict == Verdict::too_short) continue;
            ++all.given;
            all.held += std::abs(answer.mean) <= answer.half_width;
        }
        return all;
    }
};

TEST_P(SteadyOfCorrelatedRows, HoldTheMeanAsOftenAsTheySay) {
    const Count hundred = count(100);
    EXPECT_GE(hundred.given, 140);
    EXPECT_GE(hundred.held, 0.90 * hundred.given);
    EXPECT_LE(hundred.held, 0.98 * hundred.given);
    EXPECT_LE(count(3).given, 2);
    EXPECT_LE(count(10).given, 2);
    EXPECT_LE(count(30).given, 4);
}

INSTANTIATE_TEST_SUITE_P(Rows, SteadyOfCorrelatedRows, testing::Values(3, 20));

class InspectOverTime : public testing::Test {
  protected:
    void SetUp() override {
        const Ended ended = run_program(
            {"movie", write_small_scene(here.path()).string(), "--no-film", "--no-report", "--out", "run"},
            setting);
        ASSERT_EQ(ended.status, 0) << ended.err;
    }
    Ended ask(std::vector<std::string> words) const {
        words.insert(words.begin(), {"inspect", "run"});
        return run_program(words, setting);
    }

    TemporaryFolder here;
    Program::Setting setting{here.path()};
};

TEST_F(InspectOverTime, TellsWhetherAColumnIsSteady) {
    const Ended short_run = ask({"--steady", "kinetic_J"});
    EXPECT_EQ(short_run.status, 0) << short_run.err;
    EXPECT_THAT(short_run.out, HasSubstr("too short to tell"));
    EXPECT_THAT(short_run.out, HasSubstr("10 are the least"));
    std::string table = "step,time_s,height_m\n";
    for (int i = 0; i < 400; ++i) table += fmt::format("{},{:.6f},{}\n", i, i * 0.05 / 8, i);
    write_text(here / "run/measures.csv", table);
    const auto answer =
        nlohmann::json::parse(ask({"--steady", "height_m", "--json", "--set", "run.threads=1"}).out);
    EXPECT_THAT(answer.dump(),
                HasSubstr("too short to tell"));  // the transient of a straight line never ends
    const Ended wrong = ask({"--steady", "heigth_m"});
    EXPECT_EQ(wrong.status, 2);
    EXPECT_THAT(wrong.err, tells({"--steady", "'heigth_m'", "no column", "measures.csv", "'height_m'?"}));
    EXPECT_THAT(ask({"--steady", "height_m", "--at", "0.1 s"}).err, tells({"--steady", "the whole run"}));
}

// There are twenty moments from 0 to 0.2 s, restored every 10 ms; all grains lie above the floor.
TEST_F(InspectOverTime, GivesCountsAndMeansAtEachMultipleOfATime) {
    const Ended ended =
        ask({"--where", "height > 0", "--every", "10 ms", "--mean", "height", "--csv", "--limit", "0"});
    ASSERT_EQ(ended.status, 0) << ended.err;
    std::istringstream lines(ended.out);
    std::string line;
    std::getline(lines, line);
    EXPECT_THAT(line, HasSubstr("grains_small"));
    EXPECT_THAT(line, HasSubstr("mean_height"));
    int rows = 0;
    while (std::getline(lines, line)) {
        EXPECT_THAT(line, HasSubstr(",40,10,50,"));
        EXPECT_NEAR(std::stod(line), 0.01 * rows, 1e-4);
        ++rows;
    }
    EXPECT_EQ(rows, 21);
    EXPECT_THAT(ask({"--where", "height > 0", "--every", "1 us"}).err,
                tells({"--every", "shorter than a step"}));
}

TEST_F(InspectOverTime, RefusesWhatMakesNoSense) {
    EXPECT_THAT(ask({"--where", "height > 0", "--mean", "height"}).err,
                tells({"--mean", "over time", "--every or --over-time"}));
    EXPECT_THAT(ask({"--where", "height > 0", "--over-time", "--mean", "hight"}).err,
                tells({"'hight'", "no quantity"}));
    EXPECT_THAT(ask({"--where", "height > 0", "--every", "0 s"}).err, HasSubstr("longer than 0 s"));
    EXPECT_THAT(ask({"--where", "touches(nobody)", "--at", "0.1 s"}).err,
                tells({"touches", "'nobody'", "no species", "no wall", "no id", "wall, small"}));
}

// A grain touches a wall, grains, or both exactly if it has contacts.
TEST_F(InspectOverTime, KnowsWhatTouches) {
    const auto count = [&](const std::string& condition) {
        const Ended ended = ask({"--where", condition, "--at", "0 s", "--json", "--limit", "0"});
        EXPECT_EQ(ended.status, 0) << ended.err;
        return nlohmann::json::parse(ended.out)["tables"]["count"]["rows"].back()[1].get<int>();
    };
    const int any = count("contacts > 0");
    EXPECT_GT(any, 10);
    EXPECT_EQ(count("touches(wall) or touches(small) or touches(\"big\")"), any);
    EXPECT_EQ(count("touches(floor) and not touches(wall)"), 0);
    EXPECT_GT(count("touches(floor)"), 3);
}

TEST_F(InspectOverTime, SaysWhetherOverlapsKeepToTheLimit) {
    EXPECT_THAT(ask({"--largest-overlap"}).out, HasSubstr("the limit: "));
}

}  // namespace
}  // namespace grainreel
