// Compiles the file named HWY_TARGET_INCLUDE once for each instruction set we serve: the plain one of every
// x86-64, SSE4, AVX2 and AVX-512. Those left out differ from these in nothing we use.
#ifndef HWY_DISABLED_TARGETS
#define HWY_DISABLED_TARGETS (HWY_SSSE3 | HWY_AVX3_DL)
#endif
#include <hwy/foreach_target.h>
