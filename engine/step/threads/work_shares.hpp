// Which grains each thread has, and where its time goes. A thread has a range of grains. A thread that was
// faster lately gets a longer range. The bits of a run do not depend on the ranges.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "engine/base/system/processor.hpp"
#include "engine/base/team.hpp"
#include "engine/step/grid/neighbours.hpp"
#include "engine/step/threads/halo.hpp"

namespace grainreel {

class WorkShares {
  public:
    explicit WorkShares(const Team& team) : team_(team), threads_(team.size()) {}

    // The grains of each thread, now and before the last share_out().
    const Shares& now() const { return share_; }
    const Shares& before() const { return last_share_; }
    std::int32_t begin(int thread) const { return share_[thread]; }
    std::int32_t end(int thread) const { return share_[thread + 1]; }
    // The grains whose neighbours each thread searches for.
    std::int32_t search_begin(int thread) const { return search_share_[thread]; }
    std::int32_t search_end(int thread) const { return search_share_[thread + 1]; }

    // Each thread reports the times that it was busy. It calls begin_lists() when new lists are begun,
    // searched() with the ticks of its search, end_lists() when the lists are complete, and refreshed() with
    // the ticks of each refresh.
    void begin_lists(int thread) { threads_[thread].busy_in_all = team_.busy(thread); }
    void searched(int thread, double ticks) { threads_[thread].searched_for = ticks; }
    void end_lists(int thread) {
        threads_[thread].busy_before = team_.busy(thread);
        threads_[thread].busy_refreshing = 0;
    }
    void refreshed(int thread, double busy) { threads_[thread].busy_refreshing += busy; }

    // One thread calls the following functions for all threads. begin_search() comes before the search and
    // makes equal parts if the number of grains has changed. renew() comes after the search. share_out()
    // alone uses the speeds as they were noted last. `contacts` holds the number of contacts of each grain as
    // first body; it is not read if there is one thread.
    void begin_search(std::int32_t grains);
    void renew(const NeighbourList& pairs, const std::vector<std::int32_t>& contacts, std::int32_t grains);
    void share_out(const NeighbourList& pairs, const std::vector<std::int32_t>& contacts,
                   std::int32_t grains);
    // clear() is for a bed without grains. leave_out() takes rising indices of grains that leave. append()
    // adds grains after the last one.
    void clear() { share_.assign(team_.size() + 1, 0); }
    void leave_out(const std::vector<std::int32_t>& leavers);
    void append(std::int32_t grains) { share_.back() = grains; }
    bool empty() const { return share_.empty(); }

  private:
    void note_speeds();
    void share_search();

    struct alignas(64) Thread {
        // Work of its grains, and of their contacts, when they were shared out, in units of a grain without
        // contacts.
        double work = 0, contact_work = 0;
        // Ticks that it was busy: until the last lists, in all, and in refreshes since then.
        double busy_before = 0, busy_in_all = 0, busy_refreshing = 0;
        double speed = 1;         // speed lately, relative to the mean of all threads
        double searched_for = 0;  // ticks
    };

    const Team& team_;
    std::vector<Thread> threads_;
    Shares share_, last_share_;
    Shares search_share_, last_search_share_;
};

// Measures where a thread's time goes. It is off unless someone asks for it. It then reads the processor's
// counter several times for each chunk of contacts.

// neighbours: lists and cells. contacts: geometry and laws of pairs. gather: adding their forces to the
// grains' loads. walls: geometry, laws and loads of walls. integrate: kicks and drifts. other: waiting for
// threads, and the rest.
enum class Cost { neighbours, contacts, walls, gather, integrate, other };
constexpr int kCosts = 6;

class CostClock {
  public:
    // Sets all counts to zero.
    void clear() { spent_.fill(0); }
    void turn(bool on) { on_ = on; }
    void start() {
        if (on_) last_ = ticks();
    }
    // Adds the time since start() or the last lap() to `cost`.
    void lap(Cost cost) {
        if (!on_) return;
        const std::uint64_t now = ticks();
        spent_[static_cast<int>(cost)] += static_cast<double>(now - last_);
        last_ = now;
    }
    const std::array<double, kCosts>& spent() const { return spent_; }  // ticks of unknown length

  private:
    bool on_ = false;
    std::uint64_t last_ = 0;
    std::array<double, kCosts> spent_{};
};

}  // namespace grainreel
