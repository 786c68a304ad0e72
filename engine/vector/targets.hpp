// The instruction sets for which kernels are compiled: plain x86-64, SSE4, AVX2 and AVX-512, and NEON of
// ARM64. Other sets of x86 differ from these in nothing that we use. Those of ARM (SVE) have registers whose
// size is not known before the program runs. If HWY_TARGET_INCLUDE names a file, it is compiled once for each
// set.
#ifndef HWY_DISABLED_TARGETS
#define HWY_DISABLED_TARGETS (HWY_SSSE3 | HWY_AVX3_DL | HWY_SVE | HWY_SVE2 | HWY_SVE_256 | HWY_SVE2_128)
#endif
#ifdef HWY_TARGET_INCLUDE
#include <hwy/foreach_target.h>
#endif
