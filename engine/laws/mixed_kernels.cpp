// The kernels whose laws and histories are in floats, so that a register holds twice as many numbers.
// Positions and sums of forces stay doubles; overlaps are computed from doubles and then rounded. The file is
// compiled once for each instruction set. A new law goes into list-inl.hpp; nothing changes here.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "engine/laws/mixed_kernels.cpp"
#include "engine/vector/targets.hpp"
//
#include "engine/laws/list-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace grainreel::HWY_NAMESPACE {

const LawKernel* find_mixed(const ContactModel& model) {
    return kernel_at<FloatLanes>(model);
}

const LawKernel* find_mixed_rolling() {
    return &kernel_of_rolling<FloatLanes>();
}

}  // namespace grainreel::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace grainreel {

HWY_EXPORT(find_mixed);
HWY_EXPORT(find_mixed_rolling);

const LawKernel* mixed_kernel(const ContactModel& model) {
    return HWY_DYNAMIC_DISPATCH(find_mixed)(model);
}
const LawKernel* mixed_rolling_kernel() {
    return HWY_DYNAMIC_DISPATCH(find_mixed_rolling)();
}

}  // namespace grainreel
#endif
