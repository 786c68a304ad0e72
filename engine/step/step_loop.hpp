// The step loop: the order in which a step does its work, on a team of threads. A step kicks the grains
// (changes velocities by forces), lets them drift (move), keeps the neighbour lists up to date, and computes
// contacts. The parts have files of their own:
//   motion/scheme.hpp             when forces are evaluated, and the kicks and drifts between two evaluations
//   lists/list_life.hpp           how long lists last
//   lists/bed_lists.hpp           the lists
//   threads/work_shares.hpp       which grains each thread has
//   forces/contact_forces.hpp     the forces
//   step_loop_device.cpp          the loop where a graphics card computes the steps
//   step_loop_traffic.cpp         grains that leave and enter, and walls that change
//   step_loop.cpp                 the loop itself, its state for checkpoints, and what ends a run
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <iosfwd>
#include <limits>
#include <memory>
#include <vector>

#include "engine/base/team.hpp"
#include "engine/plan/plan.hpp"
#include "engine/state/grains.hpp"
#include "engine/state/traffic.hpp"
#include "engine/step/contact_view.hpp"
#include "engine/step/forces/contact_forces.hpp"
#include "engine/step/lists/bed_lists.hpp"
#include "engine/step/motion/scheme.hpp"
#include "engine/step/step_device.hpp"
#include "engine/step/surroundings.hpp"

namespace grainreel {

class Bytes;

class StepLoop {
  public:
    // Grains, surroundings and team must outlive the loop.
    StepLoop(const Plan& plan, const Surroundings& surroundings, Grains& grains, Team& team);

    // Lets a device compute the steps from now on. The team must have one thread, and the device must take
    // the scene.
    void use(std::unique_ptr<StepDevice> device);

    // Starts from the grains as they are now, without any contact history. Call it after positions, radii or
    // faces have changed.
    void restart();

    // Call this after a restart(). Gives histories to contacts that touch, and sets the forces to those that
    // follow from the histories. history_of gets a group of contacts, the indices of the two bodies (as in
    // ContactTable) and the numbers of the history to fill in. It returns whether there is a history for
    // them. It must answer the same on every thread.
    using HistoryOf =
        std::function<bool(std::size_t group, std::int32_t first, std::int32_t second, double* to)>;
    void take_histories(const HistoryOf& history_of);

    // Runs `count` steps of `step` seconds from step number `from`, which determines where the walls are.
    // drag: 1/s, slows every grain's velocity and spin; 0 for none (settling and growing only). Grains in an
    // exit at the end of a step leave then, and the others go on without them.
    void run(std::int64_t from, std::int64_t count, double step, double drag);

    // Lets the grains that are in an exit leave between two runs. `step` is the step that has been reached.
    void let_leave(std::int64_t step);
    // Takes grains out between two runs. `step` is the step that has been reached. Ids that no grain has are
    // ignored.
    void remove(const std::vector<std::int32_t>& ids, std::int64_t step);
    // Adds grains between two runs, after a restart(). New grains must touch nothing. They get rising ids
    // that no grain has had. Returns the first of these ids.
    std::int32_t insert(const std::vector<ComingGrain>& grains);
    // Lets `change` open an outlet between two runs, so that faces of the surroundings end or have a gap.
    // Faces keep their numbers, and no face may grow.
    void open_faces(const std::function<void()>& change, std::int64_t step);
    const Traffic& traffic() const { return traffic_; }
    // The grains that have left since the last call, by step, then by id.
    std::vector<Departure> take_departures();
    // The same grains, which stay there to be taken.
    const std::vector<Departure>& departures() const { return departures_; }
    // Sets the counts of grains that have come and left, and their energies, to zero.
    void begin_account() { traffic_ = {.next_id = traffic_.next_id}; }

    // Sums the forces of grains on the walls from now on. The first forces are those of the last evaluation.
    // If walls were not tallied then, they are the forces that contacts have at the present step, `step`. The
    // tally does not change the run. It takes a few percent of the time that the walls take.
    void tally_walls(const WallScale& scale, std::int64_t step);
    // Like tally_walls(), but goes on from the sums `before`. Their vectors must fit the numbers of faces and
    // slices.
    void go_on_tallying(const WallSums& before, const WallScale& scale);
    WallSums wall_sums() const;

    // Shows all touching contacts, in the same order on any number of threads.
    void visit_contacts(std::int64_t at_step, const std::function<void(const ContactView&)>& visit) const;

    // Writes lists and histories, bit by bit, for checkpoints and hashes. The grains are not written here;
    // their owner saves them.
    void save(std::ostream& out) const;
    // Reads what save() wrote. The grains must be in order already. Reading fails for anything that the loop
    // cannot have written; no index is trusted.
    void load(Bytes& in, std::int64_t at_step);
    // Whether no step has been made since restart(). save() does not write this; a checkpoint keeps it
    // separately.
    bool is_fresh() const { return fresh_; }
    void set_fresh(bool fresh) { fresh_ = fresh; }
    // Whether grains carry derivatives along from step to step.
    bool carries_derivatives() const { return scheme_.corrects && !fresh_; }

    std::int64_t rebuilds() const { return lists_.rebuilds(); }
    std::int64_t refreshes() const { return lists_.refreshes(); }
    // time_costs() says whether run() measures how long each stage takes; this slows it by some 5 %.
    // cost_shares() gives each stage's share of the time measured since clear_costs(), over all threads.
    void time_costs(bool on);
    void clear_costs();
    std::array<double, kCosts> cost_shares() const;

    std::size_t listed_pairs() const { return lists_.listed_pairs(); }

  private:
    // The message of a thread to the others in each evaluation of forces.
    struct alignas(64) Told {
        Vec3 fastest{0, 0,
                     0};  // m/s, largest velocity components of its grains relative to the bed's free flight
        std::int64_t parted = 0;  // number of contacts of its grains that no longer touched in the last step
        bool may_leave = false;   // whether one of its grains may leave at the end of this step
    };

    // The data that a thread writes. They share no cache line with the data of another thread.
    struct alignas(64) Member {
        WallState walls;
        WallTally tally;
        ChunkMemory memory;
        Vanguard ahead;  // its grains that begin the next step early
        CostClock clock;
        Vec3 fastest{0, 0, 0};  // m/s, largest velocity components of its grains, for the next message
        Told told[2];           // messages of this evaluation and the one before, which others may still read
        int box = 0;            // which of the two messages, and of the two boxes of its halo, is in use
        std::int64_t reached = 0;  // the step that a run ended at
    };

    double last_share() const;
    void run_member(int member, std::int64_t from, std::int64_t to, double step, KickInput kicks);
    void run_on_device(std::int64_t from, std::int64_t to, double step, KickInput kicks);
    std::vector<DeviceStep> steps_ahead(Evaluations evaluations, std::int64_t to, double step,
                                        KickInput kicks, bool begins_run) const;
    void set_kicks(const Evaluations& evaluations, const Evaluation& at, double step, KickInput& kicks) const;
    void move(int member, bool first, const KickInput& kicks);
    Told exchange(int member, const FreeFlight& flight, bool may_leave);
    void send_ahead(int member, bool goes_on, const KickInput& kicks);
    void end_run(int member, double step, KickInput kicks);
    void copy_foreign(int member);

    bool in_exit(std::int32_t grain) const;
    bool may_leave(int member, double step) const;
    void check_meshes() const;
    void end_with_fault() const;
    void take_out(const std::vector<std::int32_t>& leavers, std::int64_t step);
    std::vector<bool> note_departures(const std::vector<std::int32_t>& leavers, std::int64_t step);
    void sum_loads_anew(const std::vector<bool>& of, std::int64_t step);
    void add(const ComingGrain& grain);
    bool is_traffic_sound() const;

    const Surroundings& around_;
    Grains& grains_;
    Team& team_;
    const ContactRules rules_;
    const Scheme scheme_;
    const Clock clock_;  // for messages
    BedLists lists_;
    std::vector<Member> members_;
    bool fresh_ = true;                  // after restart(): the next run() sets the step of the lists
    std::int64_t first_step_ = kGoesOn;  // first step after a restart; nothing moved before it
    static constexpr std::int64_t kGoesOn = std::numeric_limits<std::int64_t>::min();

    Traffic traffic_;
    std::vector<Departure> departures_;  // departures that nobody has asked for yet

    std::unique_ptr<StepDevice> device_;  // nullptr: this processor computes the steps
};

}  // namespace grainreel
