// Tests of the queue between the threads of a film.
#include "render/film/production/bounded_queue.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <memory>
#include <thread>

namespace grainreel {
namespace {

// Pushes 0 to count - 1 and counts the items that are in the queue.
std::thread producer_of(BoundedQueue<int>& queue, int count, std::atomic<int>& in) {
    return std::thread([&queue, count, &in] {
        for (int i = 0; i < count; ++i) {
            ASSERT_TRUE(queue.push(i));
            ++in;
        }
        queue.close();
    });
}

TEST(BoundedQueue, KeepsOrderAndNeverHoldsMoreThanItsCapacity) {
    constexpr int count = 20'000, capacity = 3;
    BoundedQueue<int> queue(capacity);
    std::atomic<int> in = 0;
    std::thread producer = producer_of(queue, count, in);
    int out = 0, most = 0;
    while (const std::optional<int> item = queue.pop()) {
        ASSERT_EQ(*item, out++);
        most = std::max(most, in - out);  // items that are surely in the queue and not yet taken out
        if (out % 1000 == 0) std::this_thread::yield();
    }
    producer.join();
    EXPECT_EQ(out, count);
    EXPECT_LE(most, capacity);
}

TEST(BoundedQueue, CloseLetsOutWhatIsInsideAndTakesNothingMore) {
    BoundedQueue<int> queue(3);
    queue.push(1);
    queue.push(2);
    queue.close();
    EXPECT_FALSE(queue.push(3));
    EXPECT_EQ(queue.pop(), 1);
    EXPECT_EQ(queue.pop(), 2);
    EXPECT_EQ(queue.pop(), std::nullopt);
}

TEST(BoundedQueue, CancelThrowsAwayWhatIsInsideAndWakesBothSides) {
    BoundedQueue<std::unique_ptr<int>> full(1), empty(1);
    full.push(std::make_unique<int>(1));
    std::thread producer([&] { EXPECT_FALSE(full.push(std::make_unique<int>(2))); });
    std::thread consumer([&] { EXPECT_EQ(empty.pop(), std::nullopt); });
    full.cancel();
    empty.cancel();
    producer.join();
    consumer.join();
    EXPECT_EQ(full.pop(), std::nullopt);
}

// Items come out in turns: each turn begins with a full queue, and no item goes in until it is empty.
TEST(BoundedQueue, TakesTurns) {
    constexpr int count = 1000, capacity = 4;
    BoundedQueue<int> queue(capacity, std::chrono::hours(1));
    std::atomic<int> in = 0;
    std::thread producer = producer_of(queue, count, in);
    for (int out = 0; out < count; ++out) {
        ASSERT_EQ(queue.pop(), out);
        // Within a turn, only items of this turn and earlier ones have gone in.
        if (out % capacity < capacity - 1) {
            ASSERT_LE(in, out / capacity * capacity + capacity);
        }
    }
    producer.join();
    EXPECT_EQ(queue.pop(), std::nullopt);
}

TEST(BoundedQueue, ATurnDoesNotWaitForeverForAFullQueue) {
    BoundedQueue<int> queue(100, std::chrono::milliseconds(1));
    queue.push(1);
    queue.push(2);
    EXPECT_EQ(queue.pop(), 1);
    EXPECT_EQ(queue.pop(), 2);
    queue.push(3);
    EXPECT_EQ(queue.pop(), 3);
    queue.push(4);
    queue.close();
    EXPECT_EQ(queue.pop(), 4);
    EXPECT_EQ(queue.pop(), std::nullopt);
}

}  // namespace
}  // namespace grainreel
