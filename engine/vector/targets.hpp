// The instruction sets for which kernels are compiled: plain x86-64, SSE4, AVX2 and AVX-512. Other sets
// differ from these in nothing that we use. If HWY_TARGET_INCLUDE names a file, it is compiled once for each
// set.
#ifndef HWY_DISABLED_TARGETS
#define HWY_DISABLED_TARGETS (HWY_SSSE3 | HWY_AVX3_DL)
#endif
#ifdef HWY_TARGET_INCLUDE
#include <hwy/foreach_target.h>
#endif
