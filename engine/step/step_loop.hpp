// The step loop: neighbours -> walls -> contacts -> integrate, on a team of threads.
//
// Why the bits do not depend on the number of threads: grains are in one spatial order whatever the team,
// every thread computes all contacts of its own grains, and every grain sums its contacts in one order: walls
// before pairs, law by law; of one law first those that began since the last refresh, by the step in which
// they did, then as second partner by rising index of the first, as first partner by rising index of the
// second.
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

// The surroundings of the grains, which the loop only reads.
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

    // Takes the grains as they are now: all contacts are new. Call after changing positions, radii or faces.
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

    // In the same order on any number of threads.
    void visit_contacts(std::int64_t at_step, const std::function<void(const ContactView&)>& visit) const;

    // Lists and histories, bit by bit, for checkpoints and hashes. Grains are saved by their owner.
    void save(std::ostream& out) const;
    // For grains that are in order themselves. Makes the reading fail where what it reads is not such as the
    // loop makes: no index is believed.
    void load(Bytes& in);
    // Whether no step has been made since restart(); not among what is saved.
    bool is_fresh() const { return fresh_; }
    void set_fresh(bool fresh) { fresh_ = fresh; }
    // Whether grains carry derivatives along from step to step.
    bool carries_derivatives() const { return scheme_.corrects && !fresh_; }

    std::int64_t rebuilds() const { return rebuilds_; }
    std::int64_t refreshes() const { return refreshes_; }
    // Whether run() notes which stage takes how long, which slows it by some 5 %. Shares of all the time so
    // noted since the last clear_costs(), summed over the threads.
    void time_costs(bool on);
    void clear_costs();
    std::array<double, kCosts> cost_shares() const;

    std::size_t listed_pairs() const { return lists_.pairs.size(); }

  private:
    // How far the contact lists reach, and what has used that up since their last refresh. Every thread keeps
    // its own, and all are alike.
    struct Reach {
        double skin = 0;          // m
        double moved = 0;         // m, that no grain has surpassed against the bed's free flight
        double fastest = 0;       // m/s, of the last step
        std::int64_t parted = 0;  // contacts that were computed in vain, summed over the steps
        Vec3 drift{0, 0, 0};      // m, of the free flight at the refresh
        Pose pose;                // likewise
    };

    // What the others are told of a thread at a step.
    struct alignas(64) Told {
        Vec3 fastest{0, 0, 0};    // m/s, largest components of its grains against the bed's free flight
        std::int64_t parted = 0;  // contacts of its grains that no longer touched in the last step
        bool may_leave = false;   // one of its grains, at the end of this step
    };

    // What a thread writes; a cache line apart from the next thread's.
    struct alignas(64) Member {
        ContactPass contacts;
        WallState walls;
        std::vector<KeptContacts> leaving;  // for other threads, by group
        NeighbourList pairs;                // its part of the search, where there are several threads
        std::vector<WallNeighbour> walls_near;
        Reach reach;
        Vanguard ahead;  // its grains that go on before the others
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

    // The forces of a stage: when (in steps), where the walls are then, and what went before.
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
    Shares search_share_, last_search_share_;  // who looks for whose neighbours
    std::vector<std::int32_t> new_index_;      // of the grains before the last reordering
    std::vector<std::int32_t> contacts_;       // of each grain, as first body, when the lists were made

    // Where and how the grains and walls were when the lists were made.
    std::vector<Eigen::Vector3f> listed_at_;  // half the memory, and its rounding is allowed for
    Vec3 listed_velocity_{0, 0, 0};
    Pose listed_pose_;
    double listed_step_ = 0;             // steps
    double skin_, next_skin_;            // m, of the neighbour lists and of those in the making
    bool fresh_ = true;                  // restarted: the next run() says at which step the lists were made
    std::int64_t first_step_ = kGoesOn;  // of the first run after a restart: nothing moved before it
    static constexpr std::int64_t kGoesOn = std::numeric_limits<std::int64_t>::min();
    std::int64_t rebuilds_ = 0, refreshes_ = 0;

    Traffic traffic_;
    std::vector<Departure> departures_;  // nobody has asked for yet
};

}  // namespace grainreel
