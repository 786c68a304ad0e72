// The same bits for any number of threads and any vector width, and today's as yesterday's: a change of them
// must be meant. Bits depend on the compiler's order of operations, so the hashes are those of GCC.
#include <gtest/gtest.h>
#include <hwy/targets.h>

#include <algorithm>

#include "engine/bench/bench_run.hpp"

namespace grainreel {
namespace {

struct Golden {
    const char* name;
    int particles;
    Precision precision;
    std::uint64_t hash;
};

// A case's bed after so many steps of one thread, the drive being about to start.
BenchBed fallen(const Golden& golden, std::int64_t steps) {
    const auto& all = bench_cases();
    const auto bench =
        std::find_if(all.begin(), all.end(), [&](const BenchCase& c) { return c.name == golden.name; });
    BenchBed bed = bench->bed(golden.particles);
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
    EXPECT_GT(loop.listed_pairs(), 0u);
    return hash_of_motion(bed.grains);
}

class GoldenHash : public testing::TestWithParam<Golden> {};

TEST_P(GoldenHash, HoldsForAnyThreadsAndWidth) {
    const BenchBed bed = fallen(GetParam(), 12000);
    const std::uint64_t hash = hash_after(bed, 1);
    for (const int threads : {2, 3, 8, 16}) EXPECT_EQ(hash_after(bed, threads), hash) << threads;
    for (const std::int64_t target : {std::int64_t{HWY_SSE4}, std::int64_t{HWY_AVX2}}) {
        if (!(hwy::SupportedTargets() & target)) continue;
        hwy::GetChosenTarget().Update(target);
        EXPECT_EQ(hash_after(bed, 1), hash) << hwy::TargetName(target);
    }
    hwy::GetChosenTarget().Update(hwy::SupportedTargets());
#if defined(__GNUC__) && !defined(__clang__)
    EXPECT_EQ(hash, GetParam().hash) << std::hex << "now " << hash;
#endif
}

INSTANTIATE_TEST_SUITE_P(Cases, GoldenHash,
                         testing::Values(Golden{"bed10k", 400, Precision::full, 0x3e582d908be47fc1},
                                         Golden{"bed10k", 400, Precision::mixed, 0x388bd8db03977372},
                                         Golden{"bed10k-walton-braun", 400, Precision::full,
                                                0x4606a3a1236b3d6f},
                                         Golden{"frictionless", 400, Precision::full, 0xcc093714738003fa},
                                         Golden{"wedge", 405, Precision::full, 0xeaf75e8d6a0898c6},
                                         Golden{"intruder", 400, Precision::full, 0x43591c57e4e882cc},
                                         Golden{"gas", 400, Precision::full, 0xf7597cbf9b117b9a}),
                         [](const auto& one) {
                             std::string name = one.param.name;
                             std::replace(name.begin(), name.end(), '-', '_');
                             return name + (one.param.precision == Precision::mixed ? "_mixed" : "");
                         });

}  // namespace
}  // namespace grainreel
