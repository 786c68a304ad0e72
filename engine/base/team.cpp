#include "engine/base/team.hpp"

#include <sched.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <fstream>
#include <string>

#include "engine/base/ticks.hpp"

namespace grainreel {

namespace {

constexpr int kSpins = 400;  // about 20 us with the pause instruction
constexpr std::chrono::microseconds kYields(100);

void relax() {
#if defined(__x86_64__) || defined(__i386__)
    __builtin_ia32_pause();
#endif
}

// Returns once `value` is no longer `old`. Between spinning and sleeping it offers its processor to whoever
// wants it, for as long as it would take to wake up: a sleeper that wakes late makes the others sleep at the
// next barrier, and so on. (Steps of a bed on two threads: 1.06 times as fast as without.)
void wait_while(const std::atomic<int>& value, int old) {
    for (int spin = 0; spin < kSpins; ++spin) {
        if (value.load(std::memory_order_acquire) != old) return;
        relax();
    }
    const auto until = std::chrono::steady_clock::now() + kYields;
    while (std::chrono::steady_clock::now() < until) {
        if (value.load(std::memory_order_acquire) != old) return;
        sched_yield();
    }
    while (value.load(std::memory_order_acquire) == old) value.wait(old, std::memory_order_acquire);
}

// Processors' worth of time the cgroup grants; infinite without a quota. Version 2 writes "quota period" or
// "max period" into one file, version 1 uses two.
double cgroup_quota() {
    std::string quota;
    double period = 0, microseconds = 0;
    if (std::ifstream v2("/sys/fs/cgroup/cpu.max"); v2 >> quota >> period) {
        return quota == "max" || period <= 0 ? INFINITY : std::stod(quota) / period;
    }
    std::ifstream v1_quota("/sys/fs/cgroup/cpu/cpu.cfs_quota_us"),
        v1_period("/sys/fs/cgroup/cpu/cpu.cfs_period_us");
    const bool limited = v1_quota >> microseconds && v1_period >> period && microseconds > 0 && period > 0;
    return limited ? microseconds / period : INFINITY;
}

}  // namespace

int usable_processors() {
    cpu_set_t mask;
    CPU_ZERO(&mask);
    int count = static_cast<int>(std::thread::hardware_concurrency());
    if (sched_getaffinity(0, sizeof mask, &mask) == 0) count = CPU_COUNT(&mask);
    const double quota = std::ceil(cgroup_quota());
    if (quota < count) count = static_cast<int>(quota);
    return std::max(count, 1);
}

Team::Team(int members) : size_(std::max(members, 1)), timings_(size_), seats_(size_) {
    for (int member = 1; member < size_; ++member) threads_.emplace_back([this, member] { serve(member); });
}

Team::~Team() {
    round_.store(-1, std::memory_order_release);
    round_.notify_all();
    for (std::thread& thread : threads_) thread.join();
}

void Team::run(const std::function<void(int)>& work) {
    if (size_ == 1) return work(0);
    work_ = &work;
    running_.store(size_ - 1, std::memory_order_relaxed);
    round_.fetch_add(1, std::memory_order_release);
    round_.notify_all();
    work_as(0);
    for (int left = running_.load(std::memory_order_acquire); left != 0;
         left = running_.load(std::memory_order_acquire)) {
        wait_while(running_, left);
    }
}

void Team::serve(int member) {
    for (int seen = 0;;) {
        wait_while(round_, seen);
        seen = round_.load(std::memory_order_acquire);
        if (seen < 0) return;
        work_as(member);
        if (running_.fetch_sub(1, std::memory_order_acq_rel) == 1) running_.notify_one();
    }
}

void Team::work_as(int member) {
    timings_[member].since = ticks();
    (*work_)(member);
}

// Everyone says on a line of its own which barrier it has come to, and looks at the others' lines: one way
// from processor to processor, where a common counter takes three. Nobody is more than one barrier ahead.
void Team::barrier(int member) {
    if (size_ == 1) return;
    Timing& mine = timings_[member];
    mine.busy.store(busy(member) + static_cast<double>(ticks() - mine.since), std::memory_order_relaxed);
    std::atomic<int>& own = seats_[member].barrier;
    const int last = own.load(std::memory_order_relaxed);
    own.store(last + 1);  // in one order with the sleepers' counter, or one might be left asleep
    own.notify_all();
    for (int other = 0; other < size_; ++other)
        if (other != member) wait_while(seats_[other].barrier, last);
    mine.since = ticks();
}

}  // namespace grainreel
