// Several pieces of work at once, each on a thread of its own, while this one keeps watch.
#pragma once

#include <chrono>
#include <exception>
#include <functional>
#include <future>
#include <vector>

namespace grainreel {

// Returns when all have ended; calls `watch` now and then until then. Of several exceptions the first in
// order is thrown on.
inline void run_together(const std::vector<std::function<void()>>& works,
                         const std::function<void()>& watch) {
    constexpr auto glance = std::chrono::milliseconds(100);
    std::vector<std::future<void>> running;
    for (const auto& work : works) running.push_back(std::async(std::launch::async, work));
    std::exception_ptr problem;
    for (std::future<void>& one : running) {
        while (one.wait_for(glance) != std::future_status::ready) watch();
        try {
            one.get();
        } catch (...) {
            if (!problem) problem = std::current_exception();
        }
    }
    if (problem) std::rethrow_exception(problem);
}

}  // namespace grainreel
