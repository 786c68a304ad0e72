// What number-inl.hpp and the formulas above it need of Highway where they are compiled for one number at a
// time: for a graphics card, or for the processor as a card that is emulated (engine/card). A file that
// defines GRAINREEL_CARD includes this in place of Highway.
#pragma once

#define HWY_NAMESPACE N_CARD
#define HWY_INLINE inline __attribute__((always_inline))
#define HWY_ATTR
#define HWY_ALIGN alignas(64)

// A product and a sum are rounded once. A card can do that; a processor may have to be told that it can.
#if defined(__CUDA__)
#define HWY_BEFORE_NAMESPACE() \
    _Pragma("clang force_cuda_host_device begin") static_assert(true, "a semicolon follows")
#define HWY_AFTER_NAMESPACE() \
    _Pragma("clang force_cuda_host_device end") static_assert(true, "a semicolon follows")
#elif defined(__x86_64__) && defined(__clang__)
#pragma clang diagnostic ignored "-Wpragma-clang-attribute"  // a header may have no functions
#define HWY_BEFORE_NAMESPACE()                                                                            \
    _Pragma("clang attribute push(__attribute__((target(\"fma\"))), apply_to = function)") static_assert( \
        true, "a semicolon follows")
#define HWY_AFTER_NAMESPACE() _Pragma("clang attribute pop") static_assert(true, "a semicolon follows")
#elif defined(__x86_64__)
#define HWY_BEFORE_NAMESPACE() \
    _Pragma("GCC push_options") _Pragma("GCC target(\"fma\")") static_assert(true, "a semicolon follows")
#define HWY_AFTER_NAMESPACE() _Pragma("GCC pop_options") static_assert(true, "a semicolon follows")
#else
#define HWY_BEFORE_NAMESPACE() static_assert(true, "a semicolon follows")
#define HWY_AFTER_NAMESPACE() static_assert(true, "a semicolon follows")
#endif
