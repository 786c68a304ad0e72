// The plan: what the engine does for a scene (laws, stiffness, step), and what that will cost.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "engine/base/clock.hpp"
#include "engine/plan/times.hpp"
#include "engine/scene/scene.hpp"

namespace grainreel {

// The law of the normal force for one kind of contact. The plan takes the simplest law that does what the
// scene asks for.
enum class NormalForce {
    walton_braun,
    walton_braun_corrected,
    walton_braun_speed,
    walton_braun_table,
    spring_dashpot,
    hertz
};
struct LawKernel;

struct ContactModel {
    NormalForce normal = NormalForce::walton_braun;
    TangentialLaw tangential = TangentialLaw::incremental_slip;  // `none` when nothing rubs
    bool rolls = false;  // resists rolling; only where there is friction
    Precision precision = Precision::full;
    const LawKernel* own = nullptr;  // a caller's law in place of these; scenes have none
    bool operator==(const ContactModel&) const = default;
};

// The numbers of one kind of contact, ready for the laws. SI units.
struct PairPlan {
    ContactModel model;
    double effective_mass = 0;       // kg, of the lightest pair of these species
    double loading_stiffness = 0;    // N/m: K1 (Walton-Braun), kn (spring-dashpot), dN/da at the allowed
                                     // overlap of the smallest (Hertz)
    double unloading_stiffness = 0;  // N/m: K2 = K1 / e^2; equals K1 for laws with a dashpot
    double hardening = 0;  // 1/m: S of K2 = K1 + S F_max, in place of a constant K2 (unloading_stiffness is
                           // then K2 at v*)
    std::vector<RestitutionPoint> restitution_table;  // in place of one e: K2 = K1 / e(v)^2
    double modulus = 0;                               // Pa, E* of Hertz
    double tangential_stiffness = 0;                  // N/m: K0 or kt; Mindlin: at the allowed overlap
    double tangential_ratio = 0;  // tangential stiffness divided by normal stiffness (Mindlin)
    double gamma = 0;
    double restitution = 1;  // at v* where it depends on speed
    double friction = 0;
    double rolling_friction = 0;
    // The dashpots: damping rates (1/s), to be multiplied by the effective mass of the touching pair. The
    // value `..._by_root` (kg^(1/2)/s), divided by the root of that mass, is added to each rate; this keeps
    // one restitution for grains of all sizes.
    double normal_damping = 0, tangential_damping = 0;
    double damping_by_root = 0, tangential_damping_by_root = 0;
    double hertz_damping = 0;    // d of Hertz' dashpot d sqrt(m k) a^(1/4) v
    bool attraction = false;     // the dashpot may pull
    double contact_time = 0;     // s, of a free impact
    double allowed_overlap = 0;  // m
    // Which condition binds: "impact", "static load", "wave", "the scene", "the start file", "overlaps in the
    // start file".
    std::string stiffness_reason;

    double damping_rate(double mass) const;             // 1/s, of the normal dashpot at this effective mass
    double tangential_damping_rate(double mass) const;  // 1/s, of the tangential dashpot
    // The restitution of a free impact at this speed (m/s) between two bodies of this effective mass (kg).
    double restitution_of(double mass, double speed) const;
    bool operator==(const PairPlan&) const = default;
};

// What a plan takes from the file that a run starts from (engine/start/start_plan.cpp reads it).
struct StartFacts {
    bool known = false;  // whether the file could be read; the other fields hold only then
    // Stiffness (N/m; with Hertz Pa) in the run that wrote the file, by kind of contact as in Plan. Empty
    // where that run has another law, or where the file does not tell.
    std::vector<std::optional<double>> grain, wall, glued, mesh;
    double linear = 0, modulus = 0;  // N/m and Pa; the stiffness with which the file's overlaps carry the
                                     // bed's weight; 0 where they do not tell
    double speed = 0;                // m/s, of the impacts to expect
};

// How a run begins if it starts from a file.
struct StartPlan {
    bool keeps_histories = false;  // contacts keep their histories if their law is that of the file's run
    bool relaxes = false;          // the file's bed comes to rest under the scene's laws before step 0
    std::string text;              // for the user: what happens to stiffness, histories and bed
};

struct Plan {
    LeverArms arms = LeverArms::contact_plane;
    Integrator integrator = Integrator::velocity_verlet;
    bool moving_walls = false;

    std::vector<PairPlan> grain;  // species x species, row-major
    std::vector<PairPlan> wall;   // one for each species
    std::vector<PairPlan>
        glued;  // one for each species, for contacts with grains glued to walls; empty without such grains
    std::vector<PairPlan> mesh;  // mesh x species, row-major

    Clock clock;
    std::int64_t steps = 0;                                     // steps of the run itself, from step 0 on
    std::int64_t settle_steps_limit = 0, rain_steps_limit = 0;  // most steps of settling and of rain
    StartPlan start;                                            // only where the run starts from a file
    std::string step_reason;                                    // names the condition that binds the step
    double impact_speed = 0;                                    // m/s, v* of the stiffness rule
    double wall_speed = 0;  // m/s, of the fastest wall with a motion of its own (reach.hpp)
    // Overlap divided by the smaller diameter: the largest that is expected, and that of most contacts.
    // `deepest` names the kind of contact that has the largest.
    double expected_overlap = 0, usual_overlap = 0;
    std::string deepest;

    // Number of steps between records, not always whole: a record is taken at the step nearest to a multiple,
    // so the times do not drift. 0: no records.
    double trajectory_every = 0, measures_every = 0;
    FieldTimes fields;  // when fields are measured, if there are any
    // `capacity` is the greatest number of grains that there will ever be, including those that have left.
    // `traffic` says whether grains may leave or come.
    std::int64_t capacity = 0;
    bool traffic = false;
    std::optional<std::int64_t> opens;  // the step in which the container's outlet opens
    // Where a drive changes and the scene gives no interval, this is the number of periods of the drive's
    // present stage between records; trajectory_every and measures_every are then mean numbers of steps. 0:
    // records come by steps.
    double trajectory_periods = 0, measures_periods = 0;
    double bed_height = 0;              // m, expected, at a solid fraction of 0.6
    std::vector<std::string> warnings;  // one line each, with place and remedy

    // Whether any contact has friction, and whether any resists rolling.
    bool rubs() const;
    bool rolls() const;

    const PairPlan& between(std::size_t a, std::size_t b) const { return grain[a * wall.size() + b]; }
    const PairPlan& at_mesh(std::size_t number, std::size_t a) const {
        return mesh[number * wall.size() + a];
    }
};

// Plans the scene's run; reads the file that it starts from, if there is one (engine/start/start_plan.cpp).
// Throws UserError when the scene cannot be run as it stands (does not fit, too many steps, no stiffness).
Plan make_plan(const Scene& scene);
// The same with facts about the start file that are known already. Does not fill in Plan::start.
Plan make_plan(const Scene& scene, const StartFacts& file);

}  // namespace grainreel
