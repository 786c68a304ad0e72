// What kernels of geometry need beside their formulas to go through the rows of a chunk.
#if defined(GRAINREEL_STEP_ROWS_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef GRAINREEL_STEP_ROWS_INL
#undef GRAINREEL_STEP_ROWS_INL
#else
#define GRAINREEL_STEP_ROWS_INL
#endif

#include "engine/laws/row-inl.hpp"
#include "engine/step/geometry/turn-inl.hpp"
#include "engine/step/grid/places-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace grainreel::HWY_NAMESPACE {

// The number of contacts together with the copies that fill the last block. Laws may read these copies, so
// whether they touch is computed for them too.
HWY_INLINE int whole_blocks(int count) {
    return (count + kBlock - 1) / kBlock * kBlock;
}

}  // namespace grainreel::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
