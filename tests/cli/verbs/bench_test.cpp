// Tests of the verb `bench`: its numbers add up, and it names the run that it made.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "tests/cli/program.hpp"
#include "tests/support/temporary_folder.hpp"

namespace grainreel {
namespace {

using namespace test;
using testing::HasSubstr;

Ended bench(std::vector<std::string> words) {
    const TemporaryFolder here;
    words.insert(words.begin(), "bench");
    Program program(words, {here.path(), {}, 0});
    return program.wait();
}

nlohmann::json json_of(std::vector<std::string> words) {
    words.insert(words.end(), {"--json", "--quiet"});
    const Ended end = bench(words);
    EXPECT_EQ(end.status, 0) << end.err;
    return nlohmann::json::parse(end.out);
}

TEST(Bench, CostsAddUpToTheStep) {
    for (const int threads : {1, 2}) {
        const auto r = json_of(
            {"gas", "--particles", "500", "--threads", std::to_string(threads), "--repeat", "2", "--quick"});
        EXPECT_EQ(r["case"], "gas");
        EXPECT_EQ(r["particles"], 500);
        EXPECT_EQ(r["threads"], threads);
        EXPECT_EQ(r["precision"], "double");
#ifndef __SANITIZE_ADDRESS__  // (the sanitizer's heap does not count memory)
        EXPECT_GT(r["bytes_per_particle"], 100);
#endif
        ASSERT_EQ(r["phases"].size(), 1u);
        const auto& phase = r["phases"][0];
        EXPECT_EQ(phase["steps"], 2000);
        EXPECT_EQ(phase["repetitions"].size(), 2u);
        double sum = 0;
        for (const auto& cost : phase["ns_per_particle_step"]) {
            EXPECT_GE(cost.get<double>(), 0);
            sum += cost.get<double>();
        }
        EXPECT_EQ(phase["ns_per_particle_step"].size(), 6u);
        double slowest = 1e30, fastest = 0;
        for (const double speed : phase["repetitions"]) {
            slowest = std::min(slowest, speed);
            fastest = std::max(fastest, speed);
        }
        EXPECT_LE(sum, 1.001e9 * threads / slowest);
        EXPECT_GE(sum, 0.999e9 * threads / fastest);
    }
}

TEST(Bench, HashTellsRunsApartAndThreadsNot) {
    const auto one = json_of({"bed10k", "--particles", "100", "--threads", "1", "--quick"});
    const auto two = json_of({"bed10k", "--particles", "100", "--threads", "2", "--quick"});
    const auto mixed =
        json_of({"bed10k", "--particles", "100", "--threads", "1", "--precision", "mixed", "--quick"});
    EXPECT_EQ(one["state_hash"], two["state_hash"]);
    EXPECT_NE(one["state_hash"], mixed["state_hash"]);
    EXPECT_EQ(one["phases"].size(), 3u);
    EXPECT_GE(one["phases"][0]["pairs_listed"], 50);
}

TEST(Bench, CopiesAreTimedBesideASingleOne) {
    const auto r = json_of({"bed10k", "--particles", "30000", "--quick"});
    EXPECT_EQ(r["particles"], 4 * 10125);
    ASSERT_EQ(r["phases"].size(), 3u);
    for (const auto& phase : r["phases"]) {
        const double all = phase["particle_steps_per_s"], one = phase["particle_steps_per_s_of_one_copy"];
        EXPECT_GT(all, 0.1 * one);
        EXPECT_LT(all, 10 * one);
    }
}

TEST(Bench, RefusesWhatItDoesNotKnow) {
    const Ended no_case = bench({"bed11k"});
    EXPECT_EQ(no_case.status, 2);
    EXPECT_THAT(no_case.err, HasSubstr("bed10k"));
    EXPECT_EQ(bench({"gas", "--precision", "half"}).status, 2);
    EXPECT_EQ(bench({"gas", "--particles", "5"}).status, 2);
}

}  // namespace
}  // namespace grainreel
