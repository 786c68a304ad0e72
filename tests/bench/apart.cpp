// How long what one processor writes takes to be seen by another: two threads answer each other through two
// lines of memory. Prints ns one way, the median of nine times. On a virtual machine it changes as the host
// moves its processors: 25 ns within a chip, 250 ns between two.
#include <algorithm>
#include <array>
#include <atomic>
#include <chrono>
#include <cstdio>
#include <thread>

namespace {

struct alignas(64) Line {
    std::atomic<int> number{0};
};

double one_way() {
    constexpr int kTurns = 20'000;
    Line call, answer;
    const auto begin = std::chrono::steady_clock::now();
    std::thread other([&] {
        for (int turn = 1; turn <= kTurns; ++turn) {
            while (call.number.load(std::memory_order_acquire) != turn) {
            }
            answer.number.store(turn, std::memory_order_release);
        }
    });
    for (int turn = 1; turn <= kTurns; ++turn) {
        call.number.store(turn, std::memory_order_release);
        while (answer.number.load(std::memory_order_acquire) != turn) {
        }
    }
    other.join();
    const std::chrono::duration<double, std::nano> passed = std::chrono::steady_clock::now() - begin;
    return passed.count() / kTurns / 2;
}

}  // namespace

int main() {
    std::array<double, 9> times;
    for (double& time : times) time = one_way();
    std::sort(times.begin(), times.end());
    std::printf("%.0f\n", times[times.size() / 2]);
}
