// What is wanted soon of arrays larger than the caches, fetched to the second level a few lines at a time
// between other work: the processor has room for some 16 lines under way, and waits when it is asked for
// more.
#pragma once

#include <array>
#include <cstdint>

namespace grainreel {

class Ahead {
  public:
    // Nothing to fetch; what is added then comes within so many calls of fetch_some().
    void start(int calls) {
        count_ = 0;
        calls_ = calls;
    }
    template <class Array>
    void add(const Array& array, std::int32_t begin, std::int32_t end) {
        Stretch& s = stretches_[count_++];
        s.next = reinterpret_cast<std::uintptr_t>(array.data() + begin) / kLine * kLine;
        s.end = reinterpret_cast<std::uintptr_t>(array.data() + end);
        s.each = ((s.end - s.next) / kLine / calls_ + 1) * kLine;
    }
    // (Inlined by force: GCC 12 takes a function that only prefetches for one without effect, and leaves out
    // its calls.)
    [[gnu::always_inline]] inline void fetch_some() {
        for (int k = 0; k < count_; ++k) {
            Stretch& s = stretches_[k];
            const std::uintptr_t last = s.next + s.each < s.end ? s.next + s.each : s.end;
            for (; s.next < last; s.next += kLine)
                __builtin_prefetch(reinterpret_cast<const void*>(s.next), 0, 2);
        }
    }

  private:
    static constexpr std::uintptr_t kLine = 64;
    struct Stretch {
        std::uintptr_t next, end, each;
    };
    std::array<Stretch, 4> stretches_{};
    int count_ = 0;
    std::uintptr_t calls_ = 1;
};

}  // namespace grainreel
