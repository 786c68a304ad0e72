#include "engine/laws/law_kernel.hpp"

#include <algorithm>

#include "engine/base/error.hpp"

namespace grainreel {

// These are defined in double_kernels.cpp and mixed_kernels.cpp.
const LawKernel* double_kernel(const ContactModel& model);
const LawKernel* double_rolling_kernel();
const LawKernel* mixed_kernel(const ContactModel& model);
const LawKernel* mixed_rolling_kernel();

void LawParameters::add(double value) {
    constexpr double bound = 1e30;  // for infinite friction and similar values
    values.push_back(value);
    rounded.push_back(static_cast<float>(std::clamp(value, -bound, bound)));
}

const LawKernel& law_kernel(const ContactModel& model) {
    if (model.own) return *model.own;
    const LawKernel* kernel =
        model.precision == Precision::mixed ? mixed_kernel(model) : double_kernel(model);
    GRAINREEL_CHECK(kernel != nullptr);
    return *kernel;
}

const LawKernel& rolling_kernel(Precision precision) {
    return precision == Precision::mixed ? *mixed_rolling_kernel() : *double_rolling_kernel();
}

}  // namespace grainreel
