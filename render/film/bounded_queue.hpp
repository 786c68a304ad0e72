// Hands items from one thread to the next, in order, never more than `capacity` at a time.
#pragma once

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
    explicit BoundedQueue(std::size_t capacity) : capacity_(capacity) {}

    // Waits for a place. False, and the item is gone, when the queue is closed.
    bool push(Item item) {
        {
            std::unique_lock lock(mutex_);
            place_.wait(lock, [&] { return closed_ || items_.size() < capacity_; });
            if (closed_) return false;
            items_.push_back(std::move(item));
        }
        item_.notify_one();
        return true;
    }

    // Waits for an item; none when the queue is closed and empty.
    std::optional<Item> pop() {
        std::optional<Item> item;
        {
            std::unique_lock lock(mutex_);
            item_.wait(lock, [&] { return closed_ || !items_.empty(); });
            if (items_.empty()) return item;
            item = std::move(items_.front());
            items_.pop_front();
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
    const std::size_t capacity_;
    std::mutex mutex_;
    std::condition_variable place_, item_;
    std::deque<Item> items_;
    bool closed_ = false;
};

}  // namespace grainreel
