// Test that once a bed has been through its motions, the step asks the heap for memory only to hold more
// contacts than ever before.
#include <gtest/gtest.h>

#include <atomic>
#include <cstdlib>
#include <new>

#include "engine/lab/bench/bench_case.hpp"

namespace {

std::atomic<bool> counting = false;
std::atomic<int> allocations = 0;

void* allocated(std::size_t size, std::size_t alignment) {
    if (counting) ++allocations;
    void* memory = std::aligned_alloc(alignment, (size + alignment - 1) / alignment * alignment);
    if (!memory) throw std::bad_alloc();
    return memory;
}

// If this were inlined, the compiler would take new and delete for two that do not belong together.
[[gnu::noinline]] void release(void* memory) {
    std::free(memory);
}

}  // namespace

void* operator new(std::size_t size) {
    return allocated(size, alignof(std::max_align_t));
}
void* operator new(std::size_t size, std::align_val_t alignment) {
    return allocated(size, static_cast<std::size_t>(alignment));
}
// std::stable_sort uses this form; a sanitizer's own form would not fit the delete below.
void* operator new(std::size_t size, const std::nothrow_t&) noexcept {
    if (counting) ++allocations;
    return std::malloc(size);
}
void operator delete(void* memory) noexcept {
    release(memory);
}
void operator delete(void* memory, std::size_t) noexcept {
    release(memory);
}
void operator delete(void* memory, std::align_val_t) noexcept {
    release(memory);
}
void operator delete(void* memory, std::size_t, std::align_val_t) noexcept {
    release(memory);
}

namespace grainreel {
namespace {

TEST(Allocations, AreNoneInTheStepLoop) {
    for (const BenchCase& bench : bench_cases()) {
        if (bench.name != "wedge") continue;
        BenchBed bed = bench.bed(400);
        for (const int threads : {1, 2}) {
            Team team(threads);
            StepLoop loop(bed.plan, bed.around, bed.grains, team);
            loop.restart();
            const double step = bed.plan.clock.step;
            const std::int64_t period = bed.plan.clock.steps_per_period;
            loop.run(0, 3 * period, step, 0);
            constexpr int kGrowth = 14;  // allocations of two tables that grow
            // Threads that other programs keep from working get smaller shares, and later larger ones than
            // ever before. This does not go on for ever.
            const int last = threads == 1 ? 3 : 8;
            for (int n = 3; n <= last && (n == 3 || allocations > kGrowth); ++n) {
                const std::int64_t rebuilds = loop.rebuilds();
                allocations = 0;
                counting = true;
                loop.run(n * period, period, step, 0);
                counting = false;
                EXPECT_GT(loop.rebuilds(), rebuilds + 4);
            }
            EXPECT_LE(allocations, kGrowth) << threads << " threads";
        }
    }
}

}  // namespace
}  // namespace grainreel
