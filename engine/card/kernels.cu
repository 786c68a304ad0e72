// The kernels of a card. clang makes PTX of them without a toolkit of NVIDIA's; tests/card/ptx_test.py has
// the options. The emulated device calls the same functions in loops (emulated_device.cpp).
#define GRAINREEL_CARD
#include "engine/vector/one_number.hpp"

#include "engine/card/grain-inl.hpp"
#include "engine/card/laws.hpp"

#define GRAINREEL_KERNEL extern "C" __attribute__((global)) void

namespace grainreel::N_CARD {

// The number that this thread is to compute, or `count` once the contact lists have expired.
__attribute__((device)) inline std::int32_t number_of_thread(const Bed& bed, bool always,
                                                             std::int32_t count) {
    const std::int32_t i = static_cast<std::int32_t>(__nvvm_read_ptx_sreg_ctaid_x()) *
                               static_cast<std::int32_t>(__nvvm_read_ptx_sreg_ntid_x()) +
                           static_cast<std::int32_t>(__nvvm_read_ptx_sreg_tid_x());
    return always || bed.status->expired == 0 ? i : count;
}

}  // namespace grainreel::N_CARD

using namespace grainreel::N_CARD;

GRAINREEL_KERNEL move_grains(Bed bed, Step step, std::int32_t count, bool always) {
    const std::int32_t i = number_of_thread(bed, always, count);
    if (i < count) move_grain(bed, step, i);
}
GRAINREEL_KERNEL count_once(Bed bed, Step step, std::int32_t count, bool always) {
    const std::int32_t i = number_of_thread(bed, always, count);
    if (i < count) count_evaluation(bed, step);
}
GRAINREEL_KERNEL sum_grains(Bed bed, Step step, std::int32_t count, bool always) {
    const std::int32_t i = number_of_thread(bed, always, count);
    if (i < count) sum_grain(bed, step, i);
}

#define X(normal_law, tangential_law, Normal, Tangential)                                            \
    GRAINREEL_KERNEL pairs_##normal_law##_##tangential_law(Bed bed, Step step, std::int32_t count,   \
                                                           bool always, std::int32_t group) {        \
        const std::int32_t i = number_of_thread(bed, always, count);                                 \
        if (i < count) meet<LawPair<Normal, Tangential>, PairMeets>(bed, bed.group[group], step, i); \
    }                                                                                                \
    GRAINREEL_KERNEL walls_##normal_law##_##tangential_law(Bed bed, Step step, std::int32_t count,   \
                                                           bool always, std::int32_t group) {        \
        const std::int32_t i = number_of_thread(bed, always, count);                                 \
        if (i < count) meet<LawPair<Normal, Tangential>, WallMeets>(bed, bed.group[group], step, i); \
    }
GRAINREEL_CARD_LAWS(X)
#undef X
