// The bed as a card's memory holds it. Kernels get these structs as they lie in memory, so they are plain.
//
// Contacts lie in places. First come those of the processor's table (contact_table.hpp), at the same places
// and with histories in the same blocks, then the candidates, of which each may become a contact at its
// place. `state` says what a place holds. The order of a grain's sums does not depend on the places: each
// grain has lists of its own.
#pragma once

#include <cstdint>

namespace grainreel::card {

enum PlaceState : std::uint8_t {
    kEmpty,    // nothing, or a candidate that is in the table already
    kWaits,    // a candidate
    kParted,   // a contact that does not touch
    kTouches,  // a contact that touches
};

// The numbers of a contact's pushes: force on the second body, torque that the first loses, torque that the
// second gains. At a wall the first of the last three is the work that it does.
constexpr int kPushNumbers = 9;

// Lists of contacts by grain: those of grain i are at[start[i]] up to at[start[i + 1]]. An entry is 2 x
// place, + 1 where the grain is the second body.
struct ByGrain {
    const std::int32_t *start, *at;
};

struct Group {
    std::int32_t places, begin_of_candidates;
    std::int32_t kinds, row_species;  // of the parameters; species in a row of `row`
    std::int32_t history_size, law_history_size;
    bool of_pairs, rubs, rolls, uses_radius, at_mid_step;
    const double *parameters, *rolling_parameters;
    const std::int32_t *row, *first, *second;
    std::uint8_t* state;
    std::int32_t* began;  // the evaluation since bring() in which a candidate became a contact
    double *history, *push;
    ByGrain sorted, candidates;
    const std::int32_t*
        late_start;  // contacts that began since the last refresh, as ByGrain has them; at first
    std::int32_t *late_at, *late_count;  // late_count[i] of them
};

// What an evaluation told, and whether the lists have expired (engine/step/lists/expiry.hpp).
struct Told {
    std::uint64_t fastest[3];  // bits of doubles >= 0, which have the order of the numbers
    std::int64_t parted;
};
struct Status {
    double moved, fastest;
    std::int64_t parted_in_all, parted_now;
    std::int32_t expired, evaluations;
};

struct Bed {
    std::int32_t grains, groups;
    double *place, *motion, *load, *wall_work;
    const std::int32_t* species;
    double period;
    bool rubs, plane_arms;
    const Group* group;
    Status* status;
    Told* told;  // of each evaluation of a run
};

// One evaluation; see DeviceStep (engine/step/step_device.hpp).
struct Step {
    std::int32_t number, told;  // since bring(); of the run
    bool begins_run, drags, any_round;
    double gravity[3], frame[3];
    double end_kick, begin_kick, keep, closing_drift, drift;
    double since, ahead, acts, turns;
    double wall_way, skin;
    const double *faces, *wall_motion;  // FaceRecord and FaceMotion (engine/step/geometry/walls.hpp)
};

}  // namespace grainreel::card
