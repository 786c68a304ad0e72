// Laws in the form that the step loop calls: chunks of contacts (TouchChunk, ForceChunk), and for each
// combination of laws the functions that go through a chunk (LawKernel), in the vector code of the machine
// that the program runs on.
#pragma once

#include <cstddef>
#include <cstdint>
#include <type_traits>
#include <vector>

#include "engine/base/system/processor.hpp"
#include "engine/plan/plan.hpp"

namespace grainreel {

// Contacts go through a law a chunk at a time. A chunk is small enough for the first-level cache, and laid
// out so that a register takes several contacts at once.

constexpr int kBlock = 16;  // histories are kept in blocks of 16 contacts
constexpr int kChunk = 64;  // contacts in a chunk

// The bits of a chunk's first `count` contacts.
inline std::uint64_t bits_of_first(int count) {
    return count < kChunk ? (std::uint64_t{1} << count) - 1 : ~std::uint64_t{0};
}

// One number of each contact of a chunk: doubles, or floats on the way through a law of mixed precision.
union alignas(64) Row {
    double doubles[kChunk] = {};
    float floats[kChunk];

    template <class Number>
    Number* of() {
        if constexpr (std::is_same_v<Number, float>)
            return floats;
        else
            return doubles;
    }
    template <class Number>
    const Number* of() const {
        return const_cast<Row*>(this)->of<Number>();
    }
    double operator[](int c) const { return doubles[c]; }  // for observers, who get doubles
    // Gives one number, whether the row holds doubles or floats of `number_size` bytes.
    double get(int c, std::size_t number_size) const {
        return number_size == sizeof(float) ? floats[c] : doubles[c];
    }
    void set(int c, double value, std::size_t number_size) {
        if (number_size == sizeof(float))
            floats[c] = static_cast<float>(value);
        else
            doubles[c] = value;
    }
};

// Geometry and motion of each contact; see Touch for the meaning. Only the rows that the law asks for are
// set.
struct TouchChunk {
    Row normal[3];
    Row overlap;                 // m
    Row velocity[3];             // m/s, of i's surface relative to j's
    Row turn[3];                 // Cayley's vector: a pure number
    Row first_arm, second_arm;   // m, from the centres to where T acts
    Row inverse_distance;        // 1/m, of the centres of a pair
    Row inverse_mass;            // 1/kg, of the effective mass
    Row effective_radius;        // m
    std::uint64_t touching = 0;  // one bit for each contact: overlap > 0
    Ahead* ahead = nullptr;      // data to fetch while the chunk is worked on

    bool touches(int c) const { return touching >> c & 1; }
    [[gnu::always_inline]] inline void fetch_some() const {
        if (ahead) ahead->fetch_some();
    }
    // Whether any of `count` contacts from c on touches.
    bool any_touching(int c, int count) const {
        return (touching >> c & ((std::uint64_t{2} << (count - 1)) - 1)) != 0;
    }
};
static_assert(kChunk == 64, "a bit for each contact");

// The forces that the law computes; zero for contacts that do not touch.
struct ForceChunk {
    Row normal;         // N, on j along k
    Row tangential[3];  // N, on j
};

// Energies and powers of each contact for observers; see Energies for the meaning.
struct alignas(64) EnergyChunk {
    double stored[kChunk] = {}, sideways[kChunk] = {}, latched[kChunk] = {};  // J
    double damping[kChunk] = {}, rubbing[kChunk] = {};                        // W
};

// The motion of contacts that resist rolling, and the resulting torque.
struct RollingChunk {
    Row rate[3];    // rad/s, spin of i relative to j, without its part along k
    Row torque[3];  // N m, on j, the opposite on i
};

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
    bool at_mid_step =
        true;  // whether slip is perpendicular to the normal at the step's middle or, if not, at its end
    bool uses_mass, uses_radius;
    LawParameters (*parameters)(const std::vector<PairPlan>& kinds);

    // `history` is laid out in blocks of kBlock contacts, and within a block number by number. It is set to
    // zero for contacts that do not touch. Each number in a chunk has `number_size` bytes. step_one_kind() is
    // for contacts that are all of one kind, and gives the same bits in less time. (With a large grain among
    // small ones, nearly all chunks are of one kind, and take a tenth less time.)
    void (*step)(const LawInput& in, void* history, ForceChunk& out);
    void (*step_one_kind)(const LawInput& in, void* history, ForceChunk& out);
    // Gives forces and energies at the present instant, without a step, from the present velocities. Chunks
    // hold doubles. Resistance to rolling adds to the energies of its law.
    void (*observe)(const LawInput& in, const void* history, ForceChunk& out, EnergyChunk& energy);
};

// The one place where laws are chosen at run time. It ignores model.rolls, because rolling_kernel() runs in
// addition.
const LawKernel& law_kernel(const ContactModel& model);
// The resistance to rolling. It runs after the law, and uses the normal force that the law has put into
// `out`.
const LawKernel& rolling_kernel(Precision precision);

}  // namespace grainreel
