// A vector whose memory, when it is large, comes in pages of 2 MiB where the system has them: arrays of a
// large bed are read at many places at once, and the processor finds few small pages without looking them up
// in memory. 5 to 10 % of a step of a million grains (docs/notes/performance.md).
#pragma once

#include <cstddef>
#include <cstdlib>
#include <new>
#include <vector>

#if defined(__linux__)
#include <sys/mman.h>
#endif

namespace grainreel {

template <class T>
struct LargePages {
    using value_type = T;
    static constexpr std::size_t kPage = std::size_t{2} << 20, kLarge = 2 * kPage;  // bytes

    LargePages() = default;
    template <class U>
    LargePages(const LargePages<U>&) {}

    T* allocate(std::size_t count) {
        const std::size_t bytes = count * sizeof(T);
        if (bytes < kLarge) return static_cast<T*>(::operator new(bytes, std::align_val_t(alignof(T))));
        const std::size_t whole = (bytes + kPage - 1) / kPage * kPage;
        void* memory = std::aligned_alloc(kPage, whole);
        if (!memory) throw std::bad_alloc();
#if defined(MADV_HUGEPAGE)
        madvise(memory, whole, MADV_HUGEPAGE);  // a hint: where it is refused, small pages do
#endif
        return static_cast<T*>(memory);
    }
    void deallocate(T* memory, std::size_t count) {
        if (count * sizeof(T) < kLarge)
            ::operator delete(memory, std::align_val_t(alignof(T)));
        else
            std::free(memory);
    }
    friend bool operator==(const LargePages&, const LargePages&) {
        return true;
    }
};

template <class T>
using LargeArray = std::vector<T, LargePages<T>>;

}  // namespace grainreel
