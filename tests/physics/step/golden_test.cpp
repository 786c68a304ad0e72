// Tests that the bits are the same for any number of threads and on AVX2, AVX-512 and NEON, which fuse
// multiplications with additions; and that those of plain code and SSE4, which cannot, are the same too. Two
// cases also compare today's bits with yesterday's, so that no change of them goes unnoticed.
// reference_test.cpp shows that the step is right. Bits depend on the compiler's order of operations, so the
// hashes are those of GCC.
#include <gtest/gtest.h>

#include <algorithm>
#include <optional>
#include <vector>

#include "engine/lab/bench/bench_run.hpp"
#include "tests/instruction_sets.hpp"

namespace grainreel {
namespace {

struct Golden {
    const char* name;
    int particles;
    Precision precision;
    int steps;                           // number of steps before the test, so that pairs touch
    std::uint64_t fused = 0, plain = 0;  // yesterday's hashes; 0: not compared
};

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

// The bed falls with kernels of the same kind (fused or plain) and then moves, with those of each set of the
// kind and with so many threads. Returns the hash; 0 where this processor has no such set.
template <class Sets>
std::uint64_t one_hash(const Sets& sets, std::uint64_t golden, const std::vector<int>& threads) {
    std::optional<BenchBed> bed;
    std::uint64_t hash = 0;
    for (const std::int64_t set : sets)
        test::with_instruction_set(set, [&] {
            if (!bed) {
                bed = fallen(GoldenHash::GetParam(), GoldenHash::GetParam().steps);
                hash = hash_after(*bed, 1);
                expect_golden(hash, golden);
            }
            for (const int many : threads) EXPECT_EQ(hash_after(*bed, many), hash) << many;
        });
    return hash;
}

// All sets of a kind take part in the short run that is compared. The fall before it takes long.
TEST_P(GoldenHash, HoldsForAnyThreadsAndWidth) {
    const std::uint64_t plain = one_hash(test::plain_sets, GetParam().plain, {1, 3});
    const std::uint64_t fused = one_hash(test::fused_sets, GetParam().fused, {1, 2, 3, 8, 16});
    EXPECT_NE(fused, plain) << "no contacts?";
}

INSTANTIATE_TEST_SUITE_P(
    Cases, GoldenHash,
    testing::Values(Golden{"bed10k", 400, Precision::full, 40000, 0x0d5c7a7bec68e755, 0x18b3742f26164992},
                    Golden{"bed10k", 400, Precision::mixed, 40000},
                    Golden{"bed10k-walton-braun", 400, Precision::full, 40000},
                    Golden{"frictionless", 400, Precision::full, 40000},
                    Golden{"wedge", 405, Precision::full, 40000, 0x4f456ee83a2fcafc, 0xbf99374aea6909c4},
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
