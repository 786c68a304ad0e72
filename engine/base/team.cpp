#include "engine/base/team.hpp"

#include <sched.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <fstream>
#include <string>
#include <utility>

#include "engine/base/system/processor.hpp"

namespace grainreel {

namespace {

constexpr int kSpins = 400;  // about 20 us with the pause instruction
constexpr std::chrono::microseconds kYields(100), kLongTurn(1000);

void relax() {
#if defined(__x86_64__) || defined(__i386__)
    __builtin_ia32_pause();
#elif defined(__aarch64__)
    asm volatile("isb");  // what "yield" should do is left to the processor, and most do nothing
#endif
}

using SteadyClock = std::chrono::steady_clock;

// Yields the processor to other programs for about as long as waking up would take. Returns false if `value`
// is still `old` afterwards. If another program wants the processor, a yield lasts as long as its turn, which
// is many steps; the next waits then do not yield.
bool yield_while(const std::atomic<int>& value, int old) {
    constexpr int kUntilNextTry = 100;  // number of waits, some hundredths of a second
    thread_local int waits_without = 0;
    if (waits_without > 0) return --waits_without, false;
    auto now = SteadyClock::now();
    for (const auto until = now + kYields; now < until;) {
        if (value.load(std::memory_order_acquire) != old) return true;
        sched_yield();
        const auto before = std::exchange(now, SteadyClock::now());
        if (now - before > kLongTurn) waits_without = kUntilNextTry;
    }
    return value.load(std::memory_order_acquire) != old;
}

// Returns when `value` is no longer `old`. Between spinning and sleeping it yields, because a thread that
// wakes up late makes the others sleep at the next barrier, and so on. (With yielding, steps of a bed on two
// threads are 1.06 times as fast.)
void wait_while(const std::atomic<int>& value, int old) {
    for (int spin = 0; spin < kSpins; ++spin) {
        if (value.load(std::memory_order_acquire) != old) return;
        relax();
    }
    if (yield_while(value, old)) return;
    while (value.load(std::memory_order_acquire) == old) value.wait(old, std::memory_order_acquire);
}

// Asks for short turns on the processor for the case that other programs want it too. Long turns are of no
// use, because each step waits for the thread that waits for its turn. Linux does this from 6.12 on and
// ignores it before. (docs/notes/performance.md, "Beside other programs".)
void ask_for_short_turns() {
#if defined(SYS_sched_getattr) && defined(SYS_sched_setattr)
    constexpr std::uint64_t kTurn = 100'000, kForItselfOnly = 1;  // ns; SCHED_FLAG_RESET_ON_FORK
    struct {  // the kernel's sched_attr, for which glibc has no name
        std::uint32_t size, policy;
        std::uint64_t flags;
        std::int32_t nice;
        std::uint32_t priority;
        std::uint64_t runtime, deadline, period;
    } attributes{};
    if (syscall(SYS_sched_getattr, 0, &attributes, sizeof attributes, 0) != 0) return;
    if (attributes.policy != SCHED_OTHER) return;
    attributes.flags |= kForItselfOnly;
    attributes.runtime = kTurn;
    syscall(SYS_sched_setattr, 0, &attributes, 0);
#endif
}

// The processor time that the cgroup allows, as a number of processors; infinite without a quota. Version 2
// has "quota period" or "max period" in one file, version 1 uses two files.
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
    if (thread_local bool asked = false; !std::exchange(asked, true)) ask_for_short_turns();
    timings_[member].since = ticks();
    (*work_)(member);
}

// Each member writes the number of its barrier into a cache line of its own and reads the others' lines. So a
// message travels once from processor to processor; with a common counter it would travel three times. No
// member is more than one barrier ahead.
void Team::barrier(int member) {
    if (size_ == 1) return;
    Timing& mine = timings_[member];
    mine.busy.store(busy(member) + static_cast<double>(ticks() - mine.since), std::memory_order_relaxed);
    std::atomic<int>& own = seats_[member].barrier;
    const int last = own.load(std::memory_order_relaxed);
    own.store(last + 1);  // sequentially consistent; otherwise a sleeping member might not be woken
    own.notify_all();
    for (int other = 0; other < size_; ++other)
        if (other != member) wait_while(seats_[other].barrier, last);
    mine.since = ticks();
}

}  // namespace grainreel
