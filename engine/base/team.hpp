// Team: threads that run a function together, with a barrier. All parallel work goes through it, and no other
// file of the engine makes threads.
#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <thread>
#include <vector>

namespace grainreel {

// Number of processors that this process may use: by its affinity mask and the quota of its cgroup.
int usable_processors();

class Team {
  public:
    explicit Team(int members);  // >= 1; the caller of run() is member 0
    ~Team();
    Team(const Team&) = delete;
    Team& operator=(const Team&) = delete;

    int size() const { return size_; }

    // Calls work(member) on every member and returns when all have finished. `work` must not throw.
    void run(const std::function<void(int)>& work);

    // Waits until all members have come here. It spins for some 20 us, yields for 100 us and then sleeps, so
    // that a renderer or an encoder on the same processors gets its turn.
    void barrier(int member);
    // Ticks that a member has worked, without waiting, up to its last barrier.
    double busy(int member) const { return timings_[member].busy.load(std::memory_order_relaxed); }

  private:
    // Timing and Seat are cache lines that only their member writes.
    struct alignas(64) Timing {
        std::uint64_t since = 0;  // tick at which the present work began
        std::atomic<double> busy{0};
    };
    struct alignas(64) Seat {
        std::atomic<int> barrier{0};  // number of the last barrier that the member has reached
    };

    void serve(int member);
    void work_as(int member);

    const int size_;
    std::vector<Timing> timings_;
    std::vector<Seat> seats_;
    std::vector<std::thread> threads_;
    const std::function<void(int)>* work_ = nullptr;
    std::atomic<int> round_{0};    // counts calls of run(); negative: the team is dismissed
    std::atomic<int> running_{0};  // members still at work besides member 0
};

// A member of a team, for functions that all members call.
struct TeamMember {
    Team& team;
    int member;

    bool leads() const { return member == 0; }
    void wait() const { team.barrier(member); }
    // The member's part of `count` things.
    struct Part {
        std::int32_t begin, end;
    };
    Part part_of(std::size_t count) const {
        const auto at = [&](int m) { return static_cast<std::int32_t>(count * m / team.size()); };
        return {at(member), at(member + 1)};
    }
};

}  // namespace grainreel
