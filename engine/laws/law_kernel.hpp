// A combination of laws in the form that the step loop calls: functions over chunks of contacts, in the
// vector code of the machine that the program runs on.
#pragma once

#include <cstdint>
#include <type_traits>
#include <vector>

#include "engine/laws/touch_chunk.hpp"
#include "engine/plan/plan.hpp"

namespace grainreel {

// Parameters of all kinds of contact. Parameter p of kind k is values[p * kinds + k].
struct LawParameters {
    std::vector<double> values;
    std::vector<float> rounded;  // the same values, bounded so that their products fit floats
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
    int count;  // number of contacts, at most kChunk; arrays can be read up to a multiple of kBlock
    const TouchChunk* touch;
    const std::int32_t*
        kind;  // kind of each contact; not read by step_one_kind where parameters have one kind
    const LawParameters* parameters;
    double step;            // s, between the last forces and these
    double ahead;           // steps from the known velocity to the time of the force
    int history_stride;     // numbers per contact in the history, for all laws together
    RollingChunk* rolling;  // read and written by the resistance to rolling only
};

struct LawKernel {
    int history_size;         // numbers per contact; all are zero for a new contact
    std::size_t number_size;  // bytes of a number: 8, or 4 with mixed precision
    std::vector<bool> turns;  // whether each number changes sign when the bodies swap places
    bool rubs;                // whether the law reads spin, twist and arms
    bool rolls;               // whether the law reads the rolling motion
    bool uses_velocity;       // whether the law reads velocity; a law that rubs reads it too
    bool at_mid_step = true;  // whether slip is across the normal at the step's middle, not at its end
    bool uses_mass, uses_radius;
    LawParameters (*parameters)(const std::vector<PairPlan>& kinds);

    // `history` stands in blocks of kBlock contacts, and within a block number by number. It is set to zero
    // for contacts that do not touch. Chunks hold numbers of number_size. step_one_kind() is for contacts
    // that are all of one kind, and gives the same bits in less time. (With a large grain among small ones,
    // nearly all chunks are of one kind, and take a tenth less time.)
    void (*step)(const LawInput& in, void* history, ForceChunk& out);
    void (*step_one_kind)(const LawInput& in, void* history, ForceChunk& out);
    // Gives forces and energies at the present instant, without a step, from the present velocities. Chunks
    // hold doubles. Resistance to rolling adds to the energies of its law.
    void (*observe)(const LawInput& in, const void* history, ForceChunk& out, EnergyChunk& energy);
};

// The one place where laws are chosen at run time. The rolling of `model` is ignored, because
// rolling_kernel() comes on top.
const LawKernel& law_kernel(const ContactModel& model);
// The resistance to rolling. It runs after the law, and uses the normal force that the law has put into
// `out`.
const LawKernel& rolling_kernel(Precision precision);

}  // namespace grainreel
