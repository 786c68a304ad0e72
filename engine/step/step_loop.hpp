// The step loop: neighbours -> walls -> contacts -> integrate, on a team of threads.
//
// The bits do not depend on the number of threads, for three reasons. The grains have one spatial order,
// whatever the team. Every thread computes all contacts of its own grains. Every grain sums its contacts in
// one order: walls before pairs, law by law. Within a law, the contacts that began since the last refresh
// come first, in the order in which they began. Then come the contacts in which the grain is the second body,
// by rising first body, then those in which it is the first body, by rising second body.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <iosfwd>
#include <limits>
#include <vector>

#include "engine/base/team.hpp"
#include "engine/plan/plan.hpp"
#include "engine/state/container_faces.hpp"
#include "engine/state/grains.hpp"
#include "engine/state/wall_motion.hpp"
#include "engine/step/contact_view.hpp"
#include "engine/step/forces/contact_pass.hpp"
#include "engine/step/forces/integrate.hpp"
#include "engine/step/forces/scheme.hpp"
#include "engine/step/grid/cells.hpp"
#include "engine/step/grid/neighbours.hpp"
#include "engine/step/traffic.hpp"

namespace grainreel {

class Bytes;

// The surroundings of the grains. The loop reads them and never changes them.
struct Surroundings {
    std::vector<Face> faces;
    WallMotion motion;
    Vec3 gravity{0, 0, 0};    // m/s2
    double period = 0;        // m, of x; 0 for none
    double skin = 0;          // m, of the first neighbour lists; later ones follow the motion
    std::vector<Exit> exits;  // through which grains leave; may change between two runs
};

class StepLoop {
  public:
    // Grains, surroundings and team must outlive the loop.
    StepLoop(const Plan& plan, const Surroundings& surroundings, Grains& grains, Team& team);

    // Starts from the grains as they are now, without any contact history. Call it after positions, radii or
    // faces have changed.
    void restart();

    // Runs `count` steps of `step` seconds from absolute step `from` (which sets the walls' phase).
    // drag: 1/s, slows every grain's velocity and spin; 0 for none (settling and growing only).
    // Grains in an exit at the end of a step leave then, and the others go on without them.
    void run(std::int64_t from, std::int64_t count, double step, double drag);

    // Between two runs, `step` being the one that has been reached. Grains that are not there are left out.
    void remove(const std::vector<std::int32_t>& ids, std::int64_t step);
    // Likewise, after a restart(). New grains must touch nothing. They get rising ids, none of which any
    // grain has had; returns the first of them.
    std::int32_t insert(const std::vector<NewGrain>& grains);
    const Traffic& traffic() const { return traffic_; }
    // Who has left since the last call, by step, then by id.
    std::vector<Departure> take_departures();
    // From now on: nobody has come or left.
    void begin_account() { traffic_ = {.next_id = traffic_.next_id}; }

    // Shows all touching contacts, in the same order on any number of threads.
    void visit_contacts(std::int64_t at_step, const std::function<void(const ContactView&)>& visit) const;

    // Writes lists and histories, bit by bit, for checkpoints and hashes. The owner of the grains saves them.
    void save(std::ostream& out) const;
    // Reads what save() wrote. The grains must be in order already. The reading fails where the loop could
    // not have written what is read; no index is trusted.
    void load(Bytes& in);
    // Whether no step has been made since restart(). save() does not write this.
    bool is_fresh() const { return fresh_; }
    void set_fresh(bool fresh) { fresh_ = fresh; }
    // Whether grains carry derivatives along from step to step.
    bool carries_derivatives() const { return scheme_.corrects && !fresh_; }

    std::int64_t rebuilds() const { return rebuilds_; }
    std::int64_t refreshes() const { return refreshes_; }
    // time_costs() says whether run() measures how long each stage takes; this slows it by some 5 %.
    // cost_shares() gives each stage's share of the time measured since clear_costs(), over all threads.
    void time_costs(bool on);
    void clear_costs();
    std::array<double, kCosts> cost_shares() const;

    std::size_t listed_pairs() const { return lists_.pairs.size(); }

  private:
    // How far the contact lists reach, and how much of that has been used up since their last refresh. Every
    // thread has its own copy, and all copies are equal.
    struct Reach {
        double skin = 0;          // m
        double moved = 0;         // m; no grain has moved farther relative to the bed's free flight
        double fastest = 0;       // m/s, the largest speed of the last step
        std::int64_t parted = 0;  // contacts that were computed in vain, summed over the steps
        Vec3 drift{0, 0, 0};      // m, displacement of the free flight at the refresh
        Pose pose;                // of the walls at the refresh
    };

    // What a thread tells the others in each step.
    struct alignas(64) Told {
        Vec3 fastest{0, 0, 0};    // m/s, largest components of its grains against the bed's free flight
        std::int64_t parted = 0;  // contacts of its grains that no longer touched in the last step
        bool may_leave = false;   // one of its grains, at the end of this step
    };

    // What a thread writes. It shares no cache line with what another thread writes.
    struct alignas(64) Member {
        ContactPass contacts;
        WallState walls;
        std::vector<KeptContacts> leaving;  // for other threads, by group
        NeighbourList pairs;                // its part of the search, where there are several threads
        std::vector<WallNeighbour> walls_near;
        Reach reach;
        Vanguard ahead;  // its grains that begin the next step early
        CostClock clock;
        Vec3 fastest{0, 0, 0};     // m/s, as it will be told
        Told told[2];              // of this step and the one before, which others may still read
        int box = 0;               // which of the two it is, and of its halo's boxes
        double farthest = 0;       // m, from where they were listed
        bool may_leave = false;    // as it will be told
        std::int64_t reached = 0;  // the step that a run ended at
        // Of its share of the grains: work in units of a grain, without contacts and of these when the
        // grains were shared out; ticks that it was busy, before and in all.
        double work = 0, contact_work = 0;
        double busy_before = 0, busy_in_all = 0, busy_refreshing = 0;
        double speed = 1;         // lately, against the mean of all
        double searched_for = 0;  // ticks
    };

    // The forces of a stage: at which time, where the walls are then, and how long ago the last forces were.
    struct Evaluation {
        double time;   // steps
        double since;  // s, since the last forces
        double acts;   // s, that these will act
        Pose before, now;
    };
    void begin_empty();
    std::int64_t run_until_one_may_leave(std::int64_t from, std::int64_t to, double step, double drag);
    Evaluation evaluation(std::int64_t n, std::size_t stage, double step) const;
    void run_member(int member, std::int64_t from, std::int64_t to, double step, KickInput kicks);
    KickInput kicks_before(const Evaluation& at, std::size_t stage, bool first, double step,
                           KickInput kicks) const;
    void move(int member, bool first, const KickInput& kicks);
    void copy_foreign(int member);
    void exchange(int member, const Flight& flight);
    void begin_evaluation(int member, bool first, const Evaluation& at, double step, const KickInput& kicks);
    void send_ahead(int member, bool goes_on, const KickInput& kicks);
    void evaluate(int member, const Evaluation& at);
    void end_run(int member, double step, KickInput kicks);
    void renew_contacts(int member, const Evaluation& at, double step, const KickInput& kicks);

    bool in_exit(std::int32_t grain) const;
    bool may_leave(int member) const;
    bool anyone_may_leave(const Member& mine) const;
    void let_leave(std::int64_t step);
    void take_out(const std::vector<std::int32_t>& leavers, std::int64_t step);
    void note_departures(const std::vector<std::int32_t>& leavers, std::int64_t step);
    void add(const NewGrain& grain);
    void renew_shares();

    Vec3 drift_since_listing(double time, double step) const;
    bool contacts_expired(Member& mine, const Pose& now, const Vec3& drift, double passed) const;
    bool lists_expired(const Member& mine, const Pose& now, const Vec3& drift) const;
    double farthest() const;
    static constexpr float kNowhere = 1e6;  // m: where grains count as listed that came after the lists
    double farthest_of(std::int32_t begin, std::int32_t end, const Vec3& drift) const;
    void set_reach(Member& mine, const Pose& now, const Vec3& drift, const Vec3& frame, double step) const;
    void rebuild(int member, const Pose& pose, double time, double lasted);
    static constexpr double kLastsWell = 1000;                  // steps, of lists whose skin is right
    static constexpr double kLeastSkin = 0.5, kMostSkin = 2.8;  // over that of the surroundings
    double skin_after(double lasted) const;
    void join_lists(const TeamMember& me);
    void note_listing(const Pose& pose, double time);
    void note_speeds();
    void share_out();
    void share_search();
    void place_halos();
    void refresh(int member);
    ContactView view(bool rubs, std::int32_t first, std::int32_t second, int at, const TouchChunk& touch,
                     const ForceChunk& force, const EnergyChunk& energy) const;
    std::vector<KeptContacts> all_kept() const;
    bool is_traffic_sound() const;
    bool is_sound(const std::vector<KeptContacts>& kept, std::int32_t steps, const Reach& reach) const;
    template <class Loop, class Kept, class ReachType, class Each>
    static void transfer(Loop& loop, Kept& kept, std::int32_t& steps, ReachType& reach, const Each& each);

    const Surroundings& around_;
    Grains& grains_;
    Team& team_;
    const ContactRules rules_;
    const Scheme scheme_;
    Cells cells_;
    NeighbourLists lists_;
    std::vector<Member> members_;
    Shares share_, last_share_;
    Shares search_share_, last_search_share_;  // the grains whose neighbours each thread searches for
    std::vector<std::int32_t> new_index_;      // the new index of each grain in the last reordering
    std::vector<std::int32_t> contacts_;       // of each grain as first body, when the lists were made

    // State of the grains and walls when the lists were made.
    std::vector<Eigen::Vector3f> listed_at_;  // m; floats to save memory, and their rounding is counted
    Vec3 listed_velocity_{0, 0, 0};
    Pose listed_pose_;
    double listed_step_ = 0;             // steps
    double skin_, next_skin_;            // m, of the neighbour lists and of those being made
    bool fresh_ = true;                  // after restart(): the next run() sets the step of the lists
    std::int64_t first_step_ = kGoesOn;  // of the first run after a restart; nothing moved before it
    static constexpr std::int64_t kGoesOn = std::numeric_limits<std::int64_t>::min();
    std::int64_t rebuilds_ = 0, refreshes_ = 0;

    Traffic traffic_;
    std::vector<Departure> departures_;  // nobody has asked for yet
};

}  // namespace grainreel
