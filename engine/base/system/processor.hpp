// What the step loop asks of the processor: large pages of memory, prefetching, no denormal numbers, and its
// clock. They are there for speed, and only one of them touches results: with laws of floats, denormal
// numbers count as zero. Keep this header light: hot code includes it.
#pragma once

#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <new>
#include <vector>

#if defined(__linux__)
#include <sys/mman.h>
#endif
#if defined(__SSE2__)
#include <xmmintrin.h>
#endif

namespace grainreel {

// Allocates the memory of LargeArray, in pages of 2 MiB if the array is large and the system has such pages.
// The step loop reads arrays of a large bed at many places at once, and the processor remembers the addresses
// of only a few pages. This saves 5 to 10 % of a step of a million grains (docs/notes/performance.md).
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
        madvise(memory, whole, MADV_HUGEPAGE);  // a hint; where the system refuses it, pages are small
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

// Fetches a cache line that will be written, so that another processor that has the line gives it up. (GCC's
// __builtin_prefetch does this only when it compiles for processors later than 2014.)
[[gnu::always_inline]] inline void fetch_to_write(const void* at) {
#if defined(__x86_64__)
    asm volatile("prefetchw %0" : : "m"(*static_cast<const char*>(at)));
#else
    __builtin_prefetch(at, 1);
#endif
}

// Fetches parts of large arrays into the second-level cache, a few lines at a time between other work. The
// processor can have some 16 lines under way, and waits when it is asked for more.
class Ahead {
  public:
    // Begins with nothing to fetch. Whatever is added later is fetched within `calls` calls of fetch_some().
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
    // (It must be inlined: GCC 12 believes that a function which only prefetches has no effect, and leaves
    // out its calls.)
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

// While this lives, denormal numbers (those too small for full precision) count as zero in this thread, if
// the processor can do that. A processor needs a hundred times as long for them, and grains at rest make many
// in single precision. In double precision the step loop lets none arise (kNoMotion), so that its bits do not
// depend on this.
class FlushDenormals {
  public:
    explicit FlushDenormals(bool on = true) : before_(control()) {
        if (on) set_control(before_ | to_zero);
    }
    ~FlushDenormals() { set_control(before_); }
    FlushDenormals(const FlushDenormals&) = delete;
    FlushDenormals& operator=(const FlushDenormals&) = delete;

  private:
#if defined(__SSE2__)
    using Control = unsigned;
    static constexpr Control to_zero = 0x8000 | 0x0040;  // results and inputs
    static Control control() {
        return _mm_getcsr();
    }
    static void set_control(Control word) {
        _mm_setcsr(word);
    }
#elif defined(__aarch64__)
    using Control = std::uint64_t;
    static constexpr Control to_zero = Control{1} << 24;  // FZ: results and inputs
    static Control control() {
        Control word;
        asm volatile("mrs %0, fpcr" : "=r"(word));
        return word;
    }
    static void set_control(Control word) {
        asm volatile("msr fpcr, %0" : : "r"(word));
    }
#else
    using Control = unsigned;
    static constexpr Control to_zero = 0;
    static Control control() {
        return 0;
    }
    static void set_control(Control) {}
#endif
    Control before_;
};

// The processor's own clock. It is cheap to read, but the length of a tick is not known, so it only tells how
// times compare.
inline std::uint64_t ticks() {
#if defined(__x86_64__)
    return __builtin_ia32_rdtsc();
#else
    return static_cast<std::uint64_t>(std::chrono::steady_clock::now().time_since_epoch().count());
#endif
}

}  // namespace grainreel
