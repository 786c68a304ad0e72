// The step loop: neighbours -> contacts -> walls -> integrate, by velocity Verlet, on a team of threads.
//
// Why the bits do not depend on the number of threads: grains are in one spatial order whatever the team,
// every contact is computed once, by the thread that owns its first grain, into a slot of its own, and every
// grain then sums its slots in one order: as second partner by rising index of the first, as first partner by
// rising index of the second, walls last.
#pragma once

#include <cstdint>
#include <functional>
#include <iosfwd>
#include <memory>
#include <vector>

#include "engine/scene/plan.hpp"
#include "engine/state/container_faces.hpp"
#include "engine/state/grains.hpp"
#include "engine/state/wall_motion.hpp"
#include "engine/step/team.hpp"

namespace grainreel {

// The surroundings of the grains, which the loop only reads.
struct Surroundings {
    std::vector<Face> faces;
    WallMotion motion;
    Vec3 gravity{0, 0, 0};  // m/s2
    double period = 0;      // m, of x; 0 for none
    double skin = 0;        // m, of the neighbour lists
};

// One touching contact as an observer sees it.
struct ContactView {
    std::int32_t first;     // index of a grain
    std::int32_t second;    // index of a grain, or -1 - face
    Vec3 normal;            // unit, from first to second
    double overlap;         // m
    double smaller_radius;  // m
    double normal_force;    // N
    Vec3 tangential;        // N, on second
    double stored_energy;   // J
    Vec3 point;             // m
};

class StepLoop {
  public:
    virtual ~StepLoop() = default;

    // Takes the grains as they are now: all contacts are new. Call after changing positions, radii or faces.
    virtual void restart() = 0;

    // Runs `count` steps of `step` seconds from absolute step `from` (which sets the walls' phase).
    // drag: 1/s, slows every grain's velocity and spin; 0 for none (settling and growing only).
    virtual void run(std::int64_t from, std::int64_t count, double step, double drag) = 0;

    virtual void visit_contacts(std::int64_t at_step,
                                const std::function<void(const ContactView&)>& visit) const = 0;

    // Lists and histories, bit by bit, for checkpoints and hashes. Grains are saved by their owner.
    virtual void save(std::ostream& out) const = 0;
    virtual void load(std::istream& in) = 0;

    virtual std::int64_t rebuilds() const = 0;
    virtual std::size_t listed_pairs() const = 0;
};

// The one place where a law is chosen at run time. Grains, plan, surroundings and team must outlive the loop.
std::unique_ptr<StepLoop> make_step_loop(const Plan& plan, const Surroundings& surroundings, Grains& grains,
                                         Team& team);

}  // namespace grainreel
