// The kernels in which all numbers are doubles.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "engine/laws/double_kernels.cpp"
#include "engine/vector/targets.hpp"
//
#include "engine/laws/list-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace grainreel::HWY_NAMESPACE {

const LawKernel* find_double(const ContactModel& model) {
    return kernel_at<Lanes>(model);
}

const LawKernel* find_double_rolling() {
    return &kernel_of_rolling<Lanes>();
}

}  // namespace grainreel::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace grainreel {

HWY_EXPORT(find_double);
HWY_EXPORT(find_double_rolling);

const LawKernel* double_kernel(const ContactModel& model) {
    return HWY_DYNAMIC_DISPATCH(find_double)(model);
}
const LawKernel* double_rolling_kernel() {
    return HWY_DYNAMIC_DISPATCH(find_double_rolling)();
}

}  // namespace grainreel
#endif
