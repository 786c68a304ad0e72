// The instruction sets we serve: the plain one of every x86-64, SSE4, AVX2 and AVX-512. Those left out differ
// from these in nothing we use. Compiles the file named HWY_TARGET_INCLUDE, if any, once for each.
#ifndef HWY_DISABLED_TARGETS
#define HWY_DISABLED_TARGETS (HWY_SSSE3 | HWY_AVX3_DL)
#endif
#ifdef HWY_TARGET_INCLUDE
#include <hwy/foreach_target.h>
#endif
