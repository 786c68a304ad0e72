// A combination of laws as the step loop sees it: functions over chunks of contacts, in the vector code of
// the machine it runs on.
#pragma once

#include <cstdint>
#include <type_traits>
#include <vector>

#include "engine/laws/touch_chunk.hpp"
#include "engine/plan/plan.hpp"

namespace grainreel {

// Parameters of all kinds of contact: of kind k, number p is values[p * kinds + k].
struct LawParameters {
    std::vector<double> values;
    std::vector<float> rounded;  // the same, held within what floats can multiply
    int kinds = 0;

    void add(double value);
    template <class Number>
    const Number* numbers() const {
        if constexpr (std::is_same_v<Number, float>)
            return rounded.data();
        else
            return values.data();
    }
};

struct LawInput {
    int count;  // of contacts, at most kChunk; rounded up to a multiple of kBlock all can be read
    const TouchChunk* touch;
    const std::int32_t* kind;  // of each contact; not read by step_one_kind where parameters have one kind
    const LawParameters* parameters;
    double step;            // s, between the last forces and these
    double ahead;           // steps from the known velocity to the time of the force
    int history_stride;     // numbers a contact that the history has for all laws together
    RollingChunk* rolling;  // read and written by the resistance to rolling only
};

struct LawKernel {
    int history_size;         // numbers a contact, all zero for a new one
    std::size_t number_size;  // bytes of each: 8, or 4 with mixed precision
    std::vector<bool> turns;  // of each: changes sign when the bodies change places
    bool rubs;                // asks for spin, twist and arms
    bool rolls;               // asks for the rolling motion
    bool uses_velocity;       // asks for velocity; so does a law that rubs
    bool at_mid_step = true;  // slip is across the normal of the step's middle; if not, of its end
    bool uses_mass, uses_radius;
    LawParameters (*parameters)(const std::vector<PairPlan>& kinds);

    // `history`: in blocks of kBlock contacts, within a block number by number. Zeroed where nothing touches.
    // Chunks hold numbers of number_size. step_one_kind() is for contacts that are all of one kind: it gives
    // the same bits in less time. (A large grain among small ones: nearly all chunks are of one kind, and
    // take a tenth less time so.)
    void (*step)(const LawInput& in, void* history, ForceChunk& out);
    void (*step_one_kind)(const LawInput& in, void* history, ForceChunk& out);
    // Forces and energies as they stand, without a step; velocities are those of now. Chunks hold doubles.
    // Resistance to rolling adds to the energies of its law.
    void (*observe)(const LawInput& in, const void* history, ForceChunk& out, EnergyChunk& energy);
};

// The one place where laws are chosen at run time. `model` without its rolling, which comes on top.
const LawKernel& law_kernel(const ContactModel& model);
// Resistance to rolling: runs after the law, on the normal force that this has put into `out`.
const LawKernel& rolling_kernel(Precision precision);

}  // namespace grainreel
