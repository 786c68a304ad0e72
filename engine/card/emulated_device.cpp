// The processor as a card: kernels are loops.
#define GRAINREEL_CARD
#include <cstdlib>
#include <cstring>

#include "engine/base/error.hpp"
#include "engine/card/device.hpp"
#include "engine/card/grain-inl.hpp"
#include "engine/card/laws.hpp"

HWY_BEFORE_NAMESPACE();
namespace grainreel::HWY_NAMESPACE {

template <class Law, class Meets>
void meet_all(const Bed& bed, const Group& group, const Step& step, std::int32_t count) {
    for (std::int32_t place = 0; place < count; ++place) meet<Law, Meets>(bed, group, step, place);
}

// Calls the kernel of the laws; returns whether there is one.
bool meet_by(const ContactModel& model, bool of_pairs, const Bed& bed, const Group* group, const Step& step,
             std::int32_t count) {
#define X(normal_law, tangential_law, Normal, Tangential)                                               \
    if (model.normal == NormalForce::normal_law && model.tangential == TangentialLaw::tangential_law) { \
        using Law = LawPair<Normal, Tangential>;                                                        \
        if (group)                                                                                      \
            of_pairs ? meet_all<Law, PairMeets>(bed, *group, step, count)                               \
                     : meet_all<Law, WallMeets>(bed, *group, step, count);                              \
        return true;                                                                                    \
    }
    GRAINREEL_CARD_LAWS(X)
#undef X
    return false;
}

void emulate(const card::Kernel& kernel, const Bed& bed, const Step& step) {
    using Work = card::Kernel::Work;
    if (kernel.work == Work::meet)
        meet_by(kernel.model, kernel.of_pairs, bed, bed.group + kernel.group, step, kernel.count);
    for (std::int32_t i = 0; kernel.work == Work::move && i < kernel.count; ++i) move_grain(bed, step, i);
    for (std::int32_t i = 0; kernel.work == Work::sum && i < kernel.count; ++i) sum_grain(bed, step, i);
    if (kernel.work == Work::count_evaluation) count_evaluation(bed, step);
}

}  // namespace grainreel::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

namespace grainreel::card {

namespace {

class EmulatedDevice : public Device {
  public:
    void* allocate(std::size_t bytes) override {
        void* const memory = std::malloc(bytes);
        if (!memory) throw std::bad_alloc();
        std::memset(memory, 0xff, bytes);  // nothing may rely on zeros
        return memory;
    }
    void release(void* memory) override { std::free(memory); }
    void send(void* to, const void* from, std::size_t bytes) override { std::memcpy(to, from, bytes); }
    void get(void* to, const void* from, std::size_t bytes) override { std::memcpy(to, from, bytes); }
    void run(const Kernel& kernel, const Bed& bed, const Step& step, bool always) override {
        if (always || !bed.status->expired) HWY_NAMESPACE::emulate(kernel, bed, step);
    }
    std::size_t steps_ahead() const override { return 7; }
};

bool can_fuse() {
#if defined(__x86_64__)
    return __builtin_cpu_supports("fma");
#else
    return true;
#endif
}

}  // namespace

std::unique_ptr<Device> emulated_device() {
    if (!can_fuse())
        throw UserError(
            "a card cannot be emulated here: the processor has no fused multiply-add (FMA); compute "
            "on the processor");
    return std::make_unique<EmulatedDevice>();
}

bool has_kernels(const ContactModel& model) {
    return HWY_NAMESPACE::meet_by(model, true, {}, nullptr, {}, 0);
}

}  // namespace grainreel::card
