// A queue that hands items from one thread to the next, in order. It never holds more than `capacity` items.
#pragma once

#include <chrono>
#include <condition_variable>
#include <cstddef>
#include <deque>
#include <mutex>
#include <optional>
#include <utility>

namespace grainreel {

template <class Item>
class BoundedQueue {
  public:
    // With a patience of 0 both sides work at the same time. Otherwise they take turns, which is faster where
    // they share processors. Items come out once the queue is full, or once no item has come in for as long
    // as the patience. Items go in again once the queue is empty.
    explicit BoundedQueue(std::size_t capacity, std::chrono::milliseconds patience = {})
        : capacity_(capacity), patience_(patience) {}

    // Waits for a place. Returns false when the queue is closed; the item is then lost.
    bool push(Item item) {
        {
            std::unique_lock lock(mutex_);
            place_.wait(lock, [&] { return closed_ || (items_.size() < capacity_ && !emptying_); });
            if (closed_) return false;
            items_.push_back(std::move(item));
        }
        item_.notify_one();
        return true;
    }

    // Waits for an item. Gives none when the queue is closed and empty.
    std::optional<Item> pop() {
        std::optional<Item> item;
        {
            std::unique_lock lock(mutex_);
            wait_for_items(lock);
            if (items_.empty()) return item;
            item = std::move(items_.front());
            items_.pop_front();
            emptying_ = patience_.count() > 0 && !items_.empty();
        }
        place_.notify_one();
        return item;
    }

    // Nothing more goes in; what is inside can still be taken out.
    void close() {
        {
            const std::scoped_lock lock(mutex_);
            closed_ = true;
        }
        place_.notify_all();
        item_.notify_all();
    }

    // Closes and throws away what is inside.
    void cancel() {
        {
            const std::scoped_lock lock(mutex_);
            closed_ = true;
            items_.clear();
        }
        place_.notify_all();
        item_.notify_all();
    }

  private:
    void wait_for_items(std::unique_lock<std::mutex>& lock) {
        if (emptying_) return;
        std::size_t there = 0;
        do {  // each new item renews the patience
            item_.wait(lock, [&] { return closed_ || items_.size() > there; });
            there = items_.size();
        } while (patience_.count() > 0 && !closed_ && there < capacity_ &&
                 item_.wait_for(lock, patience_, [&] { return closed_ || items_.size() > there; }));
    }

    const std::size_t capacity_;
    const std::chrono::milliseconds patience_;
    std::mutex mutex_;
    std::condition_variable place_, item_;
    std::deque<Item> items_;
    bool closed_ = false, emptying_ = false;
};

}  // namespace grainreel
