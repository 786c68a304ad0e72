// The input of a contact law for a touching pair, or for a grain and a wall. The time levels are consistent:
// geometry and velocities belong to the end of the step, slip and turn to the whole step.
#if defined(GRAINREEL_LAWS_TOUCH_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef GRAINREEL_LAWS_TOUCH_INL
#undef GRAINREEL_LAWS_TOUCH_INL
#else
#define GRAINREEL_LAWS_TOUCH_INL
#endif

#include "engine/vector/number-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace grainreel::HWY_NAMESPACE {

template <class R>
struct Touch {
    Triple<R> normal;    // unit k, from grain i to grain j, or from the grain to the wall
    R overlap;           // m, > 0
    R inverse_mass;      // 1/kg, of the effective mass; set only for laws that use it
    R effective_mass;    // kg; set only for laws that use it
    R effective_radius;  // m; set only for laws that use it
    R closing_speed;     // m/s, k . (v_i - v_j), > 0 when approaching; set only for laws that use velocity
    Triple<R> slip;      // m, of i relative to j at the contact during this step; set only for laws that rub
    Triple<R>
        turn;  // Cayley's vector, tan(angle / 2) along the axis, of the contact's turn during this step: the
               // turn of k, and the mean turn of the two bodies about k; set only for laws that rub
    Triple<R> slip_velocity;  // m/s; set only for laws that rub and have a dashpot
    R step;                   // s, between two forces; set only for laws that use velocity
};

// The energies and powers of a contact that an observer gets.
template <class R>
struct ContactEnergies {
    R stored;    // J, energy that the contact would give back if it were unloaded
    R sideways;  // J, the part of it in tangential and rolling springs
    R latched;   // J, energy lost in the latching spring since the bodies met, if they were unloaded now
    R damping;   // W, lost in the normal dashpot
    R rubbing;   // W, that slip and rolling put into springs, friction and tangential dashpots
};

}  // namespace grainreel::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
