// What a contact law is told of a touching pair (or of a grain and a wall), all at consistent time levels:
// geometry and velocities at the end of the step, slip and turn over the step.
#if defined(GRAINREEL_LAWS_TOUCH_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef GRAINREEL_LAWS_TOUCH_INL
#undef GRAINREEL_LAWS_TOUCH_INL
#else
#define GRAINREEL_LAWS_TOUCH_INL
#endif

#include "engine/vector/lanes-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace grainreel::HWY_NAMESPACE {

template <class R>
struct Touch {
    Triple<R> normal;    // unit k, from grain i to grain j, or from the grain to the wall
    R overlap;           // m, > 0
    R inverse_mass;      // 1/kg, of the effective mass; set only for laws that use it
    R effective_mass;    // kg; as above
    R effective_radius;  // m; as above
    R closing_speed;     // m/s, k . (v_i - v_j), > 0 when approaching; set only for laws that use velocity
    Triple<R> slip;      // m, of i over j at the contact during this step; set only for laws that rub
    Triple<R> turn;      // Cayley's vector, tan(angle / 2) along the axis, of the contact's turn during this
                         // step: as k has turned, and about k by the mean of the two bodies; as above
    Triple<R> slip_velocity;  // m/s; set only for laws that rub and have a dashpot
    R step;                   // s, between two forces; set only for laws that use velocity
};

// What an observer is told of a contact's energy.
template <class R>
struct Energies {
    R stored;    // J, that it would give back if it were unloaded
    R sideways;  // J, the part of it in tangential and rolling springs
    R latched;   // J, that latching has taken since the bodies met, if they were unloaded now
    R damping;   // W, into the normal dashpot
    R rubbing;   // W, that slip and rolling put into springs, friction and tangential dashpots
};

}  // namespace grainreel::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
