// A card, as far as the bed on it (card_bed.hpp) needs one: memory, and kernels over a range of numbers.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <utility>

#include "engine/card/bed.hpp"
#include "engine/plan/plan.hpp"

namespace grainreel::card {

// What to compute for each number from 0 to `count`.
struct Kernel {
    enum class Work { move, count_evaluation, meet, sum };
    Work work;
    std::int32_t count;
    std::int32_t group = 0;  // of Work::meet, with its laws
    ContactModel model{};
    bool of_pairs = true;
};

class Device {
  public:
    Device() = default;
    Device(const Device&) = delete;
    Device& operator=(const Device&) = delete;
    virtual ~Device() = default;

    virtual void* allocate(std::size_t bytes) = 0;
    virtual void release(void* memory) = 0;
    virtual void send(void* to, const void* from, std::size_t bytes) = 0;
    virtual void get(void* to, const void* from, std::size_t bytes) = 0;
    // Kernels run one after the other. Unless `always`, a kernel does nothing once the contact lists have
    // expired.
    virtual void run(const Kernel& kernel, const Bed& bed, const Step& step, bool always) = 0;
    // How many evaluations are handed over at once.
    virtual std::size_t steps_ahead() const = 0;
};

// The processor as a card, for tests: its kernels are those of a card, and it is slow. Throws UserError if
// the processor cannot round a product and a sum once.
std::unique_ptr<Device> emulated_device();

// Whether there are kernels for these laws.
bool has_kernels(const ContactModel& model);

// An array in a card's memory, which grows.
template <class T>
class Array {
  public:
    explicit Array(Device& device) : device_(&device) {}
    Array(Array&& other) noexcept
        : device_(other.device_), data_(std::exchange(other.data_, nullptr)), room_(other.room_) {}
    Array& operator=(Array&&) = delete;
    ~Array() {
        if (data_) device_->release(data_);
    }
    T* data() const { return data_; }

    // Makes room for `count` values. They have none then.
    T* resize(std::size_t count) {
        if (count > room_ || !data_) {
            if (data_) device_->release(std::exchange(data_, nullptr));
            room_ = count + count / 8 + 1;
            data_ = static_cast<T*>(device_->allocate(room_ * sizeof(T)));
        }
        return data_;
    }
    template <class Values>
    T* send(const Values& values) {
        return send(values.data(), values.size());
    }
    template <class Value>
    T* send(const Value* values, std::size_t count) {
        static_assert(sizeof(Value) % sizeof(T) == 0);
        const std::size_t bytes = count * sizeof(Value);
        resize(bytes / sizeof(T));
        if (bytes > 0) device_->send(data_, values, bytes);
        return data_;
    }
    template <class Value>
    void get(Value* values, std::size_t count) const {
        if (count > 0) device_->get(values, data_, count * sizeof(Value));
    }

  private:
    Device* device_;
    T* data_ = nullptr;
    std::size_t room_ = 0;
};

}  // namespace grainreel::card
