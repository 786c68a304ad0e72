// Tests that the bits are the same for any number of threads and on AVX2 and AVX-512, which fuse
// multiplications with additions; and that those of SSE4, which cannot, are the same for any number of
// threads. Two cases also compare today's bits with yesterday's, so that no change of them goes unnoticed.
// reference_test.cpp shows that the step is right. Bits depend on the compiler's order of operations, so the
// hashes are those of GCC.
#include <gtest/gtest.h>
#include <hwy/targets.h>

#include <algorithm>
#include <vector>

#include "engine/lab/bench/bench_run.hpp"

namespace grainreel {
namespace {

struct Golden {
    const char* name;
    int particles;
    Precision precision;
    int steps;                           // number of steps before the test, so that pairs touch
    std::uint64_t fused = 0, plain = 0;  // yesterday's hashes; 0: not compared
};

bool has(std::int64_t target) {
    return (hwy::SupportedTargets() & HWY_TARGETS & target) != 0;
}

// Calls work() with the kernels of one instruction set.
template <class Work>
void at_width(std::int64_t target, const Work& work) {
    hwy::GetChosenTarget().Update(target);
    work();
    hwy::GetChosenTarget().Update(hwy::SupportedTargets());
}

const BenchCase& case_of(const Golden& golden) {
    const auto& all = bench_cases();
    return *std::find_if(all.begin(), all.end(), [&](const BenchCase& c) { return c.name == golden.name; });
}

// The bed of a case after so many steps of one thread, just before the drive starts.
BenchBed fallen(const Golden& golden, std::int64_t steps) {
    BenchBed bed = case_of(golden).bed(golden.particles);
    for (auto* kinds : {&bed.plan.grain, &bed.plan.wall})
        for (PairPlan& pair : *kinds) pair.model.precision = golden.precision;
    Team team(1);
    StepLoop loop(bed.plan, bed.around, bed.grains, team);
    loop.restart();
    loop.run(-steps, steps, bed.plan.clock.step, 0);
    return bed;
}

std::uint64_t hash_after(BenchBed bed, int threads) {
    Team team(threads);
    StepLoop loop(bed.plan, bed.around, bed.grains, team);
    loop.restart();
    loop.run(0, 250, bed.plan.clock.step, 0);
    return hash_of_motion(bed.grains);
}

class GoldenHash : public testing::TestWithParam<Golden> {};

void expect_golden([[maybe_unused]] std::uint64_t hash, [[maybe_unused]] std::uint64_t golden) {
#if defined(__GNUC__) && !defined(__clang__)
    if (golden != 0) {
        EXPECT_EQ(hash, golden) << std::hex << "now 0x" << hash;
    }
#endif
}

TEST_P(GoldenHash, HoldsForAnyThreadsAndWidth) {
    BenchBed bed;
    std::uint64_t plain = 0;
    // Builds without SSE4, such as those of the sanitizers, have plain code in its place, with the same bits.
    at_width(has(HWY_SSE4) ? HWY_SSE4 : HWY_STATIC_TARGET, [&] {
        bed = fallen(GetParam(), GetParam().steps);
        const std::uint64_t hash = hash_after(bed, 1);
        EXPECT_EQ(hash_after(bed, 3), hash);
        expect_golden(hash, GetParam().plain);
        plain = hash;
    });
    const auto expect_fused = [&](const std::vector<int>& threads) {
        const std::uint64_t hash = hash_after(bed, 1);
        EXPECT_NE(hash, plain) << "no contacts?";
        for (const int many : threads) EXPECT_EQ(hash_after(bed, many), hash) << many;
        expect_golden(hash, GetParam().fused);
    };
    if (has(HWY_AVX2)) at_width(HWY_AVX2, [&] { expect_fused({2, 3, 8, 16}); });
    if (has(HWY_AVX3)) at_width(HWY_AVX3, [&] { expect_fused({2, 3}); });
}

INSTANTIATE_TEST_SUITE_P(
    Cases, GoldenHash,
    testing::Values(Golden{"bed10k", 400, Precision::full, 40000, 0xd4daa8327dbfecc8, 0x18b3742f26164992},
                    Golden{"bed10k", 400, Precision::mixed, 40000},
                    Golden{"bed10k-walton-braun", 400, Precision::full, 40000},
                    Golden{"frictionless", 400, Precision::full, 40000},
                    Golden{"wedge", 405, Precision::full, 40000, 0x8b556a0d441da73b, 0xb171f7791e01b7f0},
                    Golden{"intruder", 1000, Precision::full, 25000},
                    Golden{"gas", 400, Precision::full, 12000}),
    [](const auto& one) {
        std::string name = one.param.name;
        std::replace(name.begin(), name.end(), '-', '_');
        return name + (one.param.precision == Precision::mixed ? "_mixed" : "");
    });

// In a large bed some grains begin the next step before the others (see Vanguard), as far as no other thread
// reads them.
TEST(Threads, LargeBedHasTheSameBits) {
    const Golden bed10k{"bed10k", 800, Precision::full, 30000};
    const BenchBed one = fallen(bed10k, bed10k.steps);
    const BenchBed large = copied(one, one.grains, case_of(bed10k).side_of_copies(one), 8);
    ASSERT_GE(large.grains.size(), kLargeBed);
    const std::uint64_t hash = hash_after(large, 1);
    for (const int threads : {2, 3}) EXPECT_EQ(hash_after(large, threads), hash) << threads;
}

}  // namespace
}  // namespace grainreel
